//! Files of the program's own data: what it is, whose it is, a checksum, and the data.
//!
//! ```text
//! title                 such as "bagnold record\n"
//! version               u32, little endian
//! length of the key     u64, little endian
//! key                   UTF-8
//! SHA-256               32 bytes, over the data
//! data
//! ```

use super::whole::write_parts;
use crate::input::read_own;
use sha2::{Digest, Sha256};
use std::io;
use std::path::Path;

/// A kind of such files.
#[derive(Debug)]
pub(crate) struct SealedFormat {
    /// Begins the file.
    pub(crate) title: &'static str,
    /// Version of the form of the data.
    pub(crate) version: u32,
    /// Largest file `[bytes]`.
    pub(crate) most: u64,
}

/// Reason why a file is not used, as a clause after its name.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refused {
    /// It cannot be read, or is a folder, a link or a pipe.
    #[error("cannot be read ({0})")]
    Unreadable(#[from] io::Error),
    /// It does not begin as its kind does.
    #[error("is not a {0}")]
    OtherKind(&'static str),
    /// Another form.
    #[error("has format {0}, but this program reads format {1}")]
    Version(u32, u32),
    /// Another key.
    #[error("belongs to another run, or to another version of the program")]
    Foreign,
    /// It was cut short or changed.
    #[error("is damaged")]
    Damaged,
}

impl SealedFormat {
    /// The data in a file of a key, or of any key.
    pub(crate) fn read(&self, path: &Path, key: Option<&str>) -> Result<Vec<u8>, Refused> {
        let mut bytes = read_own(path, self.most)?;
        let is_begun = self.title.as_bytes().starts_with(&bytes);
        let other = || if is_begun { Refused::Damaged } else { Refused::OtherKind(self.title.trim_end()) };
        let rest = bytes.strip_prefix(self.title.as_bytes()).ok_or_else(other)?;
        let (version, rest) = rest.split_first_chunk().ok_or(Refused::Damaged)?;
        match u32::from_le_bytes(*version) {
            version if version == self.version => {}
            version => return Err(Refused::Version(version, self.version)),
        }
        let (length, rest) = rest.split_first_chunk().ok_or(Refused::Damaged)?;
        let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| Refused::Damaged)?;
        let (own, rest) = rest.split_at_checked(length).ok_or(Refused::Damaged)?;
        if key.is_some_and(|key| own != key.as_bytes()) {
            return Err(Refused::Foreign);
        }
        let (checksum, data) = rest.split_first_chunk::<32>().ok_or(Refused::Damaged)?;
        if Sha256::digest(data).as_slice() != checksum {
            return Err(Refused::Damaged);
        }
        let head = bytes.len() - data.len();
        bytes.drain(..head);
        Ok(bytes)
    }

    /// Writes a key's data so that a reader sees all of it or nothing, also when several processes write it.
    pub(crate) fn write(&self, path: &Path, key: &str, data: &[u8]) -> io::Result<()> {
        let (version, length) = (self.version.to_le_bytes(), (key.len() as u64).to_le_bytes());
        let checksum = Sha256::digest(data);
        write_parts(path, &[self.title.as_bytes(), &version, &length, key.as_bytes(), &checksum, data])
    }
}
