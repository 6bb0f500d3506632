//! The folder of a calibration: which plan it belongs to.

use crate::ToolError;
use crate::input::{WRITTEN_BY_HAND, read_text};
use crate::output::{FileError, FolderLock, Owner, claim, owner_of};
use crate::store::{CodeOrigin, identity_or_unique, is_of_this_program};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Program and plan to which a folder belongs.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Belongs {
    source_hash: String,
    plan: String,
}

impl Owner for Belongs {
    const WHAT: &'static str = "calibration";
    const MARKER: &'static str = "plan.json";

    fn is_foreign(&self) -> bool {
        !is_of_this_program(&self.source_hash)
    }
}

/// A calibration on disk, which one process works on at a time: every search would do the same.
#[derive(Debug)]
pub struct CalibrationFolder {
    folder: PathBuf,
    _lock: FolderLock,
}

impl CalibrationFolder {
    /// Makes the folder of the calibration of a plan with cases of this origin, or continues it.
    ///
    /// # Errors
    /// A folder with another calibration, foreign files, or a calibration that is not to be resumed or that another
    /// command works on; files that cannot be read or written.
    pub fn begin(folder: &Path, plan: &Path, origin: CodeOrigin, resume: bool) -> Result<Self, ToolError> {
        let plan = read_text(plan, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(plan, &error))?;
        // what is unfinished is resumed; the result is written last
        let own = Belongs { source_hash: identity_or_unique(origin).to_owned(), plan };
        let unfinished = !folder.join("result.json").exists()
            && owner_of::<Belongs>(folder).is_ok_and(|other| other.as_ref() == Some(&own));
        let lock = claim(folder, &own, resume || unfinished)?;
        let begun = Self { folder: folder.to_owned(), _lock: lock };
        let evaluations = begun.evaluations();
        std::fs::create_dir_all(&evaluations).map_err(|error| FileError::unwritable(&evaluations, &error))?;
        Ok(begun)
    }

    /// Folder of the evaluations.
    pub fn evaluations(&self) -> PathBuf {
        self.folder.join("evaluations")
    }
}
