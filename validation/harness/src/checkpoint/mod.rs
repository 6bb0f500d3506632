//! Checkpoints of unfinished runs: written at intervals and when the program is asked to end, the last two of each run
//! kept, and continued by the next command that wants the same run of the same program.

mod stored;

pub use stored::{BULK_MODULUS, Likeness, StoredState};

use crate::interruption;
use crate::output::SealedFormat;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::time::{Duration, Instant};

/// Time between two checkpoints, unless the user asks for another.
pub const USUAL_INTERVAL: Duration = Duration::from_secs(60);

/// A checkpoint may cost this part of the time until the next one, unless the user asks for an interval; but that is no
/// longer than what a run may lose.
const SHARE_OF_TIME: f64 = 0.01;
const LONGEST_INTERVAL: Duration = Duration::from_secs(120);

/// Checkpoints of a run that are kept.
const KEPT: usize = 2;

/// The state of a run in a file; the version is that of what a state consists of.
const STATE: SealedFormat = SealedFormat { title: "bagnold checkpoint\n", version: 1, most: 1 << 40 };

/// Ends the names of checkpoints.
const EXTENSION: &str = "checkpoint";

/// Checkpoints of one run. They are used by one run at a time; another program that simulates an identical run does no
/// harm, because both would write identical states.
#[derive(Debug)]
pub struct Checkpoints {
    folder: PathBuf,
    key: String,
    interval: Option<Duration>,
    state: Mutex<CheckpointState>,
}

#[derive(Debug)]
struct CheckpointState {
    /// Paths and contents of whole checkpoints of an earlier program, the newest first, until a run has taken them.
    left: Option<Vec<(PathBuf, Vec<u8>)>>,
    /// Time at which the next checkpoint is due.
    due: Instant,
}

impl Checkpoints {
    /// Checkpoints of the run with this key, in a separate folder; `interval` is the one requested by the user.
    pub fn at(folder: &Path, key: &str, interval: Option<Duration>) -> Self {
        let due = Instant::now() + interval.unwrap_or(USUAL_INTERVAL);
        let state = Mutex::new(CheckpointState { left: None, due });
        Self { folder: folder.to_owned(), key: key.to_owned(), interval, state }
    }

    fn lock(&self) -> MutexGuard<'_, CheckpointState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets `decode` try what is left of an earlier program, the newest first, and gives what it makes of the first that
    /// it does not refuse, with a reason. Only the first caller finds anything: what follows in a run is new.
    pub fn take<T>(&self, decode: impl FnMut(&[u8]) -> Result<T, String>) -> Option<T> {
        let taken = self.look(decode);
        self.lock().left = Some(Vec::new());
        taken
    }

    /// The same without taking it: the first that `decode` does not refuse stays, alone, for the next caller.
    pub fn look<T>(&self, mut decode: impl FnMut(&[u8]) -> Result<T, String>) -> Option<T> {
        let mut state = self.lock();
        let left = state.left.take().unwrap_or_else(|| self.whole());
        let refuse = |reason| format!("does not hold the state of this run ({reason})");
        let mut decoded =
            |(path, contents): &(PathBuf, Vec<u8>)| decode(contents).map_err(|reason| warn(path, &refuse(reason))).ok();
        let seen = left.into_iter().find_map(|found| Some((decoded(&found)?, found)));
        let (decoded, found) = seen.unzip();
        state.left = Some(found.into_iter().collect());
        decoded
    }

    /// Result of `decode` for the newest checkpoint that it can use.
    pub fn usable<T>(&self, decode: impl FnMut(&[u8]) -> Option<T>) -> Option<T> {
        self.whole().iter().map(|(_, contents)| &contents[..]).find_map(decode)
    }

    /// File of the newest checkpoint.
    pub fn newest(&self) -> Option<PathBuf> {
        self.numbers().last().map(|number| self.path(*number))
    }

