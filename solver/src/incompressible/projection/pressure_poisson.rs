//! The pressure Poisson equation (A + s D G) P = −ρ (∇·u*/Δt + γ (1 − δ)/Δt²).
//!
//! With g_ab = V F r_ab, divided by its sum over a lattice, and n the normal of a wall:
//!
//! - G, the symmetric gradient (13): (G P)_a = Σ_b (P_a + P_b) g_ab + 2 P_a (Σ_w g_aw·n) n
//! - D, its adjoint: (D u)_a = Σ_b (u_b − u_a)·g_ab − 2 u_a·n (Σ_w g_aw·n)
//! - A, the compact Laplacian (12), negative: (A P)_a = Σ_b 2 V (−F) (P_a − P_b)
//!
//! A wall particle has the pressure of its partner and the opposite normal velocity. G is −Dᵀ, so −D G is positive,
//! and pair forces are equal and opposite whatever P is. On disordered particles −D G exceeds A for smooth P, because
//! Σ_b g_ab is not zero: with A alone a step corrects too much, with alternating sign. A + s D G does not.
//! All weights of a pair are divided by ½ (M_a + M_b), M = Σ V (−F) r²/D, which is 1 in a continuum and not on
//! disordered particles: without it the hydrostatic pressure is 2.6 % low.
//! At the surface, missing neighbours count as mirrored ones with the opposite pressure (32)–(34); where particles at
//! the surface are eliminated (31), they have P = 0 and are no unknowns.
//! A fluid without a surface has no level of pressure: P is then sought among fields of mean zero, and what the right
//! side has of a constant is left out, because no pressure but an enormous one answers it. With the density source P is
//! lifted until its lowest is 0, as it is below a surface: (13) draws particles together where P is negative, and
//! nothing else keeps them apart.

use super::super::passes::pressure_rows::{LinkChunk, PressureRows};
use super::super::{LEAST_TASK, MOST_ITERATIONS, Phase, PressureSource, ProjectionNumerics, SurfaceTreatment};
use super::correction::Correction;
use super::gauge::Gauge;
use super::pressure_links::{Divergence, Gradient, Link};
use crate::domain::Domain;
use crate::linear::{
    ConjugateGradient, Criterion, IncompleteCholesky, LaneRows, Lattices, NotConverged, Rows, TASK_ROWS,
};
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// Rows from which on the pressure is preconditioned by lattices: factors without fill see no further than their neighbours, and
/// take the more iterations the finer the particles.
pub(crate) const LATTICE_ROWS: usize = 4096;

/// Coefficients, reused from step to step.
#[derive(Debug, Default)]
pub struct PressurePoisson<const D: usize> {
    links: LaneRows<LinkChunk<D>>,
    /// Σ_b g_ab + 2 (Σ_w g_aw·n) n `[1/m]`.
    pub(crate) own: Vec<Vector<D>>,
    diagonal: Vec<f64>,
    /// Excess of the diagonal over the sum of its links `[1/m²]`.
    pub(crate) held: Vec<f64>,
    right_side: Vec<f64>,
    gradient: Vec<Vector<D>>,
    /// A pressure less its mean, where there is no level.
    deviation: Vec<f64>,
    /// Whether a surface fixes the level of the pressure.
    pub(crate) gauge: Gauge,
    factors: IncompleteCholesky,
    lattices: Lattices<D>,
    pub(crate) solver: ConjugateGradient<f64>,
}

