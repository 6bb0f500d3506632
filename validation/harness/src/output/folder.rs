//! The folder that a command writes: claimed before the work, filled at once after it.

use super::error::{FileError, FolderError};
use super::lock::{FolderLock, LOCK};
use super::publication::{self, COMMITTED, MARKER, STAGING, remove, write_marker};
use super::whole::OWN_PREFIX;
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// Entries of `reports/` in a fresh checkout, and those of other commands than a report: they make no folder foreign.
const OF_REPORTS: [&str; 12] = [
    "README.md",
    "gallery",
    "history.csv",
    "speeds.csv",
    "store",
    "runs",
    "judged",
    "sweeps",
    "calibrations",
    "suites",
    "mutation",
    "mutation-drawn",
];

/// A folder that is ours alone to write. What it held stays until [`OutputFolder::publish`]; without
/// that, dropping it leaves the folder as it was. Entries that Bagnold did not write always stay.
#[derive(Debug)]
pub struct OutputFolder {
    folder: PathBuf,
    staging: PathBuf,
    /// Whether the claim has marked the folder; without a publication it is then unmarked again.
    is_new: bool,
    /// Until this is dropped no other command writes the folder.
    _lock: FolderLock,
}

impl OutputFolder {
    /// Checks that the folder may be written before any simulation starts.
    ///
    /// # Errors
    /// A folder with foreign files, one that another command writes, or one that cannot be made or written, such as a link
    /// to nothing.
    pub fn claim(folder: &Path) -> Result<Self, FolderError> {
        refuse_foreign(folder, MARKER)?;
        let lock = FolderLock::take(folder)?;
        let (staging, is_new) = (folder.join(STAGING), !Self::is_one(folder));
        let claimed = Self { folder: folder.to_owned(), staging, is_new, _lock: lock };
        claimed.begin().map_err(|error| FileError::unwritable(folder, &error))?;
        Ok(claimed)
    }

    /// Marks the folder, so that it is known after a kill, and clears up after a command that was killed.
    fn begin(&self) -> io::Result<()> {
        if self.is_new {
            write_marker(&self.folder, &BTreeSet::new())?;
        }
        for entry in std::fs::read_dir(&self.folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with(OWN_PREFIX) && ![MARKER, LOCK, COMMITTED].contains(&&*name) {
                remove(&path)?;
            }
        }
        publication::finish(&self.folder)?;
        std::fs::create_dir(&self.staging)
    }

    /// Whether a folder was written by this program.
    pub fn is_one(folder: &Path) -> bool {
        folder.join(MARKER).is_file()
    }

    /// The folder that is claimed.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Folder in which the new contents are written.
    pub fn staging(&self) -> &Path {
        &self.staging
    }

    /// Puts the new contents in place of the old ones, after the disk has all of them.
    ///
    /// # Errors
    /// Files that cannot be moved; what a kill leaves undone is done by the next command that claims the folder.
    pub fn publish(mut self) -> Result<(), FolderError> {
        self.is_new = false;
        let published = publication::publish(&self.folder, &self.staging);
        published.map_err(|error| FileError::unwritable(&self.folder, &error).into())
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        // Best effort: whatever stays behind is inside a folder that the marker declares ours.
        let _ = remove(&self.staging);
        if self.is_new {
            let _ = remove(&self.folder.join(MARKER));
        }
    }
}

/// Refuses a folder that holds anything of others and no marker of this name.
pub(super) fn refuse_foreign(folder: &Path, marker: &str) -> Result<(), FolderError> {
    let mut entries = match std::fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries.map_err(|error| FileError::unwritable(folder, &error))?,
    };
    let is_reports = folder.file_name().is_some_and(|name| name == "reports");
    let is_own = |name: &str| name.starts_with(OWN_PREFIX) || (is_reports && OF_REPORTS.contains(&name));
    let has_foreign = entries.any(|entry| entry.is_ok_and(|entry| !is_own(&entry.file_name().to_string_lossy())));
    // looked for after the entries were read: another command may have put them there meanwhile, and marks before it does
    if has_foreign && !folder.join(marker).is_file() {
        return Err(FolderError::Foreign(folder.to_owned()));
    }
    Ok(())
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
    fn runs_before_the_first_report_of_a_checkout_do_not_make_its_folder_foreign() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("reports");
        std::fs::create_dir_all(folder.join("gallery")).expect("writable");
        publish(&folder.join("runs/bagnold-quick"), &["index.html"]);
        publish(&folder, &["index.html"]);
        assert_eq!(names(&folder), [MARKER, "gallery", "index.html", "runs"]);
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
    fn a_folder_is_one_commands_at_a_time_also_while_it_is_published() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        for others in [false, true] {
            let claimed = OutputFolder::claim(&folder).expect("claimable");
            let refused = OutputFolder::claim(&folder).expect_err("in use").to_string();
            assert!(refused.contains(&format!("running (process {})", std::process::id())), "{refused}");
            assert!(names(&folder).contains(&".bagnold-output-lock".to_owned()));
            std::fs::write(claimed.staging().join("x"), "").expect("writable");
            if others {
                std::fs::create_dir(folder.join("mine")).expect("writable");
            }
            claimed.publish().expect("publishable");
        }
        assert_eq!(names(&folder), [MARKER, "mine", "x"]);
    }

    #[test]
    fn of_many_that_begin_a_new_folder_one_has_it_and_none_takes_it_for_foreign() {
        let root = tempfile::tempdir().expect("temporary folder");
        for round in 0..20 {
            let folder = root.path().join(format!("{round}/out"));
            let start = std::sync::Barrier::new(8);
            let claim = || {
                start.wait();
                OutputFolder::claim(&folder)
            };
            let claims: Vec<_> = std::thread::scope(|scope| {
                let threads: Vec<_> = (0..8).map(|_| scope.spawn(claim)).collect();
                threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
            });
            assert_eq!(claims.iter().filter(|claim| claim.is_ok()).count(), 1, "{claims:?}");
            assert!(
                claims
                    .iter()
                    .flat_map(|claim| claim.as_ref().err())
                    .all(|error| matches!(error, FolderError::Locked { .. }))
            );
            drop(claims);
            // one that was refused may have made it
            assert!(!folder.exists() || names(&folder).is_empty(), "nothing has happened");
        }
    }

    #[test]
    fn a_link_to_nothing_is_refused() {
        let root = tempfile::tempdir().expect("temporary folder");
        let (link, target) = (root.path().join("link"), root.path().join("gone"));
        std::os::unix::fs::symlink(&target, &link).expect("a link");
        for folder in [link.clone(), link.join(""), link.join("below/it")] {
            let refused = OutputFolder::claim(&folder).expect_err("dangling").to_string();
            assert!(refused.starts_with(&format!("{}: cannot be written (", folder.display())), "{refused}");
        }
        std::fs::create_dir(&target).expect("writable");
        publish(&link, &["x"]);
        assert_eq!(names(&target), [MARKER, "x"]);
    }

    #[test]
    fn remains_of_a_kill_at_the_start_are_not_foreign() {
        let root = tempfile::tempdir().expect("temporary folder");
        for name in [".bagnold-output-01.partial", LOCK, STAGING] {
            std::fs::write(root.path().join(name), "half").expect("writable");
        }
        assert!(refuse_foreign(root.path(), "manifest.json").is_ok());
        drop(OutputFolder::claim(root.path()).expect("claimable"));
        assert_eq!(names(root.path()), [""; 0]);
        std::fs::write(root.path().join("thesis.tex"), "").expect("writable");
        assert!(refuse_foreign(root.path(), "manifest.json").is_err());
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
