//! Atomic replacement of old contents by new ones, so that a kill at any moment leaves no mixture behind.
//!
//! A folder that holds nothing but Bagnold's entries and plain files is exchanged as a whole: the new contents are a
//! folder of their own beside it, with links to those files, and one rename exchanges the two. A reader sees either. If
//! it also holds folders that are not Bagnold's (`reports/` holds the store) or the file system cannot exchange, one
//! rename commits the new contents inside the folder and the entries are then moved one by one; the next claim of the
//! folder ends what a kill interrupted.

use super::marker::{MARKER, STAGING_PREFIX, read_marker, write_marker};
use super::whole::{settle, settle_all};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// Contents that are committed, but not yet all in their place.
const COMMITTED: &str = ".bagnold-output-new";

/// Puts what is in `staging` in place of what Bagnold wrote into `folder` before.
pub(super) fn publish(folder: &Path, staging: &Path) -> io::Result<()> {
    let folder = folder.canonicalize()?;
    let staging = staging.canonicalize()?;
    let entries = names(&staging)?;
    write_marker(&staging, &entries)?;
    settle_all(&staging)?;
    // a folder that is worked in must stay the one it is
    let is_worked_in = std::env::current_dir().is_ok_and(|current| current.starts_with(&folder));
    let beside = beside(&folder, std::process::id()).filter(|_| !is_worked_in);
    let exchanged = match &beside {
        Some(beside) if link_others(&folder, &staging)? => {
            std::fs::set_permissions(&staging, folder.metadata()?.permissions())?;
            std::fs::rename(&staging, beside).is_ok_and(|()| match exchange(&folder, beside) {
                Ok(()) => true,
                Err(error) => {
                    tracing::debug!("{}: cannot be exchanged ({error})", folder.display());
                    // best effort: without it the next line fails and says why
                    let _ = std::fs::rename(beside, &staging);
                    false
                }
            })
        }
        _ => false,
    };
    if let (true, Some(beside)) = (exchanged, beside) {
        folder.parent().map_or(Ok(()), settle)?;
        return remove_marked(&beside);
    }
    finish_committed(&folder)?;
    unlink_others(&folder, &staging, &entries)?;
    std::fs::rename(&staging, folder.join(COMMITTED))?;
    settle(&folder)?;
    finish_committed(&folder)
}

/// Ends what killed processes left undone, and removes what they had not committed; a living process keeps its own.
pub(super) fn tidy(folder: &Path) -> io::Result<()> {
    finish_committed(folder)?;
    // without /proc nothing tells which processes live
    if !Path::new("/proc/self").exists() {
        return Ok(());
    }
    let ended = |process: &str| !process.is_empty() && !Path::new("/proc").join(process).exists();
    let inside = entries_after(folder, STAGING_PREFIX);
    let folder = folder.canonicalize()?;
    let outside = match (folder.parent(), beside_prefix(&folder)) {
        (Some(parent), Some(prefix)) => entries_after(parent, &prefix),
        _ => Vec::new(),
    };
    let is_empty = |path: &Path| std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none());
    let is_ours = |path: &Path| path.join(MARKER).is_file() || is_empty(path);
    let outside = outside.into_iter().filter(|(path, _)| is_ours(path));
    for (path, _) in inside.into_iter().chain(outside).filter(|(_, process)| ended(process)) {
        if let Err(error) = remove_marked(&path) {
            tracing::warn!("cannot remove {}: {error}", path.display());
        }
    }
    Ok(())
}

/// Removes a folder, its marker last, so that one whose removal is interrupted is still known to be Bagnold's.
fn remove_marked(folder: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() != MARKER {
            remove(&entry.path())?;
        }
    }
    remove(&folder.join(MARKER))?;
    std::fs::remove_dir(folder)
}

/// Folders whose names begin like this, with the rest of their names.
fn entries_after(folder: &Path, prefix: &str) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let rest = |entry: std::fs::DirEntry| {
        let rest = entry.file_name().to_str()?.strip_prefix(prefix)?.to_owned();
        entry.file_type().ok()?.is_dir().then(|| (entry.path(), rest))
    };
    entries.filter_map(rest).collect()
}

/// Begins the name of a folder beside `folder` that is to take its place.
fn beside_prefix(folder: &Path) -> Option<String> {
    Some(format!(".{}{STAGING_PREFIX}", folder.file_name()?.to_str()?))
}

