//! Conjugate gradients, preconditioned and, if asked, with the constant vector deflated.
//!
//! Deflation (Nicolaides 1987) splits off the one vector that local factors handle worst: the whole set moving as one.
//! Every residual is then orthogonal to the constant. If the unknowns are velocities and the rows forces, that is the
//! total momentum: it closes to rounding, whatever the tolerance.

use super::descent::{Descent, Stalled, descend};
use super::reductions::{BLOCK, Unknown, dot, sum_of_blocks, weighted_square};
use crate::parallel::prelude::*;

/// Preconditioner that turns a residual into a direction.
pub(crate) trait Preconditioner<T: Unknown> {
    /// Weights of the residual's norm: the inverse diagonal, 0 for a row that is no unknown.
    fn weights(&self) -> &[f64];
    /// M⁻¹ times a residual.
    fn apply(&mut self, residual: &[T], out: &mut [T]);
}

/// The inverse diagonal alone.
impl<T: Unknown> Preconditioner<T> for Vec<f64> {
    fn weights(&self) -> &[f64] {
        self
    }

    fn apply(&mut self, residual: &[T], out: &mut [T]) {
        for ((out, residual), weight) in out.iter_mut().zip(residual).zip(&*self) {
            *out = *residual * *weight;
        }
    }
}

/// Stopping criterion of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Criterion {
    /// Norm of the residual over that of the right-hand side `[-]`, both weighted with the inverse diagonal.
    pub(crate) tolerance: f64,
    /// Iterations after which the solve is given up.
    pub(crate) most_iterations: usize,
}

/// A solve that did not reach its tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NotConverged {
    /// Row with the largest residual, or the first that is not a number.
    pub(crate) row: usize,
    /// Norm of the residual over that of the right-hand side `[-]`.
    pub(crate) residual: f64,
}

/// Buffers, reused from solve to solve.
#[derive(Debug)]
pub(crate) struct ConjugateGradient<T> {
    residual: Vec<T>,
    direction: Vec<T>,
    product: Vec<T>,
    preconditioned: Vec<T>,
    /// Sums of blocks.
    numbers: Vec<f64>,
    vectors: Vec<T>,
    /// Iterations of all solves.
    pub(crate) iterations: u64,
}

impl<T: Unknown> Default for ConjugateGradient<T> {
    fn default() -> Self {
        Self {
            residual: Vec::new(),
            direction: Vec::new(),
            product: Vec::new(),
            preconditioned: Vec::new(),
            numbers: Vec::new(),
            vectors: Vec::new(),
            iterations: 0,
        }
    }
}

impl<T: Unknown> ConjugateGradient<T> {
    /// Improves `unknown` until `apply(unknown) = right_side`. `of_constant` is the operator times the constant vector
    /// of ones where that is to be deflated.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub(crate) fn solve(
        &mut self,
        unknown: &mut [T],
        right_side: &[T],
        preconditioner: &mut impl Preconditioner<T>,
        of_constant: Option<&[f64]>,
        criterion: Criterion,
        mut apply: impl FnMut(&[T], &mut [T]),
    ) -> Result<(), NotConverged> {
        let rows = unknown.len();
        let weights = preconditioner.weights();
        for buffer in [&mut self.residual, &mut self.direction, &mut self.product, &mut self.preconditioned] {
            buffer.clear();
            buffer.resize(rows, T::ZERO);
        }
        apply(unknown, &mut self.product);
        for (residual, (right, product)) in self.residual.iter_mut().zip(right_side.iter().zip(&self.product)) {
            *residual = *right - *product;
        }
        let deflation = of_constant.map(|image| (image, 1.0 / image.iter().fold(0.0, |sum, value| sum + value)));
        if let Some((image, inverse)) = deflation {
            let shift = sum(&self.residual) * inverse;
            for (row, value) in unknown.iter_mut().enumerate() {
                *value = *value + shift;
                self.residual[row] = self.residual[row] - shift * image[row];
            }
        }
        let scale = weighted_square(right_side, weights);
        if scale == 0.0 {
            // no residual is small against nothing
            unknown.fill(T::ZERO);
            return Ok(());
        }
        let goal = criterion.tolerance * criterion.tolerance * scale;
        let mut iteration = Iteration { buffers: &mut *self, unknown, preconditioner, deflation, apply };
        match descend(&mut iteration, goal, criterion.most_iterations) {
            Ok(iterations) => {
                self.iterations += iterations as u64;
                Ok(())
            }
            Err(Stalled { square }) => {
                Err(NotConverged { row: worst(&self.residual), residual: (square / scale).sqrt() })
            }
        }
    }
}

