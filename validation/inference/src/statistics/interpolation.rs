//! Straight lines between the points of a table; what stands beyond its ends is said by whoever asks.

/// Extrapolation of a table beyond one of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extrapolation {
    /// Nothing.
    Nothing,
    /// The value of the end.
    EndValue,
    /// The line through the two outermost points, for at most so many of their distances `[-]`, and then nothing.
    Line(f64),
}

/// The value at a place, straight between points of rising abscissa; [`Extrapolation`] before the first and after the last.
#[must_use]
pub fn interpolated(points: &[(f64, f64)], place: f64, (before, after): (Extrapolation, Extrapolation)) -> Option<f64> {
    let next = points.partition_point(|point| point.0 < place);
    if let Some(&(x, y)) = points.get(next)
        && x == place
    {
        return Some(y);
    }
    let (end, beyond) = match next {
        0 => (points.first()?, before),
        _ => points.get(next).map_or((points.last()?, after), |right| (right, Extrapolation::Line(0.0))),
    };
    match beyond {
        Extrapolation::Nothing => None,
        Extrapolation::EndValue => (!place.is_nan()).then_some(end.1),
        Extrapolation::Line(most) => {
            let right = next.min(points.len() - 1).max(1);
            let ((x0, y0), (x1, y1)) = (points[right - 1], *points.get(right)?);
            let distance = (x0 - place).max(place - x1) / (x1 - x0);
            (distance <= most).then(|| y0 + (y1 - y0) * (place - x0) / (x1 - x0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(interpolated(&POINTS[..1], 0.5, (Extrapolation::Line(9.0), Extrapolation::Line(9.0))), None);
    }
}
