//! Values between and beyond points.

use bagnold_inference::statistics::{Extrapolation, interpolated};

const POINTS: [(f64, f64); 3] = [(0.0, 1.0), (1.0, 3.0), (3.0, 4.0)];

#[test]
fn values_are_straight_between_points_whatever_the_ends_are() {
    for ends in [Extrapolation::Nothing, Extrapolation::EndValue, Extrapolation::Line(1.0)].map(|end| (end, end)) {
        let values = [0.0, 0.25, 1.0, 2.0, 3.0].map(|place| interpolated(&POINTS, place, ends));
        assert_eq!(values, [1.0, 1.5, 3.0, 3.5, 4.0].map(Some));
        assert_eq!(interpolated(&POINTS, f64::NAN, ends), None);
        assert_eq!(interpolated(&[], 0.0, ends), None);
    }
}

#[test]
fn each_end_gives_what_was_asked_for() {
    let at = |place, before, after| interpolated(&POINTS, place, (before, after));
    assert_eq!(at(-0.5, Extrapolation::Nothing, Extrapolation::EndValue), None);
    assert_eq!(at(3.5, Extrapolation::Nothing, Extrapolation::EndValue), Some(4.0));
    assert_eq!(at(-0.5, Extrapolation::EndValue, Extrapolation::Nothing), Some(1.0));
    assert_eq!(at(3.5, Extrapolation::EndValue, Extrapolation::Nothing), None);
    assert_eq!(at(-0.5, Extrapolation::Line(0.5), Extrapolation::Nothing), Some(0.0));
    assert_eq!(at(-0.6, Extrapolation::Line(0.5), Extrapolation::Nothing), None);
    assert_eq!(at(4.0, Extrapolation::Nothing, Extrapolation::Line(0.5)), Some(4.5));
    assert_eq!(at(4.1, Extrapolation::Nothing, Extrapolation::Line(0.5)), None);
    let gap = [(0.0, 1.0), (1.0, f64::NAN), (2.0, 3.0)];
    let beside = |place| interpolated(&gap, place, (Extrapolation::EndValue, Extrapolation::EndValue));
    assert_eq!([0.0, 0.5, 1.0, 1.5, 2.0].map(beside), [Some(1.0), None, None, None, Some(3.0)]);
    assert_eq!(interpolated(&POINTS[..1], 0.5, (Extrapolation::Line(9.0), Extrapolation::Line(9.0))), None);
}
