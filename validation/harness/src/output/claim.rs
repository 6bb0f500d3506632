//! A folder that belongs to one plan: begun once, continued when asked, never mixed with another.

use super::error::{FileError, FolderError};
use super::lock::FolderLock;
use super::whole::{is_unused, write_whole};
use crate::input::{STORED, read_text};
use serde::Serialize;
use serde::de::DeserializeOwned;
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

/// Makes the folder and marks it, or continues it. The marker comes last, so that a folder with one is whole. While the lock
/// that comes with it is kept, no other process can claim the folder.
///
/// # Errors
/// A folder of another plan or program, foreign files, one that is locked, or one that is not to be resumed; files
/// that cannot be read or written.
pub fn claim<O: Owner>(folder: &Path, owner: O, resume: bool) -> Result<(O, FolderLock), FolderError> {
    let unwritable = |error: std::io::Error| FileError::unwritable(folder, &error);
    FolderError::refuse_dangling(folder)?;
    // the second look is for a command that has marked it between the first and the look inside
    if !is_claimed::<O>(folder) && !is_unused(folder).map_err(unwritable)? && !is_claimed::<O>(folder) {
        return Err(FolderError::Foreign { folder: folder.to_owned() });
    }
    let lock = FolderLock::take(folder, || std::fs::create_dir_all(folder))?;
    if is_claimed::<O>(folder) {
        return continued(folder, &owner, resume).map(|old| (old, lock));
    }
    let text = serde_json::to_string_pretty(&owner).map_err(|error| unwritable(error.into()))?;
    write_whole(&folder.join(O::MARKER), format!("{text}\n").as_bytes()).map_err(unwritable)?;
    Ok((owner, lock))
}

/// The owner of a marked folder, if it is the same.
fn continued<O: Owner>(folder: &Path, owner: &O, resume: bool) -> Result<O, FolderError> {
    if !resume {
        return Err(FolderError::InUse { what: O::WHAT, folder: folder.to_owned() });
    }
    let old: O = owner_of(folder)?;
    if old == *owner {
        return Ok(old);
    }
    Err(FolderError::OtherPlan { what: O::WHAT, folder: folder.to_owned(), by_program: old.is_foreign() })
}

/// Whether the folder is marked.
#[must_use]
pub fn is_claimed<O: Owner>(folder: &Path) -> bool {
    folder.join(O::MARKER).is_file()
}

/// Owner of a marked folder.
///
/// # Errors
/// A marker that cannot be read or is damaged.
pub fn owner_of<O: Owner>(folder: &Path) -> Result<O, FileError> {
    let marker = folder.join(O::MARKER);
    let text = read_text(&marker, STORED).map_err(|error| FileError::unreadable(&marker, &error))?;
    serde_json::from_str(&text).map_err(|error| FileError::Damaged {
        file: marker,
        reason: error.to_string(),
        remedy: format!("begin the {} again with another --out", O::WHAT),
    })
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
        assert!(!is_claimed::<Plan>(&folder));
        let (begun, lock) = claim(&folder, plan(2, "a"), true).expect("a new folder");
        assert_eq!(begun, plan(2, "a"));
        let locked = claim(&folder, plan(2, "a"), true);
        assert!(matches!(locked, Err(FolderError::Locked { .. })), "{locked:?}");
        drop(lock);
        assert!(is_claimed::<Plan>(&folder));
        assert!(matches!(claim(&folder, plan(2, "a"), false), Err(FolderError::InUse { what: "study", .. })));
        assert_eq!(claim(&folder, plan(2, "a"), true).expect("the same plan").0, plan(2, "a"));
        let other = claim(&folder, plan(2, "b"), true);
        assert!(matches!(other, Err(FolderError::OtherPlan { by_program: false, .. })), "{other:?}");
        std::fs::write(folder.join("study.json"), "{\"version\":1,\"text\":\"a\"}").expect("writable");
        let older = claim(&folder, plan(2, "a"), true);
        assert!(matches!(older, Err(FolderError::OtherPlan { by_program: true, .. })), "{older:?}");
        std::fs::write(folder.join("study.json"), "{").expect("writable");
        let damaged = claim(&folder, plan(2, "a"), true).expect_err("half a marker");
        assert!(damaged.to_string().ends_with("begin the study again with another --out"), "{damaged}");
    }

    #[test]
    fn other_peoples_folders_are_left_alone() {
        let root = tempfile::tempdir().expect("temporary folder");
        std::fs::write(root.path().join("thesis.tex"), "years of work").expect("writable");
        for resume in [false, true] {
            let refused = claim(root.path(), plan(2, "a"), resume);
            assert!(matches!(refused, Err(FolderError::Foreign { .. })), "{refused:?}");
        }
        assert!(!is_claimed::<Plan>(root.path()));
    }
}
