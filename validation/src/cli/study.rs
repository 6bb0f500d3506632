//! `bagnold run STUDY.toml`: the runs of a user's own study, judged by its checks.

use super::arguments::RunArguments;
use super::error::ProgramError;
use super::panels::add_panels;
use super::profile::StageTimer;
use super::publication::Publication;
use super::simulation::{announce, estimate, introduce, reject_fast, simulate};
use super::{Exit, Session, terminal};
use crate::case::{ParameterError, Registry};
use crate::output::OutputFolder;
use crate::report::{Baseline, CommittedValues, SingleRun};
use crate::study::{Study, is_study};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The file of a study, if that is what the target names. A case goes before a file of the same name.
pub(super) fn file(target: &str, registry: Registry) -> Option<PathBuf> {
    let path = Path::new(target);
    (registry.find(target).is_err() && path.is_file() && is_study(path)).then(|| path.to_owned())
}

/// Simulates, judges, writes and prints a study.
pub(super) fn run(file: &Path, command: &RunArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let Session { registry, quiet, .. } = *session;
    refuse_what_cases_take(command)?;
    let study = Study::read(file, registry)?;
    let tier = command.tier.unwrap_or(study.tier());
    let cases = study.prepare(registry, command.tier, &command.settings, command.allowance.limits())?;
    let study = study.told_with(&command.settings);
    let store = command.work.open_store();
    if command.estimate {
        session.say(&estimate(&cases, &store));
        return Ok(Exit::Held);
    }
    let folder = command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/runs/{}-{tier}", study.name())));
    introduce(&cases, quiet || command.json, command.deny_warnings)?;
    let claimed = OutputFolder::claim(&folder)?;
    let expectation = announce("run", &cases, &store, quiet || command.json);
    let committed = CommittedValues::OfSuite(file.parent().unwrap_or(Path::new("")).to_owned());
    // the baseline is that of the study as it stands
    let own =
        if command.settings.is_empty() { committed.baseline(study.name(), tier) } else { Ok(Baseline::default()) };
    let judged_by = SingleRun {
        started: Instant::now(),
        baseline: own?,
        expected_failures: committed.expected_failures()?,
        gates: Baseline::default(),
        all_runs: Vec::new(),
        is_whole: true,
        has_own_parameters: false,
        junit: command.junit.clone(),
        terminal: terminal::shape(),
    };
    let mut profile = StageTimer::begin();
    let results = simulate(cases, &store, quiet, None, Some(&expectation))?;
    reject_fast(&results, command.deny_warnings)?;
    profile.over("runs and their figures");
    let mut result = study.judge(results)?;
    add_panels(&mut result.figures, &command.panels)?;
    let measured = study.measurements().cloned().collect();
    let publication = Publication { command, claimed, store: &store, expectation: None, profile, measured };
    publication.publish(judged_by, result, session)
}

/// Options that mean one case.
fn refuse_what_cases_take(command: &RunArguments) -> Result<(), ParameterError> {
    let options = [
        ("--vary", !command.vary.is_empty(), "change the [[vary]] values in a copy of the file"),
        ("--only", !command.only.is_empty(), "delete other `[[variants]]` or `[[vary]]` values in a copy of the file"),
        ("--overlay", !command.overlay.is_empty(), "name the file by `compare` in a check"),
        ("--output-every", command.output_every.is_some(), "run the case that the study is based on"),
    ];
    match options.into_iter().find(|(_, given, _)| *given) {
        Some((option, _, remedy)) => Err(ParameterError::field(option, "not available for a study", "", remedy)),
        None => Ok(()),
    }
}
