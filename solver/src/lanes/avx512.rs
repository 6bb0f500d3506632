//! The AVX-512 back end: one register of eight lanes.
#![expect(unsafe_code, reason = "vector intrinsics; a value of this type exists only after the processor was asked")]

use super::avx2::pairs;
use super::x86_single::Single;
use super::{FlatRecords, InstructionSet, LANES, LaneIndices, LanePass, Lanes, Level, Real};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Runs a pass with AVX-512.
#[inline]
pub(super) fn run<P: LanePass>(pass: P, set: InstructionSet) {
    #[target_feature(enable = "avx512f,avx512vl,popcnt")]
    fn inner<P: LanePass>(pass: P) {
        pass.run::<Avx512>();
    }
    assert!(set.0 == Level::Avx512, "instruction set was not detected");
    // SAFETY: an InstructionSet of this level is made only where the processor reported the features.
    unsafe { inner(pass) }
}

#[derive(Clone, Copy)]
pub(super) struct Avx512(__m512d);

macro_rules! lane_wise {
    ($($trait:ident $method:ident $wide:ident),*) => {$(
        impl $trait for Avx512 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: values of this type exist only inside `run`.
                Self(unsafe { $wide(self.0, other.0) })
            }
        }
    )*};
}
lane_wise!(Add add _mm512_add_pd, Sub sub _mm512_sub_pd, Mul mul _mm512_mul_pd, Div div _mm512_div_pd);

impl Neg for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe {
            let sign = _mm512_castpd_si512(_mm512_set1_pd(-0.0));
            Self(_mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(self.0), sign)))
        }
    }
}

impl Real for Avx512 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called from passes inside run only.
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MAXPD is `a > b ? a : b`.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MINPD is `a < b ? a : b`.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe { Self(_mm512_mask_mov_pd(other.0, _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a.0, b.0), self.0)) }
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        super::lane_by_lane(values, function)
    }
}

impl Lanes for Avx512 {
    type Single = Single;

    #[inline(always)]
    fn widen(single: Single) -> Self {
        // SAFETY: values of these types exist only inside run.
        Self(unsafe { _mm512_cvtps_pd(single.0) })
    }

    #[inline(always)]
    fn narrow(self) -> Single {
        // SAFETY: values of this type exist only inside run.
        Single(unsafe { _mm512_cvtpd_ps(self.0) })
    }

    #[inline(always)]
    fn gather_records(source: FlatRecords<'_>, indices: &LaneIndices, offset: usize) -> Self {
        assert!(source.records >= indices.bound && offset < source.stride, "array shorter than its index bound");
        let mut lanes = [0.0; LANES];
        for (lane, raw) in lanes.iter_mut().zip(indices.raw) {
            // SAFETY: raw < bound ≤ records and offset < stride, so the element lies inside the borrowed slice.
            *lane = unsafe { *source.first.add(*raw as usize * source.stride + offset) };
        }
        // SAFETY: the array holds eight values.
        unsafe { Self(_mm512_loadu_pd(lanes.as_ptr())) }
    }

    #[inline(always)]
    fn load_pairs(source: FlatRecords<'_>, indices: &LaneIndices<'_>) -> [Self; 2] {
        let [x, y] = pairs(source, indices);
        // SAFETY: values of this type exist only inside run.
        let join = |low, high| unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high) };
        [Self(join(x.0, x.1)), Self(join(y.0, y.1))]
    }

    #[inline(always)]
    fn load_quads(source: &[[f64; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        assert!(source.len() >= indices.bound * stride && offset < stride, "array shorter than its index bound");
        // SAFETY: raw < bound and offset < stride, so every record lies inside the slice.
        unsafe {
            let load =
                |lane: usize| _mm256_loadu_pd(source.as_ptr().add(indices.raw[lane] as usize * stride + offset).cast());
            let pair = |low: __m256d, high: __m256d| _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high);
            let rows = [pair(load(0), load(4)), pair(load(1), load(5)), pair(load(2), load(6)), pair(load(3), load(7))];
            // a 4 × 4 transpose in each half
            let (a, b) = (_mm512_unpacklo_pd(rows[0], rows[1]), _mm512_unpackhi_pd(rows[0], rows[1]));
            let (c, d) = (_mm512_unpacklo_pd(rows[2], rows[3]), _mm512_unpackhi_pd(rows[2], rows[3]));
            let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            [
                Self(_mm512_permutex2var_pd(a, low, c)),
                Self(_mm512_permutex2var_pd(b, low, d)),
                Self(_mm512_permutex2var_pd(a, high, c)),
                Self(_mm512_permutex2var_pd(b, high, d)),
            ]
        }
    }

    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: the array holds eight values.
        Self(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        // SAFETY: the array holds eight values.
        Self(unsafe { _mm512_cvtps_pd(_mm256_loadu_ps(values.as_ptr())) })
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        // SAFETY: values of this type exist only inside run.
        unsafe { u32::from(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn pack(indices: &[u32; LANES], mask: u32, excluded: u32, out: &mut [u32; LANES]) -> usize {
        // SAFETY: called from passes inside run only; both arrays hold eight values.
        unsafe {
            let all = _mm256_loadu_si256(indices.as_ptr().cast());
            let kept = mask as u8 & _mm256_cmpneq_epi32_mask(all, _mm256_set1_epi32(excluded.cast_signed()));
            _mm256_storeu_si256(out.as_mut_ptr().cast(), _mm256_maskz_compress_epi32(kept, all));
            kept.count_ones() as usize
        }
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: the array holds eight values.
        unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), self.0) };
        lanes
    }

    #[inline(always)]
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize) {
        assert!(offset < stride, "a quad beyond its record");
        // SAFETY: register shuffles only; the stores go through slices.
        unsafe {
            let [x, y, z, w] = [quads[0].0, quads[1].0, quads[2].0, quads[3].0];
            let (a, b) = (_mm512_unpacklo_pd(x, y), _mm512_unpackhi_pd(x, y));
            let (c, d) = (_mm512_unpacklo_pd(z, w), _mm512_unpackhi_pd(z, w));
            let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            let rows = [
                _mm512_permutex2var_pd(a, low, c),
                _mm512_permutex2var_pd(b, low, d),
                _mm512_permutex2var_pd(a, high, c),
                _mm512_permutex2var_pd(b, high, d),
            ];
            for (lane, record) in out.chunks_exact_mut(stride).enumerate().take(LANES) {
                let row = rows[lane % 4];
                let half = if lane < 4 { _mm512_castpd512_pd256(row) } else { _mm512_extractf64x4_pd::<1>(row) };
                _mm256_storeu_pd(record[offset].as_mut_ptr(), half);
            }
        }
    }
}
