//! Errors that tests must notice: each is run through the tests that it names, all of which must fail.

use super::program::Program;
use super::{PATIENCE, try_all};
use crate::error::DevError;
use crate::mutation::{Detection, Mutation, MutationOutcome, Mutations, TestProgram, TestTarget, build_tests};
use bagnold_validation::cli::tell;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::{Duration, Instant};

/// Runs each error through the tests that it names.
pub(super) fn findings(
    errors: &[&Mutation],
    mutations: &Mutations,
    program: &Program,
    workspace: &Path,
    quiet: bool,
) -> Result<Vec<MutationOutcome>, DevError> {
    if errors.is_empty() {
        return Ok(Vec::new());
    }
    if let Some(error) = errors.iter().find(|error| error.tests.is_empty()) {
        let (name, remedy) = (&error.name, "give it `tests` in validation/dev/mutations.toml, or try it in a case");
        return Err(DevError::Stopped(format!(
            "mutation `{name}` names no test to run; {remedy}: `cargo run -p bagnold-dev -- mutate trial {name} CASE`"
        )));
    }
    let named = errors.iter().flat_map(|error| &error.tests);
    let targets: BTreeSet<TestTarget> = named.filter_map(|test| TestTarget::of(test)).collect();
    if !quiet {
        tell("building the tests of the copy");
    }
    let programs = build_tests(workspace, &Vec::from_iter(targets))?;
    let right = |test: &String| {
        let started = Instant::now();
        let outcome = run(program, &programs, test, 0, Duration::MAX);
        let unsound = |reason| format!("test {test} fails without an error as well: {reason}; mend it first");
        outcome.map_err(|reason: String| DevError::Stopped(unsound(reason)))?;
        Ok(started.elapsed())
    };
    let wrong = |error: &Mutation, right: &[(&String, &Duration)]| {
        let (number, started) = (mutations.number(error), Instant::now());
        let answer = |(test, usual): &(&String, &Duration)| {
            let limit = 10 * **usual + Duration::from_secs_f64(PATIENCE);
            run(program, &programs, test, number, limit).err()
        };
        let answers: Vec<Option<String>> = right.iter().map(answer).collect();
        let stands = right.iter().zip(&answers).find(|(_, answer)| answer.is_none());
        let accepted = stands.map(|((test, _), _)| format!("{test} passes with the error")).unwrap_or_default();
        MutationOutcome {
            error: error.clone(),
            cases: Vec::new(),
            catch: match accepted.as_str() {
                "" => Detection::Test(answers.into_iter().flatten().collect::<Vec<_>>().join("; ")),
                _ => Detection::Nothing,
            },
            drifted: 0,
            first_drift: accepted,
            wall_seconds: started.elapsed().as_secs_f64(),
        }
    };
    let tests = |error: &Mutation| error.tests.clone();
    try_all(errors, mutations, ("tests and errors", quiet), (tests, right, wrong))
}

/// Runs one test with the mutation of a number.
///
/// # Errors
/// That it fails, or that there is none.
fn run(program: &Program, programs: &[TestProgram], test: &str, number: usize, limit: Duration) -> Result<(), String> {
    let (file, function) = test.split_once("::").unwrap_or((test, ""));
    let target = TestTarget::of(file).ok_or_else(|| format!("{file}: no source of tests"))?;
    let own = programs.iter().find(|own| own.target == target);
    let own = own.ok_or_else(|| format!("{} is not built", target.name))?;
    program.test(own, Some(function), number, limit)
}
