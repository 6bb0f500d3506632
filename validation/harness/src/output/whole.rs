//! Files that appear whole or not at all.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Write};
use std::path::Path;

/// Begins the names of everything that Bagnold puts into a folder beside its results: marker, lock, half written files.
pub(super) const OWN_PREFIX: &str = ".bagnold-output";

/// Writes a file so that a reader sees all of it or nothing, also when several processes write it or one is killed.
///
/// # Errors
/// A file that cannot be written.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    write_parts(path, &[contents])
}

/// Writes the parts of a file one after the other, with the guarantee of [`write_whole`].
///
/// # Errors
/// A file that cannot be written.
pub(crate) fn write_parts(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    std::fs::create_dir_all(folder)?;
    // random: threads, processes and machines may write the same file
    let random = RandomState::new().build_hasher().finish();
    let partial = folder.join(format!("{OWN_PREFIX}-{random:016x}.partial"));
    write_through(&partial, parts).and_then(|()| std::fs::rename(&partial, path)).inspect_err(|_| {
        // Best effort: the error that counts is the one already at hand.
        let _ = std::fs::remove_file(&partial);
    })?;
    settle(folder)
}

/// Writes a file and waits until the disk has it: a rename may otherwise reach the disk before the contents do.
fn write_through(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let mut file = std::fs::File::create(path)?;
    parts.iter().try_for_each(|part| file.write_all(part))?;
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
