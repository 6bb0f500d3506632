//! A folder of studies, simulated and judged together.

use super::Study;
use crate::case::{CaseResult, Limits, ParameterError, PreparedCase, Registry, Tier};
use crate::input::{FieldError, WRITTEN_BY_HAND, read_text};
use crate::output::{FileError, OutputFolder};
use std::fs::ReadDir;
use std::path::{Path, PathBuf};
use toml::Table;

/// Keys that only studies have; a study whose first line is misspelt is to be refused, not passed over.
const KEYS: [&str; 2] = ["study", "checks"];

/// Whether a file describes a study: it has the key `study`, or one that only studies have.
pub fn is_study(path: &Path) -> bool {
    read_text(path, WRITTEN_BY_HAND).is_ok_and(|text| describes_study(&text))
}

fn describes_study(text: &str) -> bool {
    // a file with a slip in its syntax is a study as well, if a line says so
    match text.parse::<Table>() {
        Ok(table) => KEYS.iter().any(|key| table.contains_key(*key)),
        Err(_) => text.lines().any(|line| line.split_once('=').is_some_and(|(key, _)| key.trim() == "study")),
    }
}

/// The studies of a folder, in the order of their files' names.
#[derive(Debug, Clone)]
pub struct Suite {
    studies: Vec<Study>,
}

impl Suite {
    /// Reads every study of a folder; other files, such as the case files that studies are based on, are left alone.
    ///
    /// # Errors
    /// A folder that cannot be read or holds no study, a TOML file that cannot be read, a study in a folder below, two of
    /// the same name.
    pub fn read(folder: &Path, registry: Registry) -> Result<Self, ParameterError> {
        let mut files: Vec<PathBuf> = Vec::new();
        for path in entries(folder)? {
            if path.is_dir() && !OutputFolder::is_one(&path) {
                if let Some(study) = entries(&path)?.iter().find(|inner| is_toml(inner) && is_study(inner)) {
                    let remedy = "move it into the suite's folder, or report its own folder as a suite elsewhere";
                    let error = FieldError::finding("study", "in a subfolder of the suite", remedy);
                    return Err(error.in_file(study).into());
                }
            } else if is_toml(&path) && !path.is_dir() {
                // a file that cannot be read or parsed may be a study
                let text = read_text(&path, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(&path, &error))?;
                if text.parse::<Table>().is_err() || describes_study(&text) {
                    files.push(path);
                }
            }
        }
        files.sort();
        if files.is_empty() {
            let (rule, remedy) = ("a folder with at least one study", "add a TOML file with `study = \"NAME\"`");
            return Err(FieldError::new("--suite", folder.display(), rule, remedy).into());
        }
        let mut studies: Vec<Study> = Vec::new();
        for file in &files {
            let study = Study::read(file, registry)?;
            if let Some(twin) = studies.iter().find(|other| other.name() == study.name()) {
                let rule = format!("different from that of {}", twin.file.display());
                let error = FieldError::new("study", format!("\"{}\"", study.name()), &rule, "rename one of them");
                return Err(error.in_file(file).into());
            }
            studies.push(study);
        }
        Ok(Self { studies })
    }

    /// Studies of the suite in the order of their files.
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
    ) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
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
    pub fn judge(&self, results: Vec<CaseResult>) -> Result<Vec<CaseResult>, ParameterError> {
        let mut results = results.into_iter();
        self.studies.iter().map(|study| study.judge(results.by_ref().take(study.case_count()).collect())).collect()
    }
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let read = |all: ReadDir| all.map(|entry| entry.map(|entry| entry.path())).collect();
    std::fs::read_dir(folder).and_then(read).map_err(|error| FileError::unreadable(folder, &error))
}

fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}
