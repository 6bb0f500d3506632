//! `bagnold-dev sensitivities`: a case with each input at both ends of its stated range.

use crate::arguments::SensitivitiesArguments;
use crate::case::ParameterError;
use crate::error::DevError;
use crate::evaluation::SensitivityPlan;
use crate::evidence::sensitivity_text;
use crate::output::{FileError, write_whole};
use bagnold_validation::cli::{Exit, Session, simulate_announced};

/// Simulates and writes the table.
pub(crate) fn sensitivities(command: &SensitivitiesArguments, session: &mut Session<'_>) -> Result<Exit, DevError> {
    let case = session.registry.find(&command.case)?;
    let plan = SensitivityPlan::of(case.name());
    if plan.is_empty() {
        let remedy = format!("state ranges of its inputs in reference-data/{}/uncertainty.toml", case.name());
        return Err(ParameterError::field("CASE", case.name(), "a case with stated ranges", &remedy).into());
    }
    let prepared = plan.prepare(case, command.allowance.limits())?;
    let results = simulate_announced("sensitivities", prepared, &command.work.open_store(), session.quiet)?;
    let rows = plan.rows(&results);
    let text = sensitivity_text(case.name(), &rows)
        .map_err(|error| FileError::unwritable(&command.out, &std::io::Error::other(error)))?;
    write_whole(&command.out, text.as_bytes()).map_err(|error| FileError::unwritable(&command.out, &error))?;
    session.say(&format!("{} comparisons written to {}\n", rows.len(), command.out.display()));
    Ok(Exit::Held)
}
