//! Simulating under the eyes of a user: what it is expected to take, and how far it has come.

use super::error::ProgramError;
use super::expectation::Expectation;
use super::progress::RunsBar;
use super::tell;
use crate::case::{CaseResult, Estimate, ParameterError, PreparedCase, execute};
use crate::output::{caution, cautions};
use crate::result::States;
use crate::store::{Store, provenance};

/// Largest validated Mach number of a scene `[-]`.
const LARGEST_MACH_NUMBER: f64 = 0.2;
/// Lines on scenes before they run, beyond which only their number is told.
const MOST_BRIEFS: usize = 4;

/// Summarises runs on standard error and rejects an input that was warned of, if the user asks for that.
pub(super) fn introduce(cases: &[Box<dyn PreparedCase>], quiet: bool, is_denied: bool) -> Result<(), ProgramError> {
    let briefs: Vec<String> = cases.iter().flat_map(|case| case.briefs()).collect();
    if !quiet {
        briefs.iter().take(MOST_BRIEFS).for_each(|brief| tell(brief));
        if briefs.len() > MOST_BRIEFS {
            tell(&format!("and {} more scenes", briefs.len() - MOST_BRIEFS));
        }
    }
    reject_warnings(is_denied)
}

/// Particles, memory and hours of each run and of all runs, in lines.
pub(super) fn estimate(cases: &[Box<dyn PreparedCase>], store: &Store) -> String {
    let threads = rayon::current_num_threads();
    let lines = cases.iter().flat_map(|case| {
        let line = |run| format!("{} {}: {}\n", case.name(), case.variant(run), case.estimate(run).in_words(1));
        (0..case.run_count()).map(line).collect::<Vec<_>>()
    });
    let all = cases.iter().map(|case| case.estimate_of_all()).fold(Estimate::default(), Estimate::and);
    let time = Expectation::of("run", cases).in_words(store.root(), threads);
    format!("{}all: {}\n{time}\n", lines.collect::<String>(), all.in_words(threads))
}

/// Prints the expected cost of the runs of a command on standard error.
pub(super) fn announce(
    command: &'static str,
    cases: &[Box<dyn PreparedCase>],
    store: &Store,
    quiet: bool,
) -> Expectation {
    if let Some(warning) = provenance::unoptimised() {
        tracing::warn!("{warning}");
    }
    let expectation = Expectation::of(command, cases);
    if !quiet {
        tell(&expectation.in_words(store.root(), rayon::current_num_threads()));
    }
    expectation
}

/// Warns of scenes that became faster than the weakly compressible model is validated for, and rejects an input that was warned of, if
/// the user asks for that.
pub(super) fn reject_fast(results: &[CaseResult], is_denied: bool) -> Result<(), ProgramError> {
    warn_of_fast(results);
    reject_warnings(is_denied)
}

/// Warns of scenes that became faster than the weakly compressible model is validated for.
pub fn warn_of_fast(results: &[CaseResult]) {
    let metrics = results.iter().flat_map(|result| &result.metrics);
    for metric in metrics.filter(|metric| metric.name == "mach_number" && metric.value > LARGEST_MACH_NUMBER) {
        let (mach, variant) = (metric.value, &metric.variant);
        caution(&format!(
            "{variant}: the Mach number reaches {mach:.2}, above {LARGEST_MACH_NUMBER}: impacts and forces are not validated; \
             multiply `stiffness` by {:.1}",
            (mach / LARGEST_MACH_NUMBER).powi(2)
        ));
    }
}

/// Rejects an input that was warned of, if the user asks for that.
fn reject_warnings(is_denied: bool) -> Result<(), ProgramError> {
    let count = cautions().len();
    if is_denied && count > 0 { Err(ProgramError::Cautions(count)) } else { Ok(()) }
}

/// Prints the expected cost of the runs of a command, and simulates them with a progress bar.
///
/// # Errors
/// A scene that turns out impossible, or an interruption.
pub fn simulate_announced(
    command: &'static str,
    cases: Vec<Box<dyn PreparedCase>>,
    store: &Store,
    quiet: bool,
) -> Result<Vec<CaseResult>, ParameterError> {
    let expectation = announce(command, &cases, store, quiet);
    simulate(cases, store, quiet, None, Some(&expectation))
}

/// Simulates with a progress bar, and shows states on the way where they are wanted.
pub(super) fn simulate(
    cases: Vec<Box<dyn PreparedCase>>,
    store: &Store,
    quiet: bool,
    states: Option<&States>,
    expectation: Option<&Expectation>,
) -> Result<Vec<CaseResult>, ParameterError> {
    let bar = RunsBar::new(&cases, quiet, states, expectation);
    execute(cases, store, &bar)
}
