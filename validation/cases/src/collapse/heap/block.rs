//! The grains before the collapse: displaced from a lattice on a bed, under hydrostatic pressure, at rest.

use crate::setup::{displaced_flow, hydrostatic_pressure, wall_rows};
use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::walls::wall::fill;
use bagnold_solver::weakly_compressible::{Numerics, Scene, Wall};

/// Bulk modulus over ρ0 g h_0 `[-]`.
pub(crate) const STIFFNESS: f64 = 50.0;

/// Common properties of the grains of a block.
pub(crate) struct GrainBlock<const D: usize> {
    /// Particle spacing `[m]`.
    pub(crate) spacing: f64,
    /// Height of its surface `[m]`, along the second axis.
    pub(crate) height: f64,
    /// Gravity `[m/s²]`.
    pub(crate) gravity: Vector<D>,
    /// Bulk density `[kg/m³]`.
    pub(crate) density: f64,
    /// Bulk modulus `[Pa]`.
    pub(crate) bulk_modulus: f64,
    /// Law that is simulated.
    pub(crate) rheology: Rheology,
    /// Largest random displacement of a particle along each axis, in spacings `[-]`.
    pub(crate) jitter: f64,
    /// Seed of the displacements.
    pub(crate) seed: u64,
    /// Numerical scheme of the weakly compressible model.
    pub(crate) numerics: Numerics,
}

impl<const D: usize> GrainBlock<D> {
    /// The block at its lattice sites on a bed that ends at `bed_end` `[m]` along all horizontal axes.
    pub(crate) fn scene(&self, sites: impl Iterator<Item = Vector<D>>, domain: Domain<D>, bed_end: f64) -> Scene<D> {
        let equation_of_state =
            EquationOfState { reference_density: self.density, bulk_modulus: self.bulk_modulus, tension: Tension::Cut };
        let bed = Wall::still(1, 0.0, 1.0);
        let rows = wall_rows(self.numerics.smoothing_ratio);
        let mut far = Vector::<D>::repeat(bed_end);
        far[1] = self.height;
        let pressure = |depth: f64| hydrostatic_pressure(self.bulk_modulus, self.density, -self.gravity[1], depth);
        let flow = displaced_flow(
            sites,
            (self.jitter * self.spacing, self.seed),
            |site| equation_of_state.density(pressure(self.height - site[1])),
            |density| density * self.spacing.powi(D as i32),
        );
        Scene {
            wall_particles: fill(&[bed], &domain, (Vector::zeros(), far), self.spacing, rows),
            walls: vec![bed],
            domain,
            gravity: self.gravity,
            numerics: self.numerics,
            ..Scene::unbounded(flow, self.spacing, equation_of_state, self.rheology)
        }
    }
}
