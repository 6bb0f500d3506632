//! `bagnold run`: one case into one folder, with its page.

use super::arguments::Run;
use super::error::ProgramError;
use super::progress::Progress;
use super::{Exit, say, summary};
use crate::case::{
    AnyCase, CaseFile, CaseResult, Changes, Estimate, ParameterError, Prepared, Registry, Tier, execute,
};
use crate::metric::Variant;
use crate::output::{FileError, OutputFolder};
use crate::report::{self, Baseline, History, Provenance, Report};
use crate::result::{MetricsDocument, write_case};
use crate::store::Store;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulates, judges, writes and prints one case.
pub(super) fn run(
    command: &Run,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    let (prepared, tier, changed) = prepare(command, registry)?;
    let folder =
        command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/runs/{}-{tier}", prepared.name())));
    if command.out.is_none() {
        OutputFolder::adopt(Path::new("reports"))?;
    }
    let claimed = OutputFolder::claim(&folder)?;
    announce(std::slice::from_ref(&prepared), quiet || command.json);
    let known = super::report::known_failures()?;
    // accepted values are those of the case as it comes
    let baseline = if changed { Baseline::default() } else { super::report::accepted(prepared.name(), tier)? };
    let started = Instant::now();
    let results = simulate(vec![prepared], &command.work.open_store(), quiet)?;

    let threads = rayon::current_num_threads();
    for result in &results {
        let document = MetricsDocument::of(result, threads);
        write_case(claimed.staging(), result, &document).map_err(|error| FileError::unwritable(&folder, &error))?;
        if command.json {
            say(output, &document.text());
        }
    }
    let page = Report {
        title: results.first().map(|result| result.name.clone()).unwrap_or_default(),
        tier,
        generated: Provenance::of_this_program(started.elapsed(), String::new()),
        cases: results.iter().map(super::report::case_report).collect(),
        baseline,
        against: None,
        history: History::default(),
        known_failures: known.clone(),
        papers: &[],
    };
    report::write_alone(&page, claimed.staging())?;
    claimed.publish()?;
    if let Some(path) = &command.junit {
        report::write_junit(&page, path)?;
    }
    if !command.json {
        for result in &results {
            say(output, &summary::of_case(result, |metric| super::report::is_known(&known, result, metric)));
        }
        if results.iter().any(|result| result.unexpected_divergences().next().is_some()) {
            let states =
                "of a run that diverged, NAME.pvd ends with the last good state, NAME-first-bad.pvd is the one after";
            say(output, &format!("{}: {states}\n", folder.join("snapshots").display()));
        }
        say(output, &format!("written to {}\n", folder.join("index.html").display()));
    }
    Ok(Exit::of(&results, |result, metric| super::report::is_known(&known, result, metric)))
}

/// Says on standard error what the runs are expected to need.
pub(super) fn announce(cases: &[Box<dyn Prepared>], quiet: bool) {
    if !quiet {
        let estimate = cases.iter().map(|case| case.estimate()).fold(Estimate::default(), Estimate::and);
        eprintln!("{}", estimate.in_words(rayon::current_num_threads()));
    }
}

/// Simulates with a progress bar.
pub(super) fn simulate(
    cases: Vec<Box<dyn Prepared>>,
    store: &Store,
    quiet: bool,
) -> Result<Vec<CaseResult>, ParameterError> {
    let progress = Progress::new(&cases, quiet);
    let results = execute(cases, store, &progress);
    progress.clear();
    results
}

/// The case that the target means, with the changes asked for, its tier, and whether anything may have been changed.
fn prepare(command: &Run, registry: Registry) -> Result<(Box<dyn Prepared>, Tier, bool), ProgramError> {
    let (case, tier, file): (&'static dyn AnyCase, _, _) = if names_a_file(&command.target, registry) {
        let file = CaseFile::read(Path::new(&command.target))?;
        let case = registry.find(&file.case).map_err(|error| error.in_file(&file.path))?;
        (case, command.tier.or(file.tier), Some(file))
    } else {
        (registry.find(&command.target)?, command.tier, None)
    };
    let tier = tier.unwrap_or(Tier::Quick);
    let changes = Changes {
        file: file.as_ref().map(|file| (file.path.as_path(), file.fields.clone())),
        settings: &command.settings,
        limits: command.allowance.limits(),
    };
    let changed = file.is_some() || !command.settings.is_empty() || !command.only.is_empty();
    Ok((only(case.prepare(tier, &changes)?, &command.only)?, tier, changed))
}

/// The runs that have all keys of any of the variants asked for; all where none is asked for.
fn only(prepared: Box<dyn Prepared>, asked: &[Variant]) -> Result<Box<dyn Prepared>, ParameterError> {
    if asked.is_empty() {
        return Ok(prepared);
    }
    let variants: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
    let has = |asked: &Variant| variants.iter().any(|variant| variant.includes(asked));
    if let Some(missing) = asked.iter().find(|asked| !has(asked)) {
        let listed: Vec<String> = variants.iter().take(5).map(|variant| format!("\"{variant}\"")).collect();
        let rule = format!("keys of a run of this case and tier, such as {}", listed.join(", "));
        return Err(ParameterError::field(
            "--only",
            format!("\"{missing}\""),
            &rule,
            "leave out keys to mean several runs",
        ));
    }
    let runs: Vec<usize> =
        (0..variants.len()).filter(|&run| asked.iter().any(|asked| variants[run].includes(asked))).collect();
    Ok(prepared.choose(&runs))
}

/// A case goes before a file of the same name; what looks like a path is meant as one.
fn names_a_file(target: &str, registry: Registry) -> bool {
    let path = Path::new(target);
    registry.find(target).is_err()
        && (path.components().count() > 1 || path.extension().is_some_and(|ending| ending == "toml") || path.is_file())
}
