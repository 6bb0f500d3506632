//! `bagnold-dev mutate`: builds a copy of the program with all mutations, runs it with one at a time, and says who noticed.

mod drawn;
mod program;
mod through_tests;

use crate::arguments::{MutateAction, MutateArguments};
use crate::case::{Tier, share_out};
use crate::error::DevError;
use crate::mutation::{
    CHOICE, Detection, MutantRun, Mutation, MutationOutcome, Mutations, Scope, build, holds, page, run_trial, table,
    tally,
};
use crate::output::{FileError, OutputFolder};
use crate::report::{self, CaseReport, Report, Terminal};
use crate::store::provenance::workspace;
use bagnold_validation::cli::{CountBar, Exit, Session, in_pool};
use drawn::going_on;
pub(crate) use program::Program;
use program::{NONE, trial};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Seconds that a case with an error may take beyond ten times its own.
pub(crate) const PATIENCE: f64 = 60.0;

/// Lists, tries one error, or tries all.
pub(crate) fn mutate(command: &MutateArguments, session: &mut Session<'_>) -> Result<Exit, DevError> {
    match &command.action {
        Some(MutateAction::List) => {
            let mutations = Mutations::read(&sources()?)?;
            let width = mutations.iter().map(|mutation| mutation.name.len()).max().unwrap_or(0);
            for Mutation { name, description, cases, .. } in mutations.iter() {
                session.say(&format!("{name:width$}  {description}; {}\n", cases.join(", ")));
            }
            Ok(Exit::Held)
        }
        // the copy itself is asked
        Some(MutateAction::Trial { case, settings, result, threads, .. }) if std::env::var_os(CHOICE).is_some() => {
            let scope = Scope { case: case.clone(), settings: settings.clone() };
            in_pool(*threads, || {
                let (results, sighting) = run_trial(&scope, session.registry)?;
                let cases = results.into_iter().map(|result| CaseReport::of(result, session.registry)).collect();
                let report = Report::of(String::new(), Tier::Quick, cases);
                let judgement = report::judge(&report);
                match result {
                    Some(file) => sighting.write(file).map_err(|error| FileError::unwritable(file, &error))?,
                    None => judgement.cases.iter().for_each(|case| session.say(&report::of_case(case, Terminal::ALL))),
                }
                Ok(judgement.exit())
            })
        }
        Some(MutateAction::Trial { error, case, settings, threads, .. }) => {
            let workspace = sources()?;
            let mutations = Mutations::read(&workspace)?;
            let number = if error == NONE { 0 } else { mutations.number(named(&mutations, error)?) };
            let scope = Scope { case: case.clone(), settings: settings.clone() };
            session.registry.find(case)?;
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
            in_pool(drawn.threads, || drawn::drawn(drawn, &workspace, session))
        }
        None => in_pool(command.threads, || all(command, session)),
    }
}

pub(crate) fn sources() -> Result<PathBuf, DevError> {
    let missing = "failed to find the sources that mutations change; work in a checkout of bagnold";
    workspace().map(Path::to_owned).ok_or_else(|| DevError::Stopped(missing.to_owned()))
}

pub(crate) fn named<'a>(mutations: &'a Mutations, name: &str) -> Result<&'a Mutation, DevError> {
    let unknown =
        || format!("`{name}` is not among the mutations; `cargo run -p bagnold-dev -- mutate list` names them");
    mutations.find(name).ok_or_else(|| DevError::Stopped(unknown()))
}

