//! Parameters from data: a plan names cases, parameters with ranges, data with uncertainties, and what is held out.
//!
//! ```text
//! FOLDER/plan.json                what is calibrated, with the hash of the program's sources
//! FOLDER/evaluations/KEY.postcard one file an evaluation
//! FOLDER/index.html, figures/     the page
//! FOLDER/result.json              everything on the page; evaluations.csv, data.csv
//! FOLDER/held-out.json            what was held out beside its prediction, with the digest of the plan
//! FOLDER/calibrated.toml          the first fitted case with the best parameters, for `bagnold run`
//! FOLDER/overlay/                 the measurements that it names
//! FOLDER/law.toml                 a law that was fitted to points, with draws of its posterior
//! ```
//!
//! The search is deterministic, so one that was killed is begun anew and finds its evaluations done.

mod assembly;
mod conditions;
mod cost;
mod data;
mod figures;
mod findings;
mod folder;
mod held_out;
mod law;
mod objective;
mod page;
mod plan;
mod prediction;
mod reading;
mod repeated;
mod repeats;
mod result;
mod target;
mod text;
mod trials;

pub use cost::EvaluationCost;
pub use folder::CalibrationFolder;
pub use objective::CalibrationMonitor;
pub use page::write;
pub use plan::{CalibratedParameter, CalibrationPlan, Choice, DataBlock, Repeats, usual_search};
pub use result::{
    CalibrationResult, ChoiceResult, DatumComparison, ElementaryEffect, Evaluation, ParameterEstimate, weighted_error,
};
pub use target::ProfileLocation;

use crate::ToolError;
use crate::case::Registry;
use crate::inference::posterior::sample;
use crate::inference::sensitivity::{self, Effect};
use crate::inference::{self, Answer, Evaluate, Evaluated, Method, Repeatability, SearchError, chi_squared};
use crate::sampling::design;
use crate::store::Store;
use assembly::compared;
use objective::Objective;
use repeated::Repeated;

/// Searches, or tries every choice, and judges on what was held out. What `folder` holds is not done again.
///
/// # Errors
/// Data without counterpart or with another unit, a search that finds nothing, files that cannot be read or written.
pub fn calibrate(
    plan: &CalibrationPlan,
    folder: &CalibrationFolder,
    registry: Registry,
    store: &Store,
    watch: &dyn CalibrationMonitor,
) -> Result<CalibrationResult, ToolError> {
    let mut objective = Objective::begin(plan, folder, (registry, store), watch)?;
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
    let answer = answer(&mut objective, start)?;
    let truth_inside = truth_inside(&mut objective, &answer)?;
    let effects = match plan.trajectories {
        0 => Vec::new(),
        count => sensitivity::screen(&mut objective, plan.parameters.len(), count, plan.budget.seed)?,
    };
    let named = plan.parameters.iter().map(|parameter| parameter.name.clone()).zip(effects);
    let effect =
        |(name, own): (String, Effect)| ElementaryEffect { name, effect: own.mean_size, spread: own.deviation };
    let sensitivity = named.map(effect).collect();
    let values = plan.values(&answer.search.best);
    let failed = |reason| ToolError::at(&plan.file, reason);
    let mut fit = compare_at(&objective, &values, false)?.map_err(failed)?;
    let mut hold_out = compare_at(&objective, &values, true)?;
    let posterior = answer.explored.as_ref().map(|explored| sample(&explored.region, plan.budget.seed));
    if let (Some(posterior), Some(explored)) = (&posterior, &answer.explored) {
        prediction::of_fit(&objective, explored, posterior, &mut fit);
        if let Ok(hold_out) = &mut hold_out {
            prediction::of_hold_out(&objective, &answer, posterior, hold_out)?;
        }
    }
    let asked =
        posterior.as_ref().filter(|_| plan.method == Method::Posterior || plan.blocks.iter().any(|block| block.is_law));
    let calibrated = assembly::calibrated(&objective, &values)?;
    let mut outcome = assembly::assemble(plan, &answer, sensitivity, (fit, hold_out), calibrated, truth_inside, asked);
    outcome.simulations = std::fs::read_dir(&objective.folder).map_or(0, Iterator::count);
    let failed = outcome.evaluations.iter().filter(|evaluation| evaluation.chi_squared.is_none()).count();
    if let Some(reason) = objective.last_failure().filter(|_| failed > 0) {
        let beyond = "beyond this, lines and regions of agreement are those of the emulator and may end early";
        outcome
            .findings
            .push(format!("{failed} evaluations in the parameter ranges failed, the last with: {reason}; {beyond}"));
    }
    Ok(outcome)
}

