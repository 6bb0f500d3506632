//! Finished runs on disk, shared by tests and report: nothing is simulated twice by the same program.

mod drawn;
pub(crate) mod entry;
mod identity;
mod inventory;
pub mod provenance;
mod speeds;

pub use drawn::{DrawingKey, Drawings};
pub use identity::{CodeOrigin, identity, identity_or_unique, is_of_this_program};
pub use inventory::{Pruned, RetentionPolicy, Version, prune, versions};
pub use provenance::{commit, instruction_set, profile, source_hash, target_features, version, workspace};
pub use speeds::{AllSpeeds, Speeds};

use crate::checkpoint::Checkpoints;
use crate::observation::Recorded;
use crate::output::reason;
use etcetera::BaseStrategy;
use serde::{Serialize, de::DeserializeOwned};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::sync::Once;
use std::time::Duration;

/// Folders of this many versions of the sources are kept.
const KEPT_VERSIONS: usize = 3;

/// Begins the name of every folder that the store may delete.
const FOLDER_PREFIX: &str = "sources-";

/// Folder of a version in which runs that are not finished keep their checkpoints, a folder each.
const UNFINISHED: &str = "unfinished";

/// Folder of a version in which finished runs keep a state near their end, from which longer runs continue.
const ENDED: &str = "ended";

/// Finished runs that keep such a state; the oldest are deleted first.
const MOST_ENDED: usize = 16;

/// Folder of a version in which drawn figures are kept.
const DRAWN: &str = "drawn";

/// Whether finished runs are taken from the store.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StorePolicy {
    /// Taken from the store, or simulated and kept there.
    Use,
    /// Simulated and kept there, in place of what was stored before.
    Refresh,
    /// Simulated; the store is neither read nor written: for tests of determinism, threads and timing.
    Bypass,
}

/// The store, or its absence.
#[derive(Debug, Clone)]
pub struct Store {
    /// Folder of this version of the sources.
    folder: PathBuf,
    policy: StorePolicy,
    /// Time between two checkpoints of a run, where the user asks for one.
    checkpoint_interval: Option<Duration>,
    pub(crate) keeps_ends: bool,
}

/// Identifies a run of a case by this version of the sources.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoreKey(pub(crate) String);

impl Store {
    /// The store at its usual place: `BAGNOLD_STORE`; else, if one works in the workspace that this program was built
    /// in, its `reports/store`; else `bagnold` in the platform's folder for caches; else, without a home,
    /// `.bagnold-store` in the current folder.
    pub fn open(policy: StorePolicy) -> Self {
        let root = match std::env::var_os("BAGNOLD_STORE") {
            Some(path) if !path.is_empty() => PathBuf::from(path),
            _ => workspace()
                .map(|root| root.join("reports").join("store"))
                .or_else(cache_folder)
                .unwrap_or_else(|| PathBuf::from(".bagnold-store")),
        };
        Self::at(&root, policy)
    }

    /// The store in a folder of one's choice.
    pub fn at(root: &Path, policy: StorePolicy) -> Self {
        Self::for_sources(root, source_hash(), policy)
    }

    fn for_sources(root: &Path, sources: &str, policy: StorePolicy) -> Self {
        let version = sources.get(..16).unwrap_or(sources);
        let folder = root.join(format!("{FOLDER_PREFIX}{version}"));
        Self { folder, policy, checkpoint_interval: None, keeps_ends: false }
    }

    /// The same store with another time between two checkpoints of a run.
    #[must_use]
    pub fn with_checkpoints_every(self, interval: Option<Duration>) -> Self {
        Self { checkpoint_interval: interval, ..self }
    }

    /// Store in which finished runs keep a state near their end.
    #[must_use]
    pub fn with_ends(self) -> Self {
        Self { keeps_ends: true, ..self }
    }

    /// States near the end of the finished runs of a trajectory; emptied if everything is to begin anew.
    pub fn ends(&self, key: &StoreKey) -> Checkpoints {
        let all = self.folder.join(ENDED);
        inventory::keep_newest(inventory::folders_in(&all).unwrap_or_default(), MOST_ENDED);
        self.kept_in(&all.join(&key.0), key)
    }

    /// Checkpoints of an unfinished run; emptied if everything is to begin anew.
    pub fn checkpoints(&self, key: &StoreKey) -> Checkpoints {
        self.kept_in(&self.checkpoint_folder(key), key)
    }

    fn kept_in(&self, folder: &Path, key: &StoreKey) -> Checkpoints {
        let checkpoints = Checkpoints::at(folder, &key.0, self.checkpoint_interval);
        if self.policy == StorePolicy::Refresh {
            checkpoints.discard();
        }
        checkpoints
    }

