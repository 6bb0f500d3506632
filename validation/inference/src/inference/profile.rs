//! The profile of χ² along one parameter, all others at their best for it.
//!
//! Where χ² has several branches in the other parameters, every evaluated point that agrees with the data begins a part of
//! the interval, and gaps between the parts are left out of it.

use super::descent::{LocalMinimum, descend_held};
use super::emulator::Emulator;

/// First step towards the threshold in standard deviations, and its bounds in the unit cube.
const STEP: f64 = 0.5;
const LEAST_STEP: f64 = 1e-9;
const LARGEST_STEP: f64 = 0.1;

/// Growth of the next steps.
const GROWTH: f64 = 1.2;

/// Halvings by which a crossing of the threshold is refined.
const HALVINGS: usize = 24;

/// Points of the curve, and values at which the whole range is looked through for other branches.
const CURVE_POINTS: usize = 41;
const NODES: usize = 24;

/// Evaluated points from which the best values of the other parameters are sought at a node.
const STARTS: usize = 6;

/// Share of an interval below which a gap is none.
const LEAST_GAP: f64 = 0.03;

/// A point of the curve.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileLikelihoodPoint {
    /// All parameters, in the unit cube.
    pub point: Vec<f64>,
    /// χ² above its minimum `[-]`.
    pub rise: f64,
}

/// The values of one parameter that agree with the data.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileLikelihood {
    /// Least and largest value whose χ² rises by no more than the threshold, in the unit cube.
    pub interval: [f64; 2],
    /// All parameters at the lower and upper edge of every gap in the interval, in rising order.
    pub gaps: Vec<[Vec<f64>; 2]>,
    /// χ² stays below the threshold down to the lower bound of the parameter.
    pub open_below: bool,
    /// χ² stays below the threshold up to the upper bound.
    pub open_above: bool,
    /// All parameters at both ends of the interval.
    pub ends: [Vec<f64>; 2],
    /// The curve from beyond one end to beyond the other, of rising values.
    pub curve: Vec<ProfileLikelihoodPoint>,
}

impl ProfileLikelihood {
    /// Whether both ends lie between the bounds.
    pub fn is_closed(&self) -> bool {
        !self.open_below && !self.open_above
    }

    /// The values that agree, as intervals without the gaps between them, in rising order.
    pub fn intervals(&self, which: usize) -> Vec<[f64; 2]> {
        let inner = self.gaps.iter().flatten().map(|edge| edge[which]);
        let ends: Vec<f64> = [self.interval[0]].into_iter().chain(inner).chain([self.interval[1]]).collect();
        ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// Width from the least to the largest value, as a share of the range.
    pub fn width(&self) -> f64 {
        self.interval[1] - self.interval[0]
    }
}

/// The profile of one parameter on an emulator.
#[derive(Clone, Copy)]
pub(super) struct ProfileCurve<'a> {
    pub(super) emulator: &'a Emulator,
    pub(super) minimum: &'a LocalMinimum,
    /// The parameter.
    pub(super) which: usize,
    /// Rise of χ² at the ends `[-]`.
    pub(super) threshold: f64,
}

