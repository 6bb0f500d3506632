//! The back end that every x86-64 processor has: SSE2, eight f64 lanes as four registers, eight f32 lanes as two.
//!
//! The compiler would make the same of [`super::portable`]; written as vectors, the passes take a quarter of the time to
//! compile.
#![expect(unsafe_code, reason = "loads and stores through pointers; no instruction needs to be asked for")]

use super::single::lane_by_lane as single_lane_by_lane;
use super::{FlatRecords, LANES, LaneIndices, Lanes, Real, SingleLanes};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy)]
pub(super) struct Sse2([__m128d; 4]);

#[derive(Clone, Copy)]
pub(super) struct Sse2Single([__m128; 2]);

/// An array of what `value` is for each register.
macro_rules! four {
    ($k:ident => $value:expr) => {
        [
            {
                let $k = 0;
                $value
            },
            {
                let $k = 1;
                $value
            },
            {
                let $k = 2;
                $value
            },
            {
                let $k = 3;
                $value
            },
        ]
    };
}

macro_rules! lane_wise {
    ($($trait:ident $method:ident $double:ident $single:ident),*) => {$(
        impl $trait for Sse2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: every x86-64 processor has SSE2.
                Self(unsafe { four!(k => $double(self.0[k], other.0[k])) })
            }
        }
        impl $trait for Sse2Single {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: every x86-64 processor has SSE.
                Self(unsafe { [$single(self.0[0], other.0[0]), $single(self.0[1], other.0[1])] })
            }
        }
    )*};
}
lane_wise!(
    Add add _mm_add_pd _mm_add_ps,
    Sub sub _mm_sub_pd _mm_sub_ps,
    Mul mul _mm_mul_pd _mm_mul_ps,
    Div div _mm_div_pd _mm_div_ps
);

impl Neg for Sse2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe { four!(k => _mm_xor_pd(self.0[k], _mm_set1_pd(-0.0))) })
    }
}

impl Neg for Sse2Single {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: every x86-64 processor has SSE.
        Self(unsafe { self.0.map(|half| _mm_xor_ps(half, _mm_set1_ps(-0.0))) })
    }
}

impl Real for Sse2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe { [_mm_set1_pd(value); 4] })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe { four!(k => _mm_sqrt_pd(self.0[k])) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: every x86-64 processor has SSE2. MAXPD is `a > b ? a : b`.
        Self(unsafe { four!(k => _mm_max_pd(self.0[k], other.0[k])) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: every x86-64 processor has SSE2. MINPD is `a < b ? a : b`.
        Self(unsafe { four!(k => _mm_min_pd(self.0[k], other.0[k])) })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe {
            four!(k => {
                let less = _mm_cmplt_pd(a.0[k], b.0[k]);
                _mm_or_pd(_mm_and_pd(less, self.0[k]), _mm_andnot_pd(less, other.0[k]))
            })
        })
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        super::lane_by_lane(values, function)
    }
}

impl Lanes for Sse2 {
    type Single = Sse2Single;

    #[inline(always)]
    fn widen(single: Sse2Single) -> Self {
        let [near, far] = single.0;
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe {
            [
                _mm_cvtps_pd(near),
                _mm_cvtps_pd(_mm_movehl_ps(near, near)),
                _mm_cvtps_pd(far),
                _mm_cvtps_pd(_mm_movehl_ps(far, far)),
            ]
        })
    }

    #[inline(always)]
    fn narrow(self) -> Sse2Single {
        let [a, b, c, d] = self.0;
        // SAFETY: every x86-64 processor has SSE2.
        Sse2Single(unsafe {
            [_mm_movelh_ps(_mm_cvtpd_ps(a), _mm_cvtpd_ps(b)), _mm_movelh_ps(_mm_cvtpd_ps(c), _mm_cvtpd_ps(d))]
        })
    }

    #[inline(always)]
    fn gather_records(source: FlatRecords<'_>, indices: &LaneIndices, offset: usize) -> Self {
        assert!(source.records >= indices.bound && offset < source.stride, "array shorter than its index bound");
        let value = |lane: usize| {
            // SAFETY: raw < bound ≤ records and offset < stride, so the element lies inside the borrowed slice.
            unsafe { *source.first.add(indices.raw[lane] as usize * source.stride + offset) }
        };
        // SAFETY: every x86-64 processor has SSE2.
        Self(unsafe { four!(k => _mm_set_pd(value(2 * k + 1), value(2 * k))) })
    }

    #[inline(always)]
    fn load_pairs(source: FlatRecords<'_>, indices: &LaneIndices<'_>) -> [Self; 2] {
        assert!(source.records >= indices.bound && source.stride == 2, "array shorter than its index bound");
        // SAFETY: raw < bound ≤ records, so every record lies inside the borrowed slice.
        unsafe {
            let load = |lane: usize| _mm_loadu_pd(source.first.add(indices.raw[lane] as usize * 2));
            let rows = four!(k => (load(2 * k), load(2 * k + 1)));
            [
                Self(four!(k => _mm_unpacklo_pd(rows[k].0, rows[k].1))),
                Self(four!(k => _mm_unpackhi_pd(rows[k].0, rows[k].1))),
            ]
        }
    }

    #[inline(always)]
    fn load_quads(source: &[[f64; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        assert!(source.len() >= indices.bound * stride && offset < stride, "array shorter than its index bound");
        // SAFETY: raw < bound and offset < stride, so every record lies inside the slice.
        unsafe {
            let load = |lane: usize| {
                let record: *const f64 = source.as_ptr().add(indices.raw[lane] as usize * stride + offset).cast();
                (_mm_loadu_pd(record), _mm_loadu_pd(record.add(2)))
            };
            let rows = four!(k => (load(2 * k), load(2 * k + 1)));
            [
                Self(four!(k => _mm_unpacklo_pd(rows[k].0.0, rows[k].1.0))),
                Self(four!(k => _mm_unpackhi_pd(rows[k].0.0, rows[k].1.0))),
                Self(four!(k => _mm_unpacklo_pd(rows[k].0.1, rows[k].1.1))),
                Self(four!(k => _mm_unpackhi_pd(rows[k].0.1, rows[k].1.1))),
            ]
        }
    }

    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: the array holds eight values, two a load.
        Self(unsafe { four!(k => _mm_loadu_pd(values.as_ptr().add(2 * k))) })
    }

    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        Self::widen(Sse2Single::load(values))
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        // SAFETY: every x86-64 processor has SSE2.
        let [a, b, c, d] = unsafe { four!(k => _mm_movemask_pd(_mm_cmplt_pd(self.0[k], other.0[k]))) };
        (a | (b << 2) | (c << 4) | (d << 6)).cast_unsigned()
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        for (k, part) in self.0.into_iter().enumerate() {
            // SAFETY: the array holds eight values, two a store.
            unsafe { _mm_storeu_pd(lanes.as_mut_ptr().add(2 * k), part) };
        }
        lanes
    }

    #[inline(always)]
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize) {
        assert!(offset < stride, "a quad beyond its record");
        let [x, y, z, w] = quads.map(|quad| quad.0);
        // SAFETY: register shuffles only.
        let rows = unsafe {
            four!(k => [
                (_mm_unpacklo_pd(x[k], y[k]), _mm_unpacklo_pd(z[k], w[k])),
                (_mm_unpackhi_pd(x[k], y[k]), _mm_unpackhi_pd(z[k], w[k])),
            ])
        };
        for (lane, record) in out.chunks_exact_mut(stride).enumerate().take(LANES) {
            let (start, end) = rows[lane / 2][lane % 2];
            let place = record[offset].as_mut_ptr();
            // SAFETY: the quad holds four values, two a store.
            unsafe {
                _mm_storeu_pd(place, start);
                _mm_storeu_pd(place.add(2), end);
            }
        }
    }
}

