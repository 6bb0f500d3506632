//! Percentiles of each coordinate of points.

use super::region::CENTRAL;
use crate::statistics::percentile;

/// Intervals that hold 95 % of each coordinate of some points, as many left out below as above.
pub fn middles(points: &[Vec<f64>], coordinates: usize) -> Vec<[f64; 2]> {
    let middle = |k: usize| {
        let mut values: Vec<f64> = points.iter().map(|point| point[k]).collect();
        values.sort_by(f64::total_cmp);
        CENTRAL.map(|share| percentile(&values, share))
    };
    (0..coordinates).map(middle).collect()
}
