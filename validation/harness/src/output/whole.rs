//! Files that appear whole or not at all.

use super::lock::LOCK;
use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes a file so that a reader sees all of it or nothing, also when several processes write it or one is killed.
///
/// # Errors
/// A file that cannot be written.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    // machines that share a folder may have processes of the same number, hence the random part
    let random = RandomState::new().build_hasher().finish();
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let unique = format!("{}-{count}-{random:016x}.partial", std::process::id());
    let partial = path.with_extension(unique);
    write_through(&partial, contents).and_then(|()| std::fs::rename(&partial, path)).inspect_err(|_| {
        // Best effort: the error that counts is the one already at hand.
        let _ = std::fs::remove_file(&partial);
    })?;
    path.parent().map_or(Ok(()), settle)
}

/// Writes a file and waits until the disk has it: a rename may otherwise reach the disk before the contents do.
fn write_through(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut file = std::fs::File::create(path)?;
    file.write_all(contents)?;
    file.sync_all()
}

/// Waits until the disk has a folder's list of names.
pub(super) fn settle(folder: &Path) -> io::Result<()> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match std::fs::File::open(folder).and_then(|folder| folder.sync_all()) {
        // some file systems know no such thing, and a folder may be written to that may not be read
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::PermissionDenied) => Ok(()),
        settled => settled,
    }
}

/// Waits until the disk has everything in a folder.
pub(super) fn settle_all(folder: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            settle_all(&entry.path())?;
        } else {
            std::fs::File::open(entry.path())?.sync_all()?;
        }
    }
    settle(folder)
}

/// Whether a folder is missing, empty, or holds only what a command that was killed at its very start leaves.
///
/// # Errors
/// A folder that cannot be read.
pub(super) fn is_unused(folder: &Path) -> io::Result<bool> {
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        Err(error) => return Err(error),
    };
    for entry in entries {
        let path = entry?.path();
        if path.file_name().is_some_and(|name| name == LOCK) {
            continue;
        }
        let is_partial = path.extension().is_some_and(|ending| ending == "partial");
        if !is_partial && std::fs::read_dir(&path).map_or(true, |mut inside| inside.next().is_some()) {
            return Ok(false);
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remains_of_a_kill_at_the_start_do_not_count() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        assert!(is_unused(&folder).expect("readable"));
        std::fs::create_dir_all(folder.join("evaluations")).expect("writable");
        std::fs::write(folder.join("plan.17-0-00.partial"), "half").expect("writable");
        std::fs::write(folder.join(LOCK), "process 17\n").expect("writable");
        assert!(is_unused(&folder).expect("readable"));
        std::fs::write(folder.join("thesis.tex"), "").expect("writable");
        assert!(!is_unused(&folder).expect("readable"));
    }
}
