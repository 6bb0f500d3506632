//! One stored record as a file, in postcard.

use crate::input::STORED;
use crate::output::{Refused, SealedFormat};
use serde::{Serialize, de::DeserializeOwned};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

/// What the record holds is identified by the sources' hash in its key.
pub(crate) const RECORD: SealedFormat = SealedFormat { title: "bagnold record\n", version: 2, most: STORED };

/// The record of a key in a file; `None` if there is no such file.
///
/// # Errors
/// A file that cannot be read, is a link or no regular file, is damaged, or holds something else than this key's record.
pub(crate) fn read<R: DeserializeOwned>(path: &Path, key: &str) -> Result<Option<R>> {
    // Postcard would read almost any bytes as something, hence the checksum.
    read_bytes(path, key)?.map(|record| postcard::from_bytes(&record).map_err(Error::other)).transpose()
}

/// Reads a key's record, as bytes, in the same way.
///
/// # Errors
/// As for [`read`].
pub(crate) fn read_bytes(path: &Path, key: &str) -> Result<Option<Vec<u8>>> {
    match RECORD.read(path, Some(key)) {
        Err(Refused::Unreadable(error)) if error.kind() == ErrorKind::NotFound => Ok(None),
        record => record.map(Some).map_err(Error::other),
    }
}

/// Writes a key's record so that a reader sees all of it or nothing, also when several processes write it.
pub(crate) fn write<R: Serialize>(path: &Path, key: &str, record: &R) -> Result<()> {
    RECORD.write(path, key, &postcard::to_stdvec(record).map_err(Error::other)?)
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
        assert_eq!(refused(&moved, "b"), "belongs to another run, or to another version of the program");
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
        assert_eq!(refused(&link, "a"), "cannot be read (is a link, not a file of its own)");
        std::fs::remove_file(&link).expect("removable");
        std::fs::create_dir(&link).expect("writable");
        assert_eq!(refused(&link, "a"), "cannot be read (is a directory)");
    }
}
