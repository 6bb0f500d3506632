//! Eight f32 lanes: what a pair is made of. Sums over pairs are widened to f64 every few pairs.
#![expect(unsafe_code, reason = "unchecked loads behind one length check")]

use super::{LANES, LaneIndices, Real};
use std::ops::{Add, Div, Mul, Neg, Sub};

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

/// The back end for any processor.
#[derive(Clone, Copy)]
pub(super) struct PortableSingle([f32; LANES]);

macro_rules! lane_wise {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for PortableSingle {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $operator b)
            }
        }
    )*};
}
lane_wise!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for PortableSingle {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl PortableSingle {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let mut lanes = self.0;
        for k in 0..LANES {
            lanes[k] = f(self.0[k], other.0[k]);
        }
        Self(lanes)
    }
}

impl Real for PortableSingle {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value as f32; LANES])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        let mut lanes = self.0;
        for k in 0..LANES {
            lanes[k] = if a.0[k] < b.0[k] { lanes[k] } else { other.0[k] };
        }
        Self(lanes)
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        lane_by_lane(values, function)
    }
}

impl SingleLanes for PortableSingle {
    #[inline(always)]
    fn load_quads(source: &[[f32; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        assert!(source.len() >= indices.bound * stride && offset < stride, "array shorter than its index bound");
        let mut quads = [Self([0.0; LANES]); 4];
        for lane in 0..LANES {
            // SAFETY: raw < bound and offset < stride, so the record lies inside the slice.
            let record = unsafe { source.get_unchecked(indices.raw[lane] as usize * stride + offset) };
            for k in 0..4 {
                quads[k].0[lane] = record[k];
            }
        }
        quads
    }

    #[inline(always)]
    fn load(values: &[f32; LANES]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        self.0
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        let mut mask = 0;
        for k in 0..LANES {
            mask |= u32::from(self.0[k] < other.0[k]) << k;
        }
        mask
    }

    #[inline(always)]
    fn fixed_difference(self, other: Self) -> Self {
        self.zip(other, |a, b| a.to_bits().wrapping_sub(b.to_bits()).cast_signed() as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_fixed_positions_wrap() {
        let fixed = |value: i32| PortableSingle::load(&[f32::from_bits(value.cast_unsigned()); LANES]);
        let difference = |a, b| fixed(a).fixed_difference(fixed(b)).to_array()[0];
        assert_eq!(difference(7, 12), -5.0);
        assert_eq!(difference(i32::MIN + 2, i32::MAX - 1), 4.0);
        // an integer of more than 24 bits is rounded once
        assert_eq!(difference((1 << 25) + 1, 0), (1 << 25) as f32);
    }
}
