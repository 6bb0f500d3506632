//! `bagnold store`: what is stored, and making it smaller.

use super::arguments::{StoreAction, StoreArguments};
use super::error::ProgramError;
use super::{Exit, Session};
use crate::output::FileError;
use crate::store::{RetentionPolicy, Store, StorePolicy, prune, versions};
use indicatif::HumanBytes;
use std::time::{Duration, SystemTime};

const BYTES_PER_GIBIBYTE: f64 = 1024.0 * 1024.0 * 1024.0;
const SECONDS_PER_DAY: f64 = 86_400.0;

/// Lists or deletes stored results.
pub(super) fn store(command: &StoreArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let policy = StorePolicy::Use;
    let store = command.store.as_ref().map_or_else(|| Store::open(policy), |folder| Store::at(folder, policy));
    let root = store.root();
    let now = SystemTime::now();
    let mut text = String::new();
    if let StoreAction::Prune { days, size } = command.action {
        let keep = RetentionPolicy {
            younger_than: days.map(|days| Duration::from_secs_f64(days.min(1e6) * SECONDS_PER_DAY)),
            bytes: size.map(|gibibytes| (gibibytes * BYTES_PER_GIBIBYTE) as u64),
        };
        let pruned = prune(root, keep, now).map_err(|error| FileError::unwritable(root, &error))?;
        text += &format!("deleted {} entries and checkpoints, {}\n", pruned.files, HumanBytes(pruned.bytes));
    }
    let versions = versions(root).map_err(|error| FileError::unreadable(root, &error))?;
    for version in &versions {
        let days = now.duration_since(version.newest).unwrap_or_default().as_secs_f64() / SECONDS_PER_DAY;
        text += &format!(
            "{}  {}, {}, the newest {days:.1} days old\n",
            version.name,
            counted(version.entries, version.unfinished),
            HumanBytes(version.bytes)
        );
    }
    let entries = versions.iter().map(|version| version.entries).sum();
    let unfinished = versions.iter().map(|version| version.unfinished).sum();
    let bytes = versions.iter().map(|version| version.bytes).sum();
    text += &format!("{}: {}, {}\n", root.display(), counted(entries, unfinished), HumanBytes(bytes));
    session.say(&text);
    Ok(Exit::Held)
}

/// Finished and unfinished runs, these only where there are any.
fn counted(entries: usize, unfinished: usize) -> String {
    match unfinished {
        0 => format!("{entries} entries"),
        1 => format!("{entries} entries and 1 unfinished run"),
        _ => format!("{entries} entries and {unfinished} unfinished runs"),
    }
}
