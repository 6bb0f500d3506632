//! Replacement of old contents by new ones.
//!
//! One rename commits the new contents inside the folder. Their entries then take the place of the old ones, after which the
//! next claim of the folder continues if a kill interrupted it. Old entries leave before new ones come, [`RESULTS`] leave first and
//! come last: a folder with a result in it is whole.

use super::whole::{OWN_PREFIX, settle, settle_all, write_whole};
use crate::input::{DOCUMENT, read_text};
use std::collections::BTreeSet;
use std::io;
use std::path::{Component, Path};

/// Name of the file that marks a folder as Bagnold's and lists the entries that it wrote.
pub(super) const MARKER: &str = OWN_PREFIX;

const MARKER_TITLE: &str = "Written by bagnold, which replaces these entries the next time:";

/// Folder in which new contents are put together; the next claim deletes what a killed command left.
pub(super) const STAGING: &str = ".bagnold-output-staging";

/// Contents that are committed, but not yet all in their place.
pub(super) const COMMITTED: &str = ".bagnold-output-new";

/// Entries that are read as a result.
const RESULTS: [&str; 2] = ["index.html", "metrics.json"];

/// Puts what is in `staging` in place of what Bagnold wrote into `folder` before.
pub(super) fn publish(folder: &Path, staging: &Path) -> io::Result<()> {
    let names: io::Result<_> =
        std::fs::read_dir(staging)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect();
    write_marker(staging, &names?)?;
    settle_all(staging)?;
    std::fs::rename(staging, folder.join(COMMITTED))?;
    settle(folder)?;
    finish(folder)
}

/// Moves committed contents into their places, if there are any; may be begun again after a kill.
pub(super) fn finish(folder: &Path) -> io::Result<()> {
    let committed = folder.join(COMMITTED);
    if !committed.is_dir() {
        return Ok(());
    }
    let (old, new) = (read_marker(folder), read_marker(&committed));
    let all = old.union(&new).cloned().collect();
    write_marker(folder, &all)?;
    let is_result = |name: &&String| RESULTS.contains(&name.as_str());
    let (results, others): (Vec<&String>, Vec<&String>) = all.iter().partition(is_result);
    for name in results.iter().chain(&others) {
        // a new one that is not among the committed ones any more is in its place
        if !new.contains(*name) || committed.join(name).symlink_metadata().is_ok() {
            remove(&folder.join(name))?;
        }
    }
    for name in others.iter().chain(&results) {
        unless_missing(std::fs::rename(committed.join(name), folder.join(name)))?;
    }
    write_marker(folder, &new)?;
    // by one rename: half of it must not be taken for committed contents
    let staging = folder.join(STAGING);
    std::fs::rename(&committed, &staging)?;
    remove(&staging)?;
    settle(folder)
}

/// Success also of what found nothing to be done.
fn unless_missing(done: io::Result<()>) -> io::Result<()> {
    match done {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        done => done,
    }
}

pub(super) fn write_marker(folder: &Path, entries: &BTreeSet<String>) -> io::Result<()> {
    let lines: String = entries.iter().map(|name| format!("{name}\n")).collect();
    write_whole(&folder.join(MARKER), format!("{MARKER_TITLE}\n{lines}").as_bytes())
}

/// The entries that Bagnold wrote. A name that leads out of the folder was not written by it.
fn read_marker(folder: &Path) -> BTreeSet<String> {
    let is_plain = |name: &str| {
        let mut parts = Path::new(name).components();
        matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None))
    };
    let text = read_text(&folder.join(MARKER), DOCUMENT).unwrap_or_default();
    text.lines().skip(1).filter(|name| is_plain(name)).map(str::to_owned).collect()
}

/// Removes a file, or a folder with its contents, if there is one.
pub(super) fn remove(path: &Path) -> io::Result<()> {
    let is_folder = path.symlink_metadata().is_ok_and(|metadata| metadata.is_dir());
    let removed = if is_folder { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
    unless_missing(removed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn write(folder: &Path, files: &[(&str, &str)]) {
        for (name, text) in files {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
            std::fs::write(path, text).expect("writable");
        }
    }

    fn text(path: PathBuf) -> String {
        std::fs::read_to_string(path).unwrap_or_else(|_| "none".to_owned())
    }

    /// A folder with old contents and a staging folder with new ones.
    fn prepared(others: &[(&str, &str)]) -> (tempfile::TempDir, PathBuf, PathBuf) {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("out");
        let staging = folder.join(STAGING);
        write(&folder, &[("case.toml", "old"), ("metrics.json", "old"), ("figures/a.svg", "old")]);
        write(&folder, others);
        write_marker(&folder, &["case.toml", "metrics.json", "figures"].map(str::to_owned).into()).expect("writable");
        write(&staging, &[("case.toml", "new"), ("metrics.json", "new")]);
        (root, folder, staging)
    }

    fn assert_new(folder: &Path) {
        assert_eq!(["case.toml", "metrics.json"].map(|name| text(folder.join(name))), ["new", "new"]);
        assert!(!folder.join("figures").exists());
        assert_eq!(read_marker(folder).into_iter().collect::<Vec<_>>(), ["case.toml", "metrics.json"]);
        assert!([STAGING, COMMITTED].iter().all(|name| !folder.join(name).exists()));
    }

    #[test]
    fn entries_of_others_stay_and_nothing_is_left_beside() {
        let (root, folder, staging) = prepared(&[("store/entry", "kept"), ("notes.txt", "mine")]);
        publish(&folder, &staging).expect("publishable");
        assert_new(&folder);
        assert_eq!([text(folder.join("store/entry")), text(folder.join("notes.txt"))], ["kept", "mine"]);
        assert_eq!(std::fs::read_dir(root.path()).expect("readable").count(), 1);
    }

    #[test]
    fn next_claim_completes_a_commit_after_a_kill() {
        for moved in 0..=2 {
            let (_root, folder, staging) = prepared(&[("store/entry", "kept")]);
            let new = ["case.toml", "metrics.json"];
            write_marker(&staging, &new.map(str::to_owned).into()).expect("writable");
            std::fs::rename(&staging, folder.join(COMMITTED)).expect("movable");
            for name in new.iter().take(moved) {
                std::fs::remove_file(folder.join(name)).expect("removable");
                std::fs::rename(folder.join(COMMITTED).join(name), folder.join(name)).expect("movable");
            }
            finish(&folder).expect("movable");
            assert_new(&folder);
            // nothing is committed any more
            finish(&folder).expect("nothing to do");
            assert_new(&folder);
        }
    }
}
