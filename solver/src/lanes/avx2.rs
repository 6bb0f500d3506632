//! The AVX2 back end: two registers of four f64 lanes, one of eight f32 lanes.
#![expect(unsafe_code, reason = "vector intrinsics; a value of these types exists only after the processor was asked")]

use super::{InstructionSet, LANES, LaneIndices, LaneNumbers, LanePass, Lanes, Level, Real, SingleLanes, lane_by_lane};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Runs a pass with AVX2.
#[inline]
pub(super) fn run<P: LanePass>(pass: P, set: InstructionSet) {
    #[target_feature(enable = "avx2,popcnt")]
    fn inner<P: LanePass>(pass: P) {
        pass.run::<Avx2>();
    }
    assert!(set.0 == Level::Avx2, "instruction set was not detected");
    // SAFETY: an InstructionSet of this level is made only where the processor reported the features.
    unsafe { inner(pass) }
}

#[derive(Clone, Copy)]
pub(super) struct Avx2(__m256d, __m256d);

#[derive(Clone, Copy)]
pub(super) struct Avx2Single(__m256);

macro_rules! lane_wise {
    ($($trait:ident $method:ident $half:ident $single:ident),*) => {$(
        impl $trait for Avx2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: values of this type exist only inside run.
                unsafe { Self($half(self.0, other.0), $half(self.1, other.1)) }
            }
        }
        impl $trait for Avx2Single {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: values of this type exist only inside run.
                Self(unsafe { $single(self.0, other.0) })
            }
        }
    )*};
}
lane_wise!(
    Add add _mm256_add_pd _mm256_add_ps,
    Sub sub _mm256_sub_pd _mm256_sub_ps,
    Mul mul _mm256_mul_pd _mm256_mul_ps,
    Div div _mm256_div_pd _mm256_div_ps
);

impl Neg for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_xor_pd(self.0, sign), _mm256_xor_pd(self.1, sign))
        }
    }
}

impl Real for Avx2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called from passes inside run only.
        unsafe { Self(_mm256_set1_pd(value), _mm256_set1_pd(value)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe { Self(_mm256_sqrt_pd(self.0), _mm256_sqrt_pd(self.1)) }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MAXPD is `a > b ? a : b`.
        unsafe { Self(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MINPD is `a < b ? a : b`.
        unsafe { Self(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe {
            Self(
                _mm256_blendv_pd(other.0, self.0, _mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0)),
                _mm256_blendv_pd(other.1, self.1, _mm256_cmp_pd::<_CMP_LT_OQ>(a.1, b.1)),
            )
        }
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less_mask(other) != 0
    }

    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        lane_by_lane(values, function)
    }
}

impl LaneNumbers for Avx2 {
    type Number = f64;

    #[inline(always)]
    fn load_quads(source: &[[f64; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        let records = indices.entries(source, stride, offset);
        // SAFETY: a record holds four values.
        unsafe {
            let load = |lane: usize| _mm256_loadu_pd(records[lane].as_ptr());
            let [a, b, c, d] = transposed(load(0), load(1), load(2), load(3));
            let [e, f, g, h] = transposed(load(4), load(5), load(6), load(7));
            [Self(a, e), Self(b, f), Self(c, g), Self(d, h)]
        }
    }

    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: the array holds eight values, four a load.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) }, unsafe { _mm256_loadu_pd(values.as_ptr().add(4)) })
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: the array holds eight values, four a store.
        unsafe {
            _mm256_storeu_pd(lanes.as_mut_ptr(), self.0);
            _mm256_storeu_pd(lanes.as_mut_ptr().add(4), self.1);
        }
        lanes
    }

    #[inline(always)]
    fn less_mask(self, other: Self) -> u32 {
        // SAFETY: values of this type exist only inside run.
        unsafe {
            let near = _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0));
            let far = _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.1, other.1));
            (near | (far << 4)).cast_unsigned()
        }
    }
}

impl Lanes for Avx2 {
    type Single = Avx2Single;

    #[inline(always)]
    fn widen(single: Avx2Single) -> Self {
        // SAFETY: values of these types exist only inside run.
        unsafe {
            let (low, high) = (_mm256_castps256_ps128(single.0), _mm256_extractf128_ps::<1>(single.0));
            Self(_mm256_cvtps_pd(low), _mm256_cvtps_pd(high))
        }
    }

    #[inline(always)]
    fn narrow(self) -> Avx2Single {
        // SAFETY: values of this type exist only inside run.
        Avx2Single(unsafe { _mm256_set_m128(_mm256_cvtpd_ps(self.1), _mm256_cvtpd_ps(self.0)) })
    }

