//! `bagnold grains`: fields and points of a friction law from dumps of a grain code.

use super::arguments::GrainsArguments;
use super::error::ProgramError;
use super::{Exit, Session, folder_of};
use crate::grains::{GrainPlan, average, summary, write};
use crate::output::OutputFolder;

/// Averages the runs of a plan, writes tables and figures, and prints the points.
pub(super) fn grains(command: &GrainsArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let plan = GrainPlan::read(&command.file)?;
    let folder = folder_of(command.out.as_ref(), "reports/grains", &command.file);
    let runs = average(&plan)?;
    let claimed = OutputFolder::claim(&folder)?;
    write(&plan, &runs, claimed.staging(), command.figures.format())?;
    claimed.publish()?;
    session.say(&summary(&runs));
    session.say(&format!("Points of the law: {}\n", folder.join("points.csv").display()));
    Ok(Exit::Held)
}
