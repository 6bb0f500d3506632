//! Code that cases of several families share.

mod arrangement;
mod gate;
mod metrics;
pub(crate) mod transport_panel;

pub(crate) use arrangement::Arrangement;
pub(crate) use gate::close_by_gate;
pub(crate) use metrics::printed_laws;

use crate::reference::one_dimension::bed_load::Stream;
use bagnold_number::four_digits;

/// A quantity over the height.
pub(crate) type OverHeight<'a> = &'a (dyn Fn(f64) -> f64 + Sync);

/// Transport of bed load in the units of flumes with its 95 % interval by a source, from q* and its standard uncertainty `[-]`; none without a
/// value.
pub(crate) fn transport_in_units(stream: &Stream, transport: f64, uncertainty: f64, by: &str) -> Option<String> {
    let within = |unit: f64| {
        let bounds = [transport, (transport - 1.96 * uncertainty).max(0.0), transport + 1.96 * uncertainty];
        bounds.map(|bound| four_digits(bound * unit))
    };
    let area = stream.transport_unit();
    let [[mass, least, most], [volume, low, high], [own, lower, upper]] =
        [stream.grain_density * area, area, 1.0].map(within);
    transport.is_finite().then(|| {
        format!(
            "bed load of {mass} kg/(m s) (95 % by {by}: {least} … {most}), {volume} m²/s ({low} … {high}), q* = {own} ({lower} … {upper})"
        )
    })
}

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

/// Values in ascending order, each once.
pub(crate) fn ascending(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Least and largest of values that are not negative.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, 0.0), |(least, most), value| (value.min(least), value.max(most)))
}

/// A slope `[-]` in per cent.
pub(crate) fn percent(slope: f64) -> String {
    format!("{} %", (1e4 * slope).round() / 100.0)
}
