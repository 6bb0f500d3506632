//! The grains before the collapse: displaced from a lattice on a bed, under hydrostatic pressure, at rest.

use crate::cases::layer::hydrostatic_pressure;
use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::boundary::wall::fill;
use bagnold_solver::weakly_compressible::boundary::{Enclosure, Wall};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use rand::{RngExt, SeedableRng};

/// Bulk modulus over ρ0 g h_0 `[-]`.
pub(super) const STIFFNESS: f64 = 50.0;

/// What the grains of a block have in common.
pub(super) struct Block<const D: usize> {
    /// Particle spacing `[m]`.
    pub(super) spacing: f64,
    /// Height of its surface `[m]`, along the second axis.
    pub(super) height: f64,
    /// Gravity `[m/s²]`.
    pub(super) gravity: Vector<D>,
    /// Density in bulk `[kg/m³]`.
    pub(super) density: f64,
    /// Bulk modulus `[Pa]`.
    pub(super) bulk_modulus: f64,
    /// Law that is simulated.
    pub(super) rheology: Rheology,
    /// Largest random displacement of a particle along each axis, in spacings `[-]`.
    pub(super) jitter: f64,
    /// Seed of the displacements.
    pub(super) seed: u64,
    /// Numerics.
    pub(super) numerics: Numerics,
}

impl<const D: usize> Block<D> {
    /// The block at its lattice sites on a bed that ends at `bed_end` `[m]` along all horizontal axes.
    pub(super) fn scene(&self, sites: impl Iterator<Item = Vector<D>>, domain: Domain<D>, bed_end: f64) -> Scene<D> {
        let equation_of_state =
            EquationOfState { reference_density: self.density, bulk_modulus: self.bulk_modulus, tension: Tension::Cut };
        let bed = Wall::still(1, 0.0, 1.0);
        let layers = (2.0 * self.numerics.smoothing_ratio).ceil() as usize + 1;
        let mut far = Vector::<D>::repeat(bed_end);
        far[1] = self.height;
        Scene {
            flow: self.fill(sites, &equation_of_state),
            wall_particles: fill(&[bed], &domain, (Vector::zeros(), far), self.spacing, layers),
            enclosure: Enclosure::default(),
            walls: vec![bed],
            domain,
            gravity: self.gravity,
            spacing: self.spacing,
            equation_of_state,
            rheology: self.rheology,
            numerics: self.numerics,
        }
    }

    /// Fills lattice sites. Density and mass belong to the site, so that the block neither sinks nor swells.
    fn fill(&self, sites: impl Iterator<Item = Vector<D>>, equation_of_state: &EquationOfState) -> Flow<D> {
        let mut random = rand_pcg::Pcg64::seed_from_u64(self.seed);
        let mut flow = Flow::default();
        for site in sites {
            let shift = Vector::<D>::from_fn(|_, _| self.jitter * self.spacing * (2.0 * random.random::<f64>() - 1.0));
            let depth = self.height - site[1];
            let pressure = hydrostatic_pressure(self.bulk_modulus, self.density, -self.gravity[1], depth);
            let density = equation_of_state.density(pressure);
            flow.position.push(site + shift);
            flow.velocity.push(Vector::zeros());
            flow.density.push(density);
            flow.mass.push(density * self.spacing.powi(D as i32));
            flow.stress.push(Tensor::zeros());
        }
        flow
    }
}
