//! A checkpoint as a file: a title, the version of the form, the key of the run, a checksum, and the state.

use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

const TITLE: &[u8] = b"bagnold checkpoint\n";

/// Version of this form, and of what a run's state consists of.
const VERSION: u32 = 1;

const CHECKSUM_BYTES: usize = 32;

/// Files begun by this process.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// Reason why a checkpoint is not continued.
#[derive(Debug, thiserror::Error)]
pub(super) enum Refused {
    /// It cannot be read.
    #[error("it cannot be read ({0})")]
    Unreadable(#[from] io::Error),
    /// It is a folder, a link or a pipe.
    #[error("it is no plain file")]
    NoFile,
    /// It does not begin as checkpoints do.
    #[error("it is no checkpoint")]
    NoCheckpoint,
    /// Another form.
    #[error("it has the form {0} of checkpoints, this program reads the form {VERSION}")]
    Version(u32),
    /// Another key.
    #[error("it belongs to another run, or to another version of the program")]
    Foreign,
    /// It was cut short or changed.
    #[error("it is damaged")]
    Damaged,
    /// Its contents are no state of this run.
    #[error("it does not hold the state of this run ({0})")]
    State(String),
}

/// The state in a checkpoint of the run with a key, or of any run.
pub(super) fn read(path: &Path, key: Option<&str>) -> Result<Vec<u8>, Refused> {
    if !std::fs::symlink_metadata(path)?.is_file() {
        return Err(Refused::NoFile);
    }
    let file = File::open(path)?;
    let part = |length: u64| {
        let mut bytes = Vec::new();
        (&file).take(length).read_to_end(&mut bytes).map(|_| bytes)
    };
    let title = part(TITLE.len() as u64)?;
    if title != TITLE {
        return Err(if TITLE.starts_with(&title) { Refused::Damaged } else { Refused::NoCheckpoint });
    }
    let version = part(4)?.try_into().map_err(|_| Refused::Damaged)?;
    match u32::from_le_bytes(version) {
        VERSION => {}
        other => return Err(Refused::Version(other)),
    }
    let length = u64::from_le_bytes(part(8)?.try_into().map_err(|_| Refused::Damaged)?);
    let own = part(length)?;
    if own.len() as u64 == length && key.is_some_and(|key| own != key.as_bytes()) {
        return Err(Refused::Foreign);
    }
    let (checksum, contents) = (part(CHECKSUM_BYTES as u64)?, part(u64::MAX)?);
    if *Sha256::digest(&contents) != *checksum { Err(Refused::Damaged) } else { Ok(contents) }
}

/// Head of a checkpoint file, which precedes the contents.
fn head(key: &str, contents: &[u8]) -> Vec<u8> {
    let length = (key.len() as u64).to_le_bytes();
    let checksum = Sha256::digest(contents);
    debug_assert_eq!(checksum.len(), CHECKSUM_BYTES);
    [TITLE, &VERSION.to_le_bytes(), &length, key.as_bytes(), checksum.as_slice()].concat()
}

/// Writes a checkpoint so that after a crash at any moment there is all of it or nothing.
pub(super) fn write(path: &Path, key: &str, contents: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // two threads, or processes, may write the same run
    let half = folder.join(format!(".{name}-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
    let written = File::create(&half).and_then(|mut file| {
        file.write_all(&head(key, contents))?;
        file.write_all(contents)?;
        file.sync_all()
    });
    if let Err(error) = written.and_then(|()| std::fs::rename(&half, path)) {
        let _ = std::fs::remove_file(&half);
        return Err(error);
    }
    // the name is as durable as the contents; a system without fsync of folders does not say so
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}
