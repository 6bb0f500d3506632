//! Eight f32 lanes: what a pair is made of. Sums over pairs are widened to f64 every few pairs.

use super::{LANES, LaneIndices, Real};

/// Eight f32 values with lane-wise arithmetic.
pub trait SingleLanes: Real {
    /// [`super::Lanes::load_quads`] of records of f32.
    fn load_quads(source: &[[f32; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4];
    /// Eight values in order.
    fn load(values: &[f32; LANES]) -> Self;
    /// The lanes in order.
    fn to_array(self) -> [f32; LANES];
    /// Bit k is set where `self < other` in lane k.
    fn less_mask(self, other: Self) -> u32;
    /// The lanes' bits taken as integers of 32 bits: their difference, which wraps, as f32.
    fn fixed_difference(self, other: Self) -> Self;
}

/// [`Real::lane_by_lane`] of the back ends: by f64, rounded at the end.
#[inline(always)]
pub(super) fn lane_by_lane<S: SingleLanes, const N: usize>(values: [S; N], function: &dyn Fn([f64; N]) -> f64) -> S {
    let arguments = values.map(S::to_array);
    let mut lanes = [0.0; LANES];
    for lane in 0..LANES {
        lanes[lane] = function(arguments.map(|values| f64::from(values[lane]))) as f32;
    }
    S::load(&lanes)
}
