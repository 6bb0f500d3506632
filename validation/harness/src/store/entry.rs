//! One stored record as a file: what it is, whose it is, a checksum, and the record in postcard.
//!
//! ```text
//! "bagnold record\n\0"   16 bytes
//! version               u32, little endian
//! length of the key     u32, little endian
//! key                   UTF-8
//! SHA-256               32 bytes, over all of the above and the record
//! record                postcard
//! ```

use crate::input::{STORED, read_own};
use crate::output::write_whole;
use serde::{Serialize, de::DeserializeOwned};
use sha2::{Digest, Sha256};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

const TITLE: &[u8; 16] = b"bagnold record\n\0";

/// Changes with the layout above; what the record holds is identified by the sources' hash in its key.
const VERSION: u32 = 1;

const CHECKSUM_BYTES: usize = 32;

/// The record of a key in a file; `None` if there is no such file.
///
/// # Errors
/// A file that cannot be read, is a link or no regular file, is damaged, or holds something else than this key's record.
pub(crate) fn read<R: DeserializeOwned>(path: &Path, key: &str) -> Result<Option<R>> {
    // Postcard would read almost any bytes as something, hence the checksum.
    read_bytes(path, key)?.map(|record| postcard::from_bytes(&record).map_err(Error::other)).transpose()
}

/// The same for a record that is bytes.
///
/// # Errors
/// As for [`read`].
pub(crate) fn read_bytes(path: &Path, key: &str) -> Result<Option<Vec<u8>>> {
    let bytes = match read_own(path, STORED) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let refused = |reason: &str| Error::new(ErrorKind::InvalidData, reason);
    let damaged = || refused("is damaged");
    let rest = bytes.strip_prefix(TITLE).ok_or_else(|| refused("is no record of bagnold, or is damaged"))?;
    let (version, rest) = number(rest).ok_or_else(damaged)?;
    if version != VERSION {
        return Err(refused(&format!("has the layout {version}, not {VERSION}")));
    }
    let (length, rest) = number(rest).ok_or_else(damaged)?;
    let (own, rest) = rest.split_at_checked(length as usize).ok_or_else(damaged)?;
    let (checksum, record) = rest.split_at_checked(CHECKSUM_BYTES).ok_or_else(damaged)?;
    if digest(own, record).as_slice() != checksum {
        return Err(damaged());
    }
    if own != key.as_bytes() {
        return Err(refused("belongs to another run or drawing"));
    }
    Ok(Some(record.to_vec()))
}

/// Writes a key's record so that a reader sees all of it or nothing, also when several processes write it.
pub(crate) fn write<R: Serialize>(path: &Path, key: &str, record: &R) -> Result<()> {
    write_bytes(path, key, &postcard::to_stdvec(record).map_err(Error::other)?)
}

/// The same for a record that is bytes.
pub(crate) fn write_bytes(path: &Path, key: &str, record: &[u8]) -> Result<()> {
    let mut bytes = header(key.as_bytes());
    bytes.extend(digest(key.as_bytes(), record));
    bytes.extend(record);
    write_whole(path, &bytes)
}

fn header(key: &[u8]) -> Vec<u8> {
    // a key is a few dozen digits
    let length = u32::try_from(key.len()).unwrap_or(u32::MAX);
    [&TITLE[..], &VERSION.to_le_bytes(), &length.to_le_bytes(), key].concat()
}

fn digest(key: &[u8], record: &[u8]) -> Vec<u8> {
    let mut hash = Sha256::new();
    hash.update(header(key));
    hash.update(record);
    hash.finalize().to_vec()
}

fn number(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk::<4>()?;
    Some((u32::from_le_bytes(*number), rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(path: &Path, key: &str) -> String {
        read::<String>(path, key).expect_err("refused").to_string()
    }

    #[test]
    fn an_entry_is_read_under_its_own_key_only() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let (path, moved) = (folder.path().join("a"), folder.path().join("b"));
        assert_eq!(read::<String>(&path, "a").expect("none"), None);
        write(&path, "a", &"record").expect("writable");
        assert_eq!(read(&path, "a").expect("readable"), Some("record".to_owned()));
        std::fs::rename(&path, &moved).expect("movable");
        assert_eq!(refused(&moved, "b"), "belongs to another run or drawing");
        let whole = std::fs::read(&moved).expect("readable");
        for bit in 0..8 * whole.len() {
            let mut flipped = whole.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            std::fs::write(&moved, flipped).expect("writable");
            assert!(read::<String>(&moved, "a").is_err(), "bit {bit} is not covered");
        }
    }

    #[cfg(unix)]
    #[test]
    fn an_entry_is_a_file_of_its_own() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let link = folder.path().join("a");
        std::os::unix::fs::symlink("/dev/zero", &link).expect("a link");
        assert_eq!(refused(&link, "a"), "is a link, not a file of its own");
        std::fs::remove_file(&link).expect("removable");
        std::fs::create_dir(&link).expect("writable");
        assert_eq!(refused(&link, "a"), "is a directory");
    }
}
