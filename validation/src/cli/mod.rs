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
mod expectation;
mod grains;
mod judge;
mod logging;
mod machine;
mod new;
mod panels;
mod predict;
mod profile;
mod progress;
mod publication;
mod report;
mod run;
mod setup;
mod simulation;
mod store;
mod study;
mod sweep;
mod terminal;
#[cfg(test)]
mod tests;
mod ticker;

pub use crate::report::Exit;
pub use arguments::{Arguments, Command, ExecutionOptions, ResourceLimits, Verbosity};
pub use count::CountBar;
pub use error::ProgramError;
pub use simulation::{simulate_announced, warn_of_fast};
pub use terminal::tell;

use crate::case::{Limits, ParameterError, Registry, pool};
use crate::checkpoint;
use crate::interruption::{self, Signal};
use crate::registry::{REGISTRY, declare_build};
use crate::report::{check_junit, put_refusal};
use crate::store::{Store, StorePolicy};
use bagnold_solver::lanes::InstructionSet;
use clap::Parser;
use clap::error::{ContextKind, ContextValue};
use std::ffi::OsString;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use terminal::{StandardOutput, print, say};

/// The program: reads its arguments, prints on standard output and error.
pub fn main() -> ExitCode {
    program(*REGISTRY, std::env::args_os())
}

/// The program with the cases of a registry, for crates with cases of their own. The first argument is the program's name.
pub fn program(registry: Registry, arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    declare_build();
    let words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    match Arguments::try_parse_from(&words) {
        Ok(arguments) => conduct(arguments.verbosity, registry, |session| act(&arguments.command, session)),
        Err(mut answer) => {
            // an option that another command has is no value of this one
            if let Some(ContextValue::StyledStrs(tips)) = answer.get(ContextKind::Suggested)
                && tips.iter().any(|tip| tip.to_string().starts_with("to pass"))
            {
                answer.remove(ContextKind::Suggested);
            }
            if answer.use_stderr() {
                refuse_in_junit(&words, &answer.to_string());
            }
            answered(&answer)
        }
    }
}

/// Writes a refusal of the arguments themselves into the file of `--junit`, if one is among them: an older file would stay green.
fn refuse_in_junit(words: &[OsString], message: &str) {
    let texts: Vec<&str> = words.iter().filter_map(|word| word.to_str()).collect();
    let behind = texts.iter().position(|word| *word == "--junit").and_then(|place| texts.get(place + 1).copied());
    let path = behind.or_else(|| texts.iter().find_map(|word| word.strip_prefix("--junit=")));
    let Some(path) = path.map(Path::new).filter(|path| check_junit(path).is_ok()) else { return };
    if let Err(error) = put_refusal(path, message) {
        tell(&format!("error: {error}"));
    }
}

/// Context of a command.
pub struct Session<'a> {
    /// Cases and studies that the program knows.
    pub registry: Registry,
    /// Whether only results and errors are printed.
    pub quiet: bool,
    /// Standard output.
    pub output: &'a mut (dyn Write + Send),
}

impl Session<'_> {
    /// Prints a text with control characters escaped.
    pub fn say(&mut self, text: &str) {
        say(self.output, text);
    }

    /// Prints the current activity on standard error, unless it is suppressed.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            tell(text);
        }
    }
}

