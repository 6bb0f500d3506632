//! The profile of χ² along one parameter, all others at their best for it.

use super::descent::descend;
use super::emulator::{Emulator, Minimum};

/// First step towards the threshold in standard deviations, and its bounds in the unit cube.
const STEP: f64 = 0.5;
const LEAST_STEP: f64 = 1e-9;
const LARGEST_STEP: f64 = 0.1;

/// Growth of the next steps.
const GROWTH: f64 = 1.2;

/// Halvings by which a crossing of the threshold is refined.
const HALVINGS: usize = 24;

/// Points of the curve.
const CURVE_POINTS: usize = 41;

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
    #[must_use]
    pub fn is_closed(&self) -> bool {
        !self.open_below && !self.open_above
    }

    /// Width of the interval, as a share of the range.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.interval[1] - self.interval[0]
    }
}

/// The interval of the parameter `which` up to a rise of χ² by `threshold`, without its curve; `deviation` is a guess of its
/// standard deviation in the unit cube.
pub(super) fn profile(
    emulator: &Emulator,
    minimum: &Minimum,
    which: usize,
    deviation: f64,
    threshold: f64,
) -> ProfileLikelihood {
    let side = |direction| crossing(emulator, minimum, &minimum.point, which, direction, deviation, threshold);
    let ((below, open_below), (above, open_above)) = (side(-1.0), side(1.0));
    let interval = [below[which], above[which]];
    ProfileLikelihood { interval, open_below, open_above, ends: [below, above], curve: Vec::new() }
}

/// The curve over an interval and half its width beyond.
pub(super) fn curve(
    emulator: &Emulator,
    minimum: &Minimum,
    which: usize,
    interval: [f64; 2],
) -> Vec<ProfileLikelihoodPoint> {
    let margin = 0.5 * (interval[1] - interval[0]);
    let (from, to) = ((interval[0] - margin).max(0.0), (interval[1] + margin).min(1.0));
    let value = |k: usize| from + (to - from) * k as f64 / (CURVE_POINTS - 1) as f64;
    // outwards from the minimum, each point from the one before it
    let middle = (0..CURVE_POINTS).find(|k| value(*k) >= minimum.point[which]).unwrap_or(CURVE_POINTS - 1);
    let walk = |indices: Vec<usize>| {
        let mut start = minimum.point.clone();
        let mut points = Vec::new();
        for k in indices {
            let point = constrained(emulator, minimum, &start, which, value(k));
            start.clone_from(&point.point);
            points.push(point);
        }
        points
    };
    let mut curve = walk((0..middle).rev().collect());
    curve.reverse();
    curve.extend(walk((middle..CURVE_POINTS).collect()));
    curve
}

/// The best point with one parameter held.
pub(super) fn constrained(
    emulator: &Emulator,
    minimum: &Minimum,
    start: &[f64],
    which: usize,
    value: f64,
) -> ProfileLikelihoodPoint {
    let (mut lower, mut upper) = (vec![0.0; start.len()], vec![1.0; start.len()]);
    (lower[which], upper[which]) = (value, value);
    let bottom = descend(emulator, start, &lower, &upper);
    ProfileLikelihoodPoint { point: bottom.point, rise: bottom.chi_squared - minimum.chi_squared }
}

/// The last point in a direction below the threshold, and whether it lies at the bound; all values of the others are followed
/// from `start` on, as along a valley.
pub(super) fn crossing(
    emulator: &Emulator,
    minimum: &Minimum,
    start: &[f64],
    which: usize,
    direction: f64,
    deviation: f64,
    threshold: f64,
) -> (Vec<f64>, bool) {
    let bound = if direction < 0.0 { 0.0 } else { 1.0 };
    let mut step = (STEP * deviation).clamp(LEAST_STEP, LARGEST_STEP);
    let mut inside = start.to_vec();
    while inside[which] != bound {
        let next = (inside[which] + direction * step).clamp(0.0, 1.0);
        let trial = constrained(emulator, minimum, &inside, which, next);
        if trial.rise > threshold {
            return (bisected(emulator, minimum, which, inside, trial.point, threshold), false);
        }
        inside = trial.point;
        step = (GROWTH * step).min(LARGEST_STEP);
    }
    (inside, true)
}

/// The point at the threshold between one below it and one above.
fn bisected(
    emulator: &Emulator,
    minimum: &Minimum,
    which: usize,
    mut inside: Vec<f64>,
    outside: Vec<f64>,
    threshold: f64,
) -> Vec<f64> {
    let mut beyond = outside[which];
    for _ in 0..HALVINGS {
        let trial = constrained(emulator, minimum, &inside, which, 0.5 * (inside[which] + beyond));
        if trial.rise > threshold {
            beyond = trial.point[which];
        } else {
            inside = trial.point;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::super::region::{Region, Uncertainties};
    use super::super::stand_in::emulator;

    /// For a linear model the profile is a parabola, (u − û)²/variance, whatever the other parameter does.
    #[test]
    fn the_interval_of_a_linear_model_is_that_of_its_covariance() {
        let emulator = emulator(|u| vec![20.0 * (u[0] - 0.5), 10.0 * (u[0] + u[1] - 1.0)]);
        let region = Region::new(&emulator, Uncertainties::AsStated);
        for (profile, variance) in region.profiles.iter().zip([1.0 / 400.0, 1.0 / 400.0 + 1.0 / 100.0f64]) {
            let half = 1.959_964 * variance.sqrt();
            assert!((profile.interval[0] - 0.5 + half).abs() < 1e-6, "{:?}", profile.interval);
            assert!((profile.interval[1] - 0.5 - half).abs() < 1e-6 && profile.is_closed());
        }
        for at in &region.profiles[1].curve {
            let exact = (at.point[1] - 0.5) * (at.point[1] - 0.5) / 0.0125;
            assert!((at.rise - exact).abs() < 1e-6 * (1.0 + exact));
        }
        assert!(region.profiles[1].curve.is_sorted_by(|a, b| a.point[1] < b.point[1]));
    }

    #[test]
    fn an_interval_that_reaches_a_bound_is_open() {
        let emulator = emulator(|u| vec![2.0 * (u[0] - 0.9), 0.1 * (u[1] - 0.4)]);
        let region = Region::new(&emulator, Uncertainties::AsStated);
        let [first, second] = &region.profiles[..] else { panic!("two parameters") };
        assert!(first.open_above && !first.is_closed() && first.interval[1] == 1.0);
        assert!(first.open_below == (0.9 < 0.98) && second.interval == [0.0, 1.0]);
        assert!(second.open_below && second.open_above);
    }

    #[test]
    fn a_minimum_on_a_face_has_a_one_sided_interval() {
        let emulator = emulator(|u| vec![20.0 * (u[0] - 1.05), 20.0 * (u[1] - 0.4)]);
        let region = Region::new(&emulator, Uncertainties::AsStated);
        let profile = &region.profiles[0];
        assert!(profile.open_above && !profile.open_below && profile.interval[1] == 1.0);
        // (20 (u − 1.05))² = 1 + 3.8415
        assert!((profile.interval[0] - (1.05 - 4.841_459f64.sqrt() / 20.0)).abs() < 1e-6, "{:?}", profile.interval);
    }
}
