//! The command line: arguments → calls. No physics here.

mod arguments;
mod calibrate;
mod compare;
mod completions;
mod controls;
mod count;
mod decks;
mod display;
mod error;
mod examples;
mod exit;
mod expectation;
mod judge;
mod logging;
mod machine;
mod mutate;
mod new;
mod panels;
mod places;
mod profile;
mod progress;
mod publication;
mod report;
mod run;
mod sensitivities;
mod setup;
mod simulation;
mod store;
mod study;
mod summary;
mod sweep;
mod terminal;
#[cfg(test)]
mod tests;
mod ticker;
mod unchanged;
mod verify;

pub use arguments::{Arguments, Command};
pub use error::ProgramError;
pub use exit::Exit;
pub use new::error::NewError;
pub use simulation::warn_of_fast;

use crate::case::{Limits, ParameterError, Registry};
use crate::checkpoint::{self, InterruptedRuns};
use crate::interruption::{self, Signal};
use crate::registry::{REGISTRY, declare_build};
use crate::report::check_junit;
use crate::store::{Store, StorePolicy};
use arguments::{DevCommand, ExecutionOptions, ResourceLimits};
use bagnold_solver::lanes::InstructionSet;
use clap::Parser;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use terminal::{StandardOutput, print, say, tell};

/// The program: reads its arguments, prints on standard output and error.
#[must_use]
pub fn main() -> ExitCode {
    program(*REGISTRY, std::env::args_os())
}

/// The program with the cases of a registry, for crates with cases of their own. The first argument is the program's name.
#[must_use]
pub fn program(registry: Registry, arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    declare_build();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(answer) => return answered(&answer),
    };
    logging::start(arguments.verbose, arguments.quiet);
    if let Err(error) = interruption::listen() {
        tracing::warn!("no signal is listened to ({error}): an interruption keeps what the last checkpoints hold");
    }
    if InstructionSet::available().is_empty() {
        tell("error: this program was built for processors with AVX2; build it on this machine, or with --release");
        return Exit::BadInput.into();
    }
    match execute(&arguments, registry, &mut std::io::stdout()) {
        Ok(exit) => exit.into(),
        Err(error) => match interruption::asked() {
            Some(signal) => {
                tell(&interrupted(signal, &error));
                ExitCode::from(signal.exit_code())
            }
            None => {
                tell(&format!("error: {error}"));
                Exit::BadInput.into()
            }
        },
    }
}

/// Prints what the arguments ask for by themselves, such as `--help`, or why they are refused.
fn answered(answer: &clap::Error) -> ExitCode {
    if answer.use_stderr() {
        // in colours on a terminal; arguments are the user's own
        let _: std::io::Result<()> = answer.print();
        return Exit::BadInput.into();
    }
    match answer.print().and_then(|()| std::io::stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            tell(&format!("error: {}", ProgramError::unprintable(&error)));
            Exit::BadInput.into()
        }
        _ => Exit::Held.into(),
    }
}

/// Message after a signal: the results that are kept, and how to resume.
fn interrupted(signal: Signal, error: &ProgramError) -> String {
    let InterruptedRuns { whole, lost } = checkpoint::kept_at_the_end();
    let runs = |count: usize| if count == 1 { "1 run".to_owned() } else { format!("{count} runs") };
    let mut text = format!("interrupted by {}: what is finished is kept", signal.name);
    if whole > 0 {
        text += &format!(", and a checkpoint of {} in progress", runs(whole));
    }
    text += "; the same command resumes from there (without --fresh, which begins anew)";
    if lost > 0 {
        text += &format!("\n{} could not be kept at this moment and will lose some time", runs(lost));
    }
    if error.to_string() != ParameterError::Interrupted.to_string() {
        text += &format!("\nerror: {error}");
    }
    text
}

/// Does what the arguments ask for, with the cases of a registry.
///
/// # Errors
/// Input that is refused; nothing was written then. Output that cannot be written; files then are.
pub fn execute(
    arguments: &Arguments,
    registry: Registry,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let mut output = StandardOutput::new(output);
    let exit = act(arguments, registry, &mut output)?;
    output.finish().map(|()| exit)
}

/// The error of a name that is neither a case nor a kind of file, with the kind that is meant.
fn unknown_schema(name: &str, unknown: ParameterError) -> ParameterError {
    match crate::input::nearest(name, ["study", "calibration", "sweep"]) {
        Some(kind) => ParameterError::UnknownCase { file: None, name: name.to_owned(), nearest: Some(kind) },
        None => unknown,
    }
}