/// The vectors of a solve, its operator and what is deflated: the operator times the constant vector, and one over its
/// sum.
struct Iteration<'a, T, P, A> {
    buffers: &'a mut ConjugateGradient<T>,
    unknown: &'a mut [T],
    preconditioner: &'a mut P,
    deflation: Option<(&'a [f64], f64)>,
    apply: A,
}

impl<T: Unknown, P: Preconditioner<T>, A: FnMut(&[T], &mut [T])> Descent for Iteration<'_, T, P, A> {
    fn square(&mut self) -> f64 {
        let ConjugateGradient { residual, numbers, .. } = &mut *self.buffers;
        let blocks = (residual.par_chunks(BLOCK), self.preconditioner.weights().par_chunks(BLOCK)).into_items();
        sum_of_blocks(numbers, blocks, |(residual, weights)| weighted_square(residual, weights))
    }

    fn descent(&mut self) -> f64 {
        let ConjugateGradient { residual, preconditioned, numbers, .. } = &mut *self.buffers;
        self.preconditioner.apply(residual, preconditioned);
        let blocks = (residual.par_chunks(BLOCK), preconditioned.par_chunks(BLOCK)).into_items();
        sum_of_blocks(numbers, blocks, |(residual, z)| dot(residual, z))
    }

    fn turn(&mut self, growth: f64) {
        let ConjugateGradient { direction, preconditioned, vectors, .. } = &mut *self.buffers;
        let lift = self.deflation.map_or(T::ZERO, |(image, inverse)| {
            let blocks = (preconditioned.par_chunks(BLOCK), image.par_chunks(BLOCK)).into_items();
            let overlap = sum_of_blocks(vectors, blocks, |(z, image)| {
                z.iter().zip(image).fold(T::ZERO, |sum, (z, a)| sum + *z * *a)
            });
            overlap * inverse
        });
        let blocks = (direction.par_chunks_mut(BLOCK), preconditioned.par_chunks(BLOCK)).into_items();
        blocks.for_each(|(direction, z)| {
            for (direction, z) in direction.iter_mut().zip(z) {
                *direction = (*z - lift) + *direction * growth;
            }
        });
    }

    fn curvature(&mut self) -> f64 {
        let ConjugateGradient { direction, product, numbers, .. } = &mut *self.buffers;
        (self.apply)(direction, product);
        let blocks = (direction.par_chunks(BLOCK), product.par_chunks(BLOCK)).into_items();
        sum_of_blocks(numbers, blocks, |(direction, product)| dot(direction, product))
    }

    fn advance(&mut self, step: f64) {
        let ConjugateGradient { residual, direction, product, .. } = &mut *self.buffers;
        let unknowns = (self.unknown.par_chunks_mut(BLOCK), direction.par_chunks(BLOCK));
        let residuals = (residual.par_chunks_mut(BLOCK), product.par_chunks(BLOCK));
        (unknowns, residuals).for_each(|((unknown, direction), (residual, product))| {
            for (unknown, direction) in unknown.iter_mut().zip(direction) {
                *unknown = *unknown + *direction * step;
            }
            for (residual, product) in residual.iter_mut().zip(product) {
                *residual = *residual - *product * step;
            }
        });
    }
}

fn sum<T: Unknown>(values: &[T]) -> T {
    values.iter().fold(T::ZERO, |sum, value| sum + *value)
}

fn worst<T: Unknown>(residual: &[T]) -> usize {
    let mut worst = (0, 0.0);
    for (row, value) in residual.iter().enumerate() {
        let square = value.product(value);
        if square.is_nan() {
            return row;
        }
        if square > worst.1 {
            worst = (row, square);
        }
    }
    worst.0
}
