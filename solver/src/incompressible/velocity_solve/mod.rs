//! The implicit velocities of both phases: (M + Δt K) u* = M (uⁿ + Δt a).
//!
//! K holds the viscous pairs of (18), the friction of the bed and the drag between the phases. Every entry is one
//! number per pair, the same seen from both sides, so K is symmetric, the axes do not mix, and the exchange of momentum
//! is equal and opposite. With the constant velocity deflated the total momentum closes to rounding.

mod pair_law;
mod rows;

pub(super) use rows::VelocityRows;

use super::divergence::Quantity;
use super::passes::pair_rows::FrictionRows;
use super::{Failure, MOST_ITERATIONS, Phase, ProjectionNumerics};
use crate::linear::{ConjugateGradient, Criterion, IncompleteCholesky, LaneRows, NotConverged, Rows, Single, TwoRows};
use crate::vector::Vector;

/// Largest Δt Σ k over a row's own sum m + Δt Σ_w k `[-]` up to which the diagonal alone preconditions the velocities: a few
/// iterations are then over before factors have been found.
const MILD_FRICTION: f64 = 0.5;

/// Rows of M + Δt K: the fluid's free particles first, then the sediment's.
#[derive(Debug, Default)]
pub struct VelocitySystem<const D: usize> {
    /// Δt k_ab `[kg]` of the fluid's viscous pairs.
    couplings: LaneRows<Single>,
    /// Σ_b of these in every row of the fluid `[kg]`.
    coupled: Vec<f64>,
    /// Δt k_ab `[kg]` of all other pairs, in rows of both phases: the sediment's friction, the drag.
    pub(crate) beside: LaneRows<Single>,
    /// m_a + Δt Σ k `[kg]`.
    pub(crate) diagonal: Vec<f64>,
    /// m_a, and what walls and the fixed bed hold, Δt Σ_w k_aw `[kg]`: the rows' sums.
    pub of_constant: Vec<f64>,
    /// m_a `[kg]`; of the fluid only its share of the space.
    pub inertia: Vec<f64>,
    /// Momentum before the solve `[kg m/s]`.
    pub(crate) momentum: Vec<Vector<D>>,
    /// u* `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// u* − uⁿ of the last solve `[m/s]`, where the next one starts.
    pub(crate) change: Vec<Vector<D>>,
    inverse_diagonal: Vec<f64>,
    factors: IncompleteCholesky,
    pub(crate) solver: ConjugateGradient<Vector<D>>,
}

impl<const D: usize> VelocitySystem<D> {
    /// Room for `rows` rows.
    pub(crate) fn resize(&mut self, rows: usize) {
        for array in [&mut self.diagonal, &mut self.of_constant, &mut self.inertia] {
            array.resize(rows, 0.0);
        }
        self.momentum.resize(rows, Vector::zeros());
        self.velocity.resize(rows, Vector::zeros());
    }

    /// The rows of the fluid's viscous pairs, to be filled.
    pub(crate) fn fluid_rows(&mut self, fluid: &Phase<D>) -> FrictionRows<'_> {
        let (count, list) = (fluid.len(), &fluid.free);
        self.coupled.resize(count, 0.0);
        let (couplings, width) = self.couplings.with_pattern((count, list.stride), &list.columns, list.changes);
        FrictionRows { couplings, width, coupled: &mut self.coupled }
    }

    /// Solves for the velocities. `velocity` holds uⁿ before; the solve starts from there with the change of the last
    /// step, because weight, pressure and friction change slowly.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub(crate) fn solve(&mut self, numerics: &ProjectionNumerics) -> Result<(), Failure> {
        let tolerance = numerics.velocity_tolerance;
        let criterion = Criterion { tolerance, most_iterations: MOST_ITERATIONS };
        let diagonal = &self.diagonal;
        let couplings = TwoRows { first: &self.couplings, all: &self.beside };
        self.change.resize(self.velocity.len(), Vector::zeros());
        for (velocity, change) in self.velocity.iter_mut().zip(&mut self.change) {
            (*velocity, *change) = (*velocity + *change, *velocity);
        }
        let sums = Some(self.of_constant.as_slice());
        let (velocity, momentum, solver) = (&mut self.velocity, &self.momentum, &mut self.solver);
        let product =
            |u: &[Vector<D>], product: &mut [Vector<D>]| couplings.subtract_from_diagonal(diagonal, u, product);
        let stiffest = diagonal.iter().zip(&self.of_constant).fold(0.0_f64, |most, (all, own)| most.max(all / own));
        let solved = if stiffest - 1.0 <= MILD_FRICTION {
            self.inverse_diagonal.clear();
            self.inverse_diagonal.extend(diagonal.iter().map(|diagonal| 1.0 / diagonal));
            solver.solve(velocity, momentum, &mut self.inverse_diagonal, sums, criterion, product)
        } else {
            let longest = self.couplings.stride + self.beside.stride;
            self.factors.factorise(diagonal.len(), longest, &SolvedRows { couplings, diagonal });
            solver.solve(velocity, momentum, &mut self.factors, sums, criterion, product)
        };
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
    couplings: TwoRows<'a>,
    diagonal: &'a [f64],
}

impl Rows for SolvedRows<'_> {
    #[inline(always)]
    fn diagonal(&self, row: usize) -> f64 {
        self.diagonal[row]
    }

    #[inline(always)]
    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
        let of_fluid = (row < self.couplings.first.rows).then(|| self.couplings.first.row(row));
        let all = of_fluid.into_iter().flatten().chain(self.couplings.all.row(row));
        all.map(|(column, coefficient)| (column, -coefficient))
    }
}
