//! Files of measurements as cases, studies, calibrations and sweeps name them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A file of measurements or those of an experiment's repeats, where needed with the names of their columns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "expected a file of measurements, a list of the files of repeats, or { files = […], columns = { front = \"toe [cm]\" } }"
)]
pub enum MeasuredFiles {
    /// A file.
    One(PathBuf),
    /// A file for each repeat of an experiment.
    Repeats(Vec<PathBuf>),
    /// Files whose headings are not the names of what is simulated.
    Named {
        /// A file for each repeat.
        files: Vec<PathBuf>,
        /// Heading with its unit of each column that is meant, by the name of what is simulated.
        #[schemars(with = "BTreeMap<String, serde_json::Value>")]
        columns: BTreeMap<String, toml::Value>,
    },
}

impl MeasuredFiles {
    /// The files.
    pub fn files(&self) -> &[PathBuf] {
        match self {
            Self::One(file) => std::slice::from_ref(file),
            Self::Repeats(files) | Self::Named { files, .. } => files,
        }
    }

    /// The same files, named from where a folder is.
    pub fn beside(&self, folder: &Path) -> Self {
        let files = self.files().iter().map(|file| folder.join(file)).collect();
        match self {
            Self::Named { columns, .. } => Self::Named { files, columns: columns.clone() },
            _ => Self::Repeats(files),
        }
    }
}
