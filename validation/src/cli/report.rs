//! `bagnold report`: many cases, or a suite of studies, on one page.

use super::arguments::{Denied, ReportArguments};
use super::error::ProgramError;
use super::places::CommittedValues;
use super::profile::StageTimer;
use super::publication::{case_report, is_known};
use super::simulation::{announce, simulate};
use super::{Exit, controls, say, summary, tell, unchanged};
use crate::case::{CaseResult, Changes, Features, ParameterError, PreparedCase, Registry, Tier};
use crate::evidence::{ValidatedComparison, ValidationSet};
use crate::output::{FileError, OutputFolder, write_whole};
use crate::report::{self, Baseline, CaseReport, GateList, Report, ReportProvenance};
use crate::store::provenance;
use crate::study::{Study, Suite};
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulates and judges the cases, writes the page and prints what fails.
pub(super) fn report(
    command: &ReportArguments,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let suite = command.suite.as_ref().map(|folder| Suite::read(folder, registry)).transpose()?;
    let (cases, places) = match (&suite, &command.suite) {
        (Some(suite), Some(folder)) => {
            let cases = suite.prepare(registry, command.tier, command.allowance.limits())?;
            let places = CommittedValues::OfSuite(folder.clone());
            places.refuse_orphans(suite.studies())?;
            (cases, places)
        }
        _ => (prepare(command, registry)?, CommittedValues::OfCases),
    };
    let named: Vec<(String, Tier)> = match &suite {
        Some(suite) => {
            let tier = |study: &Study| command.tier.unwrap_or(study.tier());
            suite.studies().iter().map(|study| (study.name().to_owned(), tier(study))).collect()
        }
        None => cases.iter().map(|case| (case.name().to_owned(), command.tier.unwrap_or(Tier::Quick))).collect(),
    };
    let mut baseline = baseline(command, &places, &named)?;
    let out = folder(command);
    let inputs = unchanged::inputs(command, &places);
    if let Some((exit, text)) = inputs.as_ref().and_then(|inputs| unchanged::said(&out, inputs)) {
        if !quiet {
            tell("nothing has changed since this report was made; `--fresh` makes it anew");
        }
        say(output, &text);
        return Ok(exit);
    }
    let claimed = OutputFolder::claim(&out)?;
    let known = places.known_failures()?;
    let tiers = suite.iter().flat_map(|suite| suite.studies().iter().map(Study::tier));
    let tier = command.tier.or_else(|| tiers.min_by_key(|tier| tier.name() != "quick")).unwrap_or(Tier::Quick);
    let store = command.work.open_store();
    let expectation = announce("report", &cases, &store, quiet);
    let started = Instant::now();
    let mut profile = StageTimer::begin();
    let simulated = simulate(cases, &store, quiet, Some(&expectation))?;
    let results = match &suite {
        Some(suite) => suite.judge(simulated)?,
        None => simulated,
    };
    profile.over("runs and their figures");
    if command.accept {
        baseline = accept(&places, &results)?;
    }
    let limits = command.allowance.limits();
    let mut controls =
        if suite.is_none() { controls::of_results(&results, registry, limits, &store, quiet)? } else { Vec::new() };
    controls.resize_with(results.len(), Vec::new);
    profile.over("controls");
    let of_case = |(result, controls): (&CaseResult, _)| CaseReport {
        controls,
        not_judged: baseline.not_judged(&result.name, &result.metrics),
        ..case_report(result, registry)
    };
    let cases: Vec<CaseReport> = results.iter().zip(controls).map(of_case).collect();
    let page = Report {
        title: command.suite.as_ref().map_or_else(|| "Bagnold validation report".to_owned(), |folder| name_of(folder)),
        tier,
        generated: ReportProvenance::of_this_program(started.elapsed(), repeated(command)),
        features: suite.is_none().then(|| Features::of(registry)),
        papers: if suite.is_none() { report::papers::accounted(&cases) } else { &[] },
        cases,
        baseline,
        against: command.against.as_ref().map(|folder| folder.display().to_string()),
        known_failures: known.clone(),
    };
    report::write(&page, claimed.staging(), &store.drawings().in_format(command.figures.format()))?;
    for (study, result) in suite.iter().flat_map(Suite::studies).zip(&results) {
        // what its case.toml compares with
        let folder = claimed.staging().join("cases").join(&result.name);
        let kept = study.measurements().try_for_each(|measured| measured.keep(&folder));
        kept.map_err(|error| FileError::unwritable(&folder, &error))?;
    }
    let mut text = String::new();
    for result in &results {
        text.push_str(&summary::heading(result));
        text.push_str(&summary::failures(result, |metric| is_known(&known, result, metric)));
    }
    let _ = writeln!(text, "written to {}", out.join("index.html").display());
    for case in &page.cases {
        text.push_str(&summary::not_judged(&case.name, &case.not_judged));
    }
    let contradictions = places.contradictions(&page);
    text.push_str(&contradictions);
    let is_whole = contradictions.is_empty() && page.cases.iter().all(|case| case.not_judged.is_empty());
    let exit = Exit::of(&results, |result, metric| is_known(&known, result, metric)).unless_whole(is_whole);
    let drifted = drifted(&page);
    text.push_str(&drifted);
    if exit == Exit::Held && command.deny.is_none() {
        text.push_str(&not_denied(&drifted));
    }
    let denied = command.deny == Some(Denied::Drift) && !drifted.is_empty();
    let exit = if denied && exit == Exit::Held { Exit::GateFailed } else { exit };
    if let Some(inputs) = inputs {
        let kept = unchanged::keep(claimed.staging(), inputs, exit, &text);
        kept.map_err(|error| FileError::unwritable(claimed.staging(), &error))?;
    }
    claimed.publish()?;
    if suite.is_none() {
        expectation.learn(&results, store.root(), rayon::current_num_threads());
    }
    profile.over("pages");
    if let Some(path) = &command.junit {
        report::write_junit(&page, path)?;
    }
    say(output, &text);
    if command.profile {
        tell(profile.in_words(&results, rayon::current_num_threads()).trim_end_matches('\n'));
    }
    Ok(exit)
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

/// Accepts the values of these results.
fn accept(places: &CommittedValues, results: &[CaseResult]) -> Result<Baseline, ProgramError> {
    let mut baseline = Baseline::default();
    for result in results {
        let fresh = Baseline::of(&result.name, &result.metrics);
        fresh.write(&places.accepted_folder(), &result.name, result.tier, provenance::commit())?;
        if *places == CommittedValues::OfCases {
            let mut gates = GateList::read(&places.accepted_folder(), result.tier)?;
            gates.add(&fresh);
            gates.write(&places.accepted_folder(), result.tier)?;
            accepted_comparisons(&places.accepted_folder(), result)?;
        }
        baseline.extend(fresh);
    }
    Ok(baseline)
}

/// Accepts the comparisons of a case with measurements, with the regimes of its flows.
fn accepted_comparisons(folder: &Path, result: &CaseResult) -> Result<(), ProgramError> {
    let path = folder.join("comparisons").join(format!("{}.csv", result.tier));
    let unwritable = |error: &std::io::Error| ProgramError::from(FileError::unwritable(&path, error));
    let text = match std::fs::read_to_string(&path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
        text => text.map_err(|error| unwritable(&error))?,
    };
    let malformed = |error: csv::Error| unwritable(&std::io::Error::other(error));
    let mut set = ValidationSet::parse(&text).map_err(malformed)?;
    let runs: Vec<_> = result.runs.iter().map(|run| run.variant.clone()).zip(result.regimes.iter().copied()).collect();
    set.replace(&result.name, ValidatedComparison::all(&result.name, &result.metrics, &runs));
    let text = set.text().map_err(malformed)?;
    std::fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(|error| unwritable(&error))?;
    write_whole(&path, text.as_bytes()).map_err(|error| unwritable(&error))
}

/// Baseline of the report: values of an earlier report, or the accepted ones. Read before anything is simulated.
fn baseline(
    command: &ReportArguments,
    places: &CommittedValues,
    named: &[(String, Tier)],
) -> Result<Baseline, ProgramError> {
    if let Some(folder) = &command.against {
        let names: Vec<String> = named.iter().map(|(name, _)| name.clone()).collect();
        let tier = named.first().map_or(Tier::Quick, |(_, tier)| *tier);
        return Ok(Baseline::of_report(folder, &names, tier)?);
    }
    let mut baseline = Baseline::default();
    for (name, tier) in named {
        baseline.extend(places.accepted(name, *tier)?);
    }
    Ok(baseline)
}

/// A line for each value that has drifted, the farthest first.
fn drifted(page: &Report) -> String {
    let moved = report::drift::moved(&report::judge(page), &page.baseline);
    moved.iter().filter(|moved| moved.has_drifted).map(|moved| format!("drifted: {moved}\n")).collect()
}

/// Reason for exit code 0 despite values that have drifted; empty if none has.
fn not_denied(drifted: &str) -> String {
    let (values, change) = match drifted.lines().count() {
        0 => return String::new(),
        1 => ("1 value has".to_owned(), "it does"),
        number => (format!("{number} values have"), "they do"),
    };
    format!("{values} drifted, but every gate holds: {change} not change the exit code unless --deny drift is given\n")
}

fn prepare(command: &ReportArguments, registry: Registry) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
    for (place, name) in command.cases.iter().enumerate() {
        if command.cases[..place].iter().any(|other| other.trim() == name.trim()) {
            let remedy = "name each case once: every case has one page";
            return Err(ParameterError::field("--cases", name.trim(), "unique", remedy));
        }
    }
    let wanted = if command.cases.is_empty() {
        registry.iter().collect()
    } else {
        command.cases.iter().map(|name| registry.find(name.trim())).collect::<Result<Vec<_>, _>>()?
    };
    let changes = Changes { limits: command.allowance.limits(), ..Changes::default() };
    let tier = command.tier.unwrap_or(Tier::Quick);
    wanted.into_iter().map(|case| case.prepare(tier, &changes)).collect()
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
    if let Some(folder) = &command.against {
        words += &format!(" --against {}", folder.display());
    }
    words
}
