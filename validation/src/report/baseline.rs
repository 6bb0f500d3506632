//! The committed baseline: what every metric was, and whether it has drifted since.

use super::error::BaselineError;
use crate::case::Tier;
use crate::figure::is_file_name;
use crate::metric::Metric;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Names one metric of one run of one case.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key {
    /// Case name.
    pub case: String,
    /// Metric name.
    pub metric: String,
    /// Variant.
    pub variant: String,
}

impl Key {
    /// The key of `metric` in `case`.
    #[must_use]
    pub fn of(case: &str, metric: &Metric) -> Self {
        Self { case: case.to_owned(), metric: metric.name.clone(), variant: metric.variant.clone() }
    }
}

/// Baseline values of any number of cases at one tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Baseline {
    values: BTreeMap<Key, Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    value: f64,
    unit: String,
}

/// How a metric relates to its baseline.
#[derive(Debug, Clone, PartialEq)]
pub enum Drift {
    /// There is no baseline value: nothing can have drifted.
    New,
    /// Within the metric's snapshot tolerance.
    Unchanged {
        /// value − baseline, in the metric's unit.
        change: f64,
        /// The baseline's value.
        baseline: f64,
    },
    /// Outside it.
    Drifted {
        /// value − baseline, in the metric's unit; NaN where one of them is.
        change: f64,
        /// The baseline's value.
        baseline: f64,
        /// How far the value might have moved, in the metric's unit.
        tolerance: f64,
    },
    /// The baseline is in another unit: it must be taken again.
    UnitChanged {
        /// The baseline's unit.
        unit: String,
    },
}

impl Drift {
    /// Whether this is a failed regression verdict.
    #[must_use]
    pub fn is_failure(&self) -> bool {
        matches!(self, Self::Drifted { .. } | Self::UnitChanged { .. })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    case: String,
    tier: Tier,
    metrics: Vec<Row>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    name: String,
    variant: String,
    /// `null` stands for a value that is not a number.
    value: Option<f64>,
    unit: String,
}

impl Baseline {
    /// The baseline that `metrics` of `case` would make.
    #[must_use]
    pub fn of(case: &str, metrics: &[Metric]) -> Self {
        let entry = |metric: &Metric| Entry { value: nine_digits(metric.value), unit: metric.unit.clone() };
        Self { values: metrics.iter().map(|metric| (Key::of(case, metric), entry(metric))).collect() }
    }

    /// Adds the values of another case.
    pub fn extend(&mut self, other: Self) {
        self.values.extend(other.values);
    }

    /// Whether it holds no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of `key`.
    #[must_use]
    pub fn value(&self, key: &Key) -> Option<f64> {
        self.values.get(key).map(|entry| entry.value)
    }

    /// The path of a case's file in the baseline folder.
    #[must_use]
    pub fn path(folder: &Path, case: &str, tier: Tier) -> PathBuf {
        folder.join(format!("{case}.{}.json", tier_name(tier)))
    }

    /// Reads the values of `case` from `folder`; a missing file is an empty baseline.
    ///
    /// # Errors
    /// If the file is there but cannot be read, is malformed, or belongs to another case or tier.
    pub fn read(folder: &Path, case: &str, tier: Tier) -> Result<Self, BaselineError> {
        if !is_file_name(case) {
            return Err(BaselineError::Name { name: case.to_owned() });
        }
        let path = Self::path(folder, case, tier);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Self::default()),
            Err(source) => return Err(BaselineError::Read { path, source }),
        };
        let file: File = serde_json::from_str(&text)
            .map_err(|error| BaselineError::Content { path: path.clone(), message: error.to_string() })?;
        if file.case != case || file.tier != tier {
            let message = format!("it holds the case {:?} at tier {}", file.case, tier_name(file.tier));
            return Err(BaselineError::Content { path, message });
        }
        let values = file.metrics.into_iter().map(|row| {
            let key = Key { case: case.to_owned(), metric: row.name, variant: row.variant };
            (key, Entry { value: row.value.unwrap_or(f64::NAN), unit: row.unit })
        });
        Ok(Self { values: values.collect() })
    }

    /// Writes the values of `case` into `folder`, sorted, so that a change of one value is a diff of one block.
    ///
    /// # Errors
    /// If the folder or file cannot be written.
    pub fn write(&self, folder: &Path, case: &str, tier: Tier) -> Result<PathBuf, BaselineError> {
        if !is_file_name(case) {
            return Err(BaselineError::Name { name: case.to_owned() });
        }
        let path = Self::path(folder, case, tier);
        let rows = self.values.iter().filter(|(key, _)| key.case == case).map(|(key, entry)| Row {
            name: key.metric.clone(),
            variant: key.variant.clone(),
            value: Some(entry.value).filter(|value| value.is_finite()),
            unit: entry.unit.clone(),
        });
        let file = File { case: case.to_owned(), tier, metrics: rows.collect() };
        let mut text = serde_json::to_string_pretty(&file)
            .map_err(|error| BaselineError::Content { path: path.clone(), message: error.to_string() })?;
        text.push('\n');
        let write_error = |path: &Path, source| BaselineError::Write { path: path.to_owned(), source };
        std::fs::create_dir_all(folder).map_err(|source| write_error(folder, source))?;
        std::fs::write(&path, text).map_err(|source| write_error(&path, source))?;
        Ok(path)
    }

    /// Whether `metric` of `case` has drifted: |value − baseline| > tolerance · |baseline| + floor.
    #[must_use]
    pub fn drift(&self, case: &str, metric: &Metric) -> Drift {
        let Some(entry) = self.values.get(&Key::of(case, metric)) else { return Drift::New };
        if entry.unit != metric.unit {
            return Drift::UnitChanged { unit: entry.unit.clone() };
        }
        let baseline = entry.value;
        let change = metric.value - baseline;
        let tolerance = snapshot_tolerance(metric, baseline);
        // The file cannot tell infinite values from missing ones, so both count as "not a number".
        let both_missing = !metric.value.is_finite() && !baseline.is_finite();
        if both_missing || change.abs() <= tolerance {
            Drift::Unchanged { change, baseline }
        } else {
            Drift::Drifted { change, baseline, tolerance }
        }
    }

    /// Baseline values of `case` that `metrics` no longer contain: a metric that vanishes is a regression too.
    #[must_use]
    pub fn vanished(&self, case: &str, metrics: &[Metric]) -> Vec<Key> {
        let measured: BTreeSet<Key> = metrics.iter().map(|metric| Key::of(case, metric)).collect();
        self.values.keys().filter(|key| key.case == case && !measured.contains(key)).cloned().collect()
    }
}

