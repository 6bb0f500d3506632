//! One command at a time in a folder: an advisory lock that ends with its process, however that ends.
//!
//! The lock is held on a file inside the folder. When the folder is exchanged for its new contents, that file comes along as a
//! link (`publication`), so the lock stays with the folder's name. Whoever is done removes the file while he still
//! holds the lock; whoever has locked a file that is no longer the folder's begins again.

use super::error::{FileError, FolderError};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Name of the file.
pub(super) const LOCK: &str = ".bagnold-output-lock";

/// Attempts to lock a file that others remove meanwhile.
const ATTEMPTS: usize = 1000;

/// Attempts to read who holds a lock, and the time between them: he writes it right after he has locked.
const READINGS: usize = 20;
const READING_INTERVAL: Duration = Duration::from_millis(5);

/// Longest text of a lock's file `[bytes]`.
const LONGEST_HOLDER: u64 = 100;

/// A folder that is ours until this is dropped.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    /// Closed after the file is removed, which ends the lock.
    _file: File,
}

impl FolderLock {
    /// Locks a folder, which `make` makes where it is missing; another command may remove it meanwhile.
    ///
    /// # Errors
    /// Another command that has locked it; a folder or a file that cannot be made.
    pub(super) fn take(folder: &Path, mut make: impl FnMut() -> io::Result<()>) -> Result<Self, FolderError> {
        let unwritable = |error: io::Error| FileError::unwritable(folder, &error);
        let path = folder.join(LOCK);
        let mut gone = None;
        for _ in 0..ATTEMPTS {
            match make()
                .and_then(|()| OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path))
            {
                Ok(mut file) => match file.try_lock() {
                    Ok(()) if is_at(&file, &path) => {
                        write_holder(&mut file).map_err(unwritable)?;
                        return Ok(Self { path, _file: file });
                    }
                    // removed by the one who was done
                    Ok(()) => {}
                    Err(TryLockError::WouldBlock) => {
                        return Err(FolderError::Locked { folder: folder.to_owned(), by: holder(&path) });
                    }
                    Err(TryLockError::Error(error)) => {
                        tracing::debug!("{}: the file system knows no locks ({error})", path.display());
                        return Ok(Self { path, _file: file });
                    }
                },
                // a folder that another command has just given up
                Err(error) if error.kind() == ErrorKind::NotFound => gone = Some(error),
                Err(error) => return Err(unwritable(error).into()),
            }
        }
        Err(match gone {
            Some(error) => unwritable(error).into(),
            None => FolderError::Locked { folder: folder.to_owned(), by: String::new() },
        })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // best effort: a file that stays is locked again by the next command
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Whether an open file is the one that has this name now.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |metadata: std::fs::Metadata| (metadata.dev(), metadata.ino());
    let own = file.metadata().map(identity).ok();
    own.is_some() && own == std::fs::symlink_metadata(path).map(identity).ok()
}

/// Elsewhere a file that is open cannot be removed.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

fn write_holder(file: &mut File) -> io::Result<()> {
    file.set_len(0)?;
    file.rewind()?;
    file.write_all(format!("process {}\n", std::process::id()).as_bytes())
}

/// Holder of the lock, as far as its file states it: " (process 17)".
fn holder(path: &Path) -> String {
    for _ in 0..READINGS {
        let mut text = String::new();
        let read = File::open(path).and_then(|file| file.take(LONGEST_HOLDER).read_to_string(&mut text));
        if read.is_ok() && text.ends_with('\n') {
            return format!(" ({})", text.trim_end());
        }
        std::thread::sleep(READING_INTERVAL);
    }
    String::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(folder: &Path) -> Result<FolderLock, FolderError> {
        FolderLock::take(folder, || std::fs::create_dir_all(folder))
    }

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        let lock = take(&folder).expect("free");
        let refused = take(&folder).expect_err("locked").to_string();
        let expected = format!(
            "output folder {}: in use by another bagnold command that is running (process {}), so nothing was changed; \
             wait until it has ended, or name another folder with --out",
            folder.display(),
            std::process::id()
        );
        assert_eq!(refused, expected);
        drop(lock);
        assert_eq!(std::fs::read_dir(&folder).expect("readable").count(), 0);
        // what a killed process leaves is a file without a lock
        std::fs::write(folder.join(LOCK), "process 17\n").expect("writable");
        drop(take(&folder).expect("free again"));
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
                        if let Ok(lock) = take(&folder) {
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
