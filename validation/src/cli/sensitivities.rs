//! `bagnold dev sensitivities`: a case with each input at both ends of its stated range.

use super::arguments::SensitivitiesArguments;
use super::error::ProgramError;
use super::simulation::{announce, simulate};
use super::{Exit, say};
use crate::case::{ParameterError, Registry};
use crate::evaluation::SensitivityPlan;
use crate::evidence::sensitivity_text;
use crate::output::{FileError, write_whole};
use std::io::Write;

/// Simulates and writes the table.
pub(super) fn sensitivities(
    command: &SensitivitiesArguments,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let case = registry.find(&command.case)?;
    let plan = SensitivityPlan::of(case.name());
    if plan.is_empty() {
        let remedy = format!("state ranges of its inputs in reference-data/{}/uncertainty.toml", case.name());
        return Err(ParameterError::field("CASE", case.name(), "a case with stated ranges", &remedy).into());
    }
    let prepared = plan.prepare(case, command.allowance.limits())?;
    let store = command.work.open_store();
    let expectation = announce("sensitivities", &prepared, &store, quiet);
    let results = simulate(prepared, &store, quiet, Some(&expectation))?;
    let rows = plan.rows(&results);
    let text = sensitivity_text(case.name(), &rows)
        .map_err(|error| FileError::unwritable(&command.out, &std::io::Error::other(error)))?;
    write_whole(&command.out, text.as_bytes()).map_err(|error| FileError::unwritable(&command.out, &error))?;
    say(output, &format!("{} comparisons written to {}\n", rows.len(), command.out.display()));
    Ok(Exit::Held)
}
