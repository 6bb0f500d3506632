//! An archive of a submission, in the format `ustar` of POSIX.1-1988, whose bytes follow from the files alone.

use std::collections::BTreeSet;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Size of a record `[bytes]`.
const RECORD: usize = 512;

/// The files below a folder, and those that it names outside of itself, as one archive, in the order of their paths. The archive
/// has as many of the folders above as paths to files outside need.
///
/// # Errors
/// Files that cannot be read, or a name of more than 100 bytes.
pub(super) fn archive(folder: &Path, named: &[PathBuf], name: &str) -> io::Result<Vec<u8>> {
    let folder = folder.canonicalize()?;
    let above = |file: &PathBuf| file.components().take_while(|part| *part == Component::ParentDir).count();
    let root = folder.ancestors().nth(named.iter().map(above).max().unwrap_or(0)).unwrap_or(&folder);
    let mut all: BTreeSet<PathBuf> = files(&folder)?.into_iter().collect();
    for file in named.iter().filter(|file| above(file) > 0) {
        all.insert(folder.join(file).canonicalize()?);
    }
    let mut bytes = Vec::new();
    for file in all {
        let below = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        let contents = std::fs::read(&file)?;
        bytes.extend(header(&format!("{name}/{below}"), contents.len())?);
        bytes.extend(&contents);
        bytes.resize(bytes.len().next_multiple_of(RECORD), 0);
    }
    // two empty records end an archive
    bytes.resize(bytes.len() + 2 * RECORD, 0);
    Ok(bytes)
}

fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let below = std::fs::read_dir(folder)?.map(|entry| {
        let path = entry?.path();
        if path.is_dir() { files(&path) } else { Ok(vec![path]) }
    });
    Ok(below.collect::<io::Result<Vec<_>>>()?.concat())
}

/// Header of a file: readable by all, of no owner and no time.
fn header(name: &str, size: usize) -> io::Result<[u8; RECORD]> {
    let mut header = [0; RECORD];
    if name.len() > 100 {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, format!("{name}: longer than 100 bytes")));
    }
    let mut put = |at: usize, text: &str| header[at..at + text.len()].copy_from_slice(text.as_bytes());
    put(0, name);
    // mode, user and group
    put(100, "0000644");
    put(108, "0000000");
    put(116, "0000000");
    put(124, &format!("{size:011o}"));
    put(136, "00000000000");
    // the sum counts its own field as blanks
    put(148, "        0");
    put(257, "ustar");
    put(263, "00");
    let sum: u32 = header.iter().map(|byte| u32::from(*byte)).sum();
    header[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    Ok(header)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_archive_holds_the_files_in_order_and_is_the_same_each_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let cell = folder.path().join("cell");
        std::fs::create_dir_all(cell.join("deck")).expect("a folder");
        std::fs::write(cell.join("submission.toml"), "case").expect("written");
        std::fs::write(cell.join("deck/run.sh"), [b'x'; 513]).expect("written");
        let bytes = archive(&cell, &[], "code-film").expect("an archive");
        assert_eq!(bytes.len(), RECORD * (1 + 2 + 1 + 1 + 2));
        let starts_with = |at: usize, text: &str| bytes[at * RECORD..].starts_with(text.as_bytes());
        assert!(starts_with(0, "code-film/deck/run.sh\0") && starts_with(3, "code-film/submission.toml\0"));
        assert_eq!((&bytes[124..135], starts_with(4, "case\0")), (&b"00000001001"[..], true));
        assert_eq!(archive(&cell, &[], "code-film").expect("an archive"), bytes);
        assert!(archive(&cell, &[], &"a".repeat(100)).is_err());
        // a file outside keeps its place beside the folder
        std::fs::write(folder.path().join("front.csv"), "t").expect("written");
        let bytes = archive(&cell, &["../front.csv".into()], "a").expect("an archive");
        assert!(bytes.starts_with(b"a/cell/deck/run.sh\0") && bytes[5 * RECORD..].starts_with(b"a/front.csv\0"));
    }
}
