//! Eight f64 lanes with one meaning on every instruction set: the only place with `unsafe`.
//!
//! A pair sum is written once against [`Lanes`] and compiled for the back ends that `build.rs` names: AVX2 on x86-64, and one for any
//! processor. A release build has both, any other build the one of the machine that builds.
//! The best one of the processor is chosen at run time. The lane count, the absence of fused multiply–add and the meaning of
//! every operation are fixed here, so every back end gives the same bits. A lane is a particle: lanes are never summed.
//! Each back end has eight f32 lanes beside them, for what a pair is made of; sums over pairs are f64.

pub mod algebra;
#[cfg(with_avx2)]
mod avx2;
mod indices;
#[cfg(with_portable)]
mod portable;
mod real;
mod symmetric;

pub use indices::{CheckedIndices, LaneChunks, LaneIndices, LanePlaces};
pub use real::{Number, Real};
pub use symmetric::LaneTensors;
pub(crate) use symmetric::store_symmetric;

use crate::vector::{Tensor, Vector};

/// Number of lanes.
pub const LANES: usize = 8;

/// Eight numbers of one precision with lane-wise arithmetic.
pub trait LaneNumbers: Real {
    /// f64 or f32.
    type Number: Number;
    /// Loads four neighbouring values of eight records and transposes them: `result[k]` holds
    /// `source[index · stride + offset][k]` for eight indices.
    fn load_quads(source: &[[Self::Number; 4]], stride: usize, offset: usize, indices: &LaneIndices<'_>) -> [Self; 4];
    /// Eight values in order.
    fn load(values: &[Self::Number; LANES]) -> Self;
    /// The lanes in order.
    fn to_array(self) -> [Self::Number; LANES];
    /// Bit k is set where `self < other` in lane k.
    fn less_mask(self, other: Self) -> u32;
}

/// Eight f32 values: what a pair is made of. Sums over pairs are widened to f64 every few pairs.
pub trait SingleLanes: LaneNumbers<Number = f32> {
    /// The lanes' bits taken as integers of 32 bits: their difference, which wraps, as f32.
    fn fixed_difference(self, other: Self) -> Self;
}

/// Eight f64 values.
pub trait Lanes: LaneNumbers<Number = f64> {
    /// Eight f32 lanes of the same instruction set.
    type Single: SingleLanes;
    /// Eight f32 values as f64, exactly.
    fn widen(single: Self::Single) -> Self;
    /// The nearest f32 values.
    fn narrow(self) -> Self::Single;
    /// Both values of eight records of two: `result[k]` holds `records[lane][k]`.
    fn load_pairs(records: [&[f64; 2]; LANES]) -> [Self; 2];
    /// The transpose of [`LaneNumbers::load_quads`]: writes the four values of lane k to `out[k · stride + offset]` for as
    /// many lanes as `out` has records, at most eight.
    fn store_quads(quads: &[Self; 4], out: &mut [[f64; 4]], stride: usize, offset: usize);
    /// Packs the `indices` whose bit in `mask` is set, but not `excluded`, to the front of `out`, in order, and
    /// returns their number. What stands behind them in `out` is of no meaning.
    fn pack(indices: &[u32; LANES], mask: u32, excluded: u32, out: &mut [u32; LANES]) -> usize {
        let mut count = 0;
        for k in 0..LANES {
            out[count.min(LANES - 1)] = indices[k];
            count += usize::from((mask >> k) & 1 == 1 && indices[k] != excluded);
        }
        count
    }
}

/// [`Real::lane_by_lane`] of the back ends: by f64, rounded at the end.
#[inline(always)]
fn lane_by_lane<V: LaneNumbers, const N: usize>(values: [V; N], function: &dyn Fn([f64; N]) -> f64) -> V {
    let mut arguments = [[V::Number::of(0.0); LANES]; N];
    for n in 0..N {
        arguments[n] = values[n].to_array();
    }
    let mut lanes = [V::Number::of(0.0); LANES];
    for lane in 0..LANES {
        let mut argument = [0.0; N];
        for n in 0..N {
            argument[n] = arguments[n][lane].into();
        }
        lanes[lane] = V::Number::of(function(argument));
    }
    V::load(&lanes)
}

/// Gathers scalars, shape `[8]`.
#[inline(always)]
#[must_use]
pub fn gather<V: Lanes>(source: &[f64], indices: &LaneIndices<'_>) -> V {
    let entries = indices.entries(source, 1, 0);
    let mut values = [0.0; LANES];
    for lane in 0..LANES {
        values[lane] = *entries[lane];
    }
    V::load(&values)
}

/// Gathers vectors, shape `[D][8]`.
#[inline(always)]
#[must_use]
pub fn gather_vectors<V: Lanes, const D: usize>(source: &[Vector<D>], indices: &LaneIndices<'_>) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    if D == 2 {
        lanes.copy_from_slice(&V::load_pairs(indices.pairs(source)));
        return lanes;
    }
    let entries = indices.entries(source, 1, 0);
    for axis in 0..D {
        let mut values = [0.0; LANES];
        for lane in 0..LANES {
            values[lane] = entries[lane][axis];
        }
        lanes[axis] = V::load(&values);
    }
    lanes
}

