//! `bagnold-dev mutate drawn`: draws mutations by rule, runs each through the cases that reach it, and estimates how many are killed.

use super::program::Program;
use crate::arguments::DrawnArguments;
use crate::case::{ParameterError, Registry, share_out};
use crate::error::DevError;
use crate::interruption;
use crate::mutation::{
    Detection, Draw, DrawProgress, MutationOutcome, Scope, TestTarget, TracedCase, build_tests, drawn_line, drawn_page,
};
use crate::output::{FileError, OutputFolder};
use bagnold_validation::cli::{Exit, Session, tell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Seconds that a case may take beyond ten times its own.
const PATIENCE: f64 = 10.0;

/// A draw, what is known of it, and where that is kept.
struct Trial<'a, 'b> {
    draw: Draw,
    progress: Mutex<DrawProgress>,
    kept: PathBuf,
    session: Mutex<&'a mut Session<'b>>,
}

pub(super) fn drawn(command: &DrawnArguments, workspace: &Path, session: &mut Session<'_>) -> Result<Exit, DevError> {
    let claimed = OutputFolder::claim(&command.out)?;
    let draw = Draw::new(workspace, command.seed)?;
    let (mut progress, kept) = DrawProgress::open(workspace, &draw);
    let count = usize::from(command.count);
    let (registry, quiet) = (session.registry, session.quiet);
    let note = |text: &str| {
        if !quiet {
            tell(text);
        }
    };
    let mut wanted = 2 * count;
    let (places, program, sample) = loop {
        note(&format!("building a copy of the program with {wanted} of {} mutations", draw.count()));
        let (places, path) = draw.build(workspace, wanted, &mut progress.rejected, &note)?;
        progress.save(&kept)?;
        let program = Program::new(path, claimed.staging())?;
        if places.iter().any(|place| !progress.traced.contains(place)) {
            note("tracing which of them each case reaches");
            progress.cases = traced(&program, &places, registry)?;
            progress.traced = places.iter().copied().collect();
            progress.save(&kept)?;
        }
        let reached = |place: &&usize| !progress.cases_of(**place).is_empty();
        let sample: Vec<usize> = places.iter().filter(reached).take(count).copied().collect();
        if sample.len() == count || places.len() < wanted {
            break (places, program, sample);
        }
        wanted += count;
    };
    let number = |place: usize| places.iter().position(|other| *other == place).map_or(0, |index| index + 1);
    let trial = Trial { draw, progress: Mutex::new(progress), kept, session: Mutex::new(session) };
    let open = |done: &dyn Fn(&DrawProgress, usize) -> bool| -> Vec<usize> {
        let progress = trial.progress.lock().unwrap_or_else(PoisonError::into_inner);
        sample.iter().filter(|place| !done(&progress, **place)).copied().collect()
    };
    share_out(open(&|progress, place| progress.outcomes.contains_key(&place)), |place| {
        trial.cases(&program, place, number(place))
    })?;
    if command.tests {
        let is_killed = |progress: &DrawProgress, place: usize| progress.outcomes[&place].catch.is_certain();
        let left = open(&|progress, place| progress.tested.contains(&place) || is_killed(progress, place));
        note(&format!("running the tests with {} mutations that no gate has killed", left.len()));
        trial.tests(workspace, &program, left, &number)?;
    }
    drop(program);
    let Trial { progress, session, .. } = trial;
    let progress = progress.into_inner().unwrap_or_else(PoisonError::into_inner);
    let findings: Vec<MutationOutcome> = sample.iter().map(|place| progress.outcomes[place].clone()).collect();
    let last = sample.last().copied().unwrap_or(0);
    let refused = progress.rejected.iter().filter(|place| **place < last).count();
    let unreached = places.iter().filter(|place| **place < last && !sample.contains(place)).count();
    let sentence = format!(
        "{} mutations of seed {:#x}; {refused} drawn beside them do not compile, {unreached} are reached by no case of the quick tier.",
        findings.len(),
        command.seed
    );
    let page = drawn_page(&sentence, &findings);
    let file = claimed.staging().join("drawn.md");
    std::fs::write(&file, &page).map_err(|error| FileError::unwritable(&command.out, &error))?;
    claimed.publish()?;
    let session = session.into_inner().unwrap_or_else(PoisonError::into_inner);
    session.say(page.split("\n| mutation").next().unwrap_or_default());
    session.say(&format!("written to {}\n", command.out.join("drawn.md").display()));
    Ok(Exit::Held)
}

/// Every case at the quick tier without an error, and the places whose expressions it reaches.
fn traced(program: &Program, places: &[usize], registry: Registry) -> Result<BTreeMap<String, TracedCase>, DevError> {
    let cases = share_out(registry.iter().map(|case| case.name().to_owned()).collect(), |case: String| {
        let file = program.file(&format!("reached-{case}"));
        let scope = Scope { case, settings: Vec::new() };
        let right = program.run(&file.to_string_lossy(), &scope, Duration::MAX);
        going_on()?;
        let right = right.map_err(|reason| DevError::trial(&scope.case, &reason))?;
        let numbers = std::fs::read_to_string(&file).unwrap_or_default();
        let place = |line: &str| places.get(line.parse::<usize>().ok()?.checked_sub(1)?).copied();
        let reached: BTreeSet<usize> = numbers.lines().filter_map(place).collect();
        Ok::<_, DevError>((scope.case, TracedCase { right, reached }))
    })?;
    Ok(cases.into_iter().collect())
}

/// # Errors
/// A signal: what a trial that it ended says is no finding.
pub(super) fn going_on() -> Result<(), DevError> {
    interruption::asked().map_or(Ok(()), |_| Err(ParameterError::Interrupted.into()))
}

impl Trial<'_, '_> {
    /// Keeps a finding and prints it.
    fn keep(&self, place: usize, outcome: MutationOutcome) -> Result<(), DevError> {
        let mut session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        session.say(&format!("{}\n", drawn_line(&outcome)));
        let mut progress = self.progress.lock().unwrap_or_else(PoisonError::into_inner);
        progress.outcomes.insert(place, outcome);
        Ok(progress.save(&self.kept)?)
    }

    /// Runs a mutation through the cases that reach it.
    fn cases(&self, program: &Program, place: usize, number: usize) -> Result<(), DevError> {
        let mutation = self.draw.mutation(place);
        let cases: Vec<_> = {
            let progress = self.progress.lock().unwrap_or_else(PoisonError::into_inner);
            let scope = |case: &String| Scope { case: case.clone(), settings: Vec::new() };
            progress.cases_of(place).into_iter().map(|(case, traced)| (scope(case), traced.right.clone())).collect()
        };
        let cases: Vec<_> = cases.iter().map(|(scope, right)| (scope, right)).collect();
        let started = Instant::now();
        let mut outcome = program.try_error(&mutation, number, &cases, PATIENCE);
        going_on()?;
        outcome.wall_seconds = started.elapsed().as_secs_f64();
        self.keep(place, outcome)
    }

    /// Runs the tests with each of these mutations, until one fails.
    fn tests(
        &self,
        workspace: &Path,
        program: &Program,
        places: Vec<usize>,
        number: &(impl Fn(usize) -> usize + Sync),
    ) -> Result<(), DevError> {
        if places.is_empty() {
            return Ok(());
        }
        let mut tests = Vec::new();
        for test in build_tests(workspace, &TestTarget::of_physics())? {
            let started = Instant::now();
            let outcome = program.test(&test, None, 0, Duration::MAX);
            going_on()?;
            match outcome {
                Ok(()) => tests.push((started.elapsed(), test)),
                Err(reason) => tell(&format!("left out, as it fails without an error: {reason}")),
            }
        }
        tests.sort_by_key(|(time, _)| *time);
        share_out(places, |place| {
            let started = Instant::now();
            let limit = |time: Duration| 10 * time + Duration::from_secs_f64(PATIENCE);
            let failed =
                tests.iter().find_map(|(time, test)| program.test(test, None, number(place), limit(*time)).err());
            going_on()?;
            let mut outcome = {
                let mut progress = self.progress.lock().unwrap_or_else(PoisonError::into_inner);
                progress.tested.insert(place);
                progress.outcomes[&place].clone()
            };
            outcome.wall_seconds += started.elapsed().as_secs_f64();
            if let Some(reason) = failed {
                outcome.catch = Detection::Test(reason);
            }
            self.keep(place, outcome)
        })
        .map(drop)
    }
}
