//! `bagnold run`: one case or study into one folder, with its page.

use super::Exit;
use super::arguments::RunArguments;
use super::error::ProgramError;
use super::panels::add_panels;
use super::places::CommittedValues;
use super::profile::StageTimer;
use super::publication::{Publication, ResultPublication};
use super::simulation::{announce, introduce, reject_fast, simulate_showing};
use crate::case::{Changes, OutputPlan, ParameterError, Registry, Request, Requested, SettingError, settings_to_vary};
use crate::checkpoint::{Checkpoints, StoredState};
use crate::measured::{Measurements, draw_measured};
use crate::output::{FileError, OutputFolder};
use crate::report::Baseline;
use crate::result::States;
use crate::store::StorePolicy;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The setting by which a scene starts from the state in a file, or from the newest state of a folder.
fn start_setting(given: &Path, command: &RunArguments, registry: Registry) -> Result<String, ParameterError> {
    let refused = |defect: String| {
        ParameterError::field(
            "--from",
            format!("\"{}\": {defect}", given.display()),
            "",
            "give the file that `bagnold run` names as a state near its end; with --fresh it simulates and names it again",
        )
    };
    let file = if given.is_dir() { newest_state(given, command, registry).map_err(refused)? } else { given.to_owned() };
    let digest = StoredState::read(&file).map_err(refused)?.digest;
    let name = file.display().to_string();
    Ok(format!("from={{ file = {}, sha256 = \"{digest}\" }}", toml::Value::String(name)))
}

/// The newest state in a folder of states, or that the store keeps of the run in a folder of results.
fn newest_state(folder: &Path, command: &RunArguments, registry: Registry) -> Result<PathBuf, String> {
    let case = folder.join("case.toml");
    if !case.is_file() {
        let newest = Checkpoints::at(folder, "", None).newest();
        return newest.ok_or_else(|| "the folder holds neither a state nor the case.toml of a run".to_owned());
    }
    let target = case.display().to_string();
    let request = Request { target: &target, tier: None, settings: &[], only: &[], limits: command.allowance.limits() };
    let prepared = request.prepare(registry).map_err(|error| error.to_string())?.prepared;
    match prepared.run_count() {
        // --fresh must not discard the state that it starts from
        1 => prepared
            .kept_state(0, &command.work.store_for(StorePolicy::Use).with_ends())
            .ok_or_else(|| "the store keeps no state of its run any more, or never of this case".to_owned()),
        runs => Err(format!("the folder is of {runs} runs, so that it does not say which one continues")),
    }
}

/// Simulates, judges, writes and prints one case.
pub(super) fn run(
    command: &RunArguments,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let start = command.from.as_deref().map(|given| start_setting(given, command, registry)).transpose()?;
    let vary = settings_to_vary(&command.vary).map_err(ParameterError::from)?;
    let settings: Vec<String> = command.settings.iter().cloned().chain(vary).chain(start).collect();
    let request = Request {
        target: &command.target,
        tier: command.tier,
        settings: &settings,
        only: &command.only,
        limits: command.allowance.limits(),
    };
    let Requested { prepared, tier, overlay, output: wanted, changed, has_own_parameters } =
        request.prepare(registry).map_err(|error| match (error, &command.from) {
            (ParameterError::Setting(SettingError::Path { path, .. }), Some(file)) if path == "from" => {
                let rule = "left out for this case: only scenes start from a state";
                ParameterError::field("--from", file.display(), rule, "change the parameters of the case instead")
            }
            (error, _) => error,
        })?;
    let wanted = match command.output_every {
        Some(every) => Some(OutputPlan::new(every, command.output_fields.clone()).map_err(ParameterError::from)?),
        None => wanted,
    };
    let overlay: Vec<Measurements> =
        overlay.iter().chain(&command.overlay).map(|file| Measurements::read(file)).collect::<Result<_, _>>()?;
    let folder =
        command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/runs/{}-{tier}", prepared.name())));
    introduce(std::slice::from_ref(&prepared), quiet || command.json, command.deny_warnings)?;
    let claimed = OutputFolder::claim(&folder)?;
    let store = command.work.open_store().with_ends();
    let expectation = announce("run", std::slice::from_ref(&prepared), &store, quiet || command.json);
    let known = CommittedValues::OfCases.known_failures()?;
    // accepted values are those of the case as it comes; a study in a file has none
    let own = registry.find(prepared.name()).ok().filter(|case| !case.is_study() || case.name() == command.target);
    let as_it_comes = own.map(|case| case.prepare(tier, &Changes::default())).transpose()?;
    let accepted = match &as_it_comes {
        Some(case) => CommittedValues::OfCases.accepted(case.name(), tier)?,
        None => Baseline::default(),
    };
    let all_runs = as_it_comes.iter().flat_map(|case| (0..case.run_count()).map(|run| case.variant(run))).collect();
    let baseline = if changed { Baseline::default() } else { accepted.clone() };
    let started = Instant::now();
    let mut profile = StageTimer::begin();
    let states = wanted.as_ref().map(|plan| States::of(prepared.as_ref(), plan, &claimed.staging().join("states")));
    let mut results = simulate_showing(vec![prepared], &store, quiet, states.as_ref(), Some(&expectation))?;
    reject_fast(&results, command.deny_warnings)?;
    states.map_or(Ok(()), States::finish).map_err(|error| FileError::unwritable(&folder, &error))?;
    profile.over("runs and their figures");
    for result in &mut results {
        draw_measured(result, &overlay)?;
        add_panels(&mut result.figures, &command.panels)?;
        if let Some(plan) = &wanted {
            result.parameters_toml += &format!("\n{}", plan.text());
            "bagnold run case.toml".clone_into(&mut result.command);
        }
    }

    let written = ResultPublication {
        command,
        title: results.first().map(|result| result.name.clone()).unwrap_or_default(),
        tier,
        baseline,
        accepted,
        all_runs,
        is_whole: !changed,
        has_own_parameters,
        known,
        measured: overlay.iter().collect(),
        // states on the way take a time of their own
        learns: wanted.is_none(),
    };
    written.publish(&results, Publication { claimed, store: &store, registry, expectation, started, profile }, output)
}
