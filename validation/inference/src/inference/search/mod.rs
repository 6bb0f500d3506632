//! The search for the point of least χ², by one of several methods, within a budget of evaluations.

mod barrier;
mod design;
pub(crate) mod differences;
mod evaluated;
pub(crate) mod recorder;
mod starts;
mod trust_region;

pub use design::search_design;
pub use evaluated::{Evaluated, lowest};
pub(super) use recorder::{Halt, Recorder};

use super::descent::LocalMinimum;
use super::{Evaluate, largest_distance};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Search method for the minimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Gauss–Newton steps in a trust region: the fewest evaluations where the model is smooth.
    TrustRegion,
    /// Points spread over the whole cube, and the minimum of a polynomial through them.
    Design,
    /// The trust region, and then samples of the posterior.
    Posterior,
}

impl Method {
    /// Name in files and on pages.
    pub fn name(self) -> &'static str {
        match self {
            Self::TrustRegion => "trust-region",
            Self::Design => "design",
            Self::Posterior => "posterior",
        }
    }
}

/// Budget and stopping criterion of a search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Most distinct points at which the model is evaluated.
    pub evaluations: usize,
    /// Seed of everything random.
    pub seed: u64,
    /// Step of finite differences in the unit cube `[-]`, above 0 and at most 0.5.
    pub difference: f64,
    /// Change of χ² that is not worth another evaluation, in units of the reduced χ² or 1, whichever is more `[-]`.
    pub tolerance: f64,
    /// Points spread over the cube from which other minima are looked for, with as many evaluations again.
    pub starts: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Self { evaluations: 40, seed: 1, difference: 0.02, tolerance: 0.01, starts: 0 }
    }
}

impl Budget {
    /// The change of χ² `[-]` that is not worth an evaluation, where χ² of `data` data has this value.
    pub(super) fn negligible(&self, chi_squared: f64, data: usize) -> f64 {
        self.tolerance * (chi_squared / data.max(1) as f64).max(1.0)
    }
}

/// Termination of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Termination {
    /// No step would change χ² by more than the tolerance.
    Converged,
    /// The next evaluation would have exceeded the budget.
    BudgetSpent,
    /// Steps became too short to tell from noise, but χ² should still fall.
    Stalled,
    /// Runs are too rough for shorter steps, but nothing in the region promises a χ² lower by what its ends would notice.
    AtRest,
    /// No parameter changes the residuals at the best point, although they are far larger than the errors.
    Plateau,
    /// The points of the design are evaluated.
    DesignDone,
}

impl fmt::Display for Termination {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Converged => "converged: no step would change χ² by more than the tolerance",
            Self::BudgetSpent => "budget spent: the best point so far may not be the minimum; allow more evaluations",
            Self::Stalled => {
                "stalled: χ² does not decrease although its gradient is not zero; if the model is noisy, average over seeds \
                 with `repeats = 3`"
            }
            Self::AtRest => {
                "at rest: runs scatter too much for shorter steps, and no notably lower χ² is expected nearby"
            }
            Self::Plateau => {
                "on a plateau: no parameter changes the model at the best point, although its χ² is far too high; move the start or \
                 the ranges to where the model responds"
            }
            Self::DesignDone => "done: all points of the design and the minimum of their polynomial are evaluated",
        })
    }
}

/// Result of a search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SearchResult {
    /// The evaluated point of least χ², in the unit cube.
    pub best: Vec<f64>,
    /// χ² there `[-]`.
    pub chi_squared: f64,
    /// Every distinct point once, in the order of first evaluation.
    pub history: Vec<Evaluated>,
    /// Reason for the end of the search.
    pub stopped: Termination,
    /// Minima in which descents have ended, the lowest first.
    pub minima: Vec<LocalMinimum>,
    /// Whether every one of the other starts was followed up.
    pub every_start: bool,
}

/// Distance along every axis of the unit cube up to which a run covers it, and points at which that is tested.
const COVERED: f64 = 0.25;
const COVERAGE_POINTS: usize = 1024;

impl SearchResult {
    /// Share of the unit cube that lies near a point at which the model worked `[-]`: minima elsewhere may be unknown.
    pub fn covered(&self) -> f64 {
        let near = |place: &&Vec<f64>| {
            let worked = self.history.iter().filter(|evaluated| evaluated.chi_squared.is_some());
            worked.map(|evaluated| &evaluated.point).any(|point| largest_distance(point, place) <= COVERED)
        };
        let places = crate::sampling::design::sobol(COVERAGE_POINTS, self.best.len(), 1);
        places.iter().filter(near).count() as f64 / COVERAGE_POINTS as f64
    }
}

/// Error of a search that has found nothing. Completes "failed to search: …".
#[derive(Debug, thiserror::Error)]
pub enum SearchError<E> {
    /// The model cannot be evaluated at all.
    #[error("{0}")]
    Model(E),
    /// No run of the model succeeded.
    #[error("the model failed at all {0} points that were tried; move the start or narrow the ranges")]
    NothingWorked(usize),
    /// The search cannot begin.
    #[error("`{field}` is {value}, but must be {rule}")]
    Setting {
        /// The field at fault.
        field: &'static str,
        /// Value as written.
        value: String,
        /// The rule it breaks, completing "must be …".
        rule: &'static str,
    },
    /// The model does not always compare with the same data.
    #[error("the model returned {found} residuals, but {expected} before; every point must give one for each datum")]
    Residuals {
        /// Residuals of the first success.
        expected: usize,
        /// Residuals of a later one.
        found: usize,
    },
}