fn act(arguments: &Arguments, registry: Registry, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let junit = match &arguments.command {
        Command::Run(run) => run.junit.as_deref(),
        Command::Report(report) => report.junit.as_deref(),
        Command::Judge(judge) => judge.junit.as_deref(),
        _ => None,
    };
    junit.map_or(Ok(()), check_junit).map_err(ParameterError::from)?;
    match &arguments.command {
        Command::List => {
            let width = registry.iter().map(|case| case.name().len()).max().unwrap_or(0);
            for case in registry.iter() {
                say(output, &format!("{:width$}  {}\n", case.name(), case.summary()));
            }
            Ok(Exit::Held)
        }
        Command::Show(show) => {
            match &show.picture {
                Some(picture) => setup::draw(show, picture, registry, output)?,
                None => say(output, &setup::show(show, registry)?),
            }
            Ok(Exit::Held)
        }
        Command::Schema(show) => {
            // a case goes before the file of the same name
            let schema = match (registry.find(&show.case), show.case.as_str()) {
                (Err(_), "study") => crate::study::schema(),
                (Err(_), "calibration") => crate::calibration::schema().clone(),
                (Err(_), "sweep") => crate::sweep::schema().clone(),
                (Ok(case), _) => case.schema(show.tier),
                (Err(unknown), name) => return Err(unknown_schema(name, unknown).into()),
            };
            print(output, &format!("{schema:#}\n"));
            Ok(Exit::Held)
        }
        Command::Run(command) => in_pool(&command.work, || match study::file(&command.target, registry) {
            Some(file) => study::run(&file, command, registry, arguments.quiet, output),
            None => run::run(command, registry, arguments.quiet, output),
        }),
        Command::Calibrate(command) => {
            in_pool(&command.work, || calibrate::run(command, registry, arguments.quiet, output))
        }
        Command::Completions(command) => Ok(completions::completions(command, registry, output)),
        Command::Examples(command) => examples::examples(command, output),
        Command::New(command) => new::new(command, output),
        Command::Compare(command) => compare::compare(command, output),
        Command::Judge(command) => in_pool(&command.work, || judge::judge(command, registry, arguments.quiet, output)),
        Command::League(command) => {
            in_pool(&command.work, || judge::league(command, registry, arguments.quiet, output))
        }
        Command::Export(command) => {
            in_pool(&command.work, || judge::export(command, registry, arguments.quiet, output))
        }
        Command::Store(command) => store::store(command, output),
        Command::Sweep(command) => in_pool(&command.work, || sweep::sweep(command, registry, arguments.quiet, output)),
        Command::Dev(DevCommand::Verify(command)) => verify::verify(command, registry, output),
        Command::Dev(DevCommand::Sensitivities(command)) => {
            in_pool(&command.work, || sensitivities::sensitivities(command, registry, arguments.quiet, output))
        }
        Command::Dev(DevCommand::Controls(command)) => {
            in_pool(&command.work, || mutate::controls::controls(command, registry, arguments.quiet, output))
        }
        Command::Dev(DevCommand::Mutate(command)) => mutate::mutate(command, registry, arguments.quiet, output),
        Command::Report(command) => {
            in_pool(&command.work, || report::report(command, registry, arguments.quiet, output))
        }
    }
}

/// Runs a command inside a pool of the threads asked for.
fn in_pool(
    work: &ExecutionOptions,
    command: impl FnOnce() -> Result<Exit, ProgramError> + Send,
) -> Result<Exit, ProgramError> {
    in_pool_of(work.threads, command)
}

/// Runs a command inside a pool of so many threads, or of one a core.
fn in_pool_of(
    threads: Option<u16>,
    command: impl FnOnce() -> Result<Exit, ProgramError> + Send,
) -> Result<Exit, ProgramError> {
    // For rayon, 0 threads means all cores.
    let threads = usize::from(threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| ParameterError::Threads { threads, reason: error.to_string() })?;
    pool.install(command)
}

impl ResourceLimits {
    fn limits(&self) -> Limits {
        Limits::of(self.most_memory, self.most_hours)
    }
}

impl ExecutionOptions {
    fn open_store(&self) -> Store {
        self.store_for(if self.fresh { StorePolicy::Refresh } else { StorePolicy::Use })
    }

    fn store_for(&self, policy: StorePolicy) -> Store {
        let store = self.store.as_ref().map_or_else(|| Store::open(policy), |folder| Store::at(folder, policy));
        store.with_checkpoints_every(self.checkpoint_interval)
    }
}