    /// Paths and contents of all whole checkpoints, the newest first; others are refused with their reason.
    fn whole(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let mut numbers = self.numbers();
        numbers.reverse();
        let read = |number: u64| {
            let path = self.path(number);
            let contents = STATE.read(&path, Some(&self.key)).map_err(|refused| warn(&path, &refused)).ok()?;
            Some((path, contents))
        };
        numbers.into_iter().filter_map(read).collect()
    }

    /// Whether it is time for a checkpoint.
    pub fn is_due(&self) -> bool {
        Instant::now() >= self.lock().due
    }

    /// Writes a checkpoint and drops all but the last two. One that cannot be written is reported, and the run continues: those
    /// before it stay as they are. Whether it was written.
    pub fn keep(&self, encode: impl FnOnce() -> postcard::Result<Vec<u8>>) -> bool {
        let begun = Instant::now();
        let written = encode().map_err(io::Error::other).and_then(|contents| self.write(&contents));
        let cost = begun.elapsed();
        let usual = || cost.div_f64(SHARE_OF_TIME).clamp(USUAL_INTERVAL, LONGEST_INTERVAL);
        let wait = self.interval.unwrap_or_else(usual);
        self.lock().due = Instant::now() + wait;
        match &written {
            Ok(()) => {
                tracing::info!("checkpoint in {}, written in {:.0} ms", self.folder.display(), cost.as_secs_f64() * 1e3)
            }
            Err(error) => {
                static FULL: Once = Once::new();
                FULL.call_once(|| {
                    tracing::warn!(
                        "checkpoint in {}: not kept ({error}); those before it stay, and the run continues; further \
                         warnings of this kind are not shown",
                        self.folder.display()
                    );
                });
            }
        }
        written.is_ok()
    }

    fn write(&self, contents: &[u8]) -> io::Result<()> {
        let numbers = self.numbers();
        let next = numbers.last().map_or(0, |last| last + 1);
        STATE.write(&self.path(next), &self.key, contents)?;
        for old in numbers.iter().rev().skip(KEPT - 1) {
            // another program may have been faster
            let _ = std::fs::remove_file(self.path(*old));
        }
        Ok(())
    }

    /// Removes all checkpoints of the run: it is finished, or begins anew.
    pub fn discard(&self) {
        self.lock().left = Some(Vec::new());
        if let Err(error) = std::fs::remove_dir_all(&self.folder)
            && error.kind() != io::ErrorKind::NotFound
        {
            tracing::debug!("checkpoints {}: not removed: {error}", self.folder.display());
        }
    }

    /// Numbers of the checkpoints in the folder, rising.
    fn numbers(&self) -> Vec<u64> {
        let number = |entry: std::fs::DirEntry| {
            let name = entry.file_name();
            name.to_str()?.strip_suffix(EXTENSION)?.strip_suffix('.')?.parse().ok()
        };
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut numbers: Vec<u64> = entries.filter_map(number).collect();
        numbers.sort_unstable();
        numbers
    }

    fn path(&self, number: u64) -> PathBuf {
        self.folder.join(format!("{number}.{EXTENSION}"))
    }
}

fn warn(path: &Path, refused: &impl std::fmt::Display) {
    let path = path.display();
    tracing::warn!("checkpoint {path}: not continued: it {refused}; the one before it is used, or the run begins anew");
}

static STOPPED: [AtomicUsize; 2] = [AtomicUsize::new(0), AtomicUsize::new(0)];

/// Counts a run that an interruption has stopped.
pub fn count_stopped(is_kept: bool) {
    STOPPED[usize::from(is_kept)].fetch_add(1, Ordering::Relaxed);
}

/// Numbers of runs that an interruption has stopped so far: without a checkpoint of that moment, and with one.
pub fn stopped_runs() -> [usize; 2] {
    STOPPED.each_ref().map(|count| count.load(Ordering::Relaxed))
}

/// Whether the program has been asked to end.
pub fn is_interrupted() -> bool {
    interruption::asked().is_some()
}

#[cfg(test)]
mod tests;
