//! The back end for any processor: arrays of eight.
#![expect(unsafe_code, reason = "unchecked gathers and loads behind one length check")]

use super::single::lane_by_lane as single_lane_by_lane;
use super::{FlatRecords, LANES, LaneIndices, Lanes, Real, SingleLanes};
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy)]
pub(super) struct Portable([f64; LANES]);

macro_rules! lane_wise {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for Portable {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut lanes = self.0;
                for k in 0..LANES {
                    lanes[k] = self.0[k] $operator other.0[k];
                }
                Self(lanes)
            }
        }
    )*};
}
lane_wise!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut lanes = self.0;
        for k in 0..LANES {
            lanes[k] = f(self.0[k], other.0[k]);
        }
        Self(lanes)
    }
}

impl Real for Portable {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
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
        super::lane_by_lane(values, function)
    }
}

impl Lanes for Portable {
    type Single = PortableSingle;

    #[inline(always)]
    fn widen(single: PortableSingle) -> Self {
        Self(single.to_array().map(f64::from))
    }

    #[inline(always)]
    fn narrow(self) -> PortableSingle {
        PortableSingle::load(&self.0.map(|value| value as f32))
    }

    #[inline(always)]
    fn gather_records(source: FlatRecords<'_>, indices: &LaneIndices, offset: usize) -> Self {
        assert!(source.records >= indices.bound && offset < source.stride, "array shorter than its index bound");
        let mut lanes = [0.0; LANES];
        for k in 0..LANES {
            // SAFETY: raw[k] < bound ≤ records and offset < stride, so the element lies inside the borrowed slice.
            lanes[k] = unsafe { *source.first.add(indices.raw[k] as usize * source.stride + offset) };
        }
        Self(lanes)
    }

    #[inline(always)]
    fn load_quads(source: &[[f64; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
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
    fn load(values: &[f64; LANES]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        let mut lanes = [0.0; LANES];
        for k in 0..LANES {
            lanes[k] = f64::from(values[k]);
        }
        Self(lanes)
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
    fn to_array(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize) {
        assert!(offset < stride, "a quad beyond its record");
        for (lane, record) in out.chunks_exact_mut(stride).enumerate().take(LANES) {
            for k in 0..4 {
                record[offset][k] = quads[k].0[lane];
            }
        }
    }
}

#[derive(Clone, Copy)]
pub(super) struct PortableSingle([f32; LANES]);

macro_rules! single_lane_wise {
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
single_lane_wise!(Add add +, Sub sub -, Mul mul *, Div div /);

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
        single_lane_by_lane(values, function)
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
