//! Numbers of several folders beside each other, the largest difference first.

use super::reading::Results;
use crate::metric::Variant;
use crate::number::two_digits;
use crate::result::MetricEntry;
use std::collections::BTreeSet;

/// A number in every folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the case.
    pub case: String,
    /// Name of the metric.
    pub metric: String,
    /// Variant of the run.
    pub variant: Variant,
    /// Unit of the compared values.
    pub unit: String,
    /// The number in every folder; none where the folder has no such number.
    pub entries: Vec<Option<MetricEntry>>,
    /// Largest difference from the first folder that has it, in its tolerances; none where fewer than two have it.
    pub tolerances: Option<f64>,
}

/// All numbers of some folders, the largest difference in tolerances first, then those that not all folders have, in the
/// order of the first folder.
pub fn differences(all: &[Results]) -> Vec<Difference> {
    let mut seen = BTreeSet::new();
    let mut differences: Vec<Difference> = all
        .iter()
        .flat_map(Results::entries)
        .map(|(case, entry)| (case.to_owned(), entry.name.clone(), entry.variant.clone(), entry.unit.clone()))
        .filter(|key| seen.insert(key.clone()))
        .map(|(case, metric, variant, unit)| {
            let find = |results: &Results| {
                let metrics = &results.cases.get(&case)?.document.metrics;
                metrics.iter().find(|entry| entry.name == metric && entry.variant == variant).cloned()
            };
            let entries: Vec<Option<MetricEntry>> = all.iter().map(find).collect();
            let tolerances = tolerances(&entries);
            Difference { case, metric, variant, unit, entries, tolerances }
        })
        .collect();
    // a stable sort keeps the cases' order among equals
    differences.sort_by(|a, b| b.tolerances.unwrap_or(-1.0).total_cmp(&a.tolerances.unwrap_or(-1.0)));
    differences
}

impl Difference {
    /// Change of the number in a folder from the first folder that has a value, absolute in its unit and relative to that value;
    /// the latter only where the value is not zero. None where nothing changed.
    pub fn change(&self, folder: usize) -> Option<(f64, Option<f64>)> {
        let first = self.entries.iter().flatten().find_map(|entry| entry.value)?;
        let change = self.entries.get(folder)?.as_ref()?.value? - first;
        (change != 0.0).then(|| (change, (first != 0.0).then(|| change / first.abs())))
    }

    /// Change as text, such as `+0.12 (+3.4 %)`.
    pub fn change_in_words(&self, folder: usize) -> Option<String> {
        let signed = |value: f64| format!("{}{}", if value > 0.0 { "+" } else { "" }, two_digits(value));
        let (change, relative) = self.change(folder)?;
        let share = relative.map(|relative| format!(" ({} %)", signed(100.0 * relative)));
        Some(signed(change) + &share.unwrap_or_default())
    }
}

impl Results {
    pub(super) fn entries(&self) -> impl Iterator<Item = (&str, &MetricEntry)> {
        self.cases.iter().flat_map(|(case, own)| own.document.metrics.iter().map(|metric| (case.as_str(), metric)))
    }
}

fn tolerances(entries: &[Option<MetricEntry>]) -> Option<f64> {
    let mut given = entries.iter().flatten();
    let first = given.next()?;
    let tolerance =
        |value: f64| (first.snapshot_tolerance * value.abs()).max(first.snapshot_floor).max(f64::MIN_POSITIVE);
    let moved = |other: &MetricEntry| match (first.value, other.value) {
        (Some(value), Some(other)) => (other - value).abs() / tolerance(value),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    given.map(moved).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Metric;

    fn entry(name: &str, value: f64) -> MetricEntry {
        let metric = Metric::observed(name, &Variant::default(), value, "m").with_snapshot_tolerance(0.01, 0.0);
        MetricEntry::from(&metric)
    }

    #[test]
    fn a_change_is_absolute_and_relative_to_a_base_that_is_not_zero() {
        let of = |values: &[f64]| Difference {
            case: "film".to_owned(),
            metric: "front".to_owned(),
            variant: Variant::default(),
            unit: "m".to_owned(),
            entries: values.iter().map(|value| Some(entry("front", *value))).collect(),
            tolerances: None,
        };
        assert_eq!(of(&[2.0, 2.1]).change_in_words(1).as_deref(), Some("+0.1 (+5 %)"));
        assert_eq!(of(&[-2.0, -2.1]).change_in_words(1).as_deref(), Some("−0.1 (−5 %)"));
        assert_eq!(of(&[0.0, 0.5]).change_in_words(1).as_deref(), Some("+0.5"));
        assert_eq!(of(&[2.0, 2.0]).change(1), None);
        assert_eq!(of(&[f64::NAN, 2.0]).change(1), None);
    }

    #[test]
    fn a_difference_is_counted_in_tolerances_of_the_first() {
        let moved = |a: f64, b: f64| tolerances(&[Some(entry("front", a)), None, Some(entry("front", b))]);
        assert!((moved(2.0, 2.1).expect("two") - 5.0).abs() < 1e-9);
        assert_eq!(moved(2.0, f64::NAN), Some(f64::INFINITY));
        assert_eq!(tolerances(&[None, Some(entry("front", 2.0))]), None);
    }
}