impl<const D: usize> PressurePoisson<D> {
    /// The rows of a phase's free particles, to be filled.
    pub(crate) fn rows(&mut self, phase: &Phase<D>) -> PressureRows<'_, D> {
        let count = phase.len();
        for array in [&mut self.diagonal, &mut self.held, &mut self.right_side] {
            array.resize(count, 0.0);
        }
        self.own.resize(count, Vector::zeros());
        self.gradient.resize(count, Vector::zeros());
        let list = &phase.free;
        let (links, width) = self.links.with_pattern((count, list.stride), &list.columns, list.changes);
        PressureRows { links, width, own: &mut self.own, diagonal: &mut self.diagonal, held: &mut self.held }
    }

    /// Finds in the filled rows what fixes the level of the pressure.
    pub(crate) fn find_gauge(&mut self, phase: &Phase<D>, surface: SurfaceTreatment) {
        let has_surface = match surface {
            SurfaceTreatment::Eliminated => phase.at_surface.contains(&true),
            SurfaceTreatment::Completed => phase.nearness.iter().any(|&nearness| nearness > 0.0),
        };
        self.gauge = if has_surface { Gauge::Surface } else { Gauge::Free };
    }

    /// (D u)_a `[1/s]` of a velocity field.
    #[inline(always)]
    pub fn divergence(&self, a: usize, velocity: &[Vector<D>]) -> f64 {
        let mut sum = -self.own[a].dot(&velocity[a]);
        for link in self.links(a) {
            sum += link.gradient.dot(&velocity[link.source as usize]);
        }
        sum
    }

    /// (G P)_a `[Pa/m]`.
    #[inline(always)]
    pub fn gradient(&self, a: usize, pressure: &[f64]) -> Vector<D> {
        let mut sum = self.own[a] * pressure[a];
        for link in self.links(a) {
            sum += link.gradient * pressure[link.source as usize];
        }
        sum
    }

    /// D u `[1/s]` of a velocity field, of all particles.
    pub fn find_divergence(&self, velocity: &[Vector<D>], divergence: &mut [f64]) {
        divergence.par_chunks_mut(TASK_ROWS).enumerate().for_each(|(task, out)| {
            let (links, own, first) = (&self.links, &self.own[..], task * TASK_ROWS);
            self.links.run(Divergence { links, own, u: velocity, first, out, taken: None });
        });
    }

    /// G P `[Pa/m]` of all particles.
    pub fn find_gradient(&mut self, p: &[f64]) -> &[Vector<D>] {
        let Self { links, own, gradient, .. } = self;
        let (links, own) = (&*links, &own[..]);
        gradient.par_chunks_mut(TASK_ROWS).enumerate().for_each(|(task, gradient)| {
            links.run(Gradient { links, own, p, first: task * TASK_ROWS, gradient, compact: None });
        });
        gradient
    }

    /// The links of a particle.
    #[inline(always)]
    pub fn links(&self, a: usize) -> impl Iterator<Item = Link<D>> {
        self.links.row(a).map(|(source, (gradient, laplacian))| Link { source, gradient, laplacian })
    }

    /// Solves for the pressures `[Pa]`, starting from the present ones.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub(crate) fn solve(
        &mut self,
        phase: &mut Phase<D>,
        numerics: &ProjectionNumerics,
        domain: &Domain<D>,
        predicted: &[Vector<D>],
        correction: Correction,
        time_step: f64,
    ) -> Result<(), NotConverged> {
        let density = phase.density;
        let eliminated = numerics.surface == SurfaceTreatment::Eliminated;
        let mut right_side = std::mem::take(&mut self.right_side);
        match numerics.pressure_source {
            PressureSource::Divergence => self.find_divergence(predicted, &mut right_side),
            PressureSource::Density => right_side.fill(0.0),
        }
        right_side.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, right)| {
            let missing = numerics.density_correction * correction.missing(phase, a) / (time_step * time_step);
            let known = eliminated && phase.at_surface[a];
            *right = if known { 0.0 } else { -density * (*right / time_step + missing) };
        });
        for (pressure, at_surface) in phase.pressure.iter_mut().zip(&phase.at_surface) {
            if eliminated && *at_surface {
                *pressure = 0.0;
            }
        }
        self.gauge.take_mean_out(&mut right_side);
        let criterion = Criterion { tolerance: numerics.pressure_tolerance, most_iterations: MOST_ITERATIONS };
        let stabilisation = numerics.stabilisation;
        let mut solver = std::mem::take(&mut self.solver);
        let mut gradient = std::mem::take(&mut self.gradient);
        let mut deviation = std::mem::take(&mut self.deviation);
        let mut factors = std::mem::take(&mut self.factors);
        let mut lattices = std::mem::take(&mut self.lattices);
        let operator = |p: &[f64], product: &mut [f64]| {
            self.gauge.apply(p, product, &mut deviation, |p, product| {
                self.apply(p, product, &mut gradient, &phase.at_surface, eliminated, stabilisation);
            });
        };
        let pressure = &mut phase.pressure;
        let outcome = if self.links.rows < LATTICE_ROWS {
            factors.factorise(self.links.rows, self.links.stride, &CompactRows(self));
            solver.solve(pressure, &right_side, &mut factors, None, criterion, operator)
        } else {
            let inverse = self.diagonal.iter().map(|&diagonal| if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 });
            let row = |a: usize| (f64::from(self.diagonal[a] > 0.0), self.held[a]);
            lattices.lay(&phase.position, domain, phase.spacing, inverse, row);
            solver.solve(pressure, &right_side, &mut lattices, None, criterion, operator)
        };
        if self.gauge == Gauge::Free {
            let anchor = match numerics.pressure_source {
                PressureSource::Divergence => phase.pressure.iter().sum::<f64>() / phase.len() as f64,
                PressureSource::Density => phase.pressure.iter().copied().fold(f64::INFINITY, f64::min),
            };
            phase.pressure.iter_mut().for_each(|pressure| *pressure -= anchor);
        }
        (self.solver, self.gradient, self.right_side) = (solver, gradient, right_side);
        (self.factors, self.lattices, self.deviation) = (factors, lattices, deviation);
        outcome
    }

    /// A p, less s D G p where it is stabilised.
    pub fn apply(
        &self,
        p: &[f64],
        product: &mut [f64],
        gradient: &mut [Vector<D>],
        surface: &[bool],
        eliminated: bool,
        stabilisation: f64,
    ) {
        // both operators read the pressures, D reads the gradients when all are there
        (product.par_chunks_mut(TASK_ROWS), gradient.par_chunks_mut(TASK_ROWS)).enumerate().for_each(
            |(task, (product, gradient))| {
                let (own, first) = (&self.own, task * TASK_ROWS);
                let compact = Some((&self.diagonal[..], product));
                self.links.run(Gradient { links: &self.links, own, p, first, gradient, compact });
            },
        );
        if stabilisation != 0.0 {
            let gradient = &*gradient;
            product.par_chunks_mut(TASK_ROWS).enumerate().for_each(|(task, out)| {
                let (own, first) = (&self.own, task * TASK_ROWS);
                let taken = Some(stabilisation);
                self.links.run(Divergence { links: &self.links, own, u: gradient, first, out, taken });
            });
        }
        if eliminated {
            for (product, &at_surface) in product.iter_mut().zip(surface) {
                if at_surface {
                    *product = 0.0;
                }
            }
        }
    }
}

/// A row by row: what A + s D G is preconditioned by, being nearly (1 + s) A where the pressure is smooth.
struct CompactRows<'a, const D: usize>(&'a PressurePoisson<D>);

impl<const D: usize> Rows for CompactRows<'_, D> {
    #[inline(always)]
    fn diagonal(&self, row: usize) -> f64 {
        self.0.diagonal[row]
    }

    #[inline(always)]
    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
        self.0.links(row).map(|link| (link.source, -link.laplacian))
    }
}
