//! Gates that honest attempts did not reach. They stay red on the page, but only a change of them is an error.

use super::baseline::{MetricKey, snapshot_tolerance};
use super::error::{damaged, read_if_there};
use super::shipped;
use crate::case::ParameterError;
use crate::input::WRITTEN_BY_HAND;
use crate::metric::{Metric, Variant, Verdict};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One listed gate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedFailure {
    /// Case name.
    pub case: String,
    /// Metric name.
    pub metric: String,
    /// Run whose gate is expected to fail.
    pub variant: Variant,
    /// The best value that was reached, in the metric's unit.
    pub best_value: f64,
    /// Day of that value, `YYYY-MM-DD`.
    pub date: String,
    /// Origin of the failure.
    #[serde(default)]
    pub kind: FailureKind,
    /// Reason why the gate fails.
    pub reason: String,
    /// Attempts to reach the gate, with figures; may be empty.
    #[serde(default)]
    pub tried: String,
}

/// Origin of an expected failure: the code, the law or the resolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FailureKind {
    /// A defect of ours.
    #[default]
    Defect,
    /// The law, or the closures, that the run takes: solved rightly, they contradict the reference.
    Law,
    /// Green on finer particles.
    Resolution,
}

impl FailureKind {
    /// Text for a reader.
    pub fn words(self) -> &'static str {
        match self {
            Self::Defect => "defect",
            Self::Law => "the law fails here",
            Self::Resolution => "too coarse at this tier",
        }
    }
}

/// The list of `tests/snapshots/expected_failures.toml`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedFailures {
    /// The listed gates.
    #[serde(default, rename = "failure")]
    pub failures: Vec<ExpectedFailure>,
}

/// Status of a metric in the list of expected failures.
#[derive(Debug, Clone, PartialEq)]
pub enum ListStatus {
    /// Not listed: the gate's own verdict counts.
    Unlisted,
    /// Listed and failing as expected: shown red, no error.
    AsListed(ExpectedFailure),
    /// Listed, but the gate passes: the entry must go. An error.
    PassesAgain(ExpectedFailure),
    /// Listed and failing by more than the best value's snapshot tolerance beyond it. An error.
    Worse(ExpectedFailure),
    /// Listed, but the metric has no gate (or an unverified reference): the entry means nothing. An error.
    WithoutGate(ExpectedFailure),
}

impl ListStatus {
    /// Whether the list and the result contradict each other.
    pub fn is_error(&self) -> bool {
        matches!(self, Self::PassesAgain(_) | Self::Worse(_) | Self::WithoutGate(_))
    }
}

impl ExpectedFailures {
    /// Reads the list; a missing file is an empty list.
    ///
    /// # Errors
    /// If the file cannot be read, has an unknown or missing field, an empty reason or date, a best value that is not
    /// finite, or names a gate twice.
    pub fn read(path: &Path) -> Result<Self, ParameterError> {
        let Some(text) = read_if_there(path, WRITTEN_BY_HAND)? else { return Ok(Self::default()) };
        Self::parse(path, &text)
    }

    /// The list that the program carries.
    ///
    /// # Errors
    /// If it is malformed, which a test excludes.
    pub fn shipped() -> Result<Self, ParameterError> {
        let path = Path::new("expected_failures.toml");
        shipped::text(path).map_or_else(|| Ok(Self::default()), |text| Self::parse(path, text))
    }

    fn parse(path: &Path, text: &str) -> Result<Self, ParameterError> {
        let refuse = |reason: String| damaged(path, reason);
        let list: Self = toml::from_str(text).map_err(|error| refuse(error.to_string().trim_end().to_owned()))?;
        for (index, failure) in list.failures.iter().enumerate() {
            let name = format!("failure {} ({} {} {})", index + 1, failure.case, failure.metric, failure.variant);
            let others = ["next entry", "entry above", "entry below", "previous entry"];
            let defect = if failure.reason.trim().is_empty() || failure.date.trim().is_empty() {
                "needs a date and a reason"
            } else if others.iter().any(|other| failure.reason.contains(other)) {
                "refers to another entry, but is shown without it: repeat the reason"
            } else if !failure.best_value.is_finite() {
                "needs a finite best_value"
            } else if list.failures[..index].iter().any(|other| other.key() == failure.key()) {
                "is listed twice"
            } else {
                continue;
            };
            return Err(refuse(format!("{name} {defect}")));
        }
        Ok(list)
    }