/// Gathers tensors, shape `[D][D][8]`, indexed `[row][column]`.
#[inline(always)]
#[must_use]
pub fn gather_tensors<V: Lanes, const D: usize>(source: &[Tensor<D>], indices: &LaneIndices<'_>) -> [[V; D]; D] {
    let entries = indices.entries(source, 1, 0);
    let mut lanes = [[V::splat(0.0); D]; D];
    for row in 0..D {
        for column in 0..D {
            let mut values = [0.0; LANES];
            for lane in 0..LANES {
                values[lane] = entries[lane][(row, column)];
            }
            lanes[row][column] = V::load(&values);
        }
    }
    lanes
}

/// A computation over vector lanes. `run` must be `#[inline(always)]`, so that it is compiled for the chosen back end.
pub trait LanePass {
    /// The computation.
    fn run<V: Lanes>(self);
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    #[cfg(with_portable)]
    Portable,
    #[cfg(with_avx2)]
    Avx2,
}

/// All levels, slowest first.
const LEVELS: &[Level] = &[
    #[cfg(with_portable)]
    Level::Portable,
    #[cfg(with_avx2)]
    Level::Avx2,
];

impl Level {
    fn is_available(self) -> bool {
        match self {
            #[cfg(with_portable)]
            Self::Portable => true,
            #[cfg(with_avx2)]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("popcnt"),
        }
    }
}

/// An instruction set that this processor has; it changes the speed, never the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InstructionSet(Level);

