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

#[cfg(test)]
use bagnold_figure as figure;
use bagnold_harness::{case, control, evaluation, evidence, input, interruption, metric, observation, output, store};
use bagnold_inference::sampling;
use bagnold_number as number;
use bagnold_report as report;
use bagnold_validation::REGISTRY;

use arguments::{Arguments, DevCommand};
use bagnold_validation::cli::{Exit, answered, conduct, in_pool};
use clap::Parser;
use error::DevError;
use std::io::Write;
use std::process::ExitCode;

#[cfg(test)]
#[path = "../../harness/src/case/pendulum.rs"]
mod pendulum;

/// The program: reads its arguments, prints on standard output and error.
#[must_use]
pub fn main() -> ExitCode {
    match Arguments::try_parse() {
        Ok(Arguments { command, verbosity }) => conduct(verbosity, |output| execute(&command, verbosity.quiet, output)),
        Err(answer) => answered(&answer),
    }
}

fn execute(command: &DevCommand, quiet: bool, output: &mut (dyn Write + Send)) -> Result<Exit, DevError> {
    let registry = *REGISTRY;
    match command {
        DevCommand::Verify(command) => verify::verify(command, registry, output),
        DevCommand::Sensitivities(command) => {
            in_pool(command.work.threads, || sensitivities::sensitivities(command, registry, quiet, output))
        }
        DevCommand::Controls(command) => {
            in_pool(command.work.threads, || controls::controls(command, registry, quiet, output))
        }
        DevCommand::Mutate(command) => mutate::mutate(command, registry, quiet, output),
    }
}
