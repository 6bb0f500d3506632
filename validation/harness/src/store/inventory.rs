//! Contents of a store, and their reduction on request.

use super::{DRAWN, ENDED, UNFINISHED, is_version};
use std::fs::DirEntry;
use std::io::{ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Ends the names of entries, checkpoints and drawings, and of what a killed process left half written.
const ENDINGS: [&str; 6] = ["postcard", "checkpoint", "svg", "png", "gif", "partial"];

/// One file of the store.
#[derive(Debug, Clone, PartialEq, Eq)]
struct StoredFile {
    path: PathBuf,
    bytes: u64,
    modified: SystemTime,
}

/// The entries and checkpoints of one version of the sources.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Version {
    /// Name of its folder.
    pub name: String,
    /// Number of entries.
    pub entries: usize,
    /// Number of runs that have checkpoints and no entry yet.
    pub unfinished: usize,
    /// Total size `[bytes]`.
    pub bytes: u64,
    /// Time at which its newest file was written.
    pub newest: SystemTime,
}

/// Retention policy of a store; `None` sets no limit.
#[derive(Debug, Clone, Copy, Default)]
pub struct RetentionPolicy {
    /// Entries that are not older.
    pub younger_than: Option<Duration>,
    /// The newest, of this size in all `[bytes]`.
    pub bytes: Option<u64>,
}

/// Number and size of the files that were deleted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pruned {
    /// Number of entries, checkpoints and drawings.
    pub files: usize,
    /// Total size `[bytes]`.
    pub bytes: u64,
}

/// The versions in a store, the newest first.
///
/// # Errors
/// A folder that cannot be read; a missing one is empty.
pub fn versions(root: &Path) -> Result<Vec<Version>> {
    let mut versions = Vec::new();
    for folder in folders(root)? {
        let (entries, all) = (stored_in(&folder)?.len(), stored_below(&folder)?);
        let Some(newest) = all.iter().map(|file| file.modified).max() else { continue };
        let runs = folders_in(&folder.join(UNFINISHED))?;
        versions.push(Version {
            name: folder.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            entries,
            unfinished: runs.iter().filter(|run| stored_in(run).is_ok_and(|files| !files.is_empty())).count(),
            bytes: all.iter().map(|file| file.bytes).sum(),
            newest,
        });
    }
    versions.sort_by(|a, b| b.newest.cmp(&a.newest).then_with(|| a.name.cmp(&b.name)));
    Ok(versions)
}

/// Deletes entries beyond the limits, the oldest first, and folders that become empty. Only entries of the store are touched.
///
/// # Errors
/// A folder that cannot be read or an entry that cannot be deleted.
pub fn prune(root: &Path, keep: RetentionPolicy, now: SystemTime) -> Result<Pruned> {
    let folders = folders(root)?;
    let mut stored = Vec::new();
    for folder in &folders {
        stored.extend(stored_below(folder)?);
    }
    stored.sort_by(|a, b| b.modified.cmp(&a.modified).then_with(|| a.path.cmp(&b.path)));
    let (mut kept, mut pruned) = (0, Pruned::default());
    for entry in stored {
        let age = now.duration_since(entry.modified).unwrap_or_default();
        let is_young = keep.younger_than.is_none_or(|most| age <= most);
        let fits = keep.bytes.is_none_or(|most| kept + entry.bytes <= most);
        if is_young && fits {
            kept += entry.bytes;
        } else {
            std::fs::remove_file(&entry.path)?;
            pruned.files += 1;
            pruned.bytes += entry.bytes;
        }
    }
    for folder in folders.iter().rev() {
        for below in places(folder)?.iter().rev() {
            // fails where something is left, which is what is wanted
            let _ = std::fs::remove_dir(below);
        }
    }
    Ok(pruned)
}

/// The folders of versions.
pub(super) fn folders(root: &Path) -> Result<Vec<PathBuf>> {
    let mut folders = folders_in(root)?;
    folders.retain(|folder| folder.file_name().is_some_and(|name| is_version(&name.to_string_lossy())));
    Ok(folders)
}

/// A version's folder and those below it that hold files of the store; each after the one that it lies in.
fn places(version: &Path) -> Result<Vec<PathBuf>> {
    let mut places = vec![version.to_owned()];
    places.extend([DRAWN, UNFINISHED, ENDED].map(|name| version.join(name)));
    for runs in [UNFINISHED, ENDED] {
        places.extend(folders_in(&version.join(runs))?);
    }
    Ok(places)
}

/// All files of a version.
fn stored_below(version: &Path) -> Result<Vec<StoredFile>> {
    let files: Result<Vec<_>> = places(version)?.iter().map(|place| stored_in(place)).collect();
    Ok(files?.concat())
}

/// Entries of a folder; none where it is missing.
fn entries(folder: &Path) -> Result<Vec<DirEntry>> {
    match std::fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(Vec::new()),
        entries => entries?.collect(),
    }
}

/// Files of the store in a folder.
fn stored_in(folder: &Path) -> Result<Vec<StoredFile>> {
    let mut stored = Vec::new();
    for entry in entries(folder)? {
        let path = entry.path();
        let is_entry = path.extension().is_some_and(|ending| ENDINGS.iter().any(|own| ending == *own));
        // not followed: a link that a user put here is the user's
        let metadata = entry.metadata()?;
        if is_entry && metadata.is_file() {
            stored.push(StoredFile { path, bytes: metadata.len(), modified: metadata.modified()? });
        }
    }
    Ok(stored)
}

/// Folders in a folder; no links, which may lead out of the store.
pub(super) fn folders_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let folders = entries(folder)?.into_iter().filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    Ok(folders.map(|entry| entry.path()).collect())
}

