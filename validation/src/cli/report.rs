//! `bagnold report`: many cases on one page.

use super::arguments::{Denied, Report as Arguments};
use super::error::ProgramError;
use super::profile::Profile;
use super::run::{announce, simulate};
use super::{Exit, places, say, summary, tell};
use crate::case::{CaseResult, Changes, ParameterError, Prepared, Registry, Tier};
use crate::output::OutputFolder;
use crate::report::{self, Baseline, CaseReport, History, KnownFailures, Provenance, Report, Standing, history};
use crate::result::MetricsDocument;
use crate::store::provenance;
use std::io::Write;
use std::time::Instant;

/// Simulates and judges the cases, writes the page and prints what fails.
pub(super) fn report(
    command: &Arguments,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let cases = prepare(command, registry)?;
    let names: Vec<String> = cases.iter().map(|case| case.name().to_owned()).collect();
    let mut baseline = baseline(command, &names)?;
    let claimed = OutputFolder::claim(&command.out)?;
    let known = places::known_failures()?;
    let history = History::read(&places::history_file(), command.tier)?;
    let store = command.work.open_store();
    let expectation = announce("report", &cases, &store, quiet);
    let started = Instant::now();
    let mut profile = Profile::begin();
    let results = simulate(cases, &store, quiet, Some(&expectation))?;
    profile.over("runs and their figures");
    if command.accept {
        baseline = Baseline::default();
        for result in &results {
            let fresh = Baseline::of(&result.name, &result.metrics);
            fresh.write(&places::accepted_folder(), &result.name, command.tier)?;
            let made_by = (provenance::version(), provenance::commit());
            history::append(&places::history_file(), made_by, command.tier, &result.name, &result.metrics)?;
            baseline.extend(fresh);
        }
    }
    let cases: Vec<CaseReport> = results.iter().map(case_report).collect();
    let page = Report {
        title: "Bagnold validation report".to_owned(),
        tier: command.tier,
        generated: Provenance::of_this_program(started.elapsed(), repeated(command)),
        papers: report::papers::accounted(&cases),
        cases,
        baseline,
        against: command.against.as_ref().map(|folder| folder.display().to_string()),
        history,
        known_failures: known.clone(),
    };
    report::write(&page, claimed.staging(), &store.drawings())?;
    claimed.publish()?;
    expectation.learn(&results, store.root(), rayon::current_num_threads());
    profile.over("pages");
    if let Some(path) = &command.junit {
        report::write_junit(&page, path)?;
    }

    for result in &results {
        let is_known = |metric: &_| is_known(&known, result, metric);
        say(output, &summary::heading(result));
        say(output, &summary::failures(result, is_known));
    }
    say(output, &format!("written to {}\n", command.out.join("index.html").display()));
    let exit = Exit::of(&results, |result, metric| is_known(&known, result, metric));
    let drifted = drifted(&page);
    say(output, &drifted);
    if command.profile {
        tell(profile.in_words(&results, rayon::current_num_threads()).trim_end_matches('\n'));
    }
    let denied = command.deny == Some(Denied::Drift) && !drifted.is_empty();
    Ok(if denied && exit == Exit::Held { Exit::GateFailed } else { exit })
}

/// What the values are compared with: those of an earlier report, or the accepted ones.
fn baseline(command: &Arguments, cases: &[String]) -> Result<Baseline, ProgramError> {
    if let Some(folder) = &command.against {
        return Ok(Baseline::of_report(folder, cases, command.tier)?);
    }
    let mut baseline = Baseline::default();
    for case in cases {
        baseline.extend(places::accepted(case, command.tier)?);
    }
    Ok(baseline)
}

/// A line for each value that has drifted, the farthest first.
fn drifted(page: &Report) -> String {
    let moved = report::drift::moved(&report::judge(page), &page.history);
    moved.iter().filter(|moved| moved.has_drifted).map(|moved| format!("drifted: {moved}\n")).collect()
}

fn prepare(command: &Arguments, registry: Registry) -> Result<Vec<Box<dyn Prepared>>, ParameterError> {
    for (place, name) in command.cases.iter().enumerate() {
        if command.cases[..place].iter().any(|other| other.trim() == name.trim()) {
            let remedy = "name each case once: every case has one page";
            return Err(ParameterError::field("--cases", name.trim(), "unlike the others", remedy));
        }
    }
    let wanted = if command.cases.is_empty() {
        registry.iter().collect()
    } else {
        command.cases.iter().map(|name| registry.find(name.trim())).collect::<Result<Vec<_>, _>>()?
    };
    let changes = Changes { limits: command.allowance.limits(), ..Changes::default() };
    wanted.into_iter().map(|case| case.prepare(command.tier, &changes)).collect()
}

/// The command that makes the same report again.
fn repeated(command: &Arguments) -> String {
    let mut words = "bagnold report".to_owned();
    if command.tier != Tier::Quick {
        words += &format!(" --tier {}", command.tier);
    }
    if !command.cases.is_empty() {
        words += &format!(" --cases {}", command.cases.join(","));
    }
    if let Some(folder) = &command.against {
        words += &format!(" --against {}", folder.display());
    }
    words
}

/// A finished case as a report shows it.
pub(super) fn case_report(result: &CaseResult) -> CaseReport {
    CaseReport {
        name: result.name.clone(),
        summary: result.summary.clone(),
        description: result.description.clone(),
        parameters_toml: result.parameters_toml.clone(),
        command: result.command.clone(),
        metrics: result.metrics.clone(),
        figures: result.figures.clone(),
        animations: result.animations.clone(),
        runs: result.runs.clone(),
        metrics_json: MetricsDocument::of(result, rayon::current_num_threads()).text(),
    }
}

/// Whether a failing gate is listed, and fails as listed.
pub(super) fn is_known(known: &KnownFailures, result: &CaseResult, metric: &crate::metric::Metric) -> bool {
    matches!(known.standing(&result.name, metric), Standing::Known(_))
}