    fn checkpoint_folder(&self, key: &StoreKey) -> PathBuf {
        self.folder.join(UNFINISHED).join(&key.0)
    }

    /// The folder that holds all versions.
    pub fn root(&self) -> &Path {
        self.folder.parent().unwrap_or(&self.folder)
    }

    /// The key of a run of a case, or `None` if there is nothing to look up or keep: the store is bypassed, or it is impossible to
    /// tell which program this is.
    pub fn key<R: Serialize>(&self, origin: CodeOrigin, case: &str, run: &R) -> Option<StoreKey> {
        if self.policy == StorePolicy::Bypass {
            return None;
        }
        let program = identity(origin)?;
        let description = serde_json::to_string(run)
            .inspect_err(|error| {
                tracing::warn!("{case}: a run cannot be stored, its description does not serialise: {error}")
            })
            .ok()?;
        let own = provenance::simulation_hash(case, &description);
        let program = if program == source_hash() { own.as_str() } else { program };
        Some(StoreKey(hash_of_parts([program, case, &description])))
    }

    /// The stored record; `None` if there is none, it is damaged, or it is not wanted.
    pub fn fetch<O: DeserializeOwned>(&self, key: &StoreKey) -> Option<Recorded<O>> {
        if self.policy != StorePolicy::Use {
            return None;
        }
        adopt(&self.folder, &self.path(key));
        entry::read(&self.path(key), &key.0).unwrap_or_else(|damage| {
            tracing::warn!("stored result {}: {damage}; simulated again", self.path(key).display());
            None
        })
    }

    /// Keeps a record, whose run then needs no checkpoint. A store that cannot be written costs time later, but is no reason
    /// to fail now.
    pub fn keep<O: Serialize>(&self, key: &StoreKey, record: &Recorded<O>) {
        begin(&self.folder);
        if let Err(error) = entry::write(&self.path(key), &key.0, record) {
            static FULL: Once = Once::new();
            let (path, reason) = (self.path(key), reason(&error));
            FULL.call_once(|| {
                tracing::warn!(
                    "stored result {}: not kept ({reason}); the run is simulated again the next time; further warnings of \
                     this kind are not shown",
                    path.display()
                );
            });
            return;
        }
        Checkpoints::at(&self.checkpoint_folder(key), &key.0, None).discard();
    }

    fn path(&self, key: &StoreKey) -> PathBuf {
        self.folder.join(format!("{}.postcard", key.0))
    }
}

/// Links a file below the folder of a version of the sources from an earlier version that has it: its key says that it depends on
/// nothing that differs. What cannot be linked is made again.
fn adopt(version: &Path, file: &Path) {
    let (Some(root), Ok(name)) = (version.parent(), file.strip_prefix(version)) else { return };
    let versions = if file.exists() { Vec::new() } else { inventory::folders(root).unwrap_or_default() };
    if let Some(earlier) = versions.iter().map(|version| version.join(name)).find(|path| path.is_file()) {
        begin(version);
        let folder = file.parent().unwrap_or(version);
        let _ = std::fs::create_dir_all(folder).and_then(|()| std::fs::hard_link(earlier, file));
    }
}

/// Makes the folder of a version of the sources, in place of the oldest of several.
fn begin(version: &Path) {
    let Some(root) = version.parent().filter(|_| !version.is_dir()) else { return };
    if std::fs::create_dir_all(version).is_ok() {
        let mut others = inventory::folders(root).unwrap_or_default();
        others.retain(|folder| folder != version);
        inventory::keep_newest(others, KEPT_VERSIONS - 1);
    }
}

/// Cache folder of the platform, such as `~/.cache/bagnold`.
fn cache_folder() -> Option<PathBuf> {
    let folders = etcetera::base_strategy::choose_native_strategy().ok()?;
    Some(folders.cache_dir().join("bagnold"))
}

fn is_version(name: &str) -> bool {
    name.strip_prefix(FOLDER_PREFIX)
        .is_some_and(|version| version.len() == 16 && version.bytes().all(|byte| byte.is_ascii_hexdigit()))
}

/// Hash of several texts, each behind its length.
pub(crate) fn hash_of_parts<'p>(parts: impl IntoIterator<Item = &'p str>) -> String {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hexadecimal(&hash.finalize())
}

