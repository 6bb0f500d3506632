//! The program `bagnold-dev`: checks for developers of Bagnold, in a checkout.

mod arguments;
mod controls;
mod error;
mod mutate;
pub mod mutation;
mod sensitivities;
#[cfg(test)]
mod stale_sensitivities;
mod verify;

use bagnold_harness::{case, control, evaluation, evidence, input, interruption, metric, observation, output, store};
use bagnold_inference::sampling;
use bagnold_number as number;
use bagnold_report as report;
use bagnold_validation::REGISTRY;

use arguments::{Arguments, DevCommand};
use bagnold_validation::cli::{Exit, Session, answered, conduct, in_pool};
use clap::Parser;
pub use error::DevError;
use std::process::ExitCode;

#[cfg(test)]
#[path = "../../harness/src/case/pendulum.rs"]
mod pendulum;

/// The program: reads its arguments, prints on standard output and error.
pub fn main() -> ExitCode {
    match Arguments::try_parse() {
        Ok(Arguments { command, verbosity }) => conduct(verbosity, *REGISTRY, |session| execute(&command, session)),
        Err(answer) => answered(&answer),
    }
}

fn execute(command: &DevCommand, session: &mut Session<'_>) -> Result<Exit, DevError> {
    match command {
        DevCommand::Verify(command) => verify::verify(command, session),
        DevCommand::Sensitivities(command) => {
            in_pool(command.work.threads, || sensitivities::sensitivities(command, session))
        }
        DevCommand::Controls(command) => in_pool(command.work.threads, || controls::controls(command, session)),
        DevCommand::Mutate(command) => mutate::mutate(command, session),
    }
}
