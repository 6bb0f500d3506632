//! Incomplete Cholesky factors without fill, with the off-diagonals of the operator itself, in blocks of rows.
//!
//! M = (1 + L) P (1 + Lᵀ) within a block, L P the operator's lower part and P chosen so that the diagonals agree:
//! P_a = A_aa − Σ_{b<a} L_ab² P_b (Meijerink & van der Vorst 1977). Blocks have a fixed length and know nothing of each
//! other, so that they are solved side by side with the same result on any number of threads. L is stored in single
//! precision: both sweeps read the same numbers, so M stays symmetric, and it is an approximation anyway.

use super::conjugate_gradient::Preconditioner;
use super::reductions::Unknown;
use crate::parallel::prelude::*;

/// Rows of a block.
const BLOCK: usize = 2048;

/// A symmetric operator with negative or no off-diagonals, row by row.
pub(crate) trait Rows: Sync {
    /// A_aa, or 0 for a row that is no unknown.
    fn diagonal(&self, row: usize) -> f64;
    /// Columns and A_ab of a row off the diagonal, in any order.
    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)>;
}

/// Factors, reused from solve to solve.
#[derive(Debug, Default)]
pub(crate) struct IncompleteCholesky {
    stride: usize,
    /// L_ab within the block, row after row without gaps; the column counts from the block's first row.
    lower: Vec<(u32, f32)>,
    /// End of each row, counted from the block's start.
    end: Vec<u32>,
    /// 1/P_a, or 0 for a row that is no unknown.
    inverse_pivot: Vec<f64>,
    inverse_diagonal: Vec<f64>,
}

impl IncompleteCholesky {
    /// Factorises an operator with `rows` rows of at most `stride` entries off the diagonal.
    pub(crate) fn factorise(&mut self, rows: usize, stride: usize, operator: &impl Rows) {
        self.stride = stride;
        self.lower.resize(rows * stride, (0, 0.0));
        self.end.resize(rows, 0);
        self.inverse_pivot.resize(rows, 0.0);
        self.inverse_diagonal.clear();
        let inverse = |diagonal: f64| if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 };
        self.inverse_diagonal.extend((0..rows).map(|row| inverse(operator.diagonal(row))));
        let Self { lower, end, inverse_pivot, .. } = self;
        (lower.par_chunks_mut(BLOCK * stride), end.par_chunks_mut(BLOCK), inverse_pivot.par_chunks_mut(BLOCK))
            .enumerate()
            .for_each(|(block, (lower, end, inverse_pivot))| {
                let first = block * BLOCK;
                let mut filled = 0;
                for row in 0..end.len() {
                    let diagonal = operator.diagonal(first + row);
                    let mut pivot = diagonal;
                    for (column, value) in operator.off_diagonal(first + row) {
                        let column = (column as usize).wrapping_sub(first);
                        if column < row && value != 0.0 {
                            let factor = (value * inverse_pivot[column]) as f32;
                            lower[filled] = (column as u32, factor);
                            filled += 1;
                            pivot -= value * f64::from(factor);
                        }
                    }
                    end[row] = filled as u32;
                    inverse_pivot[row] = if diagonal > 0.0 { 1.0 / pivot.max(LEAST_PIVOT * diagonal) } else { 0.0 };
                }
            });
    }
}

impl<T: Unknown> Preconditioner<T> for IncompleteCholesky {
    fn weights(&self) -> &[f64] {
        &self.inverse_diagonal
    }

    fn apply(&mut self, residual: &[T], out: &mut [T]) {
        let stride = self.stride;
        (
            out.par_chunks_mut(BLOCK),
            residual.par_chunks(BLOCK),
            self.lower.par_chunks(BLOCK * stride),
            self.end.par_chunks(BLOCK),
            self.inverse_pivot.par_chunks(BLOCK),
        )
            .for_each(|(out, residual, lower, end, inverse_pivot)| {
                let mut start = 0;
                for row in 0..out.len() {
                    let stop = end[row] as usize;
                    let mut sum = residual[row];
                    for &(column, factor) in &lower[start..stop] {
                        sum = sum - out[column as usize] * f64::from(factor);
                    }
                    out[row] = sum;
                    start = stop;
                }
                for (out, inverse) in out.iter_mut().zip(inverse_pivot) {
                    *out = *out * *inverse;
                }
                for row in (0..out.len()).rev() {
                    let (before, this) = out.split_at_mut(row);
                    let start = if row > 0 { end[row - 1] as usize } else { 0 };
                    for &(column, factor) in &lower[start..end[row] as usize] {
                        let column = &mut before[column as usize];
                        *column = *column - this[0] * f64::from(factor);
                    }
                }
            });
    }
}

/// Smallest pivot over the diagonal `[-]`: an operator that is nearly singular must not make an infinite factor.
const LEAST_PIVOT: f64 = 1e-3;