impl Real for Sse2Single {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: every x86-64 processor has SSE.
        Self(unsafe { [_mm_set1_ps(value as f32); 2] })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: every x86-64 processor has SSE.
        Self(unsafe { [_mm_sqrt_ps(self.0[0]), _mm_sqrt_ps(self.0[1])] })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: every x86-64 processor has SSE. MAXPS is `a > b ? a : b`.
        Self(unsafe { [_mm_max_ps(self.0[0], other.0[0]), _mm_max_ps(self.0[1], other.0[1])] })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: every x86-64 processor has SSE. MINPS is `a < b ? a : b`.
        Self(unsafe { [_mm_min_ps(self.0[0], other.0[0]), _mm_min_ps(self.0[1], other.0[1])] })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        let choose = |k: usize| {
            // SAFETY: every x86-64 processor has SSE.
            unsafe {
                let less = _mm_cmplt_ps(a.0[k], b.0[k]);
                _mm_or_ps(_mm_and_ps(less, self.0[k]), _mm_andnot_ps(less, other.0[k]))
            }
        };
        Self([choose(0), choose(1)])
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        single_lane_by_lane(values, function)
    }
}

impl SingleLanes for Sse2Single {
    #[inline(always)]
    fn load_quads(source: &[[f32; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        assert!(source.len() >= indices.bound * stride && offset < stride, "array shorter than its index bound");
        // SAFETY: raw < bound and offset < stride, so every record lies inside the slice.
        unsafe {
            let load =
                |lane: usize| _mm_loadu_ps(source.as_ptr().add(indices.raw[lane] as usize * stride + offset).cast());
            let transposed = |first: usize| {
                let rows = four!(k => load(first + k));
                let (a, b) = (_mm_unpacklo_ps(rows[0], rows[1]), _mm_unpackhi_ps(rows[0], rows[1]));
                let (c, d) = (_mm_unpacklo_ps(rows[2], rows[3]), _mm_unpackhi_ps(rows[2], rows[3]));
                [_mm_movelh_ps(a, c), _mm_movehl_ps(c, a), _mm_movelh_ps(b, d), _mm_movehl_ps(d, b)]
            };
            let (near, far) = (transposed(0), transposed(4));
            four!(k => Self([near[k], far[k]]))
        }
    }

    #[inline(always)]
    fn load(values: &[f32; LANES]) -> Self {
        // SAFETY: the array holds eight values, four a load.
        Self(unsafe { [_mm_loadu_ps(values.as_ptr()), _mm_loadu_ps(values.as_ptr().add(4))] })
    }

    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: the array holds eight values, four a store.
        unsafe {
            _mm_storeu_ps(lanes.as_mut_ptr(), self.0[0]);
            _mm_storeu_ps(lanes.as_mut_ptr().add(4), self.0[1]);
        }
        lanes
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        // SAFETY: every x86-64 processor has SSE.
        let mask = |k: usize| unsafe { _mm_movemask_ps(_mm_cmplt_ps(self.0[k], other.0[k])) };
        (mask(0) | (mask(1) << 4)).cast_unsigned()
    }

    #[inline(always)]
    fn fixed_difference(self, other: Self) -> Self {
        let difference = |k: usize| {
            // SAFETY: every x86-64 processor has SSE2.
            unsafe { _mm_cvtepi32_ps(_mm_sub_epi32(_mm_castps_si128(self.0[k]), _mm_castps_si128(other.0[k]))) }
        };
        Self([difference(0), difference(1)])
    }
}
