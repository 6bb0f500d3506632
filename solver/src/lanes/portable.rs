//! The back end for any processor: vectors of the crate `wide`, which are SSE2 on plain x86-64.

use super::{LANES, LaneIndices, LaneNumbers, Lanes, Real, SingleLanes, lane_by_lane};
use std::ops::{Add, Div, Mul, Neg, Sub};
use wide::bytemuck::cast;
use wide::{f32x8, f64x2, f64x8, i32x8};

macro_rules! lanes {
    ($name:ident of $vector:ident of $number:ident, $transposed:ident, $($trait:ident $method:ident),*) => {
        #[derive(Clone, Copy)]
        pub(super) struct $name($vector);

        $(impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        })*

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Real for $name {
            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self($vector::splat(value as $number))
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }

            #[inline(always)]
            fn if_less(self, a: Self, b: Self, other: Self) -> Self {
                Self(a.0.simd_lt(b.0).select(self.0, other.0))
            }

            #[inline(always)]
            fn any_less(self, other: Self) -> bool {
                self.less_mask(other) != 0
            }

            fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
                lane_by_lane(values, function)
            }
        }

        impl LaneNumbers for $name {
            type Number = $number;

            #[inline(always)]
            fn load_quads(
                source: &[[$number; 4]],
                stride: usize,
                offset: usize,
                indices: &LaneIndices<'_>,
            ) -> [Self; 4] {
                $transposed(indices.entries(source, stride, offset)).map(Self)
            }

            #[inline(always)]
            fn load(values: &[$number; LANES]) -> Self {
                Self((*values).into())
            }

            #[inline(always)]
            fn to_array(self) -> [$number; LANES] {
                self.0.to_array()
            }

            #[inline(always)]
            fn less_mask(self, other: Self) -> u32 {
                self.0.simd_lt(other.0).to_bitmask()
            }
        }
    };
}
lanes!(Portable of f64x8 of f64, doubles, Add add, Sub sub, Mul mul, Div div);
lanes!(PortableSingle of f32x8 of f32, singles, Add add, Sub sub, Mul mul, Div div);

/// The transpose of eight records of four.
#[inline(always)]
fn doubles(records: [&[f64; 4]; LANES]) -> [f64x8; 4] {
    let mut quads = [[f64x2::ZERO; LANES / 2]; 4];
    for two in 0..LANES / 2 {
        for k in [0, 2] {
            let half = |lane: usize| f64x2::new([records[lane][k], records[lane][k + 1]]);
            [quads[k][two], quads[k + 1][two]] = f64x2::transpose([half(2 * two), half(2 * two + 1)]);
        }
    }
    quads.map(cast)
}

#[inline(always)]
fn singles(records: [&[f32; 4]; LANES]) -> [f32x8; 4] {
    let mut quads = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        for k in 0..4 {
            quads[k][lane] = records[lane][k];
        }
    }
    quads.map(f32x8::new)
}

impl SingleLanes for PortableSingle {
    #[inline(always)]
    fn fixed_difference(self, other: Self) -> Self {
        Self((cast::<_, i32x8>(self.0) - cast::<_, i32x8>(other.0)).round_float())
    }
}

impl Lanes for Portable {
    type Single = PortableSingle;

    #[inline(always)]
    fn widen(single: PortableSingle) -> Self {
        Self(single.to_array().map(f64::from).into())
    }

    #[inline(always)]
    fn narrow(self) -> PortableSingle {
        PortableSingle(self.to_array().map(|value| value as f32).into())
    }

    #[inline(always)]
    fn load_pairs(records: [&[f64; 2]; LANES]) -> [Self; 2] {
        let mut pairs = [[0.0; LANES]; 2];
        for lane in 0..LANES {
            for k in 0..2 {
                pairs[k][lane] = records[lane][k];
            }
        }
        pairs.map(|values| Self(values.into()))
    }

    #[inline(always)]
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize) {
        assert!(offset < stride, "a quad beyond its record");
        let quads = quads.map(Self::to_array);
        for (lane, record) in out.chunks_exact_mut(stride).enumerate().take(LANES) {
            for k in 0..4 {
                record[offset][k] = quads[k][lane];
            }
        }
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
