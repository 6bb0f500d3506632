//! One stored record as a file: a checksum and the record in postcard.

use crate::output::write_whole;
use serde::{Serialize, de::DeserializeOwned};
use sha2::{Digest, Sha256};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

const CHECKSUM_BYTES: usize = 32;

/// The record in a file; `None` if there is no such file.
pub(crate) fn read<R: DeserializeOwned>(path: &Path) -> Result<Option<R>> {
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
pub(crate) fn write<R: Serialize>(path: &Path, record: &R) -> Result<()> {
    let record = postcard::to_stdvec(record).map_err(Error::other)?;
    let mut bytes = Sha256::digest(&record).to_vec();
    bytes.extend(record);
    write_whole(path, &bytes)
}
