//! Exit code of the program.

use crate::case::CaseResult;
use std::process::ExitCode;

/// Exit code, by what happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// All gates pass, are inconclusive or fail as expected.
    Held = 0,
    /// A gate is a new failure, or is not judged.
    GateFailed = 1,
    /// The input was refused, or its output could not be written.
    BadInput = 2,
    /// A run diverged although its case does not expect it.
    Diverged = 3,
}

impl Exit {
    /// Exit code of runs whose gates are ignored.
    pub fn of_runs(results: &[CaseResult]) -> Self {
        let has_diverged = results.iter().any(|result| result.unexpected_divergences().next().is_some());
        if has_diverged { Self::Diverged } else { Self::Held }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
