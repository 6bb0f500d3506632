//! Output of `bagnold run` for a finished case or study.

use super::arguments::RunArguments;
use super::error::ProgramError;
use super::expectation::Expectation;
use super::profile::StageTimer;
use super::{Exit, Session, print, tell};
use crate::case::CaseResult;
use crate::measured::Measurements;
use crate::output::OutputFolder;
use crate::report::{CaseReport, SingleRun};
use crate::store::Store;

/// Context for publishing a finished run.
pub(super) struct Publication<'a> {
    pub(super) command: &'a RunArguments,
    pub(super) claimed: OutputFolder,
    pub(super) store: &'a Store,
    /// Runs whose time is kept; none where these times do not predict those of other runs.
    pub(super) expectation: Option<Expectation>,
    pub(super) profile: StageTimer,
    /// Measurements of which the folder receives copies.
    pub(super) measured: Vec<Measurements>,
}

impl Publication<'_> {
    /// Judges and writes a result, and prints the verdicts.
    pub(super) fn publish(
        self,
        run: SingleRun,
        result: CaseResult,
        session: &mut Session<'_>,
    ) -> Result<Exit, ProgramError> {
        let Self { command, store, mut profile, .. } = self;
        let threads = rayon::current_num_threads();
        let case = CaseReport { measured: self.measured, ..CaseReport::of(result, session.registry) };
        let outcome = run.finish(case, self.claimed, &store.drawings().in_format(command.figures.format()))?;
        let results = [outcome.case.result];
        if let Some(expectation) = self.expectation {
            expectation.learn(&results, store.root(), threads);
        }
        profile.over("page");
        if command.json {
            print(session.output, &outcome.json);
        } else {
            session.say(&outcome.text);
        }
        if command.profile {
            tell(profile.in_words(&results, threads).trim_end_matches('\n'));
        }
        match outcome.remarks.trim_end() {
            "" if command.json => {}
            remarks if command.json => tell(remarks),
            _ => session.say(&(outcome.remarks + &outcome.verdict)),
        }
        Ok(outcome.exit)
    }
}
