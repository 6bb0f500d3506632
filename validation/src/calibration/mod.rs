//! Parameters from data: a plan names cases, parameters with ranges, data with uncertainties, and what is held out.
//!
//! ```text
//! FOLDER/plan.json                what is calibrated, with the hash of the program's sources
//! FOLDER/evaluations/KEY.postcard one file an evaluation
//! FOLDER/index.html, figures/     the page
//! FOLDER/result.json              everything on the page; evaluations.csv, data.csv
//! FOLDER/calibrated.toml          the first fitted case with the best parameters, for `bagnold run`
//! ```
//!
//! The search is deterministic, so one that was killed is begun anew and finds its evaluations done.

mod data;
mod error;
mod figures;
mod folder;
mod objective;
mod page;
mod plan;
mod result;
mod screening;
mod target;
mod text;
mod trials;

pub use error::CalibrationError;
pub use folder::CalibrationFolder;
pub use objective::Watch;
pub use page::write;
pub use plan::{Block, Choice, Parameter, Plan};
pub use result::{Compared, Evaluation, Found, Outcome, Place, Sensitivity, weighted_error};
pub use trials::Trial;

use crate::case::Registry;
use crate::evaluation::Record;
use crate::inference::{self, Budget, Explored, Method, Search, SearchError, Uncertainties, explore};
use crate::sampling::design;
use crate::store::Store;
use objective::Objective;
use result::compared;
use std::sync::Mutex;

/// Share of repeated experiments below which a χ² is taken as a sign that the model misses something.
const UNLIKELY: f64 = 0.05;

/// Searches, or tries every choice, and judges on what was held out. What `folder` holds is not done again.
///
/// # Errors
/// Data without counterpart or with another unit, a search that finds nothing, files that cannot be read or written.
pub fn calibrate(
    plan: &Plan,
    folder: &CalibrationFolder,
    registry: Registry,
    store: &Store,
    watch: &dyn Watch,
) -> Result<Outcome, CalibrationError> {
    let mut objective = Objective {
        plan,
        registry,
        store,
        folder: folder.evaluations(),
        watch,
        data: Vec::new(),
        failure: Mutex::default(),
    };
    objective.read_data()?;
    if !plan.choices.is_empty() {
        return trials::try_all(&objective);
    }
    let start = plan.start();
    // units and names are checked before the search begins, where nothing fails
    let first = if plan.levels.is_empty() { start.clone() } else { vec![0.0; plan.levels.len()] };
    for held_out in [false, true] {
        if let Err(reason) = compare_at(&objective, &plan.values(&first), held_out)? {
            tracing::warn!("at the first point: {reason}");
        }
    }
    let found = search(plan, &mut objective, &start);
    let found = found.map_err(|error| match error {
        SearchError::Model(error) => error,
        other => {
            let cause =
                objective.last_failure().map_or_else(String::new, |reason| format!("; the last said: {reason}"));
            CalibrationError::Search { file: plan.file.clone(), reason: format!("{other}{cause}") }
        }
    })?;
    let searched = found.history.len();
    let mapped = region_of(plan, &mut objective, &found)?;
    let history = mapped.as_ref().map_or_else(|| found.history.clone(), |mapped| mapped.history.clone());
    let best = history
        .iter()
        .filter_map(|evaluated| evaluated.chi_squared.map(|chi_squared| (chi_squared, &evaluated.point)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or_else(|| found.best.clone(), |(_, point)| point.clone());
    let sensitivity = screening::screen(&mut objective, plan.trajectories)?;
    let values = plan.values(&best);
    let failed = |reason: String| CalibrationError::Search { file: plan.file.clone(), reason };
    let fit = compare_at(&objective, &values, false)?.map_err(failed)?;
    let hold_out = compare_at(&objective, &values, true)?;
    let calibrated = result::calibrated(&objective, &values)?;
    let search = Search { best, history, ..found };
    Ok(result::assemble(plan, &search, searched, mapped.as_ref(), sensitivity, (fit, hold_out), calibrated))
}

fn search(plan: &Plan, objective: &mut Objective<'_>, start: &[f64]) -> Result<Search, SearchError<CalibrationError>> {
    if plan.method == Method::Design && !plan.levels.is_empty() {
        let points = design::full_grid(&plan.levels);
        let budget = Budget { evaluations: points.len() + 1, ..plan.budget };
        return inference::search_design(objective, &points, budget);
    }
    inference::search(objective, start, plan.method, plan.budget)
}

/// The region of what was evaluated and of further points, where it is wider; none with too few points. Uncertainties are
/// enlarged where the model does not explain the data.
fn region_of(plan: &Plan, objective: &mut Objective<'_>, found: &Search) -> Result<Option<Explored>, CalibrationError> {
    let budget = Budget { evaluations: plan.region_evaluations, ..plan.budget };
    let stated = explore(objective, found.history.clone(), Uncertainties::AsStated, &budget)?;
    match stated {
        Some(stated) if stated.region.p_value.is_some_and(|p| p < UNLIKELY) => {
            let left = plan.region_evaluations.saturating_sub(stated.history.len() - found.history.len());
            let budget = Budget { evaluations: left, ..budget };
            explore(objective, stated.history, Uncertainties::Inflated, &budget)
        }
        other => Ok(other),
    }
}

/// The fitted or held-out data beside what the model says at physical values, or why a run of theirs failed.
fn compare_at(
    objective: &Objective<'_>,
    values: &[f64],
    held_out: bool,
) -> Result<Result<Vec<Compared>, String>, CalibrationError> {
    let blocks: Vec<usize> =
        (0..objective.plan.blocks.len()).filter(|&k| objective.plan.blocks[k].held_out == held_out).collect();
    let questions: Vec<_> = blocks.iter().map(|&block| objective.question(block, values)).collect();
    let records: Vec<Record> = objective.ask(&questions)?;
    if let Some(reason) = records.iter().find_map(|record| record.failure.clone()) {
        return Ok(Err(reason));
    }
    let record = |block: usize| blocks.iter().position(|&k| k == block).map(|place| &records[place]);
    compared(objective, held_out, record, Clone::clone).map(Ok)
}
