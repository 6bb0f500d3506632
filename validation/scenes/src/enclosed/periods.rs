//! Flows that come in again at the other side: where a particle went between two samples, and which of its images count.

use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;

/// Component of a direction along which layers are cut, below which it runs along the periodic sides `[-]`.
const ALONG_PERIODS: f64 = 0.05;

/// The length of the period along every axis that has one `[m]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Periods<const D: usize>([Option<f64>; D]);

impl<const D: usize> Periods<D> {
    /// The periods of a domain.
    pub(crate) fn of(axes: &[AxisBoundary; D]) -> Self {
        Self(axes.map(|axis| match axis {
            AxisBoundary::Periodic { lower, upper } => Some(upper - lower),
            _ => None,
        }))
    }

    /// Whether there is any.
    pub(super) fn are_any(&self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// Whether a direction crosses the space between periodic sides, so that a line along it leaves what they repeat.
    pub(super) fn are_crossed_by(&self, direction: &Vector<D>) -> bool {
        !self.are_any()
            || (0..D).any(|axis| self.0[axis].is_none() && direction[axis].abs() > ALONG_PERIODS * direction.norm())
    }

    /// The parts of a vector across and along the periodic sides.
    pub(super) fn split(&self, vector: &Vector<D>) -> (Vector<D>, Vector<D>) {
        let along = Vector::from_fn(|axis, _| if self.0[axis].is_some() { vector[axis] } else { 0.0 });
        (vector - along, along)
    }

    /// Unwrapped end of a particle's way from `start` to `end`, beyond the periodic sides that it has crossed. It is the image of
    /// `end` that is nearest to where its velocities take it, `expected` `[m]`. The number of periods that it is beyond along each
    /// axis comes second.
    pub(super) fn unwrapped(&self, end: &Vector<D>, expected: &Vector<D>) -> (Vector<D>, [i64; D]) {
        let turns = std::array::from_fn(|axis| match self.0[axis] {
            Some(length) => ((expected[axis] - end[axis]) / length).round() as i64,
            None => 0,
        });
        (end + self.shift(turns), turns)
    }

    /// Displacement `[m]` to an image that is given numbers of periods away along the axes.
    pub(super) fn shift(&self, turns: [i64; D]) -> Vector<D> {
        Vector::<D>::from_fn(|axis, _| self.0[axis].map_or(0.0, |length| turns[axis] as f64 * length))
    }

    /// Displacements `[m]` to all images up to a number of periods away on either side; without periods zero alone.
    pub(super) fn images(&self, reach: [i64; D]) -> Vec<Vector<D>> {
        let mut ways = vec![Vector::<D>::zeros()];
        for axis in (0..D).filter(|&axis| self.0[axis].is_some()) {
            let along = |turn: i64| self.shift(std::array::from_fn(|other| if other == axis { turn } else { 0 }));
            ways =
                ways.iter().flat_map(|way| (-reach[axis]..=reach[axis]).map(move |turn| way + along(turn))).collect();
        }
        ways
    }

    /// Number of periods along each axis that a strip of a half width `[m]` along a direction reaches. The strip begins at a
    /// place and ends where the particles do, whose lower and upper corner `extent` gives.
    pub(super) fn reach(
        &self,
        at: &Vector<D>,
        direction: &Vector<D>,
        half: f64,
        extent: &(Vector<D>, Vector<D>),
    ) -> [i64; D] {
        let bounded = (0..D).filter(|&axis| self.0[axis].is_none());
        let Some(steepest) = bounded.max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs())) else {
            return [0; D];
        };
        let farthest = (at[steepest] - extent.0[steepest]).abs().max((extent.1[steepest] - at[steepest]).abs());
        let length = (farthest + half) / direction[steepest].abs();
        std::array::from_fn(|axis| match self.0[axis] {
            Some(period) => ((length * direction[axis].abs() + half) / period).ceil() as i64 + 1,
            None => 0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn periodic_along_x() -> Periods<2> {
        Periods::of(&[AxisBoundary::Periodic { lower: 0.0, upper: 0.5 }, AxisBoundary::Open])
    }

    #[test]
    fn a_particle_that_wraps_goes_on_straight() {
        let seen = Vector::<2>::new(0.1, 0.2);
        let (end, turns) = periodic_along_x().unwrapped(&seen, &Vector::<2>::new(1.08, 0.2));
        assert_eq!((end, turns), (Vector::<2>::new(1.1, 0.2), [2, 0]));
        let none = Periods::of(&[AxisBoundary::Open; 2]);
        assert_eq!(none.unwrapped(&seen, &Vector::<2>::new(1.08, 0.2)), (seen, [0, 0]));
    }

    #[test]
    fn images_go_to_either_side_of_periodic_axes_only() {
        let ways = periodic_along_x().images([1, 7]);
        assert_eq!(ways, [-0.5, 0.0, 0.5].map(|x| Vector::<2>::new(x, 0.0)));
        assert_eq!(Periods::<3>::of(&[AxisBoundary::Open; 3]).images([3; 3]), [Vector::<3>::zeros()]);
    }

    #[test]
    fn a_direction_along_the_sides_crosses_nothing() {
        let periods = periodic_along_x();
        assert!(periods.are_crossed_by(&Vector::<2>::new(0.9, 0.4)));
        assert!(!periods.are_crossed_by(&Vector::<2>::new(1.0, 0.0)));
        assert!(Periods::of(&[AxisBoundary::Open; 2]).are_crossed_by(&Vector::<2>::new(1.0, 0.0)));
    }
}
