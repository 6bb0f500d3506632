//! Runs that differ in the value of a key, beside each other: a user's law and μ(I), two drag laws, two resolutions.

use crate::metric::{Value, Variant};
use crate::output::Table;
use crate::result::MetricsDocument;
use std::collections::BTreeMap;

/// A key that has one value in every run of either folder, another one in each.
#[derive(Debug, Clone, PartialEq)]
pub struct PairedKey {
    /// Name of the case.
    pub case: String,
    /// Key of the variant in which paired runs differ.
    pub key: String,
    /// Value in the first folder and in the other.
    pub values: [String; 2],
}

/// Gives runs of another folder the values that the runs of the first have for such keys, so that both are compared.
pub(super) fn pair(first: &MetricsDocument, other: &mut MetricsDocument, tables: &mut [Table]) -> Vec<PairedKey> {
    let theirs = single_values(other);
    let differs = |(key, own): (String, Value)| {
        let other = theirs.get(&key).filter(|other| **other != own)?;
        Some((key, own, other.clone()))
    };
    let differing: Vec<(String, Value, Value)> = single_values(first).into_iter().filter_map(differs).collect();
    for (key, own, theirs) in &differing {
        for entry in &mut other.metrics {
            entry.variant = with_value(&entry.variant, key, own);
        }
        let name = |value: &Value| Variant::of(key, value.clone()).file_name();
        for table in tables.iter_mut() {
            table.name = table.name.replace(&name(theirs), &name(own));
        }
    }
    let paired = |(key, own, theirs): (String, Value, Value)| PairedKey {
        case: first.case.clone(),
        key,
        values: [own.text().to_owned(), theirs.text().to_owned()],
    };
    differing.into_iter().map(paired).collect()
}

/// Keys with one value in all numbers that have them.
fn single_values(results: &MetricsDocument) -> BTreeMap<String, Value> {
    let mut values: BTreeMap<String, Option<Value>> = BTreeMap::new();
    for (key, value) in results.metrics.iter().flat_map(|entry| entry.variant.parts()) {
        let known = values.entry(key.to_owned()).or_insert_with(|| Some(value.clone()));
        if known.as_ref() != Some(value) {
            *known = None;
        }
    }
    values.into_iter().filter_map(|(key, value)| Some((key, value?))).collect()
}

fn with_value(variant: &Variant, wanted: &str, new: &Value) -> Variant {
    let replaced =
        |(key, value): (&str, &Value)| (key.to_owned(), if key == wanted { new.clone() } else { value.clone() });
    variant.parts().map(replaced).fold(Variant::default(), |all, (key, value)| all.and(&key, value))
}
