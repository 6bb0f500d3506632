//! The folder of a calibration: which plan it belongs to.

use crate::error::InputError;
use crate::output::{is_unused, write_whole};
use crate::store::source_hash;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What a folder belongs to.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Belongs {
    source_hash: String,
    plan: String,
}

/// A calibration on disk.
#[derive(Debug, Clone)]
pub struct CalibrationFolder {
    folder: PathBuf,
}

impl CalibrationFolder {
    /// Makes the folder of a plan's calibration, or continues it.
    ///
    /// # Errors
    /// A folder with another calibration, somebody else's files, or a calibration that is not to be resumed; files that
    /// cannot be read or written.
    pub fn begin(folder: &Path, plan: &Path, resume: bool) -> Result<Self, InputError> {
        let plan = std::fs::read_to_string(plan).map_err(|error| InputError::unreadable(plan, &error))?;
        let belongs = Belongs { source_hash: source_hash().to_owned(), plan };
        let marker = folder.join("plan.json");
        if marker.is_file() {
            if !resume {
                return Err(InputError::InUse { what: "calibration", folder: folder.to_owned() });
            }
            let text = std::fs::read_to_string(&marker).map_err(|error| InputError::unreadable(&marker, &error))?;
            let old: Belongs = serde_json::from_str(&text).map_err(|error| InputError::Damaged {
                file: marker.clone(),
                reason: error.to_string(),
                remedy: "begin the calibration again with another --out".to_owned(),
            })?;
            if old != belongs {
                let by_program = old.source_hash != belongs.source_hash;
                return Err(InputError::OtherPlan { what: "calibration", folder: folder.to_owned(), by_program });
            }
            return Ok(Self { folder: folder.to_owned() });
        }
        let unwritable = |error: std::io::Error| InputError::unwritable(folder, &error);
        if !is_unused(folder).map_err(unwritable)? {
            return Err(InputError::ForeignFolder { folder: folder.to_owned() });
        }
        let begun = Self { folder: folder.to_owned() };
        std::fs::create_dir_all(begun.evaluations()).map_err(unwritable)?;
        let text = serde_json::to_string_pretty(&belongs).map_err(|error| unwritable(error.into()))?;
        write_whole(&marker, text.as_bytes()).map_err(unwritable)?;
        Ok(begun)
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Where the evaluations are.
    #[must_use]
    pub fn evaluations(&self) -> PathBuf {
        self.folder.join("evaluations")
    }
}
