//! The region of agreement as the model has it: its ends and its edge are evaluated until they hold.
//!
//! A search that converges fast leaves its points close to the minimum. If the data determine a parameter badly, the
//! region lies far beyond them, where their emulator is a guess. The model is then evaluated at the ends of the intervals
//! that the emulator proposes, and again where it disagrees; then just inside and just outside of the joint region along
//! its principal axes. Whoever finds a lower point on the way ends the exploration: the search is to resume from there.

use super::descent::LocalMinimum;
use super::emulator::{Degree, Emulator, distance};
use super::ends::{CLOSE, IntervalEnd, IntervalSide, TOLERANCE};
use super::profile::ProfileLikelihood;
use super::region::{Region, Uncertainties};
use super::search::lowest;
use super::{Budget, Evaluate, Evaluated, largest_distance};
use nalgebra::SymmetricEigen;

/// Rounds of further points.
const MOST_ROUNDS: usize = 40;

/// Points whose χ² rises by more than this many times the threshold say little about the region.
pub(super) const FAR: f64 = 25.0;

/// Points on other branches that are tried for each parameter, though an emulator that is not at home there may promise many.
const PROMISES: usize = 1;

/// Share of a parameter's range beyond its interval that is too wide to be left unseen.
const STRETCH: f64 = 0.2;

/// Shares of the threshold at which the joint region is checked, inside and outside.
const EDGE: [f64; 2] = [0.8, 1.25];

/// Confidence region, with the emulator and the evaluations behind it.
#[derive(Debug, Clone)]
pub struct Explored {
    /// The emulator of the points in and about the region.
    pub emulator: Emulator,
    /// Region, with the intervals that the model has decided.
    pub region: Region,
    /// Lower and upper end of every parameter's interval.
    pub ends: Vec<[IntervalEnd; 2]>,
    /// Whether the model agrees with the joint region just inside and just outside of its edge.
    pub joint_settled: bool,
    /// Every point of the search and the further ones.
    pub history: Vec<Evaluated>,
    /// Whether a point was found that is lower than the search's best by more than is negligible.
    pub lower: bool,
}

impl Explored {
    /// Whether the model has decided every end and the joint region.
    pub fn is_settled(&self) -> bool {
        self.joint_settled && self.ends.iter().flatten().all(|end| end.settled)
    }

    /// The lowest evaluated point of every part of an interval in which no known minimum lies.
    pub(super) fn branches_without(&self, known: &[LocalMinimum]) -> Vec<Vec<f64>> {
        let mut found: Vec<Vec<f64>> = Vec::new();
        for (k, profile) in self.region.profiles.iter().enumerate().filter(|(_, profile)| !profile.gaps.is_empty()) {
            for [from, to] in profile.intervals(k) {
                let has = |point: &[f64]| (from..=to).contains(&point[k]);
                if known.iter().map(|minimum| &minimum.point).chain(&found).any(|point| has(point)) {
                    continue;
                }
                let inside: Vec<Evaluated> =
                    self.history.iter().filter(|evaluated| has(&evaluated.point)).cloned().collect();
                found.extend(lowest(&inside).map(|minimum| minimum.point));
            }
        }
        found
    }

    /// Points in the wide stretches that the intervals of the least determined parameter leave out, along the emulator's valley.
    pub(super) fn scouts(&self) -> Vec<Vec<f64>> {
        let share = |k: &usize| self.region.profiles[*k].intervals(*k).iter().map(|[from, to]| to - from).sum::<f64>();
        let Some(k) = (0..self.ends.len()).max_by(|a, b| share(a).total_cmp(&share(b))) else { return Vec::new() };
        let [below, above] = &self.ends[k];
        let mut points = Vec::new();
        for (end, bound) in [(below, 0.0), (above, 1.0)] {
            let stretch = bound - end.point[k];
            if stretch.abs() > STRETCH {
                let at = |part: f64| self.region.held(&end.point, k, end.point[k] + part * stretch).point;
                points.extend([0.5, 0.8, 1.0].map(at));
            }
        }
        points
    }
}

/// A check of the joint region: an axis, its sense, and whether the model agreed.
struct RegionCheck {
    axis: usize,
    sense: f64,
    holds: bool,
}

