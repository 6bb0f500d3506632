//! The folder that a command writes: claimed before the work, filled in one go after it.

use super::error::{FileError, FolderError};
use super::publication;
use super::whole::write_whole;
use crate::input::{DOCUMENT, read_text};
use std::collections::BTreeSet;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Says that a folder is Bagnold's, and which of its entries are.
pub(super) const MARKER: &str = ".bagnold-output";

/// What a fresh checkout holds in `reports/`, and the store that tests may have filled: they make no folder foreign.
const COMMITTED: [&str; 4] = ["README.md", "gallery", "history.csv", "store"];

/// Begins the name of the folder in which a process puts the new contents together; its number follows.
pub(super) const STAGING_PREFIX: &str = ".bagnold-output-staging-";

const MARKER_TITLE: &str = "Written by bagnold, which replaces these entries the next time:";

/// A folder that is ours to write. What it held stays until [`OutputFolder::publish`]; without that,
/// dropping it leaves the folder as it was. Entries that Bagnold did not write always stay.
#[derive(Debug)]
pub struct OutputFolder {
    folder: PathBuf,
    staging: PathBuf,
    /// What the claim itself made, to be taken back if nothing is published.
    made: Vec<PathBuf>,
}

impl OutputFolder {
    /// Makes sure that the folder may be written, before any time is spent on what goes into it.
    ///
    /// # Errors
    /// A folder with somebody else's files, or one that cannot be made or written.
    pub fn claim(folder: &Path) -> Result<Self, FolderError> {
        let unwritable = |error: io::Error| FileError::unwritable(folder, &error);
        let mut claimed = Self {
            folder: folder.to_owned(),
            // The process's number keeps two commands apart that write to the same folder.
            staging: folder.join(format!("{STAGING_PREFIX}{}", std::process::id())),
            made: Vec::new(),
        };
        match std::fs::read_dir(folder) {
            Ok(mut entries) => {
                let is_reports = folder.file_name().is_some_and(|name| name == "reports");
                let is_committed = |name: &std::ffi::OsStr| is_reports && COMMITTED.iter().any(|kept| name == *kept);
                let is_foreign = entries.any(|entry| entry.is_ok_and(|entry| !is_committed(&entry.file_name())));
                if is_foreign && !folder.join(MARKER).is_file() {
                    return Err(FolderError::Foreign { folder: folder.to_owned() });
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let missing: Vec<PathBuf> = folder
                    .ancestors()
                    .filter(|path| !path.as_os_str().is_empty())
                    .take_while(|path| !path.exists())
                    .map(Path::to_owned)
                    .collect();
                std::fs::create_dir_all(folder).map_err(unwritable)?;
                claimed.made = missing;
            }
            Err(error) => return Err(unwritable(error).into()),
        }
        let marker = folder.join(MARKER);
        if !marker.exists() {
            // At once, so that what an interrupted run leaves behind is recognised by the next one.
            write_marker(folder, &BTreeSet::new()).map_err(unwritable)?;
            claimed.made.insert(0, marker);
        }
        publication::tidy(folder).map_err(unwritable)?;
        std::fs::create_dir_all(&claimed.staging).map_err(unwritable)?;
        Ok(claimed)
    }

    /// Makes a folder ours if it is new or empty, so that folders inside it do not make it somebody else's.
    ///
    /// # Errors
    /// A folder that cannot be made or written.
    pub fn adopt(folder: &Path) -> Result<(), FolderError> {
        let is_empty = std::fs::read_dir(folder).map_or(true, |mut entries| entries.next().is_none());
        if is_empty { Self::claim(folder)?.publish() } else { Ok(()) }
    }

    /// Where the new contents are written.
    #[must_use]
    pub fn staging(&self) -> &Path {
        &self.staging
    }

    /// Puts the new contents in place of the old ones, after the disk has all of them; by one rename where it can.
    ///
    /// # Errors
    /// Files that cannot be moved; what a kill leaves undone is done by the next command that claims the folder.
    pub fn publish(mut self) -> Result<(), FolderError> {
        self.made.clear();
        publication::publish(&self.folder, &self.staging)
            .map_err(|error| FileError::unwritable(&self.folder, &error).into())
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        // Best effort: whatever stays behind is inside a folder that the marker declares ours.
        let _ = std::fs::remove_dir_all(&self.staging);
        for path in &self.made {
            let _ = if path.is_dir() { std::fs::remove_dir(path) } else { std::fs::remove_file(path) };
        }
    }
}

pub(super) fn write_marker(folder: &Path, entries: &BTreeSet<String>) -> io::Result<()> {
    let lines: String = entries.iter().map(|name| format!("{name}\n")).collect();
    write_whole(&folder.join(MARKER), format!("{MARKER_TITLE}\n{lines}").as_bytes())
}

/// The entries that Bagnold wrote. A name that leads out of the folder was not written by it.
pub(super) fn read_marker(folder: &Path) -> BTreeSet<String> {
    let is_plain = |name: &str| {
        let mut parts = Path::new(name).components();
        matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None))
    };
    let text = read_text(&folder.join(MARKER), DOCUMENT).unwrap_or_default();
    text.lines().skip(1).filter(|name| is_plain(name)).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(folder)
            .expect("readable")
            .flatten()
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    fn publish(folder: &Path, entries: &[&str]) {
        let claimed = OutputFolder::claim(folder).expect("claimable");
        for name in entries {
            let path = claimed.staging().join(name);
            std::fs::create_dir_all(path.parent().expect("below the staging folder")).expect("writable");
            std::fs::write(path, *name).expect("writable");
        }
        claimed.publish().expect("publishable");
    }

    #[test]
    fn our_entries_are_replaced_and_others_stay() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("new/out");
        publish(&folder, &["index.html", "figures/a.svg", "old.csv"]);
        std::fs::write(folder.join("notes.txt"), "mine").expect("writable");
        publish(&folder, &["index.html", "figures/b.svg"]);
        assert_eq!(names(&folder), [MARKER, "figures", "index.html", "notes.txt"]);
        assert_eq!(names(&folder.join("figures")), ["b.svg"]);
    }

    #[test]
    fn a_folder_with_foreign_files_is_refused_and_left_alone() {
        let root = tempfile::tempdir().expect("temporary folder");
        std::fs::write(root.path().join("thesis.tex"), "").expect("writable");
        let message = OutputFolder::claim(root.path()).expect_err("foreign").to_string();
        let expected = format!(
            "output folder {}: not empty and not written by bagnold, so nothing was changed; name an empty or new folder with --out",
            root.path().display()
        );
        assert_eq!(message, expected);
        assert_eq!(names(root.path()), ["thesis.tex"]);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named_with_the_reason() {
        let root = tempfile::tempdir().expect("temporary folder");
        let file = root.path().join("file");
        std::fs::write(&file, "").expect("writable");
        // Below a file nobody can make a folder, not even root.
        let folder = file.join("out");
        let message = OutputFolder::claim(&folder).expect_err("not writable").to_string();
        let expected = format!(
            "{}: cannot be written (not a directory); choose a folder that you may write to with --out",
            folder.display()
        );
        assert_eq!(message, expected);
    }

    #[test]
    fn without_publishing_nothing_has_happened() {
        let root = tempfile::tempdir().expect("temporary folder");
        drop(OutputFolder::claim(&root.path().join("a/b")).expect("claimable"));
        assert_eq!(names(root.path()), [""; 0]);
        publish(&root.path().join("c"), &["x"]);
        drop(OutputFolder::claim(&root.path().join("c")).expect("claimable"));
        assert_eq!(names(&root.path().join("c")), [MARKER, "x"]);
    }

    #[test]
    fn a_marker_cannot_make_us_delete_elsewhere() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        publish(&folder, &["x"]);
        std::fs::write(root.path().join("precious"), "").expect("writable");
        std::fs::write(folder.join(MARKER), "title\n../precious\n..\nx\n").expect("writable");
        publish(&folder, &["y"]);
        assert_eq!(names(root.path()), ["out", "precious"]);
        assert_eq!(names(&folder), [MARKER, "y"]);
    }
}
