//! The answers to one question with several seeds.

use super::target::Target;
use crate::evaluation::EvaluationRecord;

/// Answers to one question, one for every seed, the first seed's first.
#[derive(Debug, Clone)]
pub(super) struct Repeated(pub(super) Vec<EvaluationRecord>);

impl Repeated {
    /// Reason for a failed run, if one failed.
    pub(super) fn failure(&self) -> Option<&str> {
        self.0.iter().find_map(|record| record.failure.as_deref())
    }

    /// Record with one seed; a case without seeds gives the same record for all.
    pub(super) fn with_seed(&self, place: usize) -> Option<&EvaluationRecord> {
        self.0.get(place).or_else(|| self.0.first())
    }

    /// The mean over the seeds of what their records say, with its unit.
    ///
    /// # Errors
    /// The words for what a record does not have.
    pub(super) fn predicted(&self, target: &Target) -> Result<(f64, String), String> {
        let mut sum = 0.0;
        let mut unit = String::new();
        for record in &self.0 {
            let value;
            (value, unit) = target.predicted(record)?;
            sum += value;
        }
        Ok((sum / self.0.len() as f64, unit))
    }
}