/// Data that were held out beside the model at these values of the parameters, without a search.
///
/// # Errors
/// Those of [`calibrate`], and runs that fail.
pub fn predict(
    plan: &CalibrationPlan,
    folder: &CalibrationFolder,
    registry: Registry,
    store: &Store,
    watch: &dyn CalibrationMonitor,
    values: &[f64],
) -> Result<Vec<DatumComparison>, ToolError> {
    let objective = Objective::begin(plan, folder, (registry, store), watch)?;
    compare_at(&objective, values, true)?.map_err(|reason| ToolError::at(&plan.file, reason))
}

/// The search and its region; where evaluations are repeated, once more with the scatter that was seen about the minimum.
fn answer(objective: &mut Objective<'_>, start: Vec<f64>) -> Result<Answer, ToolError> {
    let plan = objective.plan;
    let runs = if plan.repeats.count > 1 { Repeatability::Scattering } else { Repeatability::Smooth };
    let mut steps = inference::SolvePlan {
        start,
        method: plan.method,
        design: if plan.levels.is_empty() { Vec::new() } else { design::full_grid(&plan.levels) },
        budget: plan.budget,
        region_evaluations: plan.region_evaluations,
        runs,
        series: objective.series(),
    };
    let mut first = Vec::new();
    if runs == Repeatability::Scattering {
        objective.variances = objective.first_variances()?;
        let found = inference::solve(objective, &steps).map_err(|error| unsolved(error, objective))?;
        objective.variances = objective.variances_about(&found)?;
        steps.start = found.search.best;
        first = found.search.history.into_iter().map(|evaluated| evaluated.point).collect();
    }
    let mut answer = inference::solve(objective, &steps).map_err(|error| unsolved(error, objective))?;
    // what the first search evaluated counts too, with the variances of the second
    first.retain(|point| answer.search.history.iter().all(|known| known.point != *point));
    let residuals = objective.residuals(&first)?;
    answer.searched += first.len();
    answer.search.history.splice(0..0, first.into_iter().zip(residuals).map(|(point, own)| Evaluated::new(point, own)));
    Ok(answer)
}

/// Error of a search without a result, with the last message of the model.
fn unsolved(error: SearchError<ToolError>, objective: &Objective<'_>) -> ToolError {
    match error {
        SearchError::Model(error) => error,
        other => {
            let cause =
                objective.last_failure().map_or_else(String::new, |reason| format!("; the last failure: {reason}"));
            ToolError::at(&objective.plan.file, format!("{other}{cause}"))
        }
    }
}

/// Whether the joint 95 % region holds the truth of synthetic data, as the model itself says, which made them there; where its
/// runs scatter, as the region is drawn.
fn truth_inside(objective: &mut Objective<'_>, answer: &Answer) -> Result<Option<bool>, ToolError> {
    let plan = objective.plan;
    let truth: Option<Vec<f64>> =
        plan.parameters.iter().map(|p| p.truth.map(|truth| p.bounds.coordinate(truth))).collect();
    let Some((truth, explored)) = truth.zip(answer.explored.as_ref()) else { return Ok(None) };
    if plan.repeats.count > 1 {
        // one more evaluation there would scatter
        return Ok(Some(explored.region.contains(&truth)));
    }
    let residuals = objective.residuals(std::slice::from_ref(&truth))?.pop().flatten();
    let rise = residuals.map(|residuals| chi_squared(&residuals) - answer.search.chi_squared);
    Ok(rise.map(|rise| rise <= explored.region.threshold))
}

/// The fitted or held-out data beside what the model says at physical values, or why a run of theirs failed.
fn compare_at(
    objective: &Objective<'_>,
    values: &[f64],
    held_out: bool,
) -> Result<Result<Vec<DatumComparison>, String>, ToolError> {
    let blocks: Vec<usize> =
        (0..objective.plan.blocks.len()).filter(|&k| objective.plan.blocks[k].held_out == held_out).collect();
    let answers = objective.ask_at(&blocks, &[values.to_vec()])?;
    if let Some(reason) = answers.iter().find_map(Repeated::failure) {
        return Ok(Err(reason.to_owned()));
    }
    let answer = |block: usize| blocks.iter().position(|&k| k == block).map(|place| &answers[place]);
    compared(objective, held_out, answer, Clone::clone).map(Ok)
}

/// JSON Schema of a plan.
pub fn schema() -> &'static serde_json::Value {
    bagnold_solver::parameter::schema_of::<text::CalibrationText>()
}
