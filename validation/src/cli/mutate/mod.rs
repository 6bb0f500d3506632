//! `bagnold dev mutate`: builds a copy of the program with all mutations, runs it with one at a time, and says who noticed.

pub(super) mod controls;
mod drawn;
mod program;
mod through_tests;

use super::arguments::MutateArguments;
use super::arguments::upkeep::MutateAction;
use super::count::CountBar;
use super::error::ProgramError;
use super::{Exit, say, summary, tell};
use crate::case::{Registry, share_out};
use crate::mutation::{
    CHOICE, Detection, DetectionTally, Mutation, MutationOutcome, Mutations, Scope, build, run_trial, table, write,
};
use crate::output::{FileError, OutputFolder};
use crate::store::provenance::workspace;
use program::{NONE, Program, trial};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Seconds that a case with an error may take beyond ten times its own.
pub(super) const PATIENCE: f64 = 60.0;

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
            let mut trial = trial(&build(&workspace, &mutations)?, &number.to_string(), &scope, *threads);
            let status = trial.stdin(Stdio::null()).status();
            let status = status.map_err(|error| FileError::unreadable(Path::new("bagnold"), &error))?;
            Ok(match status.code() {
                Some(0) => Exit::Held,
                Some(1) => Exit::GateFailed,
                Some(3) => Exit::Diverged,
                _ => Exit::BadInput,
            })
        }
        Some(MutateAction::Drawn(drawn)) => {
            let workspace = sources()?;
            super::in_pool_of(drawn.threads, || drawn::drawn(drawn, &workspace, registry, quiet, output))
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

/// Tries the errors asked for, writes the findings and prints them.
fn all(command: &MutateArguments, quiet: bool, output: &mut (dyn Write + Send)) -> Result<Exit, ProgramError> {
    let workspace = sources()?;
    let mutations = Mutations::read(&workspace)?;
    let errors: Vec<&Mutation> = if command.errors.is_empty() {
        let is_asked = |mutation: &&Mutation| mutation.generated || !command.generated;
        let has_witness = |mutation: &&Mutation| {
            if command.tests { !mutation.tests.is_empty() } else { !mutation.cases.is_empty() }
        };
        mutations.iter().filter(is_asked).filter(has_witness).collect()
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
    let program = Program::new(build(&workspace, &mutations)?, claimed.staging())?;
    let (of_tests, of_cases): (Vec<&Mutation>, _) =
        errors.into_iter().partition(|error| command.tests || error.cases.is_empty());
    let mut findings = findings(&of_cases, &mutations, &program, quiet)?;
    let of_tests = through_tests::findings(of_tests, &mutations, &program, &workspace, quiet)?;
    // what the trials left goes before the folder is published
    drop(program);
    let survives = |finding: &MutationOutcome| finding.error.generated && !finding.catch.is_certain();
    let is_noticed = |finding: &MutationOutcome| matches!(finding.catch, Detection::Test(_));
    let by_cases = of_cases.is_empty() || DetectionTally::of(&findings).holds() && !findings.iter().any(survives);
    let holds = by_cases && of_tests.iter().all(is_noticed);
    findings.extend(of_tests);
    write(&findings, claimed.staging()).map_err(|error| FileError::unwritable(&command.out, &error))?;
    claimed.publish()?;
    say(output, &table(&findings));
    say(output, &format!("{:.0} s; written to {}\n", started.elapsed().as_secs_f64(), command.out.display()));
    Ok(if holds { Exit::Held } else { Exit::GateFailed })
}

/// Every case first without errors, then each error through its cases until one notices for certain; as many at a time
/// as there are threads.
fn findings(
    errors: &[&Mutation],
    mutations: &Mutations,
    program: &Program,
    quiet: bool,
) -> Result<Vec<MutationOutcome>, ProgramError> {
    let scopes = |error: &Mutation| mutations.scopes(error);
    let cases: BTreeSet<Scope> = errors.iter().flat_map(|&error| scopes(error)).collect();
    let bar = CountBar::new("cases and errors", cases.len() + errors.len(), 0, quiet);
    let right = Mutex::new(BTreeMap::new());
    share_out(cases.into_iter().collect(), |scope: Scope| -> Result<(), ProgramError> {
        bar.say(&scope.case);
        let sighting = program.run("0", &scope, Duration::MAX);
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
        let number = mutations.number(error);
        let scopes = scopes(error);
        let cases: Vec<_> = scopes.iter().filter_map(|scope| Some((scope, right.get(scope)?))).collect();
        let finding = program.try_error(error, number, &cases, PATIENCE);
        tracing::info!("{}", table(std::slice::from_ref(&finding)).lines().next().unwrap_or_default());
        findings.lock().unwrap_or_else(PoisonError::into_inner).insert(number, finding);
        bar.step();
        Ok(())
    })?;
    bar.clear();
    Ok(findings.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
}
