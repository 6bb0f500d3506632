//! `bagnold examples`: the shipped plans as files.

use super::arguments::ExamplesArguments;
use super::error::ProgramError;
use super::{Exit, Session};
use crate::output::{FileError, OutputFolder, write_whole};

include!(concat!(env!("OUT_DIR"), "/plans.rs"));

/// Writes the calibrations, grains, scenes, studies and sweeps that the program carries.
pub(super) fn examples(command: &ExamplesArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let claimed = OutputFolder::claim(&command.out)?;
    for (name, text) in FILES {
        write_whole(&claimed.staging().join(name), text.as_bytes())
            .map_err(|error| FileError::unwritable(&command.out, &error))?;
    }
    claimed.publish()?;
    for (name, _) in FILES {
        session.say(&format!("{}\n", command.out.join(name).display()));
    }
    Ok(Exit::Held)
}