fn beside(folder: &Path, process: u32) -> Option<PathBuf> {
    Some(folder.parent()?.join(format!("{}{process}", beside_prefix(folder)?)))
}

fn names(folder: &Path) -> io::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    for entry in std::fs::read_dir(folder)? {
        names.insert(entry?.file_name().to_string_lossy().into_owned());
    }
    names.remove(MARKER);
    Ok(names)
}

/// Gives the new contents the plain files that are not Bagnold's; false if there are folders among them, or a file cannot
/// be in two places.
fn link_others(folder: &Path, staging: &Path) -> io::Result<bool> {
    let own = read_marker(folder);
    let mut linked = true;
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let is_own = name.to_str().is_some_and(|name| own.contains(name) || name == MARKER);
        if is_own || entry.path() == staging || staging.join(&name).exists() {
            continue;
        }
        linked &= entry.file_type()?.is_file() && std::fs::hard_link(entry.path(), staging.join(&name)).is_ok();
    }
    Ok(linked)
}

/// Takes back what [`link_others`] did.
fn unlink_others(folder: &Path, staging: &Path, new: &BTreeSet<String>) -> io::Result<()> {
    for name in names(staging)?.difference(new) {
        if folder.join(name).exists() {
            std::fs::remove_file(staging.join(name))?;
        }
    }
    Ok(())
}

#[cfg(target_os = "linux")]
fn exchange(folder: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, folder, CWD, other, RenameFlags::EXCHANGE)?)
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Moves committed contents into their places, if there are any; may be begun again after a kill.
fn finish_committed(folder: &Path) -> io::Result<()> {
    let committed = folder.join(COMMITTED);
    if !committed.is_dir() {
        return Ok(());
    }
    let (old, new) = (read_marker(folder), read_marker(&committed));
    // both, while neither is complete
    write_marker(folder, &old.union(&new).cloned().collect())?;
    for name in names(&committed)? {
        remove(&folder.join(&name))?;
        std::fs::rename(committed.join(&name), folder.join(&name))?;
    }
    for name in old.difference(&new) {
        remove(&folder.join(name))?;
    }
    write_marker(folder, &new)?;
    std::fs::remove_dir_all(&committed)?;
    settle(folder)
}

fn remove(path: &Path) -> io::Result<()> {
    let is_folder = path.symlink_metadata().is_ok_and(|metadata| metadata.is_dir());
    let removed = if is_folder { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
    match removed {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let staging = folder.join(format!("{STAGING_PREFIX}{}", std::process::id()));
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
        assert!(entries_after(folder, ".bagnold-output-").is_empty());
    }

    #[test]
    fn plain_files_of_others_stay_and_nothing_is_left_beside() {
        let (root, folder, staging) = prepared(&[("notes.txt", "mine")]);
        publish(&folder, &staging).expect("publishable");
        assert_new(&folder);
        assert_eq!(text(folder.join("notes.txt")), "mine");
        assert_eq!(std::fs::read_dir(root.path()).expect("readable").count(), 1);
    }

    #[test]
    fn folders_of_others_stay_where_they_are() {
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
            let new = names(&staging).expect("readable");
            write_marker(&staging, &new).expect("writable");
            std::fs::rename(&staging, folder.join(COMMITTED)).expect("movable");
            for name in new.iter().take(moved) {
                std::fs::remove_file(folder.join(name)).expect("removable");
                std::fs::rename(folder.join(COMMITTED).join(name), folder.join(name)).expect("movable");
            }
            tidy(&folder).expect("tidy");
            assert_new(&folder);
        }
    }

    #[test]
    fn remains_of_a_killed_process_are_removed_and_other_folders_stay() {
        let (root, folder, _) = prepared(&[]);
        // no process has this number: the kernel's largest is 4194304
        let prefix = beside_prefix(&folder).expect("a name");
        let (left, foreign) =
            (root.path().join(format!("{prefix}5000000")), root.path().join(format!("{prefix}5000001")));
        write(&left, &[("case.toml", "half"), (MARKER, "")]);
        write(&foreign, &[("thesis.tex", "")]);
        tidy(&folder).expect("tidy");
        assert!(!left.exists() && foreign.exists());
        assert_eq!(text(folder.join("case.toml")), "old");
    }
}