/// Deletes all but the newest N of some folders. Best effort: another program may have been faster.
pub(super) fn keep_newest(folders: impl IntoIterator<Item = PathBuf>, most: usize) {
    let age = |folder: PathBuf| Some((folder.metadata().and_then(|data| data.modified()).ok()?, folder));
    let mut folders: Vec<_> = folders.into_iter().filter_map(age).collect();
    folders.sort_by(|a, b| b.cmp(a));
    for (_, folder) in folders.iter().skip(most) {
        if let Err(error) = std::fs::remove_dir_all(folder) {
            tracing::debug!("old stored results {}: not deleted: {error}", folder.display());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DAY: Duration = Duration::from_secs(86_400);

    /// Ten entries of a kilobyte in two versions, a day apart, and what is not the store's.
    fn store() -> (tempfile::TempDir, SystemTime) {
        let root = tempfile::tempdir().expect("temporary folder");
        let now = SystemTime::UNIX_EPOCH + 1000 * DAY;
        for age in 0..10_u32 {
            let folder = root.path().join(format!("sources-{}", if age < 5 { "a" } else { "b" }.repeat(16)));
            std::fs::create_dir_all(&folder).expect("writable");
            let file = folder.join(format!("{age}.postcard"));
            std::fs::write(&file, [0; 1000]).expect("writable");
            std::fs::File::open(&file).and_then(|file| file.set_modified(now - age * DAY)).expect("settable");
        }
        std::fs::create_dir(root.path().join("sources-of-mine")).expect("writable");
        std::fs::write(root.path().join("sources-of-mine/thesis.postcard"), "").expect("writable");
        (root, now)
    }

    #[test]
    fn versions_are_listed_the_newest_first() {
        let (root, now) = store();
        let versions = versions(root.path()).expect("readable");
        let brief: Vec<_> = versions.iter().map(|version| (version.entries, version.bytes, version.newest)).collect();
        assert_eq!(brief, [(5, 5000, now), (5, 5000, now - 5 * DAY)]);
        assert_eq!(super::versions(&root.path().join("none")).expect("empty"), []);
    }

    #[test]
    fn checkpoints_are_listed_by_run_and_pruned_with_the_rest() {
        let (root, now) = store();
        let version = root.path().join(format!("sources-{}", "a".repeat(16)));
        for (run, age) in [("one", 0), ("other", 400)] {
            let folder = version.join(UNFINISHED).join(run);
            std::fs::create_dir_all(&folder).expect("writable");
            for number in 0..2 {
                let file = folder.join(format!("{number}.checkpoint"));
                std::fs::write(&file, [0; 100]).expect("writable");
                std::fs::File::open(&file).and_then(|file| file.set_modified(now - age * DAY)).expect("settable");
            }
        }
        let listed = versions(root.path()).expect("readable");
        assert_eq!((listed[0].entries, listed[0].unfinished, listed[0].bytes), (5, 2, 5400));
        let old = RetentionPolicy { younger_than: Some(100 * DAY), bytes: None };
        assert_eq!(prune(root.path(), old, now).expect("writable"), Pruned { files: 2, bytes: 200 });
        assert_eq!(versions(root.path()).expect("readable")[0].unfinished, 1);
        assert!(!version.join(UNFINISHED).join("other").exists() && version.join(UNFINISHED).join("one").exists());
        let nothing = RetentionPolicy { younger_than: None, bytes: Some(0) };
        assert_eq!(prune(root.path(), nothing, now).expect("writable").files, 12);
        assert!(!version.exists());
    }

    #[test]
    fn drawings_count_and_are_pruned_with_the_rest() {
        let (root, now) = store();
        let version = root.path().join(format!("sources-{}", "a".repeat(16)));
        let drawn = version.join(DRAWN);
        std::fs::create_dir(&drawn).expect("writable");
        for (name, age) in [("one.svg", 0), ("other.gif", 400), ("notes.txt", 400)] {
            let file = drawn.join(name);
            std::fs::write(&file, [0; 100]).expect("writable");
            std::fs::File::open(&file).and_then(|file| file.set_modified(now - age * DAY)).expect("settable");
        }
        let listed = versions(root.path()).expect("readable");
        assert_eq!((listed[0].entries, listed[0].bytes), (5, 5200));
        let old = RetentionPolicy { younger_than: Some(100 * DAY), bytes: None };
        assert_eq!(prune(root.path(), old, now).expect("writable"), Pruned { files: 1, bytes: 100 });
        assert!(drawn.join("one.svg").exists() && !drawn.join("other.gif").exists());
        let nothing = RetentionPolicy { younger_than: None, bytes: Some(0) };
        assert_eq!(prune(root.path(), nothing, now).expect("writable").files, 11);
        assert!(drawn.join("notes.txt").exists(), "what is not the store's stays");
    }

    #[test]
    fn prune_deletes_only_old_or_excess_entries() {
        let (root, now) = store();
        let of = |keep| prune(root.path(), keep, now).expect("writable");
        assert_eq!(of(RetentionPolicy::default()), Pruned::default());
        let young = RetentionPolicy { younger_than: Some(7 * DAY), bytes: None };
        assert_eq!(of(young), Pruned { files: 2, bytes: 2000 });
        let small = RetentionPolicy { younger_than: None, bytes: Some(3500) };
        assert_eq!(of(small), Pruned { files: 5, bytes: 5000 });
        assert_eq!(versions(root.path()).expect("readable").len(), 1);
        assert!(!root.path().join(format!("sources-{}", "b".repeat(16))).exists(), "an empty version is gone");
        assert!(root.path().join("sources-of-mine/thesis.postcard").exists());
    }
}