/// Lower-case hexadecimal digits of some bytes.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observation::Outcome;
    use std::time::SystemTime;

    fn record(data: f64) -> Recorded<f64> {
        Recorded {
            outcome: Outcome::Finished,
            state_hash: "00".to_owned(),
            particles: 1,
            steps: 2,
            simulated_time: 3.0,
            wall_seconds: 4.0,
            threads: 1,
            frames: Vec::new(),
            first_bad: None,
            data,
        }
    }

    fn key(store: &Store, run: u32) -> StoreKey {
        store.key(CodeOrigin::ELSEWHERE, "test", &run).expect("a number serialises")
    }

    #[test]
    fn a_record_comes_back_bit_for_bit_and_for_its_run_only() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let store = Store::at(folder.path(), StorePolicy::Use);
        let kept = record(0.1 + 0.2);
        store.keep(&key(&store, 1), &kept);
        assert_eq!(store.fetch(&key(&store, 1)), Some(kept));
        assert_eq!(store.fetch::<f64>(&key(&store, 2)), None);
        assert_ne!(store.key(CodeOrigin::ELSEWHERE, "test", &1), store.key(CodeOrigin::ELSEWHERE, "other", &1));
    }

    #[test]
    fn a_damaged_record_is_not_used_and_is_replaced() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let store = Store::at(folder.path(), StorePolicy::Use);
        let key = key(&store, 1);
        store.keep(&key, &record(1.0));
        let path = store.path(&key);
        let whole = std::fs::read(&path).expect("stored entry");
        let mut flipped = whole.clone();
        *flipped.last_mut().expect("not empty") ^= 1;
        for damaged in [&whole[..whole.len() - 1], &whole[..3], &[], &flipped] {
            std::fs::write(&path, damaged).expect("writable");
            assert_eq!(store.fetch::<f64>(&key), None);
        }
        store.keep(&key, &record(2.0));
        assert_eq!(store.fetch(&key), Some(record(2.0)));
    }

    #[test]
    fn bypass_touches_nothing_and_refresh_replaces() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let bypass = Store::at(folder.path(), StorePolicy::Bypass);
        assert_eq!(bypass.key(CodeOrigin::ELSEWHERE, "test", &1), None);
        let refresh = Store::at(folder.path(), StorePolicy::Refresh);
        let key = key(&refresh, 1);
        refresh.keep(&key, &record(1.0));
        assert_eq!(refresh.fetch::<f64>(&key), None);
        refresh.keep(&key, &record(2.0));
        assert_eq!(Store::at(folder.path(), StorePolicy::Use).fetch(&key), Some(record(2.0)));
    }

    #[test]
    fn the_newest_versions_stay_and_foreign_folders_are_left_alone() {
        let folder = tempfile::tempdir().expect("temporary folder");
        std::fs::create_dir(folder.path().join("sources-of-mine")).expect("writable");
        for (age, digit) in ["1", "2", "3", "4"].iter().enumerate() {
            let store = Store::for_sources(folder.path(), &digit.repeat(64), StorePolicy::Use);
            store.keep(&key(&store, 1), &record(1.0));
            // Distinct times of modification, whatever the file system's resolution.
            let time = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1000 + age as u64);
            std::fs::File::open(&store.folder).and_then(|folder| folder.set_modified(time)).expect("settable");
        }
        let mut left: Vec<String> = std::fs::read_dir(folder.path())
            .expect("readable")
            .flatten()
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        left.sort();
        let expected = ["2", "3", "4"].map(|digit| format!("{FOLDER_PREFIX}{}", digit.repeat(16)));
        assert_eq!(left, [&expected[..], &["sources-of-mine".to_owned()]].concat());
    }

    #[test]
    fn a_record_of_an_earlier_version_that_depends_on_nothing_new_is_taken() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let [earlier, later] =
            ["1", "2"].map(|digit| Store::for_sources(folder.path(), &digit.repeat(64), StorePolicy::Use));
        earlier.keep(&key(&earlier, 1), &record(1.0));
        assert_eq!(later.fetch(&key(&later, 1)), Some(record(1.0)));
        assert_eq!(later.fetch::<f64>(&key(&later, 2)), None, "another run");
        std::fs::remove_dir_all(&earlier.folder).expect("removable");
        assert_eq!(later.fetch(&key(&later, 1)), Some(record(1.0)), "it stays without the earlier version");
    }

    #[test]
    fn many_writers_of_one_entry_do_no_harm() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let store = Store::at(folder.path(), StorePolicy::Use);
        let key = key(&store, 1);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..50 {
                        store.keep(&key, &record(1.0));
                        assert_eq!(store.fetch(&key), Some(record(1.0)));
                    }
                });
            }
        });
        assert_eq!(std::fs::read_dir(&store.folder).expect("readable").count(), 1);
    }
}
