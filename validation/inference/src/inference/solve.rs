//! A search, the region about its best point, and the search again from any lower point that turns up on the way.

use super::descent::LocalMinimum;
use super::ends::TOLERANCE;
use super::explore::{Explored, FAR, explore};
use super::region::{Uncertainties, chi_squared_tail};
use super::scatter::{Repeatability, averaged};
use super::search::{
    Budget, Leads, Method, SearchError, SearchResult, Termination, continue_search, search, search_beside,
    search_design,
};
use super::serial_correlation::{SerialCorrelation, serial_correlation};
use super::{Evaluate, Evaluated, largest_distance};
use crate::sampling::design::sobol;
use std::cmp::Ordering;

/// Share of repeated experiments below which a χ² is a sign that the model or the stated uncertainties are wrong, and above
/// which it is too good to be true.
pub const UNLIKELY: f64 = 0.01;

/// Searches that are begun anew from a lower point.
const MOST_RESTARTS: usize = 3;

/// Rise of χ², in thresholds of the region, up to which the emulator's promise of another minimum is followed.
const WORST: f64 = 4.0;

/// Change of the residuals, as a share of all of them, that counts as none.
const FLAT: f64 = 1e-4;

/// Points for each parameter at which a search that begins on a plateau looks for its edge.
const PLATEAU_STARTS: usize = 16;

/// Share of repeated experiments below which a search looks elsewhere, and its points for each parameter.
const DOUBTFUL: f64 = 0.02;
const SCOUTS: usize = 6;

/// Plan of a search and its exploration, with their budgets.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvePlan {
    /// Start in the unit cube.
    pub start: Vec<f64>,
    /// Search method for the minimum.
    pub method: Method,
    /// Points of a design that is given; empty for a search.
    pub design: Vec<Vec<f64>>,
    /// Budget of each search.
    pub budget: Budget,
    /// Evaluations for each exploration of the region.
    pub region_evaluations: usize,
    /// Whether runs scatter.
    pub runs: Repeatability,
    /// Residuals of each profile or series, by their places in the order of its abscissas: errors may correlate along it.
    pub series: Vec<Vec<usize>>,
}

/// The minimum and its region.
#[derive(Debug, Clone)]
pub struct Answer {
    /// The search, with every point that was evaluated.
    pub search: SearchResult,
    /// Evaluations of the first search.
    pub searched: usize,
    /// The region; none with too few points.
    pub explored: Option<Explored>,
    /// Searches that were begun anew because a lower point had turned up.
    pub restarts: usize,
    /// Correlation of neighbouring errors, which the region includes; none where the residuals show none.
    pub correlation: Option<SerialCorrelation>,
}