impl ProfileCurve<'_> {
    /// The interval, without its curve, over all branches on which points are known to agree; `deviation` is a guess of the
    /// parameter's standard deviation in the unit cube.
    pub(super) fn interval(&self, deviation: f64) -> ProfileLikelihood {
        let Self { emulator, minimum, which, threshold } = *self;
        let mut parts: Vec<[(Vec<f64>, bool); 2]> = Vec::new();
        for start in std::iter::once(&minimum.point).chain(&emulator.below(minimum.chi_squared + threshold)) {
            if !parts.iter().any(|[below, above]| (below.0[which]..=above.0[which]).contains(&start[which])) {
                parts.push([-1.0, 1.0].map(|direction| self.crossing(start, direction, deviation)));
            }
        }
        parts.sort_by(|a, b| a[0].0[which].total_cmp(&b[0].0[which]));
        let farthest = parts.iter().map(|[_, above]| above.0[which]).fold(0.0, f64::max);
        let least = LEAST_GAP * (farthest - parts[0][0].0[which]);
        let mut gaps = Vec::new();
        let mut parts = parts.into_iter();
        let Some([(below, open_below), (mut above, mut open_above)]) = parts.next() else {
            unreachable!("the minimum begins a part")
        };
        for [lower, upper] in parts {
            if lower.0[which] > above[which] + least {
                gaps.push([above.clone(), lower.0]);
            }
            if upper.0[which] > above[which] {
                (above, open_above) = upper;
            }
        }
        let interval = [below[which], above[which]];
        ProfileLikelihood { interval, gaps, open_below, open_above, ends: [below, above], curve: Vec::new() }
    }

    /// The point of least χ² outside of the interval or in one of its gaps, if the emulator has values there that agree.
    pub(super) fn lead(&self, profile: &ProfileLikelihood) -> Option<Vec<f64>> {
        let near = self.near();
        let intervals = profile.intervals(self.which);
        let nodes = (0..NODES).map(|node| (node as f64 + 0.5) / NODES as f64);
        let middles = profile.gaps.iter().map(|[lower, upper]| 0.5 * (lower[self.which] + upper[self.which]));
        let outside = |value: &f64| !intervals.iter().any(|[from, to]| (*from..=*to).contains(value));
        let points = nodes.chain([0.0, 1.0]).chain(middles).filter(outside);
        let points = points.filter_map(|value| self.envelope(value, &near));
        let lowest = points.min_by(|a, b| a.rise.total_cmp(&b.rise))?;
        (lowest.rise <= self.threshold).then_some(lowest.point)
    }

    /// Evaluated points from which other branches are sought.
    fn near(&self) -> Vec<Vec<f64>> {
        self.emulator.below(self.minimum.chi_squared + 4.0 * self.threshold)
    }

    /// The lowest of the best points with the parameter held that lie downhill of the nearest of some points.
    fn envelope(&self, value: f64, near: &[Vec<f64>]) -> Option<ProfileLikelihoodPoint> {
        let mut starts: Vec<&Vec<f64>> = near.iter().collect();
        let off = |start: &[f64]| (start[self.which] - value).abs();
        starts.sort_by(|a, b| off(a).total_cmp(&off(b)));
        let points = starts.into_iter().take(STARTS).map(|start| self.held(start, value));
        points.min_by(|a, b| a.rise.total_cmp(&b.rise))
    }

    /// The curve over an interval and half its width beyond, the lowest of all branches.
    pub(super) fn curve(&self, interval: [f64; 2]) -> Vec<ProfileLikelihoodPoint> {
        let margin = 0.5 * (interval[1] - interval[0]);
        let (from, to) = ((interval[0] - margin).max(0.0), (interval[1] + margin).min(1.0));
        let value = |k: usize| from + (to - from) * k as f64 / (CURVE_POINTS - 1) as f64;
        // outwards from the minimum, each point from the one before it
        let best = &self.minimum.point;
        let middle = (0..CURVE_POINTS).find(|k| value(*k) >= best[self.which]).unwrap_or(CURVE_POINTS - 1);
        let walk = |indices: &mut dyn Iterator<Item = usize>| {
            let mut start = best.clone();
            let mut points = Vec::new();
            for k in indices {
                let point = self.held(&start, value(k));
                start.clone_from(&point.point);
                points.push(point);
            }
            points
        };
        let mut curve = walk(&mut (0..middle).rev());
        curve.reverse();
        curve.extend(walk(&mut (middle..CURVE_POINTS)));
        let near = self.near();
        for point in &mut curve {
            if let Some(other) = self.envelope(point.point[self.which], &near).filter(|other| other.rise < point.rise) {
                *point = other;
            }
        }
        curve
    }

    /// The best point with the parameter held, downhill from `start`.
    pub(super) fn held(&self, start: &[f64], value: f64) -> ProfileLikelihoodPoint {
        let bottom = descend_held(self.emulator, start, self.which, value);
        ProfileLikelihoodPoint { point: bottom.point, rise: bottom.chi_squared - self.minimum.chi_squared }
    }

    /// The last point in a direction below the threshold, and whether it lies at the bound; all values of the others are followed
    /// from `start` on, as along a valley.
    pub(super) fn crossing(&self, start: &[f64], direction: f64, deviation: f64) -> (Vec<f64>, bool) {
        let bound = if direction < 0.0 { 0.0 } else { 1.0 };
        let mut step = (STEP * deviation).clamp(LEAST_STEP, LARGEST_STEP);
        let mut inside = start.to_vec();
        while inside[self.which] != bound {
            let next = (inside[self.which] + direction * step).clamp(0.0, 1.0);
            let trial = self.held(&inside, next);
            if trial.rise > self.threshold {
                return (self.bisected(inside, trial.point[self.which]), false);
            }
            inside = trial.point;
            step = (GROWTH * step).min(LARGEST_STEP);
        }
        (inside, true)
    }

    /// The point at the threshold between one below it and a value beyond.
    fn bisected(&self, mut inside: Vec<f64>, mut beyond: f64) -> Vec<f64> {
        for _ in 0..HALVINGS {
            let trial = self.held(&inside, 0.5 * (inside[self.which] + beyond));
            if trial.rise > self.threshold {
                beyond = trial.point[self.which];
            } else {
                inside = trial.point;
            }
        }
        inside
    }
}
