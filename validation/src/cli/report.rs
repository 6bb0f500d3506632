//! `bagnold report`: many cases, or a suite of studies, on one page.

use super::arguments::{Denied, ReportArguments};
use super::error::ProgramError;
use super::profile::StageTimer;
use super::simulation::{announce, simulate};
use super::{Exit, Session, controls, tell, terminal};
use crate::case::{CaseResult, Changes, Features, ParameterError, PreparedCase, Registry, Tier, untaken};
use crate::output::caution_of_shipped;
use crate::report::{CaseReport, ChangedCases, CommittedValues, ReportRequest};
use crate::study::Suite;
use std::path::{Path, PathBuf};

/// Simulates the cases and says what the report says.
pub(super) fn report(command: &ReportArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let Session { registry, quiet, .. } = *session;
    caution_of_shipped(command.suite.is_none());
    let suite = command.suite.as_ref().map(|folder| Suite::read(folder, registry)).transpose()?;
    let (cases, changed) = match &suite {
        Some(suite) => (suite.prepare(registry, command.tier, command.allowance.limits())?, ChangedCases::new()),
        None => prepare(command, registry)?,
    };
    let process = match (ReportRequest { changed, ..request(command, registry, suite.as_ref(), &cases)? }).begin()? {
        Ok(process) => process,
        Err(earlier) => {
            session.note("nothing has changed since this report was written; `--fresh` computes it again");
            session.say(&earlier.text);
            return Ok(earlier.exit);
        }
    };
    let store = command.work.open_store();
    let expectation = announce("report", &cases, &store, quiet);
    let mut profile = StageTimer::begin();
    let mut results = simulate(cases, &store, quiet, None, Some(&expectation))?;
    if let Some(suite) = &suite {
        results = suite.judge(results)?;
    }
    profile.over("runs and their figures");
    let limits = command.allowance.limits();
    let trials =
        if suite.is_none() { controls::of_results(&results, registry, limits, &store, quiet)? } else { Vec::new() };
    let mut cases: Vec<CaseReport> = results.into_iter().map(|result| CaseReport::of(result, registry)).collect();
    for (case, trials) in cases.iter_mut().zip(trials) {
        case.controls = trials;
    }
    for (case, study) in cases.iter_mut().zip(suite.iter().flat_map(Suite::studies)) {
        // what its case.toml compares with
        case.measured = study.measurements().cloned().collect();
    }
    profile.over("controls");
    let outcome = process.finish(cases, &store.drawings().in_format(command.figures.format()))?;
    profile.over("pages");
    let results: Vec<CaseResult> = outcome.cases.into_iter().map(|case| case.result).collect();
    if suite.is_none() {
        expectation.learn(&results, store.root(), rayon::current_num_threads());
    }
    session.say(&outcome.text);
    if command.profile {
        tell(profile.in_words(&results, rayon::current_num_threads()).trim_end_matches('\n'));
    }
    Ok(outcome.exit)
}

/// What the command asks of a report.
fn request(
    command: &ReportArguments,
    registry: Registry,
    suite: Option<&Suite>,
    cases: &[Box<dyn PreparedCase>],
) -> Result<ReportRequest, ProgramError> {
    let (title, committed, named) = match (suite, &command.suite) {
        (Some(suite), Some(folder)) => {
            let named = |study: &crate::study::Study| (study.name().to_owned(), command.tier.unwrap_or(study.tier()));
            let committed = CommittedValues::OfSuite(folder.clone());
            committed.refuse_orphans(&suite.studies().iter().map(crate::study::Study::name).collect::<Vec<_>>())?;
            (name_of(folder), committed, suite.studies().iter().map(named).collect())
        }
        _ => {
            let tier = command.tier.unwrap_or(Tier::Quick);
            let named = cases.iter().map(|case| (case.name().to_owned(), tier)).collect();
            ("Bagnold validation report".to_owned(), CommittedValues::OfCases, named)
        }
    };
    let writes_elsewhere = command.accept || command.junit.is_some() || command.profile;
    let is_repeated = !writes_elsewhere && !command.work.fresh && command.against.is_none() && suite.is_none();
    Ok(ReportRequest {
        title,
        committed,
        named,
        changed: ChangedCases::new(),
        features: suite.is_none().then(|| Features::of(registry)),
        against: command.against.clone(),
        accept: command.accept,
        deny_moved: command.deny == Some(Denied::Moved),
        junit: command.junit.clone(),
        folder: folder(command),
        terminal: terminal::shape(),
        command: repeated(command),
        options: is_repeated.then(|| format!("{command:?} {}", terminal::shape().is_verbose)),
    })
}

