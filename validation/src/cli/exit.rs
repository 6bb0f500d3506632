//! Exit code of the program.

use crate::case::CaseResult;
use crate::metric::Metric;
use std::process::ExitCode;

/// Exit code, by what happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// All gates hold, except known failures.
    Held = 0,
    /// A gate fails that is not a known failure.
    GateFailed = 1,
    /// The input was refused, or its output could not be written.
    BadInput = 2,
    /// A run diverged although its case does not expect it.
    Diverged = 3,
}

impl Exit {
    /// Judges results. A divergence weighs more than a gate, since its metrics mean nothing.
    pub fn of(results: &[CaseResult], is_known: impl Fn(&CaseResult, &Metric) -> bool) -> Self {
        if results.iter().any(|result| result.unexpected_divergences().next().is_some()) {
            Self::Diverged
        } else if results.iter().any(|result| result.failures().any(|metric| !is_known(result, metric))) {
            Self::GateFailed
        } else {
            Self::Held
        }
    }

    /// The same where every gate is judged that was accepted; a gate that vanishes has failed.
    pub fn unless_whole(self, is_whole: bool) -> Self {
        if self == Self::Held && !is_whole { Self::GateFailed } else { self }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
