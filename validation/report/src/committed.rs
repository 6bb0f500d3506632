//! Places of committed values. In a checkout they lie there, elsewhere in the current folder; what is missing there, the
//! program carries. Those of a suite of studies lie in its folder.

use super::baseline::{Baseline, MetricKey};
use super::expected_failures::{ExpectedFailure, ExpectedFailures};
use crate::case::{ParameterError, Tier};
use crate::input::{FieldError, shown};
use crate::store::provenance::workspace;
use std::path::{Path, PathBuf};

/// Name of the list of expected failures, and the name that it had.
const EXPECTED_FAILURES: &str = "expected_failures.toml";
const KNOWN_FAILURES: &str = "known_failures.toml";

const TIERS: [Tier; 3] = [Tier::Quick, Tier::Paper, Tier::Fine];

/// Owner of the committed values.
#[derive(Debug, Clone, PartialEq)]
pub enum CommittedValues {
    /// Those of the program's cases.
    OfCases,
    /// Those of the studies in a folder.
    OfSuite(PathBuf),
}

impl CommittedValues {
    /// The folder with the baseline and the expected failures.
    pub fn folder(&self) -> PathBuf {
        match self {
            Self::OfCases => {
                workspace().map_or_else(|| PathBuf::from("snapshots"), |root| root.join("tests").join("snapshots"))
            }
            Self::OfSuite(folder) => folder.join("snapshots"),
        }
    }

    /// The baseline of a case; empty where nothing has been accepted.
    ///
    /// # Errors
    /// Values that are malformed.
    pub fn baseline(&self, case: &str, tier: Tier) -> Result<Baseline, ParameterError> {
        let folder = self.folder();
        let own = self.is_own(&Baseline::path(&folder, case, tier));
        if own { Baseline::read(&folder, case, tier) } else { Baseline::shipped(case, tier) }
    }

    /// Refuses baseline values of a suite whose study is gone: its gates would vanish with it.
    ///
    /// # Errors
    /// The first file that belongs to none of these studies.
    pub fn refuse_orphans(&self, studies: &[&str]) -> Result<(), ParameterError> {
        for tier in TIERS {
            for entry in std::fs::read_dir(self.folder().join(tier.name())).into_iter().flatten().flatten() {
                let file = entry.path();
                let Some(name) = file.file_stem().filter(|_| file.extension().is_some_and(|own| own == "snap")) else {
                    continue;
                };
                if !studies.iter().any(|study| name == *study) {
                    let name = name.to_string_lossy();
                    let remedy = "restore the study, or delete this file with its baseline";
                    let error = FieldError::new("study", &*name, "the name of a study of the suite", remedy);
                    return Err(error.in_file(&file).into());
                }
            }
        }
        Ok(())
    }

    /// Expected failures of a suite that none of its studies measures, at any tier: others have other runs.
    pub(super) fn listed_in_vain(&self, list: &ExpectedFailures) -> Vec<MetricKey> {
        if *self == Self::OfCases {
            return Vec::new();
        }
        let is_in_baseline = |key: &MetricKey| {
            TIERS.iter().flat_map(|tier| self.baseline(&key.case, *tier)).any(|own| own.value(key).is_some())
        };
        list.failures.iter().map(ExpectedFailure::key).filter(|key| !is_in_baseline(key)).collect()
    }

    /// The file of the expected failures, for messages.
    pub(super) fn list_of_failures(&self) -> String {
        shown(&self.folder().join(EXPECTED_FAILURES))
    }

    /// The gates that are expected to fail.
    ///
    /// # Errors
    /// A list that is malformed, or has the name of earlier versions.
    pub fn expected_failures(&self) -> Result<ExpectedFailures, ParameterError> {
        let path = self.folder().join(EXPECTED_FAILURES);
        let former = self.folder().join(KNOWN_FAILURES);
        if former.exists() {
            let remedy = format!("rename it to {EXPECTED_FAILURES}");
            return Err(FieldError::finding(&shown(&former), "outdated name", &remedy).into());
        }
        if self.is_own(&path) { ExpectedFailures::read(&path) } else { ExpectedFailures::shipped() }
    }

    /// Whether a file goes before what the program carries. In a checkout, and of a suite, also one that is missing does: what
    /// has been taken away there is gone.
    fn is_own(&self, path: &Path) -> bool {
        matches!(self, Self::OfSuite(_)) || workspace().is_some() || path.exists()
    }
}
