//! The implicit velocities of both phases: (M + Δt K) u* = M (uⁿ + Δt a).
//!
//! K holds the viscous pairs of (18), the friction of the bed and the drag between the phases. Every entry is one
//! number per pair, the same seen from both sides, so K is symmetric, the axes do not mix, and the exchange of momentum
//! is equal and opposite. With the constant velocity deflated the total momentum closes to rounding.

mod pair_law;
mod rows;

pub(super) use rows::VelocityRows;

use super::divergence::{Failure, Quantity};
use super::numerics::{MOST_ITERATIONS, ProjectionNumerics};
use crate::linear::{ConjugateGradient, Criterion, IncompleteCholesky, LaneRows, NotConverged, Rows, Single};
use crate::vector::Vector;

/// Rows of M + Δt K: the fluid's free particles first, then the sediment's.
#[derive(Debug)]
pub(crate) struct VelocitySystem<const D: usize> {
    /// Δt k_ab `[kg]` of every pair.
    pub(crate) couplings: LaneRows<Single>,
    /// m_a + Δt Σ k `[kg]`.
    pub(crate) diagonal: Vec<f64>,
    /// m_a, and what walls and the fixed bed hold, Δt Σ_w k_aw `[kg]`: the rows' sums.
    pub(crate) of_constant: Vec<f64>,
    /// m_a `[kg]`; of the fluid only its share of the space.
    pub(crate) inertia: Vec<f64>,
    /// Momentum before the solve `[kg m/s]`.
    pub(crate) momentum: Vec<Vector<D>>,
    /// u* `[m/s]`.
    pub(crate) velocity: Vec<Vector<D>>,
    /// u* − uⁿ of the last solve `[m/s]`.
    change: Vec<Vector<D>>,
    factors: IncompleteCholesky,
    solver: ConjugateGradient<Vector<D>>,
}

impl<const D: usize> VelocitySystem<D> {
    pub(crate) fn new() -> Self {
        Self {
            couplings: LaneRows::new(),
            diagonal: Vec::new(),
            of_constant: Vec::new(),
            inertia: Vec::new(),
            momentum: Vec::new(),
            velocity: Vec::new(),
            change: Vec::new(),
            factors: IncompleteCholesky::default(),
            solver: ConjugateGradient::new(),
        }
    }

    /// Room for `rows` rows.
    pub(crate) fn resize(&mut self, rows: usize) {
        for array in [&mut self.diagonal, &mut self.of_constant, &mut self.inertia] {
            array.resize(rows, 0.0);
        }
        self.momentum.resize(rows, Vector::zeros());
        self.velocity.resize(rows, Vector::zeros());
    }

    /// u* − uⁿ of the last solve `[m/s]`, where the next one starts.
    pub(crate) fn change(&self) -> &[Vector<D>] {
        &self.change
    }

    /// Goes on from the change of the last solve `[m/s]`, after so many iterations.
    pub(crate) fn restore(&mut self, change: Vec<Vector<D>>, iterations: u64) {
        self.change = change;
        self.solver.count_from(iterations);
    }

    /// Iterations of all solves.
    pub(crate) fn iterations(&self) -> u64 {
        self.solver.iterations()
    }

    /// Solves for the velocities. `velocity` holds uⁿ before; the solve starts from there with the change of the last
    /// step, because weight, pressure and friction change slowly.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub(crate) fn solve(&mut self, numerics: &ProjectionNumerics) -> Result<(), Failure> {
        let tolerance = numerics.velocity_tolerance;
        let criterion = Criterion { tolerance, most_iterations: MOST_ITERATIONS };
        let (couplings, diagonal) = (&self.couplings, &self.diagonal);
        self.factors.factorise(couplings.len(), couplings.stride(), &SolvedRows { couplings, diagonal });
        self.change.resize(self.velocity.len(), Vector::zeros());
        for (velocity, change) in self.velocity.iter_mut().zip(&mut self.change) {
            (*velocity, *change) = (*velocity + *change, *velocity);
        }
        let sums = Some(self.of_constant.as_slice());
        let solved =
            self.solver.solve(&mut self.velocity, &self.momentum, &self.factors, sums, criterion, |u, product| {
                couplings.subtract_from_diagonal(diagonal, u, product);
            });
        solved.map_err(|NotConverged { row, residual }| Failure {
            row,
            quantity: Quantity::VelocityResidual,
            value: residual,
            limit: tolerance,
        })?;
        for (change, velocity) in self.change.iter_mut().zip(&self.velocity) {
            *change = velocity - *change;
        }
        Ok(())
    }
}

/// M + Δt K row by row.
struct SolvedRows<'a> {
    couplings: &'a LaneRows<Single>,
    diagonal: &'a [f64],
}

impl Rows for SolvedRows<'_> {
    #[inline(always)]
    fn diagonal(&self, row: usize) -> f64 {
        self.diagonal[row]
    }

    #[inline(always)]
    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
        self.couplings.row(row).map(|(column, coefficient)| (column, -coefficient))
    }
}
