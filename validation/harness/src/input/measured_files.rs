//! Files of measurements as cases, studies, calibrations and sweeps name them.

use super::{FieldError, name_and_unit, unit};
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
        #[serde(default)]
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

/// The names and units that a plan gives the columns; empty for those that are not meant.
///
/// # Errors
/// A text that is no heading of the file, or states no unit or another one.
pub fn renamed(headings: &[&str], names: &BTreeMap<String, toml::Value>) -> Result<Vec<String>, FieldError> {
    let mut renamed = vec![String::new(); headings.len()];
    for (name, given) in names {
        for one in given.as_array().map_or(std::slice::from_ref(given), Vec::as_slice) {
            let text = one.as_str().unwrap_or_default();
            let (bare, unit) = name_and_unit(text).unwrap_or_default();
            let is_meant = |own: &str| !unit.is_empty() && (own == text || own == bare);
            if !headings.iter().any(|own| is_meant(own)) {
                let rule = format!("a heading of each file with its unit: {}", headings.join(", "));
                let first = |own: &str| own.split([' ', '(', '[']).next().unwrap_or_default().to_owned();
                let same = headings.iter().find(|own| first(own) == first(text)).or(headings.last()).unwrap_or(&"toe");
                let of_name = if ["t", "time"].contains(&name.as_str()) { "ms" } else { "cm" };
                let unit = stated(same).filter(|own| unit::is_known(own)).unwrap_or(of_name);
                let own = name_and_unit(same).map_or_else(|| format!("{same} [{unit}]"), |_| (*same).to_owned());
                let remedy = format!("write the heading and its unit in brackets, such as {name} = \"{own}\"");
                return Err(FieldError::new(&format!("columns.{name}"), one, &rule, &remedy));
            }
            check_stated(bare, unit).map_err(|rule| {
                FieldError::new(&format!("columns.{name}"), one, &rule, "correct the unit in brackets")
            })?;
            for (new, _) in renamed.iter_mut().zip(headings).filter(|(_, own)| is_meant(own)) {
                *new = format!("{name} [{unit}]");
            }
        }
    }
    Ok(renamed)
}

/// Unit in parentheses at the end of a heading.
fn stated(heading: &str) -> Option<&str> {
    heading.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')'))
}

/// Refuses a unit that is not the one in the heading's own parentheses, with the rule.
///
/// # Errors
/// The heading states another unit.
pub fn check_stated(heading: &str, unit: &str) -> Result<(), String> {
    let other = stated(heading).filter(|own| unit::is_known(own) && unit::factor(own, unit) != Some(1.0));
    other.map_or(Ok(()), |own| Err(format!("the unit that the heading states, [{own}]")))
}