/// Searches the unit cube for the least χ² from `start`; a design does not need the start, but takes its dimension. From
/// the budget's other starts it descends by the trust region, whatever the method.
///
/// # Errors
/// A setting out of range, an error of the model itself, or no point at which the model worked.
pub fn search<M: Evaluate>(
    model: &mut M,
    start: &[f64],
    method: Method,
    budget: Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    continue_search(model, Vec::new(), start, method, budget)
}

/// Search with points that were evaluated before and do not count in the budget.
///
/// # Errors
/// The same.
pub fn continue_search<M: Evaluate>(
    model: &mut M,
    history: Vec<Evaluated>,
    start: &[f64],
    method: Method,
    budget: Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    check(start, &budget)?;
    let known = history.len();
    let mut recorder = Recorder::with(model, history, known + budget.evaluations);
    let mut first = None;
    let mut outcome = match method {
        Method::TrustRegion | Method::Posterior => {
            trust_region::run(&mut recorder, start, &budget, &[]).map(|descent| {
                first = Some(descent.minimum);
                descent.stopped.unwrap_or(Termination::Converged)
            })
        }
        Method::Design => {
            let points = crate::sampling::design::sobol((budget.evaluations - 1).max(1), start.len(), budget.seed);
            design::run(&mut recorder, &points, &budget)
        }
    };
    let mut minima: Vec<LocalMinimum> = first.or_else(|| lowest(recorder.history())).into_iter().collect();
    let mut every_start = true;
    if budget.starts > 0 && !minima.is_empty() && !matches!(outcome, Err(Halt::Model(_) | Halt::Residuals(..))) {
        recorder.allow(budget.evaluations);
        match starts::follow(&mut recorder, &mut minima, &budget) {
            Ok(every) => every_start = every,
            Err(halt) => return recorder.finish(Err(halt), minima, false),
        }
        // what the other starts have left over is for a first descent that was cut short
        if every_start && matches!(outcome, Err(Halt::BudgetSpent)) {
            outcome = descend_on(&mut recorder, &mut minima, &budget);
        }
    }
    recorder.finish(outcome, minima, every_start)
}

/// Places from which minima beside the known ones are looked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Leads {
    /// Lowest evaluated points of branches without a known minimum: the model descends from each.
    pub(super) branches: Vec<Vec<f64>>,
    /// Whether the descent ends at a minimum that is already known.
    pub(super) ends_at_known: bool,
    /// Points where nothing is known, to be evaluated first.
    pub(super) scouts: Vec<Vec<f64>>,
    /// Points from which the emulator descends.
    pub(super) places: Vec<Vec<f64>>,
    /// Largest χ² that the emulator may promise.
    pub(super) worst: f64,
}

/// Descends to minima beside known ones, from branches and where the emulator of all evaluations promises one; evaluates at most
/// the budget's number of further points.
///
/// # Errors
/// An error of the model itself.
pub(super) fn search_beside<M: Evaluate>(
    model: &mut M,
    before: SearchResult,
    leads: Leads,
    budget: &Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    let most = before.history.len() + budget.evaluations;
    let mut recorder = Recorder::with(model, before.history, most);
    let mut minima = before.minima;
    let Leads { branches, ends_at_known, scouts, mut places, worst } = leads;
    let outcome = (|| {
        for branch in &branches {
            let known: &[LocalMinimum] = if ends_at_known { &minima } else { &[] };
            let descent = trust_region::run(&mut recorder, branch, budget, known)?;
            if descent.stopped.is_some() && !minima.iter().any(|known| known.is_at(&descent.minimum.point)) {
                minima.push(descent.minimum);
            }
        }
        recorder.residuals(&scouts)?;
        places.extend(scouts);
        starts::descend_from(&mut recorder, &mut minima, budget, &places, &[], worst)
    })();
    recorder.finish(outcome.map(|_| before.stopped), minima, before.every_start)
}

/// Descends on from the best point, whose minimum takes the place of those near it.
fn descend_on<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    minima: &mut Vec<LocalMinimum>,
    budget: &Budget,
) -> Result<Termination, Halt<M::Error>> {
    let start = lowest(recorder.history()).ok_or(Halt::NothingWorked)?.point;
    let descent = trust_region::run(recorder, &start, budget, &[])?;
    minima.retain(|minimum| !minimum.is_at(&descent.minimum.point) && !minimum.is_at(&start));
    minima.push(descent.minimum);
    Ok(descent.stopped.unwrap_or(Termination::Converged))
}

/// Refuses settings with which no search can work.
fn check<E>(start: &[f64], budget: &Budget) -> Result<(), SearchError<E>> {
    let refuse = |field, value: String, rule| Err(SearchError::Setting { field, value, rule });
    if start.is_empty() || start.iter().any(|u| !(0.0..=1.0).contains(u)) {
        return refuse("start", format!("{start:?}"), "a point of the unit cube, with at least one coordinate");
    }
    if budget.evaluations == 0 {
        return refuse("evaluations", "0".into(), "at least 1");
    }
    if !(budget.difference > 0.0 && budget.difference <= 0.5) {
        return refuse("difference", budget.difference.to_string(), "above 0 and at most 0.5");
    }
    if !(budget.tolerance > 0.0 && budget.tolerance.is_finite()) {
        return refuse("tolerance", budget.tolerance.to_string(), "a number above 0");
    }
    Ok(())
}
