//! The program's commands inside Python.

use crate::waiting::wait_for;
use bagnold_validation::REGISTRY;
use bagnold_validation::cli::{Arguments, execute};
use clap::Parser;
use pyo3::prelude::*;

/// Does what `bagnold WORDS…` does: the exit code and what it prints on standard output. Help, and words that no command
/// understands, come back as text with the exit code that they have.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<String>) -> PyResult<(u8, String)> {
    let arguments = match Arguments::try_parse_from(std::iter::once("bagnold".to_owned()).chain(words)) {
        Ok(arguments) => arguments,
        Err(error) => return Ok((u8::try_from(error.exit_code()).unwrap_or(2), error.to_string())),
    };
    wait_for(py, None, || {
        let mut output = Vec::new();
        let exit = execute(&arguments, *REGISTRY, &mut output)?;
        Ok::<_, bagnold_validation::cli::ProgramError>((exit as u8, String::from_utf8_lossy(&output).into_owned()))
    })
}
