//! Code that cases of several families share.

mod arrangement;
mod metrics;
pub(crate) mod transport_panel;

pub(crate) use arrangement::Arrangement;
pub(crate) use metrics::printed_laws;

/// Values in the order in which they come, each once.
pub(crate) fn distinct<T: PartialEq>(values: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for value in values {
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}

/// A slope `[-]` in per cent.
pub(crate) fn percent(slope: f64) -> String {
    format!("{} %", (1e4 * slope).round() / 100.0)
}