/// Explores the region, evaluating at most `budget.evaluations` points that are not in the history; none without points
/// enough for an emulator.
///
/// # Errors
/// An error of the model itself.
pub fn explore<M: Evaluate>(
    model: &mut M,
    mut history: Vec<Evaluated>,
    uncertainties: Uncertainties,
    budget: &Budget,
) -> Result<Option<Explored>, M::Error> {
    let searched = history.len();
    let most = searched + budget.evaluations;
    let Some(first) = lowest(&history) else { return Ok(None) };
    let dimensions = first.point.len();
    let mut sides = IntervalSide::all(dimensions);
    let senses = |axis| [1.0, -1.0].map(|sense| RegionCheck { axis, sense, holds: false });
    // with one parameter the joint region is its interval
    let mut checks: Vec<RegionCheck> =
        if dimensions > 1 { (0..dimensions).flat_map(senses).collect() } else { Vec::new() };
    let mut promises = PROMISES * dimensions;
    for round in 0.. {
        let Some((emulator, region)) = mapped(&history, searched, uncertainties, budget) else { return Ok(None) };
        let negligible = budget.negligible(first.chi_squared, emulator.data());
        let lower = first.chi_squared - region.minimum.chi_squared > negligible;
        let ends: Vec<IntervalEnd> = sides.iter().map(|side| side.judge(&region, &history)).collect();
        let open: Vec<usize> = (0..sides.len()).filter(|side| !ends[*side].settled).collect();
        let of_edge: Vec<usize> = if open.is_empty() {
            (0..checks.len()).filter(|check| !checks[*check].holds).collect()
        } else {
            Vec::new()
        };
        let at_ends: Vec<Vec<f64>> = open.iter().map(|side| sides[*side].propose(&region, &history)).collect();
        let at_edge: Vec<Vec<f64>> = of_edge.iter().map(|check| edge(&region, &checks[*check])).collect();
        let edges = if open.is_empty() { edges_of_gaps(&region, &history) } else { Vec::new() };
        let leads = if open.is_empty() && promises > 0 { leads(&region, &history) } else { Vec::new() };
        promises = promises.saturating_sub(leads.len());
        // where the emulator promises something lower, the model is asked
        let bottom = Some(emulator.minimum())
            .filter(|bottom| region.minimum.chi_squared - bottom.chi_squared > negligible)
            .map(|bottom| bottom.point);
        let mut fresh: Vec<Vec<f64>> = Vec::new();
        for point in at_ends.iter().chain(&at_edge).chain(&edges).chain(&leads).chain(&bottom) {
            if place_of(&history, point).is_none() && !fresh.contains(point) {
                fresh.push(point.clone());
            }
        }
        fresh.truncate(most.saturating_sub(history.len()));
        if lower || fresh.is_empty() || round == MOST_ROUNDS {
            let joint_settled = open.is_empty() && of_edge.is_empty() && edges.is_empty() && leads.is_empty();
            return Ok(Some(finished(emulator, region, &ends, joint_settled, history, lower)));
        }
        let results = model.residuals(&fresh)?;
        history.extend(fresh.into_iter().zip(results).map(|(point, residuals)| Evaluated::new(point, residuals)));
        for (side, point) in open.iter().zip(&at_ends) {
            if let Some(place) = place_of(&history, point) {
                let rise = history[place].chi_squared.map(|chi| chi - region.minimum.chi_squared);
                sides[*side].learn(&region, place, point, rise);
            }
        }
        for (check, point) in of_edge.iter().zip(&at_edge) {
            let chi_squared = place_of(&history, point).and_then(|place| history[place].chi_squared);
            let agrees = chi_squared.is_some_and(|chi| chi - region.minimum.chi_squared <= region.threshold);
            checks[*check].holds = agrees == region.contains(point);
        }
    }
    Ok(None)
}

/// Index of a point in the history.
fn place_of(history: &[Evaluated], point: &[f64]) -> Option<usize> {
    history.iter().position(|evaluated| evaluated.point == point)
}

/// The emulator and region of the points in and about the region and of what was asked beyond the search, which refutes what
/// an emulator promised there; of all points, if these are too few.
fn mapped(
    history: &[Evaluated],
    searched: usize,
    uncertainties: Uncertainties,
    budget: &Budget,
) -> Option<(Emulator, Region)> {
    let best = lowest(history)?;
    let emulator = Emulator::fit(history, budget.difference)?;
    let region = Region::about(&emulator, best.clone(), uncertainties);
    let limit = best.chi_squared + FAR * region.threshold;
    let mut known: Vec<(f64, usize)> =
        history.iter().enumerate().filter_map(|(place, evaluated)| Some((evaluated.chi_squared?, place))).collect();
    let least = Degree::Quadratic.points(best.point.len());
    if known.len() < least {
        return Some((emulator, region));
    }
    known.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let near: Vec<Evaluated> = known
        .iter()
        .enumerate()
        .filter(|(rank, (chi_squared, place))| *rank < least || *chi_squared <= limit || *place >= searched)
        .map(|(_, (_, place))| history[*place].clone())
        .collect();
    let local = Emulator::fit(&near, 0.5 * extent(&region))?;
    let region = Region::about(&local, best, uncertainties);
    Some((local, region))
}

