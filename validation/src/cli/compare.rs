//! `bagnold compare`: results that were written earlier, beside each other.

use super::arguments::Compare;
use super::error::ProgramError;
use super::{Exit, say};
use crate::compare::{self, Results};
use crate::output::OutputFolder;
use std::io::Write;

/// Reads, compares and writes.
pub(super) fn compare(command: &Compare, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let all = Results::read(&command.folders)?;
    let claimed = OutputFolder::claim(&command.out)?;
    let moved = compare::write(&all, claimed.staging())?;
    claimed.publish()?;
    say(output, &format!("{moved} numbers differ by more than their tolerance\n"));
    say(output, &format!("written to {}\n", command.out.join("index.html").display()));
    Ok(if moved > 0 && command.deny_differences { Exit::GateFailed } else { Exit::Held })
}
