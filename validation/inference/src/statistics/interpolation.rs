//! Straight lines between the points of a table; what stands beyond its ends is said by whoever asks.

/// Extrapolation of a table beyond one of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extrapolation {
    /// No value beyond the data.
    Nothing,
    /// The value of the end.
    EndValue,
    /// The line through the two outermost points, up to a multiple of their distance `[-]` beyond, and then nothing.
    Line(f64),
}

/// The value at a place, straight between points of rising abscissa; [`Extrapolation`] before the first and after the last. None beside a
/// point without a finite value.
pub fn interpolated(points: &[(f64, f64)], place: f64, (before, after): (Extrapolation, Extrapolation)) -> Option<f64> {
    let next = points.partition_point(|point| point.0 < place);
    if let Some(&(x, y)) = points.get(next)
        && x == place
    {
        return Some(y).filter(|y| y.is_finite());
    }
    let (end, beyond) = match next {
        0 => (points.first()?, before),
        _ => points.get(next).map_or((points.last()?, after), |right| (right, Extrapolation::Line(0.0))),
    };
    let value = match beyond {
        Extrapolation::Nothing => None,
        Extrapolation::EndValue => (!place.is_nan()).then_some(end.1),
        Extrapolation::Line(most) => {
            let right = next.min(points.len() - 1).max(1);
            let ((x0, y0), (x1, y1)) = (points[right - 1], *points.get(right)?);
            let distance = (x0 - place).max(place - x1) / (x1 - x0);
            (distance <= most).then(|| y0 + (y1 - y0) * (place - x0) / (x1 - x0))
        }
    };
    value.filter(|value| value.is_finite())
}
