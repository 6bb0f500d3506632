//! The implicit velocities of both phases: (M + Δt K) u* = M (uⁿ + Δt a).
//!
//! K holds the viscous pairs of (18), the friction of the bed and the drag between the phases. Every entry is one
//! number a pair, the same seen from both sides, so K is symmetric, the axes do not mix, and the exchange of momentum
//! is equal and opposite. With the constant velocity deflated the total momentum closes to rounding.

use super::pairs::LEAST_TASK;
use crate::linear::{ConjugateGradient, Criterion, IncompleteCholesky, NotConverged, Rows};
use crate::vector::Vector;
use rayon::prelude::*;

/// Rows of M + Δt K: the fluid's free particles first, then the sediment's.
#[derive(Debug)]
pub(super) struct VelocitySystem<const D: usize> {
    pub(super) stride: usize,
    /// Partner and coefficient `[kg]` of every pair: Δt k_ab.
    pub(super) link: Vec<(u32, f64)>,
    pub(super) count: Vec<u32>,
    /// m_a + Δt Σ k `[kg]`.
    pub(super) diagonal: Vec<f64>,
    /// m_a, and what walls and the fixed bed hold, Δt Σ_w k_aw `[kg]`: the rows' sums.
    pub(super) of_constant: Vec<f64>,
    /// m_a `[kg]`; of the fluid only its share of the space.
    pub(super) inertia: Vec<f64>,
    /// Momentum before the solve `[kg m/s]`.
    pub(super) momentum: Vec<Vector<D>>,
    /// u* `[m/s]`.
    pub(super) velocity: Vec<Vector<D>>,
    factors: IncompleteCholesky,
    solver: ConjugateGradient<Vector<D>>,
}

impl<const D: usize> VelocitySystem<D> {
    pub(super) fn new() -> Self {
        Self {
            stride: 1,
            link: Vec::new(),
            count: Vec::new(),
            diagonal: Vec::new(),
            of_constant: Vec::new(),
            inertia: Vec::new(),
            momentum: Vec::new(),
            velocity: Vec::new(),
            factors: IncompleteCholesky::default(),
            solver: ConjugateGradient::new(),
        }
    }

    /// Room for `rows` rows of at most `stride` links.
    pub(super) fn resize(&mut self, rows: usize, stride: usize) {
        self.stride = stride;
        self.link.resize(rows * stride, (0, 0.0));
        self.count.resize(rows, 0);
        for array in [&mut self.diagonal, &mut self.of_constant, &mut self.inertia] {
            array.resize(rows, 0.0);
        }
        self.momentum.resize(rows, Vector::zeros());
        self.velocity.resize(rows, Vector::zeros());
    }

    /// Iterations of all solves.
    pub(super) fn iterations(&self) -> u64 {
        self.solver.iterations()
    }

    /// Solves for the velocities, starting from those in `velocity`.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub(super) fn solve(&mut self, criterion: Criterion) -> Result<(), NotConverged> {
        let rows = VelocityRows { link: &self.link, stride: self.stride, count: &self.count, diagonal: &self.diagonal };
        self.factors.factorise(self.diagonal.len(), self.stride, &rows);
        let (link, stride, count, diagonal) = (&self.link, self.stride, &self.count, &self.diagonal);
        self.solver.solve(
            &mut self.velocity,
            &self.momentum,
            &self.factors,
            Some(&self.of_constant),
            criterion,
            |u, product| {
                product.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, out)| {
                    let mut sum = u[a] * diagonal[a];
                    for &(b, coefficient) in &link[a * stride..a * stride + count[a] as usize] {
                        sum -= u[b as usize] * coefficient;
                    }
                    *out = sum;
                });
            },
        )
    }
}

/// M + Δt K row by row.
struct VelocityRows<'a> {
    link: &'a [(u32, f64)],
    stride: usize,
    count: &'a [u32],
    diagonal: &'a [f64],
}

impl Rows for VelocityRows<'_> {
    #[inline(always)]
    fn diagonal(&self, row: usize) -> f64 {
        self.diagonal[row]
    }

    #[inline(always)]
    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
        let links = &self.link[row * self.stride..][..self.count[row] as usize];
        links.iter().map(|&(column, coefficient)| (column, -coefficient))
    }
}
