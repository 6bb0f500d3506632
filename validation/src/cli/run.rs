//! `bagnold run`: one case or study into one folder, with its page.

use super::arguments::RunArguments;
use super::error::ProgramError;
use super::panels::add_panels;
use super::profile::StageTimer;
use super::publication::Publication;
use super::simulation::{announce, estimate, introduce, reject_fast, simulate};
use super::{Exit, Session, terminal};
use crate::case::{Changes, OutputPlan, ParameterError, Registry, Request, Requested, Tier, settings_to_vary};
use crate::checkpoint::{BULK_MODULUS, Checkpoints, StoredState};
use crate::measured::{draw_measured, read_overlay};
use crate::output::{FileError, OutputFolder, caution_of_shipped};
use crate::report::{Baseline, CommittedValues, SingleRun};
use crate::result::States;
use crate::store::{CodeOrigin, StorePolicy};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The setting by which a scene starts from the state in a file, or from the newest state of a folder.
fn start_setting(given: &Path, command: &RunArguments, registry: Registry) -> Result<String, ParameterError> {
    let refused = |defect: String| {
        ParameterError::field(
            "--from",
            format!("\"{}\": {defect}", given.display()),
            "",
            "give the state file that `bagnold run` names at the end of its output; `--fresh` writes it again",
        )
    };
    let file = if given.is_dir() { newest_state(given, command, registry).map_err(refused)? } else { given.to_owned() };
    let state = StoredState::read(&file).map_err(refused)?;
    let name = toml::Value::String(file.display().to_string());
    let stiffness =
        state.property(BULK_MODULUS).map(|modulus| format!(", bulk_modulus = {modulus}")).unwrap_or_default();
    Ok(format!("from={{ file = {name}, sha256 = \"{}\"{stiffness} }}", state.digest))
}

/// The newest state in a folder of states, or that the store keeps of the run in a folder of results.
fn newest_state(folder: &Path, command: &RunArguments, registry: Registry) -> Result<PathBuf, String> {
    let case = folder.join("case.toml");
    if !case.is_file() {
        let newest = Checkpoints::at(folder, "", None).newest();
        return newest.ok_or_else(|| "the folder contains neither a state nor the case.toml of a run".to_owned());
    }
    let target = case.display().to_string();
    let request = Request { target: &target, tier: None, settings: &[], only: &[], limits: command.allowance.limits() };
    let prepared = request.prepare(registry).map_err(|error| error.to_string())?.prepared;
    match prepared.run_count() {
        // --fresh must not discard the state that it starts from
        1 => prepared
            .kept_state(0, &command.work.store_for(StorePolicy::Use).with_ends())
            .ok_or_else(|| "no state of this run is stored".to_owned()),
        runs => Err(format!("the folder has {runs} runs, and only a single one can continue")),
    }
}

/// Simulates, judges, writes and prints one case.
pub(super) fn run(command: &RunArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let Session { registry, quiet, .. } = *session;
    let start = command.from.as_deref().map(|given| start_setting(given, command, registry)).transpose()?;
    let vary = settings_to_vary(&command.vary).map_err(ParameterError::from)?;
    let settings: Vec<String> = command.settings.iter().cloned().chain(vary).chain(start).collect();
    let is_shipped = registry.find(&command.target).is_ok_and(|case| case.origin() == CodeOrigin::PACKAGE);
    caution_of_shipped(settings.is_empty() && is_shipped);
    let request = Request {
        target: &command.target,
        tier: command.tier,
        settings: &settings,
        only: &command.only,
        limits: command.allowance.limits(),
    };
    let Requested { prepared, tier, overlay, output: wanted, changed, has_own_parameters } =
        request.prepare(registry).map_err(|error| match (error, &command.from) {
            (error, Some(file)) if error.is_of_setting() && error.field_path() == Some("from") => {
                let rule = "left out for this case, because only scenes start from a state";
                ParameterError::field("--from", file.display(), rule, "change the parameters of the case instead")
            }
            (error, _) => error,
        })?;
    let asked = command.output_every.map(|every| OutputPlan::new(every, command.output_fields.clone())).transpose();
    let wanted = asked.map_err(ParameterError::from)?.or(wanted);
    let overlay = read_overlay(prepared.as_ref(), &overlay, &command.overlay)?;
    let store = command.work.open_store().with_ends();
    if command.estimate {
        session.say(&estimate(std::slice::from_ref(&prepared), &store));
        return Ok(Exit::Held);
    }
    let folder =
        command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/runs/{}-{tier}", prepared.name())));
    introduce(std::slice::from_ref(&prepared), quiet || command.json, command.deny_warnings)?;
    let claimed = OutputFolder::claim(&folder)?;
    let expectation = announce("run", std::slice::from_ref(&prepared), &store, quiet || command.json);
    let judged_by = judged_by(prepared.name(), tier, changed, command, registry)?;
    let judged_by = SingleRun { has_own_parameters, ..judged_by };
    let mut profile = StageTimer::begin();
    let states = wanted.as_ref().map(|plan| States::of(prepared.as_ref(), plan, &claimed.staging().join("states")));
    let results = simulate(vec![prepared], &store, quiet, states.as_ref(), Some(&expectation))?;
    reject_fast(&results, command.deny_warnings)?;
    states.map_or(Ok(()), States::finish).map_err(|error| FileError::unwritable(&folder, &error))?;
    profile.over("runs and their figures");
    let Some(mut result) = results.into_iter().next() else { return Ok(Exit::Held) };
    draw_measured(&mut result, &overlay)?;
    add_panels(&mut result.figures, &command.panels)?;
    if let Some(plan) = &wanted {
        result.parameters_toml += &format!("\n{}", plan.text());
        "bagnold run case.toml".clone_into(&mut result.command);
    }
    // states on the way take a time of their own
    let expectation = Some(expectation).filter(|_| wanted.is_none());
    let publication = Publication { command, claimed, store: &store, expectation, profile, measured: overlay };
    publication.publish(judged_by, result, session)
}

/// What a case is judged by: the baseline of the case as it comes, of which a study in a file has none.
fn judged_by(
    name: &str,
    tier: Tier,
    changed: bool,
    command: &RunArguments,
    registry: Registry,
) -> Result<SingleRun, ProgramError> {
    let committed = CommittedValues::OfCases;
    let expected_failures = committed.expected_failures()?;
    let own = registry.find(name).ok().filter(|case| !case.is_study() || case.name() == command.target);
    let as_it_comes = own.map(|case| case.prepare(tier, &Changes::default())).transpose()?;
    let gates = as_it_comes.as_ref().map(|case| committed.baseline(case.name(), tier)).transpose();
    let gates = gates?.unwrap_or_default();
    Ok(SingleRun {
        started: Instant::now(),
        baseline: if changed { Baseline::default() } else { gates.clone() },
        expected_failures,
        gates,
        all_runs: as_it_comes.iter().flat_map(|case| (0..case.run_count()).map(|run| case.variant(run))).collect(),
        is_whole: !changed,
        has_own_parameters: false,
        junit: command.junit.clone(),
        terminal: terminal::shape(),
    })
}
