//! The file that says that a folder is Bagnold's.

use super::whole::write_whole;
use crate::input::{DOCUMENT, read_text};
use std::collections::BTreeSet;
use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Component, Path};

/// Says that a folder is Bagnold's, and which of its entries are.
pub(super) const MARKER: &str = ".bagnold-output";

/// Begins the name of the folder in which a process puts the new contents together; its number follows.
pub(super) const STAGING_PREFIX: &str = ".bagnold-output-staging-";

/// Holds, a line per command that was refused while another had the folder, how many folders that command had made on the way to
/// it: who has the folder removes them if he leaves nothing in them.
const MADE_BY_OTHERS: &str = ".bagnold-output-made";

const MARKER_TITLE: &str = "Written by bagnold, which replaces these entries the next time:";

pub(super) fn write_marker(folder: &Path, entries: &BTreeSet<String>) -> io::Result<()> {
    let lines: String = entries.iter().map(|name| format!("{name}\n")).collect();
    write_whole(&folder.join(MARKER), format!("{MARKER_TITLE}\n{lines}").as_bytes())
}

/// The entries that Bagnold wrote. A name that leads out of the folder was not written by it.
pub(super) fn read_marker(folder: &Path) -> BTreeSet<String> {
    let is_plain = |name: &str| {
        let mut parts = Path::new(name).components();
        matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None))
    };
    let text = read_text(&folder.join(MARKER), DOCUMENT).unwrap_or_default();
    text.lines().skip(1).filter(|name| is_plain(name)).map(str::to_owned).collect()
}

/// Leaves it to the command that has the folder to remove so many folders of its path. Best effort: one that stays is empty.
pub(super) fn hand_over(folder: &Path, made: usize) {
    let file = OpenOptions::new().append(true).create(true).open(folder.join(MADE_BY_OTHERS));
    let _ = file.and_then(|mut file| writeln!(file, "{made}"));
}

/// Number of folders of its path that others have made for it; reading it deletes the record.
pub(super) fn handed_over(folder: &Path) -> usize {
    let file = folder.join(MADE_BY_OTHERS);
    let text = read_text(&file, DOCUMENT).unwrap_or_default();
    let _ = std::fs::remove_file(&file);
    text.lines().filter_map(|line| line.parse().ok()).max().unwrap_or(0)
}
