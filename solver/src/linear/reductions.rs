//! Sums in a fixed order: they do not depend on the number of threads.

use crate::parallel::prelude::*;
use crate::vector::Vector;
use std::ops::{Add, Mul, Sub};

/// An entry of a vector of unknowns: a number, or a vector in space.
pub(crate) trait Unknown:
    Copy + Send + Sync + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + std::fmt::Debug
{
    /// Zero.
    const ZERO: Self;
    /// Scalar product.
    fn product(&self, other: &Self) -> f64;
}

impl Unknown for f64 {
    const ZERO: Self = 0.0;

    #[inline(always)]
    fn product(&self, other: &Self) -> f64 {
        self * other
    }
}

impl<const D: usize> Unknown for Vector<D> {
    const ZERO: Self = Self::from_array_storage(nalgebra::ArrayStorage([[0.0; D]; 1]));

    #[inline(always)]
    fn product(&self, other: &Self) -> f64 {
        self.dot(other)
    }
}

/// Entries of a block of a sum: less is done before another thread has woken.
pub(crate) const BLOCK: usize = 2048;

/// Sums block by block, on any number of threads, and adds the blocks in order; `sums` is room for them.
pub(crate) fn sum_of_blocks<T: Unknown, S>(
    sums: &mut Vec<T>,
    blocks: impl Items<Item = S>,
    sum: impl Fn(S) -> T + Sync,
) -> T {
    sums.resize(blocks.length(), T::ZERO);
    (blocks, &mut sums[..]).for_each(|(block, place)| *place = sum(block));
    sums.iter().fold(T::ZERO, |all, sum| all + *sum)
}

/// Σ a·b: four interleaved sums, which do not wait for each other, added in order.
pub(crate) fn dot<T: Unknown>(a: &[T], b: &[T]) -> f64 {
    let mut sums = [0.0; 4];
    let (quads_a, quads_b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = quads_a.remainder().iter().zip(quads_b.remainder()).fold(0.0, |sum, (a, b)| sum + a.product(b));
    for (a, b) in quads_a.zip(quads_b) {
        for k in 0..4 {
            sums[k] += a[k].product(&b[k]);
        }
    }
    ((sums[0] + sums[1]) + (sums[2] + sums[3])) + rest
}

/// Σ w a·a in the same order.
pub(crate) fn weighted_square<T: Unknown>(values: &[T], weights: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (quads, fours) = (values.chunks_exact(4), weights.chunks_exact(4));
    let rest = quads.remainder().iter().zip(fours.remainder()).fold(0.0, |sum, (a, w)| sum + a.product(a) * w);
    for (a, w) in quads.zip(fours) {
        for k in 0..4 {
            sums[k] += a[k].product(&a[k]) * w[k];
        }
    }
    ((sums[0] + sums[1]) + (sums[2] + sums[3])) + rest
}
