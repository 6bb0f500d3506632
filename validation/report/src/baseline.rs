//! The baseline, `tests/snapshots/TIER/CASE.snap`: what every metric was, and whether it has moved since. The report and
//! the snapshot test read the same files and compare in the same way.

use super::error::{check_case_name, damaged, read_if_there};
pub use super::snapshot_text::MetricKey;
use super::snapshot_text::{self, BaselineValue};
use super::{put, shipped};
use crate::case::{ParameterError, Tier};
use crate::input::DOCUMENT;
use crate::metric::{Metric, Verdict};
use crate::number::with_unit;
use crate::store::provenance::short_commit;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Baseline values of any number of cases at one tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Baseline {
    values: BTreeMap<MetricKey, BaselineValue>,
    /// Commits at which the values of cases were made, as far as they are known.
    commits: BTreeMap<String, String>,
}

/// Change of a metric from its baseline value.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// There is no baseline value: nothing can have moved.
    New,
    /// Within the metric's snapshot tolerance.
    Unchanged {
        /// value − baseline, in the metric's unit.
        change: f64,
        /// The baseline's value.
        baseline: f64,
        /// Largest change that is tolerated, in the metric's unit.
        tolerance: f64,
    },
    /// Outside it.
    Moved {
        /// value − baseline, in the metric's unit; NaN where one of them is.
        change: f64,
        /// The baseline's value.
        baseline: f64,
        /// Largest change that is tolerated, in the metric's unit.
        tolerance: f64,
    },
    /// The baseline is in another unit, this one: it must be taken again.
    UnitChanged(String),
    /// The value is within its tolerance, but its gate has changed sides from this verdict, or has come or gone.
    VerdictChanged(Verdict),
}

impl Change {
    /// Whether the value has moved: by more than it may, to another unit or to the other side of its gate.
    pub fn has_moved(&self) -> bool {
        matches!(self, Self::Moved { .. } | Self::UnitChanged(_) | Self::VerdictChanged(_))
    }

    /// Change of the value in tolerances `[-]`; infinite if it cannot be compared, none if it is new.
    pub fn in_tolerances(&self) -> Option<f64> {
        match *self {
            Self::New => None,
            Self::Unchanged { change: 0.0, .. } => Some(0.0),
            Self::Unchanged { change, tolerance, .. } | Self::Moved { change, tolerance, .. } => {
                let moved = change.abs() / tolerance;
                Some(if moved.is_nan() { f64::INFINITY } else { moved })
            }
            Self::UnitChanged(_) | Self::VerdictChanged(_) => Some(f64::INFINITY),
        }
    }
}

impl Baseline {
    /// The baseline that `metrics` of `case` would make.
    pub fn of(case: &str, metrics: &[Metric]) -> Self {
        let mut baseline = Self::default();
        for metric in metrics {
            baseline.add(MetricKey::of(case, metric), metric.value, &metric.unit, metric.verdict());
        }
        baseline
    }

    /// Adds one value, rounded as a file holds it.
    pub(super) fn add(&mut self, key: MetricKey, value: f64, unit: &str, verdict: Verdict) {
        let line = self.values.len();
        let value = snapshot_text::rounded(value);
        self.values.insert(key, BaselineValue { value, unit: unit.to_owned(), verdict, line });
    }

    /// Adds the values of another case.
    pub fn extend(&mut self, other: Self) {
        self.values.extend(other.values);
        self.commits.extend(other.commits);
    }

    /// The keys of all values that a gate judged, whether it held or not.
    pub fn gates(&self) -> impl Iterator<Item = &MetricKey> {
        self.values.iter().filter(|(_, entry)| entry.verdict != Verdict::Observed).map(|(key, _)| key)
    }

    /// Whether it holds no value.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of `key`.
    pub fn value(&self, key: &MetricKey) -> Option<f64> {
        self.values.get(key).map(|entry| entry.value)
    }

    /// Names the commit at which the values of a case were made, unless it is empty.
    pub(super) fn made_at(&mut self, case: &str, commit: &str) {
        if !commit.is_empty() {
            self.commits.insert(case.to_owned(), commit.to_owned());
        }
    }

    /// The commit at which the values of a case were made, as short as a page shows it; empty where it is not known.
    pub fn commit(&self, case: &str) -> String {
        self.commits.get(case).map_or_else(String::new, |commit| short_commit(commit))
    }

    /// The path of a case's file in the folder of the baseline.
    pub fn path(folder: &Path, case: &str, tier: Tier) -> PathBuf {
        folder.join(tier.name()).join(format!("{case}.snap"))
    }

    /// Reads the values of `case` from `folder`; a missing file is an empty baseline.
    ///
    /// # Errors
    /// If the file is there but cannot be read, is malformed, or belongs to another case or tier.
    pub fn read(folder: &Path, case: &str, tier: Tier) -> Result<Self, ParameterError> {
        check_case_name(case)?;
        let path = Self::path(folder, case, tier);
        let Some(text) = read_if_there(&path, DOCUMENT)? else { return Ok(Self::default()) };
        Self::parse(&path, &text, case, tier)
    }

    /// Baseline values of `case` that the program contains; empty without such values.
    ///
    /// # Errors
    /// If they are malformed, which a test excludes.
    pub fn shipped(case: &str, tier: Tier) -> Result<Self, ParameterError> {
        let path = Self::path(Path::new(""), case, tier);
        shipped::text(&path).map_or_else(|| Ok(Self::default()), |text| Self::parse(&path, text, case, tier))
    }