/// The folder to write.
fn folder(command: &ReportArguments) -> PathBuf {
    let own = || match &command.suite {
        Some(suite) => Path::new("reports").join("suites").join(name_of(suite)),
        None => PathBuf::from("reports"),
    };
    command.out.clone().unwrap_or_else(own)
}

/// The last part of a folder's path, also of `.`.
fn name_of(folder: &Path) -> String {
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    whole.file_name().map_or_else(|| "suite".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// The cases, and for each setting those that have its field.
fn prepare(
    command: &ReportArguments,
    registry: Registry,
) -> Result<(Vec<Box<dyn PreparedCase>>, ChangedCases), ParameterError> {
    for (place, name) in command.cases.iter().enumerate() {
        if command.cases[..place].iter().any(|other| other.trim() == name.trim()) {
            let remedy = "name each case once";
            return Err(ParameterError::field("--cases", name.trim(), "unique", remedy));
        }
    }
    let wanted = if command.cases.is_empty() {
        registry.iter().collect()
    } else {
        command.cases.iter().map(|name| registry.find(name.trim())).collect::<Result<Vec<_>, _>>()?
    };
    let (tier, limits) = (command.tier.unwrap_or(Tier::Quick), command.allowance.limits());
    let mut changed: ChangedCases = command.settings.iter().map(|setting| (setting.clone(), Vec::new())).collect();
    let mut refusals: Vec<(String, ParameterError)> = Vec::new();
    let mut prepared = Vec::new();
    for case in wanted {
        let mut settings = command.settings.clone();
        let prepare = |settings: &[String]| case.prepare(tier, &Changes { settings, limits, ..Changes::default() });
        let mut own = loop {
            match prepare(&settings) {
                Ok(own) => break own,
                Err(error) => {
                    let Some(place) = untaken(&error, &settings) else { return Err(error.in_case(case.name())) };
                    refusals.push((settings.remove(place), error));
                }
            }
        };
        if !settings.is_empty() {
            // now it is the user's, with its warnings
            caution_of_shipped(false);
            own = prepare(&settings)?;
            caution_of_shipped(true);
        }
        prepared.push(own);
        for (_, cases) in changed.iter_mut().filter(|(setting, _)| settings.contains(setting)) {
            cases.push(case.name().to_owned());
        }
    }
    let Some((vain, _)) = changed.iter().find(|(_, cases)| cases.is_empty()) else { return Ok((prepared, changed)) };
    // the refusal that suggests a field
    refusals.sort_by_key(|(setting, error)| (setting != vain, !error.to_string().contains("did you mean")));
    Err(refusals.swap_remove(0).1.in_no_case())
}

/// The command that makes the same report again.
fn repeated(command: &ReportArguments) -> String {
    let mut words = "bagnold report".to_owned();
    if let Some(tier) = command.tier.filter(|tier| *tier != Tier::Quick) {
        words += &format!(" --tier {tier}");
    }
    if let Some(folder) = &command.suite {
        words += &format!(" --suite {}", folder.display());
    }
    if !command.cases.is_empty() {
        words += &format!(" --cases {}", command.cases.join(","));
    }
    words.extend(command.settings.iter().map(|setting| format!(" --set '{setting}'")));
    if let Some(folder) = &command.against {
        words += &format!(" --against {}", folder.display());
    }
    words
}
