//! `bagnold dev mutate`: builds a copy of the program with all mutations, runs it with one at a time, and says who noticed.

use super::arguments::MutateArguments;
use super::arguments::upkeep::MutateAction;
use super::count::CountBar;
use super::error::ProgramError;
use super::{Exit, say, summary, tell};
use crate::case::{Registry, share_out};
use crate::mutation::{
    CHOICE, DetectionTally, MutantRun, Mutation, MutationOutcome, Mutations, Scope, build, judge, run_trial, table,
    write,
};
use crate::output::{FileError, OutputFolder};
use crate::store::provenance::workspace;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The name of no error: a case as it is.
const NONE: &str = "none";

/// A case with an error may take so many times as long as without, and some seconds more; then it is stopped.
const PATIENCE: (f64, f64) = (10.0, 60.0);

/// Lists, tries one error, or tries all.
pub(super) fn mutate(
    command: &MutateArguments,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    match &command.action {
        Some(MutateAction::List) => {
            let mutations = Mutations::read(&sources()?)?;
            let width = mutations.iter().map(|mutation| mutation.name.len()).max().unwrap_or(0);
            for Mutation { name, description, cases, .. } in mutations.iter() {
                say(output, &format!("{name:width$}  {description}; {}\n", cases.join(", ")));
            }
            Ok(Exit::Held)
        }
        // the copy itself is asked
        Some(MutateAction::Trial { case, settings, result, threads, .. }) if std::env::var_os(CHOICE).is_some() => {
            let scope = Scope { case: case.clone(), settings: settings.clone() };
            super::in_pool_of(*threads, || {
                let (results, sighting) = run_trial(&scope, registry)?;
                match result {
                    Some(file) => sighting.write(file).map_err(|error| FileError::unwritable(file, &error))?,
                    None => results.iter().for_each(|result| say(output, &summary::of_case(result, |_| false))),
                }
                Ok(Exit::of(&results, |_, _| false))
            })
        }
        Some(MutateAction::Trial { error, case, settings, threads, .. }) => {
            let workspace = sources()?;
            let mutations = Mutations::read(&workspace)?;
            let number = if error == NONE { 0 } else { mutations.number(named(&mutations, error)?) };
            let scope = Scope { case: case.clone(), settings: settings.clone() };
            registry.find(case)?;
            let mut trial = trial(&build(&workspace, &mutations)?, number, &scope, *threads);
            let status = trial.stdin(Stdio::null()).status();
            let status = status.map_err(|error| FileError::unreadable(Path::new("bagnold"), &error))?;
            Ok(match status.code() {
                Some(0) => Exit::Held,
                Some(1) => Exit::GateFailed,
                Some(3) => Exit::Diverged,
                _ => Exit::BadInput,
            })
        }
        None => super::in_pool_of(command.threads, || all(command, quiet, output)),
    }
}

fn sources() -> Result<PathBuf, ProgramError> {
    workspace().map(Path::to_owned).ok_or(ProgramError::NoSources)
}

fn named<'a>(mutations: &'a Mutations, name: &str) -> Result<&'a Mutation, ProgramError> {
    mutations.find(name).ok_or_else(|| ProgramError::UnknownError { name: name.to_owned() })
}

/// The copy, asked to run a case with the mutation of a number.
fn trial(program: &Path, number: usize, scope: &Scope, threads: Option<u16>) -> Command {
    let mut command = Command::new(program);
    command.env(CHOICE, number.to_string()).args(["--quiet", "dev", "mutate", "trial", NONE, &scope.case]);
    for setting in &scope.settings {
        command.args(["--set", setting]);
    }
    if let Some(threads) = threads {
        command.arg("--threads").arg(threads.to_string());
    }
    command
}

/// Tries the errors asked for, writes the findings and prints them.
fn all(command: &MutateArguments, quiet: bool, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let workspace = sources()?;
    let mutations = Mutations::read(&workspace)?;
    let errors: Vec<&Mutation> = if command.errors.is_empty() {
        mutations.iter().collect()
    } else {
        command.errors.iter().map(|name| named(&mutations, name.trim())).collect::<Result<_, _>>()?
    };
    if command.out.starts_with("reports") {
        OutputFolder::adopt(Path::new("reports"))?;
    }
    let claimed = OutputFolder::claim(&command.out)?;
    let started = Instant::now();
    if !quiet {
        tell("building a copy of the program that holds all mutations");
    }
    let program = Program::new(build(&workspace, &mutations)?, &mutations, claimed.staging())?;
    let findings = findings(&errors, &program, quiet)?;
    // what the trials left goes before the folder is published
    drop(program);
    write(&findings, claimed.staging()).map_err(|error| FileError::unwritable(&command.out, &error))?;
    claimed.publish()?;
    say(output, &table(&findings));
    say(output, &format!("{:.0} s; written to {}\n", started.elapsed().as_secs_f64(), command.out.display()));
    Ok(if DetectionTally::of(&findings).holds() { Exit::Held } else { Exit::GateFailed })
}

