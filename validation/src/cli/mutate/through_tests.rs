//! Errors that tests must notice: each is run through the tests that it names, all of which must fail.

use super::PATIENCE;
use super::drawn::going_on;
use super::program::Program;
use crate::case::share_out;
use crate::cli::count::CountBar;
use crate::cli::error::ProgramError;
use crate::cli::tell;
use crate::mutation::{Detection, Mutation, MutationOutcome, Mutations, TestProgram, TestTarget, build_tests};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The tests of all these errors without one, then each error through its own.
pub(super) fn findings(
    errors: Vec<&Mutation>,
    mutations: &Mutations,
    program: &Program,
    workspace: &Path,
    quiet: bool,
) -> Result<Vec<MutationOutcome>, ProgramError> {
    if errors.is_empty() {
        return Ok(Vec::new());
    }
    if let Some(error) = errors.iter().find(|error| error.tests.is_empty()) {
        return Err(ProgramError::ErrorWithoutTests { name: error.name.clone() });
    }
    let tests: BTreeSet<&str> = errors.iter().flat_map(|error| error.tests.iter().map(String::as_str)).collect();
    let targets: BTreeSet<TestTarget> = tests.iter().filter_map(|test| TestTarget::of(test)).collect();
    if !quiet {
        tell("building the tests of the copy");
    }
    let programs = build_tests(workspace, &Vec::from_iter(targets))?;
    let bar = CountBar::new("tests and errors", tests.len() + errors.len(), 0, quiet);
    let right = Mutex::new(BTreeMap::new());
    share_out(Vec::from_iter(tests), |test: &str| -> Result<(), ProgramError> {
        let started = Instant::now();
        let outcome = run(program, &programs, test, 0, Duration::MAX);
        going_on()?;
        outcome.map_err(|reason| ProgramError::TestFails { test: test.to_owned(), reason })?;
        right.lock().unwrap_or_else(PoisonError::into_inner).insert(test, started.elapsed());
        bar.step();
        Ok(())
    })?;
    let right = right.into_inner().unwrap_or_else(PoisonError::into_inner);
    let findings = Mutex::new(BTreeMap::new());
    share_out(errors, |error: &Mutation| -> Result<(), ProgramError> {
        let (number, started) = (mutations.number(error), Instant::now());
        let answer = |test: &String| {
            let limit = 10 * right[test.as_str()] + Duration::from_secs_f64(PATIENCE);
            run(program, &programs, test, number, limit).err()
        };
        let answers: Vec<Option<String>> = error.tests.iter().map(answer).collect();
        going_on()?;
        let mut stands = error.tests.iter().zip(&answers).filter(|(_, answer)| answer.is_none());
        let accepted = match stands.next() {
            Some((test, _)) => format!("{test} passes with the error"),
            None => String::new(),
        };
        let finding = MutationOutcome {
            error: error.clone(),
            cases: Vec::new(),
            catch: match accepted.as_str() {
                "" => Detection::Test(answers.iter().flatten().cloned().collect::<Vec<_>>().join("; ")),
                _ => Detection::Nothing,
            },
            drifted: 0,
            first_drift: accepted,
            wall_seconds: started.elapsed().as_secs_f64(),
        };
        findings.lock().unwrap_or_else(PoisonError::into_inner).insert(number, finding);
        bar.step();
        Ok(())
    })?;
    bar.clear();
    Ok(findings.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
}

/// Runs one test with the mutation of a number.
///
/// # Errors
/// That it fails, or that there is none.
fn run(program: &Program, programs: &[TestProgram], test: &str, number: usize, limit: Duration) -> Result<(), String> {
    let (file, function) = test.split_once("::").unwrap_or((test, ""));
    let target = TestTarget::of(file).ok_or_else(|| format!("{file}: no source of tests"))?;
    let own = programs.iter().find(|own| own.target == target);
    let own = own.ok_or_else(|| format!("{target} is not built"))?;
    program.test(own, Some(function), number, limit)
}