/// Tries the errors asked for, writes the findings and prints them.
fn all(command: &MutateArguments, session: &mut Session<'_>) -> Result<Exit, DevError> {
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
    let claimed = OutputFolder::claim(&command.out)?;
    let started = Instant::now();
    session.note("building a copy of the program that holds all mutations");
    let program = Program::new(build(&workspace, &mutations)?, claimed.staging())?;
    let (of_tests, of_cases): (Vec<&Mutation>, _) =
        errors.into_iter().partition(|error| command.tests || error.cases.is_empty());
    let mut findings = findings(&of_cases, &mutations, &program, session.quiet)?;
    let of_tests = through_tests::findings(&of_tests, &mutations, &program, &workspace, session.quiet)?;
    // what the trials left goes before the folder is published
    drop(program);
    let survives = |finding: &MutationOutcome| finding.error.generated && !finding.catch.is_certain();
    let is_noticed = |finding: &MutationOutcome| matches!(finding.catch, Detection::Test(_));
    let by_cases = of_cases.is_empty() || holds(tally(&findings)) && !findings.iter().any(survives);
    let holds = by_cases && of_tests.iter().all(is_noticed);
    findings.extend(of_tests);
    std::fs::write(claimed.staging().join("mutation.md"), page(&findings))
        .map_err(|error| FileError::unwritable(&command.out, &error))?;
    claimed.publish()?;
    session.say(&table(&findings));
    session.say(&format!("{:.0} s; written to {}\n", started.elapsed().as_secs_f64(), command.out.display()));
    Ok(if holds { Exit::Held } else { Exit::GateFailed })
}

/// Each error through its cases until one notices for certain.
fn findings(
    errors: &[&Mutation],
    mutations: &Mutations,
    program: &Program,
    quiet: bool,
) -> Result<Vec<MutationOutcome>, DevError> {
    let right = |scope: &Scope| {
        let sighting = program.run("0", scope, Duration::MAX);
        sighting.map_err(|reason| DevError::trial(&scope.case, &reason))
    };
    let wrong = |error: &Mutation, right: &[(&Scope, &MutantRun)]| {
        let finding = program.try_error(error, mutations.number(error), right, PATIENCE);
        tracing::info!("{}", table(std::slice::from_ref(&finding)).lines().next().unwrap_or_default());
        finding
    };
    let cases = |error: &Mutation| mutations.scopes(error);
    try_all(errors, mutations, ("cases and errors", quiet), (cases, right, wrong))
}

/// Every witness, a case or a test, first without errors, then each error before its own, the dearest first; as many at a time as there
/// are threads. The findings are in the order of the errors' file.
///
/// `witnesses` are those of an error in order; `right` is what a witness says without an error, `wrong` what becomes of an error before
/// its witnesses, each with what it says without.
fn try_all<W: Ord + Send + Sync, R: Send + Sync>(
    errors: &[&Mutation],
    mutations: &Mutations,
    (what, quiet): (&str, bool),
    (witnesses, right, wrong): (
        impl Fn(&Mutation) -> Vec<W> + Sync,
        impl Fn(&W) -> Result<R, DevError> + Sync,
        impl Fn(&Mutation, &[(&W, &R)]) -> MutationOutcome + Sync,
    ),
) -> Result<Vec<MutationOutcome>, DevError> {
    let all: BTreeSet<W> = errors.iter().flat_map(|error| witnesses(error)).collect();
    let bar = CountBar::new(what, all.len() + errors.len(), 0, quiet);
    let said = share_out(Vec::from_iter(all), |witness: W| {
        let started = Instant::now();
        let said = right(&witness);
        going_on()?;
        bar.step();
        Ok::<_, DevError>((witness, (said?, started.elapsed())))
    })?;
    let said: BTreeMap<W, (R, Duration)> = said.into_iter().collect();
    let cost = |error: &Mutation| -> Duration {
        witnesses(error).iter().filter_map(|witness| said.get(witness)).map(|(_, time)| *time).sum()
    };
    let mut queue = errors.to_vec();
    queue.sort_by_key(|error| std::cmp::Reverse(cost(error)));
    let mut findings = share_out(queue, |error: &Mutation| {
        bar.say(&error.name);
        let own = witnesses(error);
        let own: Vec<(&W, &R)> = own.iter().filter_map(|witness| Some((witness, &said.get(witness)?.0))).collect();
        let finding = wrong(error, &own);
        going_on()?;
        bar.step();
        Ok::<_, DevError>(finding)
    })?;
    findings.sort_by_key(|finding| mutations.number(&finding.error));
    Ok(findings)
}
