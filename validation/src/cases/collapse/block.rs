//! The grains before the collapse: displaced from a lattice, under hydrostatic pressure, at rest.

use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::scene::Flow;
use rand::{RngExt, SeedableRng};

/// What the grains of a block have in common.
pub(super) struct Block {
    /// Particle spacing `[m]`.
    pub(super) spacing: f64,
    /// Height of its surface `[m]`, along the second axis.
    pub(super) height: f64,
    /// Gravity across the bed `[m/s²]`.
    pub(super) gravity_across: f64,
    /// Equation of state.
    pub(super) equation_of_state: EquationOfState,
    /// Largest random displacement of a particle along each axis, in spacings `[-]`.
    pub(super) jitter: f64,
    /// Seed of the displacements.
    pub(super) seed: u64,
}

impl Block {
    /// Fills lattice sites. Density and mass belong to the site, so that the block neither sinks nor swells.
    pub(super) fn fill<const D: usize>(&self, sites: impl Iterator<Item = Vector<D>>) -> Flow<D> {
        let mut random = rand_pcg::Pcg64::seed_from_u64(self.seed);
        let mut flow = Flow::default();
        let (modulus, reference) = (self.equation_of_state.bulk_modulus, self.equation_of_state.reference_density);
        for site in sites {
            let shift = Vector::<D>::from_fn(|_, _| self.jitter * self.spacing * (2.0 * random.random::<f64>() - 1.0));
            let depth = self.height - site[1];
            let pressure = crate::cases::layer::hydrostatic_pressure(modulus, reference, self.gravity_across, depth);
            let density = self.equation_of_state.density(pressure);
            flow.position.push(site + shift);
            flow.velocity.push(Vector::zeros());
            flow.density.push(density);
            flow.mass.push(density * self.spacing.powi(D as i32));
            flow.stress.push(Tensor::zeros());
        }
        flow
    }
}