    #[inline(always)]
    fn load_pairs(records: [&[f64; 2]; LANES]) -> [Self; 2] {
        // SAFETY: a record holds two values; called from passes inside run only.
        unsafe {
            let load = |lane: usize| _mm_loadu_pd(records[lane].as_ptr());
            let (a, b) = (_mm256_set_m128d(load(2), load(0)), _mm256_set_m128d(load(3), load(1)));
            let (c, d) = (_mm256_set_m128d(load(6), load(4)), _mm256_set_m128d(load(7), load(5)));
            let x = Self(_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d));
            let y = Self(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d));
            [x, y]
        }
    }

    #[inline(always)]
    fn pack(indices: &[u32; LANES], mask: u32, excluded: u32, out: &mut [u32; LANES]) -> usize {
        // SAFETY: called from passes inside run only; both arrays hold eight values, and an entry of the table eight bytes.
        unsafe {
            let all = _mm256_loadu_si256(indices.as_ptr().cast());
            let same = _mm256_cmpeq_epi32(all, _mm256_set1_epi32(excluded.cast_signed()));
            let kept = mask as u8 & !_mm256_movemask_ps(_mm256_castsi256_ps(same)) as u8;
            let order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(FIRST_BITS[usize::from(kept)].as_ptr().cast()));
            _mm256_storeu_si256(out.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(all, order));
            kept.count_ones() as usize
        }
    }

    #[inline(always)]
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize) {
        assert!(offset < stride, "a quad beyond its record");
        // SAFETY: register shuffles only; the stores go through slices.
        unsafe {
            let near = transposed(quads[0].0, quads[1].0, quads[2].0, quads[3].0);
            let far = transposed(quads[0].1, quads[1].1, quads[2].1, quads[3].1);
            for (lane, record) in out.chunks_exact_mut(stride).enumerate().take(LANES) {
                let row = if lane < 4 { near[lane] } else { far[lane - 4] };
                _mm256_storeu_pd(record[offset].as_mut_ptr(), row);
            }
        }
    }
}

impl Neg for Avx2Single {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe { Self(_mm256_xor_ps(self.0, _mm256_set1_ps(-0.0))) }
    }
}

impl Real for Avx2Single {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called from passes inside run only.
        Self(unsafe { _mm256_set1_ps(value as f32) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: values of this type exist only inside run.
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MAXPS is `a > b ? a : b`.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run. MINPS is `a < b ? a : b`.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run.
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

impl LaneNumbers for Avx2Single {
    type Number = f32;

    #[inline(always)]
    fn load_quads(source: &[[f32; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4] {
        let records = indices.entries(source, stride, offset);
        // SAFETY: a record holds four values.
        unsafe {
            let load = |lane: usize| _mm_loadu_ps(records[lane].as_ptr());
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
        // SAFETY: values of this type exist only inside run.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0)).cast_unsigned() }
    }
}

impl SingleLanes for Avx2Single {
    #[inline(always)]
    fn fixed_difference(self, other: Self) -> Self {
        // SAFETY: values of this type exist only inside run.
        unsafe {
            let difference = _mm256_sub_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(other.0));
            Self(_mm256_cvtepi32_ps(difference))
        }
    }
}

/// For each mask of eight lanes, those whose bit is set, in order; zeros behind them.
static FIRST_BITS: [[u8; LANES]; 256] = {
    let mut table = [[0; LANES]; 256];
    let mut mask = 0;
    while mask < table.len() {
        let (mut lane, mut count) = (0, 0);
        while lane < LANES {
            if (mask >> lane) & 1 == 1 {
                table[mask][count] = lane as u8;
                count += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// The transpose of four rows.
///
/// # Safety
/// Needs AVX.
#[inline(always)]
unsafe fn transposed(r0: __m256d, r1: __m256d, r2: __m256d, r3: __m256d) -> [__m256d; 4] {
    // SAFETY: passed on to the caller.
    unsafe {
        let (a, b) = (_mm256_unpacklo_pd(r0, r1), _mm256_unpackhi_pd(r0, r1));
        let (c, d) = (_mm256_unpacklo_pd(r2, r3), _mm256_unpackhi_pd(r2, r3));
        [
            _mm256_permute2f128_pd::<0x20>(a, c),
            _mm256_permute2f128_pd::<0x20>(b, d),
            _mm256_permute2f128_pd::<0x31>(a, c),
            _mm256_permute2f128_pd::<0x31>(b, d),
        ]
    }
}
