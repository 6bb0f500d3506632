//! Tables of values over time, by which walls move and turn.

use crate::vector::Vector;

/// Value of a table at a time `[s]`, linear between its times and constant beyond them; zero of an empty one.
pub(super) fn value_at<const N: usize>(times: &[f64], values: &[Vector<N>], time: f64) -> Vector<N> {
    match times.partition_point(|&t| t <= time) {
        0 => values.first().copied().unwrap_or_else(Vector::zeros),
        k if k == times.len() => values.last().copied().unwrap_or_else(Vector::zeros),
        k => {
            let part = (time - times[k - 1]) / (times[k] - times[k - 1]);
            values[k - 1] + (values[k] - values[k - 1]) * part
        }
    }
}

/// Slope of a table right after a time `[s]`; none beyond its times.
pub(super) fn slope_at<const N: usize>(times: &[f64], values: &[Vector<N>], time: f64) -> Option<Vector<N>> {
    let after = times.partition_point(|&t| t <= time);
    (after > 0 && after < times.len()).then(|| (values[after] - values[after - 1]) / (times[after] - times[after - 1]))
}

/// Whether the times of a table rise and all is finite.
pub(super) fn is_sound<const N: usize>(times: &[f64], values: &[Vector<N>]) -> bool {
    let finite = times.iter().all(|t| t.is_finite()) && values.iter().all(|d| d.sum().is_finite());
    finite && times.len() == values.len() && times.windows(2).all(|pair| pair[1] > pair[0])
}
