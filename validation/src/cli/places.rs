//! Places of committed values. In a checkout they lie there, elsewhere in the current folder; what is missing there, the
//! program carries. Those of a suite of studies lie in its folder.

use super::error::ProgramError;
use crate::case::Tier;
use crate::evaluation::PlanError;
use crate::input::{FieldError, shown};
use crate::report::{Baseline, KnownFailureStatus, KnownFailures, MetricKey, Report};
use crate::store::provenance::workspace;
use crate::study::Study;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const TIERS: [Tier; 3] = [Tier::Quick, Tier::Paper, Tier::Fine];

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

    /// Refuses accepted values of a suite whose study is gone: its gates would vanish with it.
    pub(super) fn refuse_orphans(&self, studies: &[Study]) -> Result<(), PlanError> {
        for tier in TIERS {
            for entry in std::fs::read_dir(self.accepted_folder().join(tier.name())).into_iter().flatten().flatten() {
                let file = entry.path();
                let Some(name) = file.file_stem().filter(|_| file.extension().is_some_and(|own| own == "snap")) else {
                    continue;
                };
                if !studies.iter().any(|study| name == study.name()) {
                    let name = name.to_string_lossy();
                    let remedy = "restore the study, or delete this file with its accepted values";
                    let error = FieldError::new("study", &*name, "the name of a study of the suite", remedy);
                    return Err(error.in_file(&file).into());
                }
            }
        }
        Ok(())
    }

    /// A line for each known failure that the results contradict, or that names no value of a suite.
    pub(super) fn contradictions(&self, page: &Report) -> String {
        let mut lines = String::new();
        // at any tier: others have other runs
        let is_accepted = |key: &MetricKey| {
            TIERS.iter().flat_map(|tier| self.accepted(&key.case, *tier)).any(|own| own.value(key).is_some())
        };
        let file = shown(&self.accepted_folder().join("known_failures.toml"));
        for failure in &page.known_failures.failures {
            let key = failure.key();
            let own = page.cases.iter().filter(|case| case.name == key.case);
            let found = own.flat_map(|case| &case.metrics).find(|metric| MetricKey::of(&key.case, metric) == key);
            let finding = match found.map(|metric| page.known_failures.standing(&key.case, metric)) {
                Some(KnownFailureStatus::PassesAgain(_)) => "the gate holds again; delete the entry",
                Some(KnownFailureStatus::WithoutGate(_)) => "the value has no gate; delete the entry",
                None if *self != Self::OfCases && !is_accepted(&key) => {
                    "no study measures this; correct or delete the entry"
                }
                _ => continue,
            };
            let _ = writeln!(lines, "KNOWN FAILURE: {file}: {} {} {}: {finding}", key.case, key.metric, key.variant);
        }
        lines
    }

    /// The gates that are known to fail.
    pub(super) fn known_failures(&self) -> Result<KnownFailures, ProgramError> {
        let path = self.accepted_folder().join("known_failures.toml");
        Ok(if self.is_own(&path) { KnownFailures::read(&path)? } else { KnownFailures::shipped()? })
    }

    /// Whether a file goes before what the program carries. In a checkout, and of a suite, also one that is missing does: what
    /// has been taken away there is gone.
    fn is_own(&self, path: &Path) -> bool {
        matches!(self, Self::OfSuite(_)) || workspace().is_some() || path.exists()
    }
}