/// Searches and explores until nothing lower turns up.
///
/// # Errors
/// Errors of [`search`](super::search()).
pub fn solve<M: Evaluate>(model: &mut M, plan: &SolvePlan) -> Result<Answer, SearchError<M::Error>> {
    let usual = match plan.runs {
        Repeatability::Smooth => plan.budget,
        // a fall of χ² by less than one says nothing there
        Repeatability::Scattering => Budget { tolerance: plan.budget.tolerance.max(1.0), ..plan.budget },
    };
    let mut found = if plan.design.is_empty() {
        search(model, &plan.start, plan.method, usual)?
    } else {
        let budget = Budget { evaluations: plan.design.len() + 1, ..usual };
        search_design(model, &plan.design, budget)?
    };
    if is_on_plateau(&found, usual.difference) {
        found = leave_plateau(model, found, &usual)?;
    } else if found.stopped == Termination::Converged && !found.minima.iter().any(|known| known.is_at(&found.best)) {
        // a start that is lower than where the descents ended
        let branches = vec![found.best.clone()];
        found = search_beside(model, found, Leads { branches, ..Leads::default() }, &usual)?;
    }
    let searched = found.history.len();
    let (mut restarts, mut continuations, mut views, mut glances, mut correlation) = (0, 0, 0, 0, None);
    let is_left = |count: &mut usize, most: usize| {
        *count += 1;
        *count <= most
    };
    loop {
        let budget = Budget { evaluations: plan.region_evaluations, ..usual };
        let factor = correlation.map_or(1.0, |own: SerialCorrelation| own.factor);
        let uncertainties = Uncertainties { factor, is_inflated: is_unexplained(&found, UNLIKELY) };
        let explored = explore(model, found.history.clone(), uncertainties, &budget).map_err(SearchError::Model)?;
        let Some(mut explored) = explored else {
            return Ok(Answer { search: found, searched, explored: None, restarts, correlation });
        };
        let lowest = explored.region.minimum.clone();
        // what the region has left over is for a search that was cut short: the region's points may have brought it home
        let left = (found.history.len() + plan.region_evaluations).saturating_sub(explored.history.len());
        found.history.clone_from(&explored.history);
        if explored.lower && restarts < MOST_RESTARTS {
            restarts += 1;
            found = again(model, found, &lowest, usual)?;
            continue;
        }
        if found.stopped == Termination::BudgetSpent && left > 0 && is_left(&mut continuations, 1) {
            found = again(model, found, &lowest, Budget { evaluations: left, ..usual })?;
            continue;
        }
        // what the region has taught may promise minima that the search has not seen
        if left > 0 && is_left(&mut views, MOST_RESTARTS) {
            let known = found.minima.len();
            let leads = Leads {
                branches: explored.branches_without(&found.minima),
                scouts: explored.scouts(),
                places: explored.emulator.below(lowest.chi_squared + FAR * explored.region.threshold),
                worst: lowest.chi_squared + WORST * explored.region.threshold,
                ..Leads::default()
            };
            found = search_beside(model, found, leads, &Budget { evaluations: left, ..usual })?;
            if found.minima.len() > known || found.chi_squared < lowest.chi_squared {
                // another minimum has a region of its own
                continue;
            }
        }
        // before the model is called wrong, the rest of the box is looked at
        if found.stopped == Termination::Converged && is_unexplained(&found, DOUBTFUL) && is_left(&mut glances, 1) {
            found = look_elsewhere(model, found, &usual)?;
            if found.chi_squared < lowest.chi_squared {
                continue;
            }
        }
        if correlation.is_none() {
            correlation = correlated(&plan.series, &found.history, &explored);
            if correlation.is_some() {
                // the wider region is explored with what is known of the narrower one
                continue;
            }
        }
        explored.history.clone_from(&found.history);
        let search = SearchResult { best: lowest.point, chi_squared: lowest.chi_squared, ..found };
        let (search, explored) = match plan.runs {
            Repeatability::Smooth => (search, explored),
            Repeatability::Scattering => {
                averaged(model, search, explored, uncertainties, &budget).map_err(SearchError::Model)?
            }
        };
        let stopped = if is_on_plateau(&search, usual.difference) {
            Termination::Plateau
        } else {
            judged(search.stopped, &explored)
        };
        let search = SearchResult { stopped, ..search };
        return Ok(Answer { search, searched, explored: Some(explored), restarts, correlation });
    }
}

/// Whether a share of repeated experiments below `share` would leave so large a χ² at the best point.
fn is_unexplained(found: &SearchResult, share: f64) -> bool {
    let best = found.history.iter().find_map(|evaluated| evaluated.residuals.as_ref());
    let freedom = best.map_or(0, Vec::len).saturating_sub(found.best.len()).max(1);
    chi_squared_tail(found.chi_squared, freedom) < share
}