    /// The entry for `metric` of `case`.
    pub fn entry(&self, case: &str, metric: &Metric) -> Option<&ExpectedFailure> {
        let key = MetricKey::of(case, metric);
        self.failures.iter().find(|failure| failure.key() == key)
    }

    /// Status of `metric` of `case` in the list.
    pub fn status(&self, case: &str, metric: &Metric) -> ListStatus {
        let Some(entry) = self.entry(case, metric).cloned() else { return ListStatus::Unlisted };
        match (metric.verdict(), &metric.gate) {
            (Verdict::Pass, _) => ListStatus::PassesAgain(entry),
            (Verdict::Fail, Some(gate)) => {
                // The margin knows which direction is worse; what is not a number is worse than anything.
                let lost = gate.limit.margin(entry.best_value) - gate.limit.margin(metric.value);
                let is_kept = metric.value.is_finite() && lost <= snapshot_tolerance(metric, entry.best_value);
                if is_kept { ListStatus::AsListed(entry) } else { ListStatus::Worse(entry) }
            }
            _ => ListStatus::WithoutGate(entry),
        }
    }
}

impl ExpectedFailure {
    /// The gate that it names.
    pub fn key(&self) -> MetricKey {
        MetricKey { case: self.case.clone(), metric: self.metric.clone(), variant: self.variant.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    const LIST: &str = r#"
    [[failure]]
    case = "bagnold"
    metric = "velocity_l2"
    variant = "resolution=40"
    best_value = 0.9
    date = "2025-01-31"
    reason = "slip at the wall"
    "#;

    fn read(text: &str) -> Result<ExpectedFailures, ParameterError> {
        let folder = tempfile::tempdir().expect("folder");
        let path = folder.path().join("expected_failures.toml");
        std::fs::write(&path, text).expect("file");
        ExpectedFailures::read(&path)
    }

    fn metric(value: f64, limit: Limit) -> Metric {
        Metric::observed("velocity_l2", &Variant::of("resolution", 40), value, "%")
            .gated(limit, "prototype")
            .with_snapshot_tolerance(0.05, 0.0)
    }

    #[test]
    fn a_listed_gate_is_expected_until_it_passes_or_gets_worse() {
        let list = read(LIST).expect("list");
        let status = |value| list.status("bagnold", &metric(value, Limit::AtMost(0.7)));
        assert!(matches!(status(0.9), ListStatus::AsListed(_)));
        assert!(matches!(status(0.94), ListStatus::AsListed(_)), "within 5 % of the best value");
        assert!(matches!(status(0.8), ListStatus::AsListed(_)), "better, but still failing");
        assert!(matches!(status(0.95), ListStatus::Worse(_)));
        assert!(matches!(status(f64::NAN), ListStatus::Worse(_)));
        assert!(matches!(status(0.69), ListStatus::PassesAgain(_)));
        assert!(!status(0.9).is_error() && status(0.95).is_error() && status(0.69).is_error());
    }

    #[test]
    fn worse_follows_the_direction_of_the_gate() {
        let list = read(LIST).expect("list");
        let status = |value| list.status("bagnold", &metric(value, Limit::AtLeast(1.5)));
        assert!(matches!(status(0.84), ListStatus::Worse(_)));
        assert!(matches!(status(1.2), ListStatus::AsListed(_)));
    }

    #[test]
    fn other_metrics_are_unlisted_and_an_entry_without_a_gate_is_an_error() {
        let list = read(LIST).expect("list");
        let gated = metric(0.9, Limit::AtMost(0.7));
        assert_eq!(list.status("film", &gated), ListStatus::Unlisted);
        let observed = Metric { gate: None, ..gated };
        assert!(matches!(list.status("bagnold", &observed), ListStatus::WithoutGate(_)));
    }

    #[test]
    fn the_file_is_checked() {
        for (text, expected) in [
            (LIST.replace("best_value = 0.9", "best_value = 0.9\nblame = \"x\""), "blame"),
            (LIST.replace("slip at the wall", " "), "date and a reason"),
            (LIST.replace("0.9", "nan"), "finite best_value"),
            (LIST.replace("slip at the wall", "see the next entry"), "repeat the reason"),
            (LIST.repeat(2), "listed twice"),
            (LIST.replace("date = \"2025-01-31\"\n", ""), "date"),
        ] {
            let error = read(&text).expect_err("refused").to_string();
            assert!(error.contains(expected) && error.contains("expected_failures.toml"), "{error}");
        }
        assert_eq!(read("").expect("empty"), ExpectedFailures::default());
        assert!(ExpectedFailures::read(Path::new("no/such/file.toml")).expect("missing").failures.is_empty());
    }
}
