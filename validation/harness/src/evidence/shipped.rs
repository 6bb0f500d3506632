//! The tables of `reference-data` that the program carries: texts by name, and what is read from them once.

use super::MeasuredData;
use crate::input::FieldError;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

include!(concat!(env!("OUT_DIR"), "/reference_data.rs"));

/// Names and texts of all tables, such as `bagnold/friction.csv`, in the order of their names.
pub fn shipped_tables() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().copied()
}

/// A table by its name.
///
/// # Errors
/// If there is no such table, or it is malformed.
pub fn shipped_table(name: &str) -> Result<MeasuredData, FieldError> {
    let found = FILES.iter().find(|(own, _)| *own == name);
    let (_, text) =
        found.ok_or_else(|| FieldError::finding(name, "unknown table of the program", "correct its name"))?;
    MeasuredData::parse(&Path::new("reference-data").join(name), text)
}

/// What texts that the program carries hold, by their names without an ending; other texts are left out.
///
/// # Panics
/// If one is malformed. No user can bring that about: tests read every one of them.
pub(super) fn carried<T, E: Display>(
    texts: &[(&'static str, &'static str)],
    ending: &str,
    read: impl Fn(&'static str) -> Result<T, E>,
) -> BTreeMap<&'static str, T> {
    let texts = texts.iter().filter_map(|(name, text)| Some((name, name.strip_suffix(ending)?, text)));
    let read = |(name, key, text): (&&str, _, &&'static str)| {
        (key, read(text).unwrap_or_else(|error| panic!("failed to read {name}: {error}")))
    };
    texts.map(read).collect()
}

/// Value that `read` computes from a shipped table.
///
/// # Panics
/// If the table is not what `read` expects. No user can bring that about: the tables are part of the program, and tests
/// read every one of them.
pub fn read_shipped<T>(name: &str, read: impl FnOnce(&MeasuredData) -> Result<T, FieldError>) -> T {
    shipped_table(name).and_then(|table| read(&table)).unwrap_or_else(|error| panic!("{error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Confidence;

    #[test]
    fn every_table_is_read_and_no_row_is_surer_than_it_can_be() {
        assert!(FILES.len() > 15, "{} tables", FILES.len());
        for (name, _) in shipped_tables() {
            let table = shipped_table(name).unwrap_or_else(|error| panic!("{error}"));
            let rows = table.confidences().unwrap_or_else(|error| panic!("{error}"));
            assert!(!rows.contains(&Confidence::Exact), "{name}: a printed number is not exact");
        }
    }

    #[test]
    fn a_table_that_is_not_there_is_named() {
        let error = shipped_table("bagnold/no.csv").expect_err("absent").to_string();
        assert_eq!(error, "`bagnold/no.csv`: unknown table of the program; correct its name");
    }
}