impl InstructionSet {
    /// All that this processor has, slowest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        LEVELS.iter().filter(|level| level.is_available()).map(|&level| Self(level)).collect()
    }

    /// The fastest that this processor has; asking allocates nothing.
    ///
    /// # Panics
    /// If this build has none of this processor; a program asks [`InstructionSet::available`] at its start.
    #[must_use]
    pub fn best() -> Self {
        let best = LEVELS.iter().rev().find(|level| level.is_available());
        Self(*best.expect("an instruction set of this processor: build on this machine, or with --release"))
    }

    /// Name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(with_portable)]
            Level::Portable => "portable",
            #[cfg(with_avx2)]
            Level::Avx2 => "AVX2",
        }
    }

    /// Runs `pass` with this instruction set.
    #[inline]
    pub fn run<P: LanePass>(self, pass: P) {
        match self.0 {
            #[cfg(with_portable)]
            Level::Portable => pass.run::<portable::Portable>(),
            #[cfg(with_avx2)]
            Level::Avx2 => avx2::run(pass, self),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Everything<'a> {
        a: &'a [f64],
        vectors: &'a [Vector<3>],
        flat: &'a [Vector<2>],
        tensors: &'a [Tensor<3>],
        quads: &'a [[f64; 4]],
        singles: &'a [[f32; 4]],
        out: &'a mut Vec<u64>,
    }

    impl LanePass for Everything<'_> {
        #[inline(always)]
        fn run<V: Lanes>(self) {
            let n = self.a.len();
            for start in 0..n - LANES {
                let raw: [u32; LANES] = std::array::from_fn(|k| ((start + 3 * k * k) % n) as u32);
                let indices = LaneIndices::new(&raw, n);
                let a: V = gather(self.a, &indices);
                let [x, y, z] = gather_vectors::<V, 3>(self.vectors, &indices);
                let [v, w] = gather_vectors::<V, 2>(self.flat, &indices);
                let t = gather_tensors::<V, 3>(self.tensors, &indices);
                let b = (x * y - z / a).max(t[0][2]).min(t[2][1] + a);
                let c = (b * b + V::splat(0.1)).sqrt().where_less(x, -t[1][1]);
                let [p, q, r, s] = V::load_quads(self.quads, 2, 1, &indices);
                let single: [f32; LANES] = std::array::from_fn(|k| self.a[start + k] as f32);
                let c = c + (p - q) * (r + s) * V::widen(V::Single::load(&single));
                self.out.extend((v - w * y).to_array().map(f64::to_bits));
                self.out.extend((b + c).to_array().map(f64::to_bits));
                self.out.extend((c - b).to_array().map(f64::to_bits));
                let mut packed = [0; LANES];
                let mask = p.less_mask(r);
                let count = V::pack(&raw, mask, raw[2], &mut packed);
                self.out.push(u64::from(mask));
                self.out.extend(packed[..count].iter().map(|&index| u64::from(index)));
                let mut stored = [[0.0; 4]; 3 * LANES];
                V::store_quads(&[p, q, r, s], &mut stored, 3, 1);
                self.out.extend(stored.as_flattened().iter().map(|value| value.to_bits()));
                let [e, f, g, h] = V::Single::load_quads(self.singles, 2, 1, &indices);
                let k = (e * f - g / h).max(e).min(h + f).sqrt().where_less(e, -g);
                self.out.extend(V::widen(k.fixed_difference(b.narrow())).to_array().map(f64::to_bits));
                self.out.extend(V::widen(k - b.narrow()).to_array().map(f64::to_bits));
                self.out.push(u64::from(e.less_mask(h)));
            }
        }
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let n = 101;
        let value = |k: usize| (k as f64 * 0.618_033_988_749_895).fract() * 3.0 - 1.4;
        let a: Vec<f64> = (0..n).map(|k| value(k) + 5.0).collect();
        let vectors: Vec<_> = (0..n).map(|k| Vector::<3>::from_fn(|i, _| value(7 * k + i))).collect();
        let flat: Vec<_> = (0..n).map(|k| Vector::<2>::from_fn(|i, _| value(13 * k + i))).collect();
        let tensors: Vec<_> = (0..n).map(|k| Tensor::<3>::from_fn(|i, j| value(11 * k + 3 * i + j))).collect();
        let quads: Vec<_> = (0..2 * n).map(|k| std::array::from_fn(|i| value(5 * k + i))).collect();
        let singles: Vec<_> = quads.iter().map(|quad: &[f64; 4]| quad.map(|value| value as f32)).collect();
        let mut results = Vec::new();
        for set in InstructionSet::available() {
            let mut out = Vec::new();
            let (quads, singles, flat) = (&quads, &singles, &flat);
            set.run(Everything { a: &a, vectors: &vectors, flat, tensors: &tensors, quads, singles, out: &mut out });
            assert!(out.len() > 8 * 50);
            results.push(out);
        }
        for other in &results[1..] {
            assert_eq!(&results[0], other);
        }
    }

    #[test]
    fn the_portable_lanes_agree_with_scalar_code() {
        struct Check<'a>(&'a [Tensor<2>]);
        impl LanePass for Check<'_> {
            #[inline(always)]
            fn run<V: Lanes>(self) {
                let indices = LaneIndices::new(&[3, 1, 4, 1, 5, 0, 2, 6], self.0.len());
                let t = gather_tensors::<V, 2>(self.0, &indices);
                let determinant = (t[0][0] * t[1][1] - t[0][1] * t[1][0]).to_array();
                let quads: Vec<[f64; 4]> =
                    (0..3 * self.0.len()).map(|k| std::array::from_fn(|i| (4 * k + i) as f64)).collect();
                let loaded = V::load_quads(&quads, 3, 2, &indices).map(V::to_array);
                let flat: Vec<_> = (0..self.0.len()).map(|k| Vector::<2>::new(k as f64, -0.5 * k as f64)).collect();
                let pairs = gather_vectors::<V, 2>(&flat, &indices).map(V::to_array);
                for (lane, &index) in [3usize, 1, 4, 1, 5, 0, 2, 6].iter().enumerate() {
                    assert_eq!((pairs[0][lane], pairs[1][lane]), (flat[index][0], flat[index][1]));
                    for (k, value) in loaded.iter().enumerate() {
                        assert_eq!(value[lane], quads[3 * index + 2][k]);
                    }
                    let m = &self.0[index];
                    assert_eq!(determinant[lane], m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]);
                }
            }
        }
        let tensors: Vec<_> = (0..7).map(|k| Tensor::<2>::from_fn(|i, j| (k * 4 + 2 * i + j) as f64 + 0.25)).collect();
        for set in InstructionSet::available() {
            set.run(Check(&tensors));
        }
    }

    #[test]
    #[should_panic(expected = "shorter")]
    fn a_shorter_array_is_refused() {
        struct Short<'a>(&'a [f64]);
        impl LanePass for Short<'_> {
            #[inline(always)]
            fn run<V: Lanes>(self) {
                let indices = LaneIndices::new(&[0, 1, 2, 3, 4, 5, 6, 7], 8);
                let _ = gather::<V>(self.0, &indices).to_array();
            }
        }
        InstructionSet::best().run(Short(&[1.0; 7]));
    }
}