/// Descends from points of a wide design, one after the other the farthest from all known minima and from those before; the worse half
/// of the design is left out.
fn look_elsewhere<M: Evaluate>(
    model: &mut M,
    found: SearchResult,
    budget: &Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    let dimensions = found.best.len();
    let scouts = sobol(SCOUTS * dimensions, dimensions, budget.seed);
    let mut found = search_beside(model, found, Leads { scouts: scouts.clone(), ..Leads::default() }, budget)?;
    let is_scout = |other: &&Evaluated| other.chi_squared.is_some() && scouts.contains(&other.point);
    let mut others: Vec<Evaluated> = found.history.iter().filter(is_scout).cloned().collect();
    others.sort_by(|a, b| a.chi_squared.partial_cmp(&b.chi_squared).unwrap_or(Ordering::Equal));
    others.truncate(others.len().div_ceil(2));
    let mut tried: Vec<Vec<f64>> = found.minima.iter().map(|minimum| minimum.point.clone()).collect();
    for _ in 0..MOST_RESTARTS {
        let alone =
            |other: &Evaluated| tried.iter().map(|known| largest_distance(&other.point, known)).fold(1.0, f64::min);
        let Some(next) = others.iter().max_by(|a, b| alone(a).total_cmp(&alone(b))) else { break };
        if !is_unexplained(&found, DOUBTFUL) {
            break;
        }
        let branches = vec![next.point.clone()];
        tried.extend(branches.clone());
        found = search_beside(model, found, Leads { branches, ends_at_known: true, ..Leads::default() }, budget)?;
    }
    Ok(found)
}

/// Whether the best point explains the data badly while no parameter changes the residuals: points equal it, all near ones too.
fn is_on_plateau(found: &SearchResult, difference: f64) -> bool {
    let Some(best) = found.history.iter().find(|evaluated| evaluated.point == found.best) else { return false };
    let Some(residuals) = &best.residuals else { return false };
    let is_near = |other: &Evaluated| largest_distance(&other.point, &best.point) <= 1.01 * difference;
    let is_equal = |other: &Evaluated| {
        let change = |of: &Vec<f64>| of.iter().zip(residuals).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        other.residuals.as_ref().is_some_and(|of| change(of) <= FLAT * FLAT * found.chi_squared)
    };
    is_unexplained(found, UNLIKELY)
        && found.history.iter().filter(|other| is_equal(other)).count() > best.point.len()
        && found.history.iter().all(|other| !is_near(other) || is_equal(other))
}

/// Descends from the lowest points of a wide design at which χ² differs from that of the plateau.
fn leave_plateau<M: Evaluate>(
    model: &mut M,
    found: SearchResult,
    budget: &Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    let (level, dimensions) = (found.chi_squared, found.best.len());
    let scouts = sobol(PLATEAU_STARTS * dimensions, dimensions, budget.seed);
    let mut found = search_beside(model, found, Leads { scouts, ..Leads::default() }, budget)?;
    found.minima.clear();
    let other = |at: &Evaluated| Some((at.chi_squared?, at.point.clone()));
    let mut others: Vec<(f64, Vec<f64>)> = found.history.iter().filter_map(other).collect();
    others.retain(|(chi_squared, _)| (chi_squared / level - 1.0).abs() > FLAT);
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    let branches = others.into_iter().take(MOST_RESTARTS).map(|(_, point)| point).collect();
    search_beside(model, found, Leads { branches, ..Leads::default() }, budget)
}

/// A search that stalled on the roughness of runs has come to rest all the same, where the region is settled and nothing in it
/// promises what its ends would notice.
fn judged(stopped: Termination, explored: &Explored) -> Termination {
    let promised = explored.region.minimum.chi_squared - explored.emulator.minimum().chi_squared;
    match stopped {
        Termination::Stalled if explored.is_settled() && promised <= TOLERANCE * explored.region.limit => {
            Termination::AtRest
        }
        other => other,
    }
}

/// The search from a lower point, with everything that is known.
fn again<M: Evaluate>(
    model: &mut M,
    before: SearchResult,
    lowest: &LocalMinimum,
    budget: Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    let budget = Budget { starts: 0, ..budget };
    let found = continue_search(model, before.history, &lowest.point, Method::TrustRegion, budget)?;
    let mut minima = before.minima;
    minima.retain(|minimum| !found.minima.iter().any(|new| new.is_at(&minimum.point)));
    minima.extend(found.minima.iter().cloned());
    minima.sort_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared));
    Ok(SearchResult { minima, every_start: before.every_start, ..found })
}

/// Correlation of the residuals at the best point.
fn correlated(series: &[Vec<usize>], history: &[Evaluated], explored: &Explored) -> Option<SerialCorrelation> {
    let best = history.iter().find(|evaluated| evaluated.point == explored.region.minimum.point)?;
    serial_correlation(series, best.residuals.as_ref()?, &explored.region.jacobian())
}
