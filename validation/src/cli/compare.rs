//! `bagnold compare`: results that were written earlier, beside each other.

use super::arguments::CompareArguments;
use super::error::ProgramError;
use super::{Exit, say};
use crate::case::ParameterError;
use crate::compare::{self, Results};
use crate::output::OutputFolder;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Reads, compares and writes.
pub(super) fn compare(command: &CompareArguments, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let all = Results::read(&command.folders)?;
    let same = |folder: &&PathBuf| {
        let whole = |path: &Path| path.canonicalize().ok();
        whole(folder).is_some_and(|folder| whole(&command.out) == Some(folder))
    };
    if let Some(folder) = command.folders.iter().find(same) {
        let (rule, remedy) = ("another folder than those that are compared", "its contents would be replaced");
        return Err(ParameterError::field("--out", folder.display(), rule, remedy).into());
    }
    let claimed = OutputFolder::claim(&command.out)?;
    let moved = compare::write(&all, claimed.staging())?;
    claimed.publish()?;
    say(output, &format!("{moved} numbers differ by more than their tolerance\n"));
    let limits =
        all.split_first().map_or(0, |(first, others)| others.iter().map(|other| first.moved_limits(other)).sum());
    if limits > 0 {
        say(
            output,
            &format!("limits of {limits} gates differ: the verdicts come from different versions of the gates\n"),
        );
    }
    say(output, &format!("written to {}\n", command.out.join("index.html").display()));
    Ok(if moved > 0 && command.deny_differences { Exit::GateFailed } else { Exit::Held })
}
