//! Record of an evaluation: numbers and tables, nothing that depends on when or where it ran.

use crate::case::CaseResult;
use crate::metric::{Metric, Variant, Verdict};
use crate::observation::Outcome;
use crate::output::Table;
use crate::store::entry;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;

/// One metric's value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricValue {
    /// Stable snake_case name.
    pub name: String,
    /// Run that the value is of, `key=value,…`.
    pub variant: Variant,
    /// The value, in `unit`.
    pub value: f64,
    /// Unit of the value.
    pub unit: String,
    /// The gate's outcome.
    pub verdict: Verdict,
    /// Reason for a missing value, or the part of a run that the value leaves out.
    pub remark: Option<String>,
}

impl MetricValue {
    fn of(metric: &Metric) -> Self {
        Self {
            name: metric.name.clone(),
            variant: metric.variant.clone(),
            value: metric.value,
            unit: metric.unit.clone(),
            verdict: metric.verdict(),
            remark: metric.remark.clone(),
        }
    }
}

/// A finished evaluation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
pub struct EvaluationRecord {
    /// Key of the evaluation, 32 hexadecimal digits.
    pub key: String,
    /// Name of the case.
    pub case: String,
    /// Hash over the final states of all runs; empty if there are none.
    pub state_hash: String,
    /// Metrics in report order.
    pub metrics: Vec<MetricValue>,
    /// Profiles and time series.
    pub tables: Vec<Table>,
    /// Reason why the numbers are invalid: a run diverged, or the parameters gave no scene.
    pub failure: Option<String>,
}

impl EvaluationRecord {
    pub(super) fn of(key: &str, result: &CaseResult) -> Self {
        let diverged = result.unexpected_divergences().next().map(|run| match &run.outcome {
            Outcome::Diverged { message, .. } => format!("{} diverged: {message}", run.variant).trim_start().to_owned(),
            _ => format!("{} diverged", run.variant),
        });
        Self {
            key: key.to_owned(),
            case: result.name.clone(),
            state_hash: result.state_hash.clone(),
            metrics: result.metrics.iter().map(MetricValue::of).collect(),
            tables: result.tables.clone(),
            failure: diverged,
        }
    }

    /// A record without values.
    pub fn failed(key: &str, case: &str, reason: &str) -> Self {
        Self { key: key.to_owned(), case: case.to_owned(), failure: Some(reason.to_owned()), ..Self::default() }
    }

    /// The record in a file; `None` if there is none, it is damaged or it belongs to another key.
    pub fn read(path: &Path, key: &str) -> Option<Self> {
        entry::read(path, key).unwrap_or_else(|damage| {
            tracing::warn!("{}: {damage}; simulated again", path.display());
            None
        })
    }

    /// Writes the record so that a reader sees all of it or nothing.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        entry::write(path, &self.key, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_comes_back_to_the_bit_and_only_for_its_key() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("record.postcard");
        let mut record = EvaluationRecord::failed("a", "film", "no scene");
        record.metrics.push(MetricValue {
            name: "velocity_l2".to_owned(),
            variant: Variant::default(),
            value: 0.1 + 0.2,
            unit: "%".to_owned(),
            verdict: Verdict::Pass,
            remark: None,
        });
        assert_eq!(EvaluationRecord::read(&path, "a"), None);
        record.write(&path).expect("writable");
        assert_eq!(EvaluationRecord::read(&path, "a"), Some(record));
        assert_eq!(EvaluationRecord::read(&path, "b"), None);
        std::fs::write(&path, "damaged").expect("writable");
        assert_eq!(EvaluationRecord::read(&path, "a"), None);
    }
}