/// Edges of gaps that no run confirms.
fn edges_of_gaps(region: &Region, history: &[Evaluated]) -> Vec<Vec<f64>> {
    let of_parameter = |(k, profile): (usize, &ProfileLikelihood)| {
        let edges = profile.gaps.iter().flatten();
        edges.filter(|edge| !is_confirmed(region, history, k, edge)).cloned().collect::<Vec<_>>()
    };
    region.profiles.iter().enumerate().flat_map(of_parameter).collect()
}

/// Points on other branches that the emulator promises and no run refutes.
fn leads(region: &Region, history: &[Evaluated]) -> Vec<Vec<f64>> {
    let leads = (0..region.profiles.len()).filter_map(|k| region.lead(k));
    leads.filter(|lead| !is_refuted(region, history, lead)).collect()
}

/// Whether a run confirms the edge of a gap.
fn is_confirmed(region: &Region, history: &[Evaluated], which: usize, edge: &[f64]) -> bool {
    let close = CLOSE * region.profiles[which].width();
    history.iter().any(|evaluated| {
        let off = evaluated.chi_squared.map_or(f64::INFINITY, |chi| chi - region.minimum.chi_squared - region.limit);
        (evaluated.point[which] - edge[which]).abs() <= close && off.abs() <= TOLERANCE * region.limit
    })
}

/// Whether a run beside a point disagrees with the data.
fn is_refuted(region: &Region, history: &[Evaluated], point: &[f64]) -> bool {
    let beside = |evaluated: &&Evaluated| largest_distance(&evaluated.point, point) <= CLOSE;
    let disagrees = |chi: f64| chi - region.minimum.chi_squared > region.limit;
    history.iter().filter(beside).any(|evaluated| evaluated.chi_squared.is_none_or(disagrees))
}

/// Everything, with the intervals that the model has decided.
fn finished(
    emulator: Emulator,
    mut region: Region,
    ends: &[IntervalEnd],
    joint_settled: bool,
    history: Vec<Evaluated>,
    lower: bool,
) -> Explored {
    let ends: Vec<[IntervalEnd; 2]> = ends.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect();
    let confirmed =
        |which: usize, gap: &[Vec<f64>; 2]| gap.iter().all(|edge| is_confirmed(&region, &history, which, edge));
    let confirmed_of = |(k, profile): (usize, &ProfileLikelihood)| {
        profile.gaps.iter().filter(|gap| confirmed(k, gap)).cloned().collect::<Vec<_>>()
    };
    let gaps: Vec<_> = region.profiles.iter().enumerate().map(confirmed_of).collect();
    for (k, (profile, [below, above])) in region.profiles.iter_mut().zip(&ends).enumerate() {
        profile.interval = [below.point[k], above.point[k]];
        profile.ends = [below.point.clone(), above.point.clone()];
        // a gap that the model has not confirmed is none
        profile.gaps.clone_from(&gaps[k]);
        (profile.open_below, profile.open_above) = (below.open, above.open);
    }
    region.draw();
    Explored { emulator, region, ends, joint_settled, history, lower }
}

/// A point on a principal axis, just inside the edge of the joint region on one side and just outside on the other, or on
/// the face of the cube.
fn edge(region: &Region, check: &RegionCheck) -> Vec<f64> {
    let factors = SymmetricEigen::new(region.covariance.clone());
    let wanted = region.threshold * if check.sense > 0.0 { EDGE[0] } else { EDGE[1] };
    let at = |step: f64| -> Vec<f64> {
        let moved =
            |(k, u): (usize, &f64)| (u + check.sense * step * factors.eigenvectors[(k, check.axis)]).clamp(0.0, 1.0);
        region.minimum.point.iter().enumerate().map(moved).collect()
    };
    let guess = region.threshold.sqrt() / region.inflation * factors.eigenvalues[check.axis].max(0.0).sqrt();
    let (mut near, mut far) = (0.0, 0.25 * guess.min(1.0));
    while region.rise(&at(far)) < wanted && far < 2.0 {
        (near, far) = (far, 1.5 * far);
    }
    for _ in 0..30 {
        let middle = 0.5 * (near + far);
        if region.rise(&at(middle)) < wanted { near = middle } else { far = middle }
    }
    at(far)
}

/// Largest distance of an end of an interval from the minimum.
pub(super) fn extent(region: &Region) -> f64 {
    let ends = region.profiles.iter().flat_map(|profile| &profile.ends);
    ends.map(|end| distance(end, &region.minimum.point)).fold(0.0, f64::max)
}