    fn parse(path: &Path, text: &str, case: &str, tier: Tier) -> Result<Self, ParameterError> {
        let refuse = |reason: String| damaged(path, reason);
        let (commit, lines) = snapshot_text::parse(text, case, tier.name()).map_err(refuse)?;
        let mut read = Self::default();
        read.made_at(case, commit);
        for (key, entry) in lines {
            if read.values.insert(key.clone(), entry).is_some() {
                return Err(refuse(format!("`{} | {}` is listed twice", key.metric, key.variant)));
            }
        }
        Ok(read)
    }

    /// The values of `case` as a snapshot's content, a line each in the order of the case.
    pub fn content(&self, case: &str) -> String {
        let mut entries: Vec<_> = self.values.iter().filter(|(key, _)| key.case == case).collect();
        entries.sort_by_key(|(_, entry)| entry.line);
        snapshot_text::content(entries)
    }

    /// Writes the values of `case` into `folder`, a line each, with the commit at which they are accepted. A file that has
    /// these values stays as it is.
    ///
    /// # Errors
    /// If the folder or file cannot be written.
    pub fn write(&self, folder: &Path, case: &str, tier: Tier, commit: &str) -> Result<PathBuf, ParameterError> {
        check_case_name(case)?;
        let path = Self::path(folder, case, tier);
        let content = self.content(case);
        if path.exists() && Self::read(folder, case, tier)?.content(case) == content {
            return Ok(path);
        }
        let text = snapshot_text::text(case, tier.name(), commit, &content);
        put(&path, text)?;
        Ok(path)
    }

    /// Change of `metric` of `case`, which has moved where |value − baseline| > tolerance · |baseline| + floor, by more than the
    /// rounding in the file; or its unit or verdict is another.
    pub fn change(&self, case: &str, metric: &Metric) -> Change {
        let Some(entry) = self.values.get(&MetricKey::of(case, metric)) else { return Change::New };
        if entry.unit != metric.unit {
            return Change::UnitChanged(entry.unit.clone());
        }
        let baseline = entry.value;
        let change = metric.value - baseline;
        let tolerance = snapshot_tolerance(metric, baseline) + snapshot_text::rounding(baseline);
        let same = metric.value == baseline || (metric.value.is_nan() && baseline.is_nan());
        if !same && (change.is_nan() || change.abs() > tolerance) {
            return Change::Moved { change, baseline, tolerance };
        }
        if entry.verdict != metric.verdict() {
            return Change::VerdictChanged(entry.verdict);
        }
        Change::Unchanged { change: if same { 0.0 } else { change }, baseline, tolerance }
    }

    /// Everything in which `metrics` of `case` differ from the baseline, a sentence each: moved, new and vanished.
    pub fn differences(&self, case: &str, metrics: &[Metric]) -> Vec<String> {
        let difference = |metric: &Metric| {
            let what = match self.change(case, metric) {
                Change::Unchanged { .. } => return None,
                Change::New => "is not in the baseline".to_owned(),
                Change::UnitChanged(unit) => format!("was in {unit}, is in {}", metric.unit),
                Change::VerdictChanged(verdict) => {
                    let now = metric.verdict().word();
                    format!("is within its tolerance, but the verdict was {}, is {now}", verdict.word())
                }
                Change::Moved { change, baseline, tolerance } => format!(
                    "was {}, is {}: change {change:.3e}, tolerance {tolerance:.3e}",
                    with_unit(baseline, &metric.unit),
                    with_unit(metric.value, &metric.unit),
                ),
            };
            Some(format!("{} [{}] {what}", metric.name, metric.variant))
        };
        let vanished = self.vanished(case, metrics).into_iter();
        let vanished = vanished.map(|key| format!("{} [{}] is no longer measured", key.metric, key.variant));
        metrics.iter().filter_map(difference).chain(vanished).collect()
    }

    /// Gates of `case` in the baseline that do not judge `metrics`, with what took each away: a gate that vanishes is a failure.
    pub fn not_judged(&self, case: &str, metrics: &[Metric]) -> Vec<(MetricKey, String)> {
        let own = self.gates().filter(|key| key.case == case);
        let gone = own.filter_map(|key| {
            let found = metrics.iter().find(|metric| MetricKey::of(case, metric) == *key);
            let reason = match found {
                Some(metric) if metric.verdict() != Verdict::Observed => return None,
                Some(metric) if metric.is_coarser_than_gate() => {
                    "the discretisation error exceeds the width of the limit"
                }
                Some(metric) if metric.gate.is_some() => "the reference is not verified",
                Some(_) => "no limit applies to these runs and parameters",
                None => "the metric is no longer measured",
            };
            let of_run =
                |metric: &&Metric| key.variant.includes(&metric.variant) || metric.variant.includes(&key.variant);
            let unsteady = metrics.iter().filter(of_run).find_map(|metric| metric.reason_of_absence().cloned());
            let reason = unsteady.map_or_else(|| reason.to_owned(), |cause| format!("{reason}; {cause}"));
            Some((key.clone(), reason))
        });
        gone.collect()
    }

    /// Baseline values of `case` that `metrics` no longer contain: a metric that vanishes is a regression too.
    pub fn vanished(&self, case: &str, metrics: &[Metric]) -> Vec<MetricKey> {
        let measured: BTreeSet<MetricKey> = metrics.iter().map(|metric| MetricKey::of(case, metric)).collect();
        self.values.keys().filter(|key| key.case == case && !measured.contains(key)).cloned().collect()
    }
}

/// Largest change of `metric` from `from` that does not count as changed, in the metric's unit.
pub(super) fn snapshot_tolerance(metric: &Metric, from: f64) -> f64 {
    metric.snapshot_tolerance * from.abs() + metric.snapshot_floor
}

#[cfg(test)]
#[path = "baseline_tests.rs"]
mod tests;
