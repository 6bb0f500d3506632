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
pub(super) const CLOSE: f64 = 0.03;

/// Miss of a promised rise, as a share of the limit, up to which the emulator is trusted.
const FAIR: f64 = 0.3;

/// One end of the interval of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalEnd {
    /// All parameters there, in the unit cube.
    pub point: Vec<f64>,
    /// χ² of the model there above the least `[-]`; none where it was not evaluated.
    pub rise: Option<f64>,
    /// The interval extends to the bound of the parameter.
    pub open: bool,
    /// The model fails beyond.
    pub fails: bool,
    /// The model has decided it.
    pub settled: bool,
}

/// A side of a parameter, with the points that were evaluated for its end.
#[derive(Debug, Clone)]
pub(super) struct IntervalSide {
    /// Index of the parameter.
    pub(super) parameter: usize,
    /// Whether it is the upper side.
    pub(super) upper: bool,
    /// Places of the evaluated proposals in the history.
    pub(super) proposals: Vec<usize>,
    /// Distance up to which the emulator has earned trust.
    radius: f64,
}

/// Bracket of an interval's end from the model's evaluations, as distances from the best point.
struct Bracket {
    /// The farthest point that agrees.
    inside: Option<(f64, usize)>,
    /// Distance of the nearest point beyond at which the model fails.
    failing: f64,
}

impl IntervalSide {
    /// Both sides of every parameter.
    pub(super) fn all(dimensions: usize) -> Vec<Self> {
        let side = |parameter| {
            [false, true].map(|upper| Self { parameter, upper, proposals: Vec::new(), radius: f64::INFINITY })
        };
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

    /// The end as the emulator has it: along its profile, followed from the best point and from the farthest that agrees.
    fn expected(&self, region: &Region, farthest: Option<&[f64]>) -> (Vec<f64>, bool) {
        let profile = &region.profiles[self.parameter];
        let [below, above] = &profile.ends;
        let from_best = if self.upper { (above, profile.open_above) } else { (below, profile.open_below) };
        let beyond = farthest.map(|point| region.end_beyond(point, self.parameter, self.upper));
        match beyond {
            Some((end, open)) if self.outwards(region, &end) >= self.outwards(region, from_best.0) => (end, open),
            _ => (from_best.0.clone(), from_best.1),
        }
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
        let failed = self.proposals.iter().filter(|place| history[**place].chi_squared.is_none());
        let failures = failed.map(|place| self.outwards(region, &history[*place].point));
        let failing = failures.filter(|distance| *distance > reached).fold(f64::INFINITY, f64::min);
        Bracket { inside, failing }
    }

    /// Records an evaluated proposal; if the model disagrees with the emulator, the next step is shorter.
    pub(super) fn learn(&mut self, region: &Region, place: usize, point: &[f64], rise: Option<f64>) {
        self.proposals.push(place);
        let Some(rise) = rise else { return };
        let miss = (rise - region.rise(point)).abs() / region.limit;
        // a residual is missed by the third power of the distance, χ² by its square
        let factor = libm::pow(FAIR / miss.max(1e-9), 1.0 / 6.0).clamp(0.2, 2.0);
        self.radius = if miss <= FAIR { f64::INFINITY } else { factor * self.outwards(region, point) };
    }

    /// End of the interval as found.
    pub(super) fn judge(&self, region: &Region, history: &[Evaluated]) -> IntervalEnd {
        let bracket = self.bracket(region, history);
        let reached = bracket.inside.map_or(0.0, |(distance, _)| distance);
        let tolerance = TOLERANCE * region.limit;
        let settles = |place: usize| {
            let evaluated = &history[place];
            let rise = evaluated.chi_squared? - region.minimum.chi_squared;
            let distance = self.outwards(region, &evaluated.point);
            // an open end is proved by its point, whatever others there may be
            let open = distance >= self.room(region) && rise <= region.limit;
            let right = (rise - region.limit).abs() <= tolerance || open;
            let farthest = (distance > 0.0 || open) && reached <= distance * (1.0 + CLOSE);
            let best = || {
                let held = region.held(&evaluated.point, self.parameter, evaluated.point[self.parameter]);
                (held.rise - region.limit).abs() <= tolerance || open
            };
            (right && farthest && best()).then(|| IntervalEnd {
                point: evaluated.point.clone(),
                rise: Some(rise),
                open,
                fails: false,
                settled: true,
            })
        };
        let off = |end: &IntervalEnd| end.rise.map_or(f64::INFINITY, |rise| (rise - region.limit).abs());
        let settled = (0..history.len()).filter_map(settles);
        if let Some(end) = settled.min_by(|a, b| b.open.cmp(&a.open).then(off(a).total_cmp(&off(b)))) {
            return end;
        }
        let farthest = bracket.inside.map(|(_, place)| &*history[place].point);
        let (expected, open) = self.expected(region, farthest);
        let fails = bracket.failing <= self.outwards(region, &expected);
        let wider = match bracket.inside {
            Some((distance, place)) if fails || distance >= self.outwards(region, &expected) => {
                let evaluated = &history[place];
                let rise = evaluated.chi_squared.map(|chi| chi - region.minimum.chi_squared);
                IntervalEnd { point: evaluated.point.clone(), rise, open: false, fails: false, settled: false }
            }
            _ => IntervalEnd { point: expected, rise: None, open, fails: false, settled: false },
        };
        let cornered = fails && bracket.failing - reached <= CLOSE * bracket.failing;
        IntervalEnd { fails: cornered, settled: cornered, ..wider }
    }

    /// The point whose evaluation would tell most about the end: where the emulator has it, as far as that is trusted.
    pub(super) fn propose(&self, region: &Region, history: &[Evaluated]) -> Vec<f64> {
        let bracket = self.bracket(region, history);
        let reached = bracket.inside.map_or(0.0, |(distance, _)| distance);
        let farthest = bracket.inside.map(|(_, place)| &*history[place].point);
        let (expected, _) = self.expected(region, farthest);
        let promised = self.outwards(region, &expected);
        let sought = if bracket.failing <= promised { 0.5 * (reached + bracket.failing) } else { promised };
        let distance = sought.min(self.radius.max(1.1 * reached));
        if distance == promised {
            return expected;
        }
        // on the way there, as the emulator's valley has it
        let from = farthest.unwrap_or(&region.minimum.point);
        let share = (distance - reached) / (promised - reached).max(f64::MIN_POSITIVE);
        let between = |(from, to): (&f64, &f64)| (from + share * (to - from)).clamp(0.0, 1.0);
        let start: Vec<f64> = from.iter().zip(&expected).map(between).collect();
        region.held(&start, self.parameter, self.coordinate(region, distance)).point
    }
}