/// Runs a command with the usual logging, signal handling and standard output, and prints the reason of a failure.
pub fn conduct<E: Display>(
    verbosity: Verbosity,
    registry: Registry,
    act: impl FnOnce(&mut Session<'_>) -> Result<Exit, E>,
) -> ExitCode {
    logging::start(verbosity.verbose, verbosity.quiet);
    if let Err(error) = interruption::listen() {
        tracing::warn!("no signal is listened to ({error}): an interruption keeps what the last checkpoints hold");
    }
    if InstructionSet::available().is_empty() {
        tell("error: this program was built for processors with AVX2; build it on this machine, or with --release");
        return Exit::BadInput.into();
    }
    let mut output = std::io::stdout();
    let mut output = StandardOutput::new(&mut output);
    let outcome = act(&mut Session { registry, quiet: verbosity.quiet, output: &mut output });
    let outcome = outcome.map_err(|error| error.to_string());
    let outcome = outcome.and_then(|exit| output.finish().map(|()| exit).map_err(|error| error.to_string()));
    match (outcome, interruption::asked()) {
        (Ok(exit), _) => exit.into(),
        (Err(error), Some(signal)) => {
            tell(&interrupted(signal, &error));
            ExitCode::from(signal.exit_code())
        }
        (Err(error), None) => {
            tell(&format!("error: {error}"));
            Exit::BadInput.into()
        }
    }
}

/// Prints what the arguments ask for by themselves, such as `--help`, or why they are refused.
pub fn answered(answer: &clap::Error) -> ExitCode {
    if answer.get(ContextKind::InvalidSubcommand) == Some(&ContextValue::String("dev".to_owned())) {
        tell(
            "error: `bagnold dev` is a separate program, bagnold-dev; in a checkout, run `cargo run -p bagnold-dev -- COMMAND`",
        );
        return Exit::BadInput.into();
    }
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
fn interrupted(signal: Signal, error: &str) -> String {
    let [lost, whole] = checkpoint::stopped_runs();
    let runs = |count: usize| if count == 1 { "1 run".to_owned() } else { format!("{count} runs") };
    let mut text = format!("interrupted by {}: what is finished is kept", signal.name());
    if whole > 0 {
        text += &format!(", and a checkpoint of {} in progress", runs(whole));
    }
    text += "; the same command resumes from there (without --fresh, which starts again)";
    if lost > 0 {
        text += &format!("\n{} could not be kept at this moment and will lose some time", runs(lost));
    }
    if error != ParameterError::Interrupted.to_string() {
        text += &format!("\nerror: {error}");
    }
    text
}

/// Does what the arguments ask for, with the cases of a registry.
///
/// # Errors
/// Input that is refused; nothing but the file of `--junit` was written then. Output that cannot be written; files then are.
pub fn execute(
    arguments: &Arguments,
    registry: Registry,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    act(&arguments.command, &mut Session { registry, quiet: arguments.verbosity.quiet, output })
}

fn act(command: &Command, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let junit = match command {
        Command::Run(run) => run.junit.as_deref(),
        Command::Report(report) => report.junit.as_deref(),
        Command::Judge(judge) => judge.junit.as_deref(),
        _ => None,
    };
    junit.map_or(Ok(()), check_junit).map_err(ParameterError::from)?;
    let outcome = perform(command, session);
    if let (Some(path), Err(error)) = (junit, &outcome) {
        // an older file would stay as it is
        put_refusal(path, &error.to_string()).map_err(ParameterError::from)?;
    }
    outcome
}

fn perform(command: &Command, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    match command {
        Command::List => {
            let registry = session.registry;
            let width = registry.iter().map(|case| case.name().len()).max().unwrap_or(0);
            for case in registry.iter() {
                session.say(&format!("{:width$}  {}\n", case.name(), case.summary()));
            }
            Ok(Exit::Held)
        }
        Command::Show(command) => setup::show(command, session),
        Command::Schema(command) => setup::schema(command, session),
        Command::Run(command) => {
            in_pool(command.work.threads, || match study::file(&command.target, session.registry) {
                Some(file) => study::run(&file, command, session),
                None => run::run(command, session),
            })
        }
        Command::Calibrate(command) => in_pool(command.work.threads, || calibrate::run(command, session)),
        Command::Predict(command) => predict::predict(command, session),
        Command::Grains(command) => grains::grains(command, session),
        Command::Completions(command) => Ok(completions::completions(command, session)),
        Command::Examples(command) => examples::examples(command, session),
        Command::New(command) => new::new(command, session),
        Command::Compare(command) => compare::compare(command, session),
        Command::Judge(command) => in_pool(command.work.threads, || judge::judge(command, session)),
        Command::League(command) => in_pool(command.work.threads, || judge::league(command, session)),
        Command::Export(command) => in_pool(command.work.threads, || judge::export(command, session)),
        Command::Store(command) => store::store(command, session),
        Command::Sweep(command) => in_pool(command.work.threads, || sweep::sweep(command, session)),
        Command::Report(command) => in_pool(command.work.threads, || report::report(command, session)),
    }
}

/// Folder of a command that works by a file: the given one, else one that is named after the file.
fn folder_of(given: Option<&PathBuf>, root: &str, file: &Path) -> PathBuf {
    given.cloned().unwrap_or_else(|| Path::new(root).join(file.file_stem().unwrap_or_default()))
}

/// Most threads for each processor.
const MOST_THREADS: usize = 8;

/// Calls a function in a pool of a given number of threads, or else of one thread per core.
///
/// # Errors
/// Threads that cannot be started, and the errors of the call.
pub fn in_pool<T: Send, E: From<ParameterError> + Send>(
    threads: Option<u16>,
    act: impl FnOnce() -> Result<T, E> + Send,
) -> Result<T, E> {
    // For rayon, 0 threads means all cores, or what its own variable says.
    let of_variable = || std::env::var("RAYON_NUM_THREADS").ok()?.parse().ok();
    let asked = threads.map(usize::from).or_else(of_variable).unwrap_or(0);
    let most = MOST_THREADS * std::thread::available_parallelism().map_or(1, usize::from);
    if asked > most {
        let reason = format!("above {most}, eight times the processors; RAYON_NUM_THREADS counts as well");
        return Err(ParameterError::Threads { threads: asked, reason }.into());
    }
    pool(threads.map_or(0, usize::from))?.install(act)
}

impl ResourceLimits {
    /// The limits that the options give.
    pub fn limits(&self) -> Limits {
        Limits::of(self.most_memory, self.most_hours)
    }
}

impl ExecutionOptions {
    /// The folder of stored results that the options name.
    pub fn open_store(&self) -> Store {
        self.store_for(if self.fresh { StorePolicy::Refresh } else { StorePolicy::Use })
    }

    fn store_for(&self, policy: StorePolicy) -> Store {
        let store = self.store.as_ref().map_or_else(|| Store::open(policy), |folder| Store::at(folder, policy));
        store.with_checkpoints_every(self.checkpoint_interval)
    }
}