/// How far `metric` may move from `from` before it counts as changed, in the metric's unit.
pub(super) fn snapshot_tolerance(metric: &Metric, from: f64) -> f64 {
    metric.snapshot_tolerance * from.abs() + metric.snapshot_floor
}

/// The tier's name in files and on the page.
pub(super) fn tier_name(tier: Tier) -> &'static str {
    match tier {
        Tier::Quick => "quick",
        Tier::Paper => "paper",
        Tier::Fine => "fine",
    }
}

/// Nine significant digits: far below any tolerance, and a diff without noise in the last bits.
fn nine_digits(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metric(name: &str, value: f64) -> Metric {
        Metric::observed(name, "resolution=40", value, "%").with_snapshot_tolerance(0.01, 0.001)
    }

    #[test]
    fn values_survive_the_file_and_other_tiers_stay_apart() {
        let folder = tempfile::tempdir().expect("folder");
        let metrics = [metric("velocity_l2", 0.512_345_678_912), metric("wall_slip", f64::NAN)];
        let written = Baseline::of("bagnold", &metrics);
        let path = written.write(folder.path(), "bagnold", Tier::Quick).expect("written");
        assert!(path.ends_with("bagnold.quick.json"));
        let read = Baseline::read(folder.path(), "bagnold", Tier::Quick).expect("read");
        assert_eq!(read.value(&Key::of("bagnold", &metrics[0])), Some(0.512_345_679));
        assert!(read.value(&Key::of("bagnold", &metrics[1])).is_some_and(f64::is_nan));
        assert!(Baseline::read(folder.path(), "bagnold", Tier::Paper).expect("missing is empty").is_empty());
        assert!(Baseline::read(folder.path(), "../bagnold", Tier::Paper).is_err());
    }

    #[test]
    fn a_value_drifts_beyond_its_relative_tolerance_and_floor() {
        let baseline = Baseline::of("bagnold", &[metric("velocity_l2", 0.5)]);
        // 0.01 · 0.5 + 0.001 = 0.006
        assert!(!baseline.drift("bagnold", &metric("velocity_l2", 0.5059)).is_failure());
        assert!(!baseline.drift("bagnold", &metric("velocity_l2", 0.4941)).is_failure());
        assert!(baseline.drift("bagnold", &metric("velocity_l2", 0.5061)).is_failure());
        assert!(baseline.drift("bagnold", &metric("velocity_l2", 0.4939)).is_failure());
        assert!(baseline.drift("bagnold", &metric("velocity_l2", f64::NAN)).is_failure());
        assert_eq!(baseline.drift("bagnold", &metric("other", 1.0)), Drift::New);
        assert_eq!(baseline.drift("film", &metric("velocity_l2", 1.0)), Drift::New);
        let mut other_unit = metric("velocity_l2", 0.5);
        other_unit.unit = "-".to_owned();
        assert!(baseline.drift("bagnold", &other_unit).is_failure());
    }

    #[test]
    fn a_value_that_is_not_a_number_drifts_only_by_becoming_one() {
        let baseline = Baseline::of("bagnold", &[metric("gci", f64::NAN)]);
        assert!(!baseline.drift("bagnold", &metric("gci", f64::NAN)).is_failure());
        assert!(baseline.drift("bagnold", &metric("gci", 1.0)).is_failure());
    }

    #[test]
    fn vanished_metrics_are_named() {
        let mut baseline = Baseline::of("bagnold", &[metric("velocity_l2", 0.5), metric("gci", 0.1)]);
        baseline.extend(Baseline::of("film", &[metric("velocity_l2", 0.5)]));
        let vanished = baseline.vanished("bagnold", &[metric("velocity_l2", 0.5)]);
        assert_eq!(vanished.len(), 1);
        assert_eq!(vanished[0].metric, "gci");
    }

    #[test]
    fn a_damaged_or_foreign_file_is_refused_with_its_path() {
        let folder = tempfile::tempdir().expect("folder");
        let path = folder.path().join("film.quick.json");
        for text in [
            "{",
            r#"{"case":"film","tier":"quick","metrics":[],"extra":1}"#,
            r#"{"case":"x","tier":"quick","metrics":[]}"#,
        ] {
            std::fs::write(&path, text).expect("file");
            let error = Baseline::read(folder.path(), "film", Tier::Quick).expect_err("refused");
            assert!(error.to_string().contains("film.quick.json"), "{error}");
        }
    }
}
