//! A folder of studies, simulated and judged together.

use super::{Study, is_study};
use crate::case::{CaseResult, Limits, PreparedCase, Registry, Tier};
use crate::evaluation::PlanError;
use crate::input::FieldError;
use crate::output::FileError;
use std::path::{Path, PathBuf};

/// The studies of a folder, in the order of their files' names.
#[derive(Debug, Clone)]
pub struct Suite {
    studies: Vec<Study>,
}

impl Suite {
    /// Reads every study of a folder; other files, such as the case files that studies are based on, are left alone.
    ///
    /// # Errors
    /// A folder that cannot be read or holds no study, a study that cannot be read, two of the same name.
    pub fn read(folder: &Path, registry: Registry) -> Result<Self, PlanError> {
        let unreadable = |error: &std::io::Error| PlanError::File(FileError::unreadable(folder, error));
        let entries = std::fs::read_dir(folder).map_err(|error| unreadable(&error))?;
        let mut files: Vec<PathBuf> = Vec::new();
        for entry in entries {
            let path = entry.map_err(|error| unreadable(&error))?.path();
            if path.extension().is_some_and(|ending| ending == "toml") && is_study(&path) {
                files.push(path);
            }
        }
        files.sort();
        if files.is_empty() {
            let (rule, remedy) = ("a folder with at least one study", "a study is a TOML file with `study = \"NAME\"`");
            return Err(FieldError::new("--suite", folder.display(), rule, remedy).into());
        }
        let mut studies: Vec<Study> = Vec::new();
        for file in &files {
            let study = Study::read(file, registry)?;
            if let Some(twin) = studies.iter().find(|other| other.name() == study.name()) {
                let rule = format!("unlike that of {}", twin.file.display());
                let error = FieldError::new("study", format!("\"{}\"", study.name()), &rule, "rename one of them");
                return Err(error.in_file(file).into());
            }
            studies.push(study);
        }
        Ok(Self { studies })
    }

    /// The studies.
    #[must_use]
    pub fn studies(&self) -> &[Study] {
        &self.studies
    }

    /// The cases of all studies, to be simulated together.
    ///
    /// # Errors
    /// A study whose case refuses its parameters.
    pub fn prepare(
        &self,
        registry: Registry,
        tier: Option<Tier>,
        limits: Limits,
    ) -> Result<Vec<Box<dyn PreparedCase>>, PlanError> {
        let mut all = Vec::new();
        for study in &self.studies {
            all.extend(study.prepare(registry, tier, &[], limits)?);
        }
        Ok(all)
    }

    /// One result per study of the results of [`Self::prepare`].
    ///
    /// # Errors
    /// A check that names what there is not.
    pub fn judge(&self, results: Vec<CaseResult>) -> Result<Vec<CaseResult>, PlanError> {
        let mut results = results.into_iter();
        self.studies.iter().map(|study| study.judge(results.by_ref().take(study.case_count()).collect())).collect()
    }
}
