//! `bagnold examples`: the shipped plans as files.

use super::arguments::ExamplesArguments;
use super::error::ProgramError;
use super::{Exit, say};
use crate::output::{FileError, OutputFolder};
use std::io::Write;
use std::path::Path;

include!(concat!(env!("OUT_DIR"), "/plans.rs"));

/// Writes the calibrations, scenes, studies and sweeps that the program carries.
pub(super) fn examples(command: &ExamplesArguments, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let claimed = OutputFolder::claim(&command.out)?;
    for (name, text) in FILES {
        let file = claimed.staging().join(name);
        let folder = file.parent().unwrap_or(Path::new(""));
        std::fs::create_dir_all(folder)
            .and_then(|()| std::fs::write(&file, text))
            .map_err(|error| FileError::unwritable(&command.out, &error))?;
    }
    claimed.publish()?;
    for (name, _) in FILES {
        say(output, &format!("{}\n", command.out.join(name).display()));
    }
    Ok(Exit::Held)
}
