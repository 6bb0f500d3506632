//! The ends of intervals: proposed by the emulator, decided by the model.
//!
//! An evaluated point whose χ² lies no more than the limit above the least proves that its parameters agree with the data,
//! whatever the emulator thinks. An end is settled by an evaluated point whose rise is within a tenth of the limit, if the
//! emulator, which passes through it, knows no better values of the other parameters there.

use super::Evaluated;
use super::region::Region;

/// Tolerance of the rise at an end, as a share of the limit.
pub const TOLERANCE: f64 = 0.1;

/// Distance, as a share of that between best point and end, within which two values are one.
const CLOSE: f64 = 0.03;

/// One end of the interval of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// All parameters there, in the unit cube.
    pub point: Vec<f64>,
    /// χ² of the model there above the least `[-]`; none where it was not evaluated.
    pub rise: Option<f64>,
    /// The interval goes on to the bound of the parameter.
    pub open: bool,
    /// The model fails beyond.
    pub fails: bool,
    /// The model has decided it.
    pub settled: bool,
}

/// A side of a parameter, with the points that were evaluated for its end.
#[derive(Debug, Clone)]
pub(super) struct Side {
    /// Which parameter.
    pub(super) parameter: usize,
    /// Whether it is the upper side.
    pub(super) upper: bool,
    /// Places of the evaluated proposals in the history.
    pub(super) proposals: Vec<usize>,
}

/// What the model has said about a side, as distances from the best point.
struct Bracket {
    /// The farthest point that agrees.
    inside: Option<(f64, usize)>,
    /// The nearest point beyond that does not, or where the model fails.
    outside: f64,
    fails: bool,
}

impl Side {
    /// Both sides of every parameter.
    pub(super) fn all(dimensions: usize) -> Vec<Self> {
        let side = |parameter| [false, true].map(|upper| Self { parameter, upper, proposals: Vec::new() });
        (0..dimensions).flat_map(side).collect()
    }

    /// Distance of a point from the best, outwards.
    fn outwards(&self, region: &Region, point: &[f64]) -> f64 {
        let distance = point[self.parameter] - region.minimum.point[self.parameter];
        if self.upper { distance } else { -distance }
    }

    /// Distance of the bound of the parameter.
    fn room(&self, region: &Region) -> f64 {
        let best = region.minimum.point[self.parameter];
        if self.upper { 1.0 - best } else { best }
    }

    /// The coordinate at a distance from the best point.
    fn coordinate(&self, region: &Region, distance: f64) -> f64 {
        let best = region.minimum.point[self.parameter];
        if distance >= self.room(region) {
            return if self.upper { 1.0 } else { 0.0 };
        }
        if self.upper { best + distance } else { best - distance }
    }

    /// The end as the emulator has it.
    fn expected<'r>(&self, region: &'r Region) -> (&'r [f64], bool) {
        let profile = &region.profiles[self.parameter];
        if self.upper { (&profile.ends[1], profile.open_above) } else { (&profile.ends[0], profile.open_below) }
    }

    fn bracket(&self, region: &Region, history: &[Evaluated]) -> Bracket {
        let rise = |evaluated: &Evaluated| evaluated.chi_squared.map(|chi| chi - region.minimum.chi_squared);
        let agrees = |evaluated: &Evaluated| rise(evaluated).is_some_and(|rise| rise <= region.limit);
        let inside = (0..history.len())
            .filter(|place| agrees(&history[*place]))
            .map(|place| (self.outwards(region, &history[place].point), place))
            .filter(|(distance, _)| *distance > 0.0)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let reached = inside.map_or(0.0, |(distance, _)| distance);
        let (mut outside, mut fails) = (f64::INFINITY, false);
        for place in &self.proposals {
            let evaluated = &history[*place];
            let distance = self.outwards(region, &evaluated.point);
            let failed = evaluated.chi_squared.is_none();
            // other values of the other parameters might agree there
            let beyond = failed
                || rise(evaluated).is_some_and(|rise| rise > region.limit) && {
                    let held = region.held(&evaluated.point, self.parameter, evaluated.point[self.parameter]);
                    held.rise > region.limit
                };
            if beyond && distance > reached && distance < outside {
                (outside, fails) = (distance, failed);
            }
        }
        Bracket { inside, outside, fails }
    }

    /// The end as it stands.
    pub(super) fn judge(&self, region: &Region, history: &[Evaluated]) -> End {
        let bracket = self.bracket(region, history);
        let reached = bracket.inside.map_or(0.0, |(distance, _)| distance);
        let tolerance = TOLERANCE * region.limit;
        let settles = |place: &usize| {
            let evaluated = &history[*place];
            let rise = evaluated.chi_squared? - region.minimum.chi_squared;
            let distance = self.outwards(region, &evaluated.point);
            let at_bound = distance >= self.room(region);
            let right = (rise - region.limit).abs() <= tolerance || at_bound && rise <= region.limit;
            let held = region.held(&evaluated.point, self.parameter, evaluated.point[self.parameter]);
            let farthest = reached <= distance * (1.0 + CLOSE);
            // an open end is proved by its point, whatever others there may be
            let best = held.rise >= rise - tolerance || at_bound && rise <= region.limit;
            let open = at_bound && rise <= region.limit;
            (right && farthest && best).then(|| End {
                point: evaluated.point.clone(),
                rise: Some(rise),
                open,
                fails: false,
                settled: true,
            })
        };
        let off = |end: &End| end.rise.map_or(f64::INFINITY, |rise| (rise - region.limit).abs());
        let settled = self.proposals.iter().filter_map(settles);
        if let Some(end) = settled.min_by(|a, b| b.open.cmp(&a.open).then(off(a).total_cmp(&off(b)))) {
            return end;
        }
        let (expected, open) = self.expected(region);
        let wider = match bracket.inside {
            Some((distance, place)) if bracket.fails || distance >= self.outwards(region, expected) => {
                let evaluated = &history[place];
                let rise = evaluated.chi_squared.map(|chi| chi - region.minimum.chi_squared);
                End { point: evaluated.point.clone(), rise, open: false, fails: false, settled: false }
            }
            _ => End { point: expected.to_vec(), rise: None, open, fails: false, settled: false },
        };
        let cornered = bracket.fails && bracket.outside - reached <= CLOSE * bracket.outside;
        End { fails: cornered, settled: cornered, ..wider }
    }

    /// The point whose evaluation would tell most about the end.
    pub(super) fn propose(&self, region: &Region, history: &[Evaluated]) -> Vec<f64> {
        let bracket = self.bracket(region, history);
        let reached = bracket.inside.map_or(0.0, |(distance, _)| distance);
        let (expected, _) = self.expected(region);
        let mut distance = self.outwards(region, expected);
        let room = self.room(region);
        if bracket.fails || distance <= reached * (1.0 + 1e-6) || distance >= bracket.outside {
            distance =
                if bracket.outside.is_finite() { 0.5 * (reached + bracket.outside) } else { (1.5 * reached).min(room) };
        }
        let start = match bracket.inside {
            Some((inside, place)) if inside > 0.5 * distance => &history[place].point,
            _ => expected,
        };
        region.held(start, self.parameter, self.coordinate(region, distance)).point
    }
}
