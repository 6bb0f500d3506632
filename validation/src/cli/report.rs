//! `bagnold report`: many cases on one page.

use super::arguments::Report;
use super::run::simulate;
use super::{Exit, say, summary};
use crate::case::{CaseResult, Changes, Prepared, Registry};
use crate::error::InputError;
use crate::metric::Metric;
use crate::metric::json::MetricsDocument;
use crate::output::{OutputFolder, write_figures};
use std::io::{self, Write};
use std::path::Path;

/// Simulates and judges the cases, writes the page and prints what fails.
pub(super) fn report(
    command: &Report,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, InputError> {
    let cases = prepare(command, registry)?;
    let claimed = OutputFolder::claim(&command.out)?;
    let known = known_failures()?;
    let results = simulate(cases, &command.work.open_store(), quiet)?;
    write(claimed.staging(), &results).map_err(|error| InputError::unwritable(&command.out, &error))?;
    claimed.publish()?;

    for result in &results {
        say(output, &summary::heading(result));
        say(output, &summary::failures(result, |metric| known.lists(result, metric)));
    }
    say(output, &format!("written to {}\n", command.out.join("index.html").display()));
    Ok(Exit::of(&results, |result, metric| known.lists(result, metric)))
}

fn prepare(command: &Report, registry: Registry) -> Result<Vec<Box<dyn Prepared>>, InputError> {
    let wanted = if command.cases.is_empty() {
        registry.iter().collect()
    } else {
        command.cases.iter().map(|name| registry.find(name.trim())).collect::<Result<Vec<_>, _>>()?
    };
    wanted.into_iter().map(|case| case.prepare(command.tier, &Changes::default())).collect()
}

/// The report's files: `metrics/CASE.json` and `figures/CASE/`.
fn write(folder: &Path, results: &[CaseResult]) -> io::Result<()> {
    let metrics = folder.join("metrics");
    std::fs::create_dir_all(&metrics)?;
    let threads = rayon::current_num_threads();
    for result in results {
        let document = MetricsDocument::of(result, threads);
        std::fs::write(metrics.join(format!("{}.json", result.name)), document.text())?;
        write_figures(&folder.join("figures").join(&result.name), result)?;
    }
    Ok(())
}

/// The gates that are known to fail.
pub(super) fn known_failures() -> Result<KnownFailures, InputError> {
    Ok(KnownFailures)
}

/// Gates that do not hold in spite of honest attempts, from `reports/baseline/known_failures.toml`.
pub(super) struct KnownFailures;

impl KnownFailures {
    pub(super) fn lists(&self, _result: &CaseResult, _metric: &Metric) -> bool {
        false
    }
}
