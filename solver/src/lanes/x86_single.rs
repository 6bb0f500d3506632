//! Eight f32 lanes in one register, for AVX2 and AVX-512 alike.
#![expect(unsafe_code, reason = "vector intrinsics; a value of this type exists only after the processor was asked")]

use super::single::lane_by_lane;
use super::{LANES, LaneIndices, Real, SingleLanes};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy)]
pub(super) struct Single(pub(super) __m256);

macro_rules! lane_wise {
    ($($trait:ident $method:ident $name:ident),*) => {$(
        impl $trait for Single {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: values of this type exist only inside `run` of the back ends.
                Self(unsafe { $name(self.0, other.0) })
            }
        }
    )*};
}
lane_wise!(Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);

impl Neg for Single {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends.
        unsafe { Self(_mm256_xor_ps(self.0, _mm256_set1_ps(-0.0))) }
    }
}

impl Real for Single {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called from passes inside `run` of the back ends only.
        Self(unsafe { _mm256_set1_ps(value as f32) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends.
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends. MAXPS is `a > b ? a : b`.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends. MINPS is `a < b ? a : b`.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends.
        unsafe { Self(_mm256_blendv_ps(other.0, self.0, _mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0))) }
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        lane_by_lane(values, function)
    }
}

impl SingleLanes for Single {
    #[inline(always)]
    fn load_quads(source: &[[f32; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        assert!(source.len() >= indices.bound * stride && offset < stride, "array shorter than its index bound");
        // SAFETY: raw < bound and offset < stride, so every record lies inside the slice.
        unsafe {
            let load =
                |lane: usize| _mm_loadu_ps(source.as_ptr().add(indices.raw[lane] as usize * stride + offset).cast());
            let pair = |low: __m128, high: __m128| _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high);
            let rows = [pair(load(0), load(4)), pair(load(1), load(5)), pair(load(2), load(6)), pair(load(3), load(7))];
            // a 4 × 4 transpose in each half
            let (a, b) = (_mm256_unpacklo_ps(rows[0], rows[1]), _mm256_unpackhi_ps(rows[0], rows[1]));
            let (c, d) = (_mm256_unpacklo_ps(rows[2], rows[3]), _mm256_unpackhi_ps(rows[2], rows[3]));
            [
                Self(_mm256_shuffle_ps::<0x44>(a, c)),
                Self(_mm256_shuffle_ps::<0xEE>(a, c)),
                Self(_mm256_shuffle_ps::<0x44>(b, d)),
                Self(_mm256_shuffle_ps::<0xEE>(b, d)),
            ]
        }
    }

    #[inline(always)]
    fn load(values: &[f32; LANES]) -> Self {
        // SAFETY: the array holds eight values.
        Self(unsafe { _mm256_loadu_ps(values.as_ptr()) })
    }

    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: the array holds eight values.
        unsafe { _mm256_storeu_ps(lanes.as_mut_ptr(), self.0) };
        lanes
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        // SAFETY: values of this type exist only inside `run` of the back ends.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0)).cast_unsigned() }
    }

    #[inline(always)]
    fn fixed_difference(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside `run` of the back ends.
        unsafe {
            let difference = _mm256_sub_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(other.0));
            Self(_mm256_cvtepi32_ps(difference))
        }
    }
}
