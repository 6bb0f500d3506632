//! A report that nothing has changed since it was made: the next one says what it said.

use super::{CommittedValues, Exit};
use crate::observation::state_hash;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// File of a report's folder that says what it was made from and what it said.
const FILE: &str = "made-from.json";

#[derive(Debug, Serialize, Deserialize)]
struct Made {
    /// Digest of what went in.
    inputs: String,
    /// Files, with digests of their contents.
    files: Vec<(PathBuf, String)>,
    exit: u8,
    text: String,
}

/// Digest of all that a report of the program's cases is made from: the program, the command, the committed values.
pub(super) fn inputs(command: &str, places: &CommittedValues) -> Option<String> {
    let mut all = fs::read(std::env::current_exe().ok()?).ok()?;
    all.extend(command.bytes());
    let folder = places.folder();
    for path in files_below(&folder).unwrap_or_default() {
        all.extend(path.to_string_lossy().bytes());
        all.extend(fs::read(folder.join(&path)).ok()?);
    }
    Some(state_hash(&all))
}

/// Exit code and text of the report in a folder, if its inputs and its files are unchanged.
pub(super) fn said(out: &Path, inputs: &str) -> Option<(Exit, String)> {
    let made: Made = serde_json::from_str(&fs::read_to_string(out.join(FILE)).ok()?).ok()?;
    let is_whole =
        |(path, digest): &(PathBuf, String)| fs::read(out.join(path)).is_ok_and(|own| state_hash(&own) == *digest);
    let exit = [Exit::Held, Exit::GateFailed, Exit::Diverged].into_iter().find(|exit| *exit as u8 == made.exit)?;
    (made.inputs == inputs && made.files.iter().all(is_whole)).then_some((exit, made.text))
}

/// Records inputs, digests of the files, exit code and text of a report in its folder.
pub(super) fn keep(folder: &Path, inputs: String, exit: Exit, text: &str) -> io::Result<()> {
    let digest = |path: PathBuf| Ok((path.clone(), state_hash(&fs::read(folder.join(path))?)));
    let files: io::Result<_> = files_below(folder)?.into_iter().map(digest).collect();
    let made = Made { inputs, files: files?, exit: exit as u8, text: text.to_owned() };
    fs::write(folder.join(FILE), serde_json::to_string(&made)?)
}

/// Files in a folder and below it, in the order of their paths from there.
fn files_below(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let (mut files, mut folders) = (Vec::new(), vec![PathBuf::new()]);
    while let Some(below) = folders.pop() {
        for entry in fs::read_dir(folder.join(&below))? {
            let entry = entry?;
            let (path, kind) = (below.join(entry.file_name()), entry.file_type()?);
            if kind.is_file() {
                files.push(path);
            } else if kind.is_dir() {
                folders.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
