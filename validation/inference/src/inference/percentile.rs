//! Percentiles of lists, and of each coordinate of points.

use super::region::CENTRAL;

/// Intervals that hold 95 % of each coordinate of some points, as many left out below as above.
pub fn middles(points: &[Vec<f64>], coordinates: usize) -> Vec<[f64; 2]> {
    let middle = |k: usize| {
        let mut values: Vec<f64> = points.iter().map(|point| point[k]).collect();
        values.sort_by(f64::total_cmp);
        CENTRAL.map(|share| percentile(&values, share))
    };
    (0..coordinates).map(middle).collect()
}

/// The value below which a share of a sorted list lies, between neighbours in proportion; not a number in an empty
/// list.
pub fn percentile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}