/// Every case first without errors, then each error through its cases until one notices for certain; as many at a time
/// as there are threads.
fn findings(errors: &[&Mutation], program: &Program<'_>, quiet: bool) -> Result<Vec<MutationOutcome>, ProgramError> {
    let scopes = |error: &Mutation| program.mutations.scopes(error);
    let cases: BTreeSet<Scope> = errors.iter().flat_map(|&error| scopes(error)).collect();
    let bar = CountBar::new("cases and errors", cases.len() + errors.len(), 0, quiet);
    let right = Mutex::new(BTreeMap::new());
    share_out(cases.into_iter().collect(), |scope: Scope| -> Result<(), ProgramError> {
        bar.say(&scope.case);
        let sighting = program.run(None, &scope, Duration::MAX);
        bar.step();
        let sighting = sighting.map_err(|reason| ProgramError::Trial { case: scope.case.clone(), reason })?;
        right.lock().unwrap_or_else(PoisonError::into_inner).insert(scope, sighting);
        Ok(())
    })?;
    let right = right.into_inner().unwrap_or_else(PoisonError::into_inner);
    let cost = |error: &Mutation| -> f64 {
        scopes(error).iter().filter_map(|scope| right.get(scope)).map(|sighting| sighting.wall_seconds).sum()
    };
    let mut queue = errors.to_vec();
    queue.sort_by(|&a, &b| cost(b).total_cmp(&cost(a)));
    let findings = Mutex::new(BTreeMap::new());
    share_out(queue, |error: &Mutation| -> Result<(), ProgramError> {
        bar.say(&error.name);
        let finding = program.try_error(error, &right);
        tracing::info!("{}", table(std::slice::from_ref(&finding)).lines().next().unwrap_or_default());
        findings.lock().unwrap_or_else(PoisonError::into_inner).insert(program.mutations.number(error), finding);
        bar.step();
        Ok(())
    })?;
    bar.clear();
    Ok(findings.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
}

/// The copy, run again for each trial: an error may stop the program that has it.
struct Program<'a> {
    path: PathBuf,
    mutations: &'a Mutations,
    /// Where the trials leave what they found.
    folder: PathBuf,
}

impl<'a> Program<'a> {
    fn new(path: PathBuf, mutations: &'a Mutations, staging: &Path) -> Result<Self, ProgramError> {
        let folder = staging.join("trials");
        std::fs::create_dir_all(&folder).map_err(|error| FileError::unwritable(&folder, &error))?;
        Ok(Self { path, mutations, folder })
    }

    /// Runs an error through its cases, the likeliest first, until a gate or a stop has caught it.
    fn try_error(&self, error: &Mutation, right: &BTreeMap<Scope, MutantRun>) -> MutationOutcome {
        let scopes = self.mutations.scopes(error);
        let mut comparisons = Vec::new();
        for scope in &scopes {
            let Some(right) = right.get(scope) else { continue };
            let limit = Duration::from_secs_f64(PATIENCE.0 * right.wall_seconds + PATIENCE.1);
            comparisons.push((scope, right, self.run(Some(error), scope, limit)));
            if judge(error, &comparisons).catch.is_certain() {
                break;
            }
        }
        judge(error, &comparisons)
    }

    /// Runs a trial on the current pool's number of threads.
    ///
    /// # Errors
    /// Why it has left nothing: it stopped, or was stopped.
    fn run(&self, error: Option<&Mutation>, scope: &Scope, limit: Duration) -> Result<MutantRun, String> {
        let file = self.folder.join(format!("{}-{}", error.map_or(NONE, |error| &error.name), scope.case));
        let number = error.map_or(0, |error| self.mutations.number(error));
        let threads = u16::try_from(rayon::current_num_threads()).ok();
        let mut command = trial(&self.path, number, scope, threads);
        command.arg("--result").arg(&file).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        let started = Instant::now();
        let mut child = command.spawn().map_err(|error| error.to_string())?;
        loop {
            match child.try_wait() {
                Ok(Some(_)) => break,
                Ok(None) if started.elapsed() > limit => {
                    // It may have ended just now.
                    let _ = child.kill();
                    let _ = child.wait();
                    return Err(format!(
                        "stopped after {:.0} s, ten times as long as without the error",
                        limit.as_secs_f64()
                    ));
                }
                Ok(None) => std::thread::sleep(Duration::from_millis(50)),
                Err(error) => return Err(error.to_string()),
            }
        }
        let said = child.wait_with_output().map(|output| String::from_utf8_lossy(&output.stderr).into_owned());
        let reason =
            || said.unwrap_or_default().lines().next().unwrap_or("the program ended without a word").to_owned();
        MutantRun::read(&file).ok_or_else(reason)
    }
}

impl Drop for Program<'_> {
    fn drop(&mut self) {
        // What stays behind stands in the staging folder, which goes as well.
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}
