//! A folder that belongs to one plan: begun once, continued when asked, never mixed with another.

use super::error::{FileError, FolderError, read_if_there};
use super::folder::refuse_foreign;
use super::lock::FolderLock;
use super::whole::write_whole;
use crate::input::STORED;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::Error;
use std::path::Path;

/// Owner of a folder, such as a sweep, kept in a file inside the folder.
pub trait Owner: Serialize + DeserializeOwned + PartialEq {
    /// Kind of work in the folder, for messages: `sweep`.
    const WHAT: &'static str;
    /// Name of the file.
    const MARKER: &'static str;

    /// Whether another program made it, whose numbers may differ from this one's.
    fn is_foreign(&self) -> bool;
}

/// Makes the folder and marks it, or continues it. While the lock is kept, no other process can claim the folder.
///
/// # Errors
/// A folder of another plan or program, foreign files, one that is locked, or one that is not to be resumed; files
/// that cannot be read or written.
pub fn claim<O: Owner>(folder: &Path, owner: &O, resume: bool) -> Result<FolderLock, FolderError> {
    refuse_foreign(folder, O::MARKER)?;
    let lock = FolderLock::take(folder)?;
    match owner_of::<O>(folder)? {
        Some(_) if !resume => Err(FolderError::InUse { what: O::WHAT, folder: folder.to_owned() }),
        Some(old) if old == *owner => Ok(lock),
        Some(old) => {
            Err(FolderError::OtherPlan { what: O::WHAT, folder: folder.to_owned(), by_program: old.is_foreign() })
        }
        None => {
            let text = serde_json::to_string_pretty(owner).map_err(Error::from);
            let written = text.and_then(|text| write_whole(&folder.join(O::MARKER), format!("{text}\n").as_bytes()));
            written.map_err(|error| FileError::unwritable(folder, &error))?;
            Ok(lock)
        }
    }
}

/// Owner of a folder; none without a marker.
///
/// # Errors
/// A marker that cannot be read or is damaged.
pub fn owner_of<O: Owner>(folder: &Path) -> Result<Option<O>, FileError> {
    let marker = folder.join(O::MARKER);
    let Some(text) = read_if_there(&marker, STORED)? else { return Ok(None) };
    let remedy = format!("begin the {} again with another --out", O::WHAT);
    serde_json::from_str(&text).map(Some).map_err(|error| FileError::damaged(&marker, error, &remedy))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Plan {
        version: u32,
        text: String,
    }

    impl Owner for Plan {
        const WHAT: &'static str = "study";
        const MARKER: &'static str = "study.json";
        fn is_foreign(&self) -> bool {
            self.version != 2
        }
    }

    fn plan(version: u32, text: &str) -> Plan {
        Plan { version, text: text.to_owned() }
    }

    #[test]
    fn a_folder_is_continued_only_when_asked_and_only_by_its_own_plan() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("new/study");
        assert_eq!(owner_of::<Plan>(&folder).expect("none"), None);
        let lock = claim(&folder, &plan(2, "a"), true).expect("a new folder");
        let locked = claim(&folder, &plan(2, "a"), true);
        assert!(matches!(locked, Err(FolderError::Locked { .. })), "{locked:?}");
        drop(lock);
        assert_eq!(owner_of(&folder).expect("whole"), Some(plan(2, "a")));
        assert!(matches!(claim(&folder, &plan(2, "a"), false), Err(FolderError::InUse { what: "study", .. })));
        drop(claim(&folder, &plan(2, "a"), true).expect("the same plan"));
        let other = claim(&folder, &plan(2, "b"), true);
        assert!(matches!(other, Err(FolderError::OtherPlan { by_program: false, .. })), "{other:?}");
        std::fs::write(folder.join("study.json"), "{\"version\":1,\"text\":\"a\"}").expect("writable");
        let older = claim(&folder, &plan(2, "a"), true);
        assert!(matches!(older, Err(FolderError::OtherPlan { by_program: true, .. })), "{older:?}");
        std::fs::write(folder.join("study.json"), "{").expect("writable");
        let damaged = claim(&folder, &plan(2, "a"), true).expect_err("half a marker");
        assert!(damaged.to_string().ends_with("begin the study again with another --out"), "{damaged}");
    }

    #[test]
    fn other_peoples_folders_are_left_alone() {
        let root = tempfile::tempdir().expect("temporary folder");
        std::fs::write(root.path().join("thesis.tex"), "years of work").expect("writable");
        for resume in [false, true] {
            let refused = claim(root.path(), &plan(2, "a"), resume);
            assert!(matches!(refused, Err(FolderError::Foreign(_))), "{refused:?}");
        }
        assert!(!root.path().join(Plan::MARKER).exists());
    }
}
