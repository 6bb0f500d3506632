//! Where committed values lie: in the checkout, if one works in it; elsewhere in the current folder, and what is not there
//! the program carries.

use super::error::ProgramError;
use crate::case::Tier;
use crate::report::{Baseline, KnownFailures};
use crate::store::provenance::workspace;
use std::path::{Path, PathBuf};

/// The folder with accepted values and known failures.
pub(super) fn accepted_folder() -> PathBuf {
    workspace().map_or_else(|| PathBuf::from("snapshots"), |root| root.join("tests").join("snapshots"))
}

/// The accepted values of a case; none where nothing has been accepted.
pub(super) fn accepted(case: &str, tier: Tier) -> Result<Baseline, ProgramError> {
    let folder = accepted_folder();
    let own = is_own(&Baseline::path(&folder, case, tier));
    Ok(if own { Baseline::read(&folder, case, tier)? } else { Baseline::shipped(case, tier)? })
}

/// The gates that are known to fail.
pub(super) fn known_failures() -> Result<KnownFailures, ProgramError> {
    let path = accepted_folder().join("known_failures.toml");
    Ok(if is_own(&path) { KnownFailures::read(&path)? } else { KnownFailures::shipped()? })
}

/// The gated figures over time; the program carries none.
pub(super) fn history_file() -> PathBuf {
    let reports = workspace().map_or_else(|| PathBuf::from("reports"), |root| root.join("reports"));
    reports.join("history.csv")
}

/// Whether a file goes before what the program carries. In a checkout also one that is missing does: what has been taken
/// away there is gone.
fn is_own(path: &Path) -> bool {
    workspace().is_some() || path.exists()
}
