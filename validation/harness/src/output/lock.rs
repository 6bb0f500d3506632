//! One command at a time in a folder: an advisory lock on a file inside it, which ends with its process.
//!
//! Whoever is done removes the file while the lock is held. Whoever has locked a removed file begins again.

use super::error::{FileError, FolderError};
use crate::input::{WRITTEN_BY_HAND, read_text};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Name of the file.
pub(super) const LOCK: &str = ".bagnold-output-lock";

/// Attempts to lock a file that others remove meanwhile.
const ATTEMPTS: usize = 1000;

/// A folder that is ours until this is dropped.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    /// Closed after the file is removed, which ends the lock.
    _file: File,
    /// Folders that did not exist before, from the inside out; those that are still empty are removed.
    made: Vec<PathBuf>,
}

impl FolderLock {
    /// Makes a folder where it is missing, and locks it.
    ///
    /// # Errors
    /// Another command that has locked it; a folder or a file that cannot be made.
    pub(super) fn take(folder: &Path) -> Result<Self, FolderError> {
        let unwritable = |error: io::Error| FileError::unwritable(folder, &error);
        let path = folder.join(LOCK);
        let missing = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let made = missing.map(Path::to_owned).collect();
        for _ in 0..ATTEMPTS {
            let open = || OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
            let mut file = match std::fs::create_dir_all(folder).and_then(|()| open()) {
                // another command has just removed the folder
                Err(error) if error.kind() == ErrorKind::NotFound => continue,
                file => file.map_err(unwritable)?,
            };
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => break,
                Err(TryLockError::Error(error)) => {
                    tracing::debug!("{}: the file system has no locks ({error})", path.display());
                }
                Ok(()) if !is_at(&file, &path) => continue,
                Ok(()) => {}
            }
            file.set_len(0).and_then(|()| writeln!(file, "process {}", std::process::id())).map_err(unwritable)?;
            return Ok(Self { path, _file: file, made });
        }
        let holder = read_text(&path, WRITTEN_BY_HAND).unwrap_or_default();
        let by = holder.strip_suffix('\n').map_or_else(String::new, |holder| format!(" ({holder})"));
        Err(FolderError::Locked { folder: folder.to_owned(), by })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // best effort: a file that stays is locked again by the next command, and a folder that is not empty stays
        let _ = std::fs::remove_file(&self.path);
        for folder in &self.made {
            let _ = std::fs::remove_dir(folder);
        }
    }
}

/// Whether an open file is the one that has this name now.
fn is_at(file: &File, path: &Path) -> bool {
    let identity = |metadata: std::fs::Metadata| (metadata.dev(), metadata.ino());
    let own = file.metadata().map(identity).ok();
    own.is_some() && own == std::fs::symlink_metadata(path).map(identity).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        let lock = FolderLock::take(&folder).expect("free");
        let refused = FolderLock::take(&folder).expect_err("locked").to_string();
        let expected = format!(
            "output folder {}: in use by another bagnold command that is running (process {}), so nothing was changed; \
             wait until it has ended, or name another folder with --out",
            folder.display(),
            std::process::id()
        );
        assert_eq!(refused, expected);
        drop(lock);
        assert!(!folder.exists());
        // what a killed process leaves is a file without a lock
        std::fs::create_dir(&folder).expect("writable");
        std::fs::write(folder.join(LOCK), "process 17\n").expect("writable");
        drop(FolderLock::take(&folder).expect("free again"));
    }

    #[test]
    fn of_many_that_come_and_go_one_is_inside() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        let (inside, wins) = (AtomicUsize::new(0), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(lock) = FolderLock::take(&folder) {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0, "two at a time");
                            wins.fetch_add(1, Ordering::SeqCst);
                            inside.fetch_sub(1, Ordering::SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
        assert!(wins.load(Ordering::SeqCst) > 0);
    }
}
