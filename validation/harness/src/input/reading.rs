//! Files that are read: regular ones, and not larger than the limit of their kind.
//!
//! A pipe would block, a device never ends, and a file of gigabytes is no case: each is refused before its contents are
//! looked at, with a reason that goes into the error of whoever reads.

use rustix::fs::OFlags;
use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result};
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::path::Path;

/// Largest file that people write by hand: cases, plans, templates and lists `[bytes]`.
pub const WRITTEN_BY_HAND: u64 = 1 << 20;

/// Largest table of measurements, and largest document that a program wrote `[bytes]`.
pub const DOCUMENT: u64 = 1 << 27;

/// Largest file of a program's own results: a stored run with its snapshots, the manifest of a sweep `[bytes]`.
pub const STORED: u64 = 1 << 32;

/// Reads a text file of at most a number of bytes. Links are followed: a file may be named by a link.
pub fn read_text(path: &Path, most: u64) -> Result<String> {
    let bytes = read_bytes(path, most)?;
    // what some editors and spreadsheets call Unicode begins with a mark of two bytes
    let is_utf16 = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let what = if is_utf16 { "text in UTF-16, not in UTF-8" } else { "no text in UTF-8" };
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, what))
}

/// A file that a program wrote under this very name: no link.
pub fn read_own(path: &Path, most: u64) -> Result<Vec<u8>> {
    if std::fs::symlink_metadata(path)?.file_type().is_symlink() {
        return Err(Error::new(ErrorKind::InvalidInput, "is a link, not a file of its own"));
    }
    read_bytes(path, most)
}

/// Reads any file of at most a number of bytes. Links are followed.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>> {
    let file = open_file(path)?;
    let too_large = || Error::new(ErrorKind::FileTooLarge, format!("is larger than {} MiB", most >> 20));
    if file.metadata()?.len() > most {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    // one more than allowed: the file may grow meanwhile
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large()) } else { Ok(bytes) }
}

/// A regular file of any size, to be read piece by piece. Links are followed.
pub fn open_file(path: &Path) -> Result<File> {
    // without waiting for a writer of a pipe
    let flags = OFlags::NONBLOCK.bits();
    let file = OpenOptions::new().read(true).custom_flags(i32::try_from(flags).unwrap_or_default()).open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        let kind = if metadata.file_type().is_fifo() { "a named pipe" } else { "a device" };
        return Err(Error::new(ErrorKind::InvalidInput, format!("is {kind}, not a regular file")));
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(path: &Path, most: u64) -> String {
        read_text(path, most).expect_err("refused").to_string()
    }

    #[test]
    fn only_regular_files_of_a_reasonable_size_are_read() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let file = folder.path().join("file");
        std::fs::write(&file, vec![b'a'; 1 << 20]).expect("writable");
        assert_eq!(read_text(&file, 1 << 20).expect("readable").len(), 1 << 20);
        std::fs::write(&file, vec![b'a'; (1 << 20) + 1]).expect("writable");
        assert_eq!(refused(&file, 1 << 20), "is larger than 1 MiB");
        assert_eq!(refused(folder.path(), 1 << 20), "is a directory");
    }

    #[test]
    fn devices_pipes_and_links_of_ours_are_refused_without_a_wait() {
        let folder = tempfile::tempdir().expect("temporary folder");
        assert_eq!(refused(Path::new("/dev/zero"), 1 << 20), "is a device, not a regular file");
        let pipe = folder.path().join("pipe");
        let mode = rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR;
        rustix::fs::mknodat(rustix::fs::CWD, &pipe, rustix::fs::FileType::Fifo, mode, 0).expect("a pipe");
        assert_eq!(refused(&pipe, 1 << 20), "is a named pipe, not a regular file");
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("/dev/zero", &link).expect("a link");
        assert_eq!(refused(&link, 1 << 20), "is a device, not a regular file");
        assert_eq!(read_own(&link, 1 << 20).expect_err("refused").to_string(), "is a link, not a file of its own");
    }
}
