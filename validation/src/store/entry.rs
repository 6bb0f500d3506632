//! One stored record as a file: a checksum and the record in postcard.

use crate::observe::Recorded;
use serde::{Serialize, de::DeserializeOwned};
use sha2::{Digest, Sha256};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

const CHECKSUM_BYTES: usize = 32;

/// The record in a file; `None` if there is no such file.
pub(super) fn read<O: DeserializeOwned>(path: &Path) -> Result<Option<Recorded<O>>> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    // Postcard would read almost any bytes as something, hence the checksum.
    let damaged = || Error::new(ErrorKind::InvalidData, "damaged");
    let (checksum, record) = bytes.split_at_checked(CHECKSUM_BYTES).ok_or_else(damaged)?;
    if Sha256::digest(record).as_slice() != checksum {
        return Err(damaged());
    }
    postcard::from_bytes(record).map(Some).map_err(Error::other)
}

/// Writes a record so that a reader sees all of it or nothing, also when several processes write it.
pub(super) fn write<O: Serialize>(path: &Path, record: &Recorded<O>) -> Result<()> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let record = postcard::to_stdvec(record).map_err(Error::other)?;
    let mut bytes = Sha256::digest(&record).to_vec();
    bytes.extend(record);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let unique = format!("{}-{}.partial", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let partial = path.with_extension(unique);
    std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path)).inspect_err(|_| {
        // Best effort: the error that counts is the one already at hand.
        let _ = std::fs::remove_file(&partial);
    })
}
