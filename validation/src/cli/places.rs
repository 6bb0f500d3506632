//! Places of committed values. In a checkout they lie there, elsewhere in the current folder; what is missing there, the
//! program carries. Those of a suite of studies lie in its folder.

use super::error::ProgramError;
use crate::case::Tier;
use crate::report::{Baseline, KnownFailures};
use crate::store::provenance::workspace;
use std::path::{Path, PathBuf};

/// Whose committed values are meant.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum CommittedValues {
    /// Those of the program's cases.
    OfCases,
    /// Those of the studies in a folder.
    OfSuite(PathBuf),
}

impl CommittedValues {
    /// The folder with accepted values and known failures.
    pub(super) fn accepted_folder(&self) -> PathBuf {
        match self {
            Self::OfCases => {
                workspace().map_or_else(|| PathBuf::from("snapshots"), |root| root.join("tests").join("snapshots"))
            }
            Self::OfSuite(folder) => folder.join("snapshots"),
        }
    }

    /// The accepted values of a case; none where nothing has been accepted.
    pub(super) fn accepted(&self, case: &str, tier: Tier) -> Result<Baseline, ProgramError> {
        let folder = self.accepted_folder();
        let own = self.is_own(&Baseline::path(&folder, case, tier));
        Ok(if own { Baseline::read(&folder, case, tier)? } else { Baseline::shipped(case, tier)? })
    }

    /// The gates that are known to fail.
    pub(super) fn known_failures(&self) -> Result<KnownFailures, ProgramError> {
        let path = self.accepted_folder().join("known_failures.toml");
        Ok(if self.is_own(&path) { KnownFailures::read(&path)? } else { KnownFailures::shipped()? })
    }

    /// The gated figures over time; the program carries none.
    pub(super) fn history_file(&self) -> PathBuf {
        match self {
            Self::OfCases => {
                workspace().map_or_else(|| PathBuf::from("reports"), |root| root.join("reports")).join("history.csv")
            }
            Self::OfSuite(_) => self.accepted_folder().join("history.csv"),
        }
    }

    /// Whether a file goes before what the program carries. In a checkout, and of a suite, also one that is missing does: what
    /// has been taken away there is gone.
    fn is_own(&self, path: &Path) -> bool {
        matches!(self, Self::OfSuite(_)) || workspace().is_some() || path.exists()
    }
}
