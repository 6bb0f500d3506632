//! One case in a program with an error, or with none: what its metrics say.

use crate::case::{CaseResult, Changes, ParameterError, Registry, Silent, Tier, execute};
use crate::metric::Metric;
use crate::observation::Outcome;
use crate::store::{Store, StorePolicy};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A case with some of its parameters changed, so that only the runs that matter remain.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Scope {
    /// Name of the case.
    pub case: String,
    /// `path=value`, as `--set` takes them.
    pub settings: Vec<String>,
}

/// Results of a case with one mutation, or with none.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MutantRun {
    /// Judged and observed numbers.
    pub metrics: Vec<Metric>,
    /// Runs that diverged although their case does not expect it, with the message.
    pub diverged: Vec<String>,
    /// Sum of the runs' wall times `[s]`.
    pub wall_seconds: f64,
}

impl MutantRun {
    fn of(result: &CaseResult) -> Self {
        let message = |run: &crate::case::RunSummary| match &run.outcome {
            Outcome::Diverged { message, .. } => format!("{} {message}", run.variant).trim_start().to_owned(),
            _ => String::new(),
        };
        Self {
            metrics: result.metrics.clone(),
            diverged: result.unexpected_divergences().map(message).collect(),
            wall_seconds: result.wall_seconds(),
        }
    }

    /// Reads what [`MutantRun::write`] wrote; none if there is nothing to be understood.
    pub fn read(file: &Path) -> Option<Self> {
        std::fs::read(file).ok().and_then(|bytes| postcard::from_bytes(&bytes).ok())
    }

    /// Writes it for the program that asked for it.
    ///
    /// # Errors
    /// The system's.
    pub fn write(&self, file: &Path) -> std::io::Result<()> {
        let bytes = postcard::to_stdvec(self).map_err(std::io::Error::other)?;
        std::fs::write(file, bytes)
    }
}

/// Runs a case at the quick tier on the current rayon pool. No stored result is read or written: what is stored belongs to a program
/// without errors, and this one may have any.
///
/// # Errors
/// A case or setting that is refused.
pub fn run_trial(scope: &Scope, registry: Registry) -> Result<(Vec<CaseResult>, MutantRun), ParameterError> {
    let changes = Changes { file: None, settings: &scope.settings, ..Changes::default() };
    let prepared = registry.find(&scope.case)?.prepare(Tier::Quick, &changes)?;
    let results = execute(vec![prepared], &Store::open(StorePolicy::Bypass), &Silent)?;
    let sighting = results.first().map(MutantRun::of).unwrap_or_default();
    Ok((results, sighting))
}
