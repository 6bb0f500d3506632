//! The scene of a channel.

use super::Channel;
use crate::setup::wall_rows;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{Fluid, IncompressibleScene, ParticleSet};
use bagnold_solver::vector::Vector;

impl Channel<'_> {
    /// The scene as the run starts from it.
    pub fn scene(&self) -> IncompressibleScene<2> {
        let lattice = &self.fluid;
        let displaced = || {
            // the exact velocity of the displaced place: a start that the flow can keep
            let position = lattice.displaced(self.jitter, self.seed);
            let velocity = position.iter().map(|x| Vector::<2>::new((self.velocity)(x[1]), 0.0)).collect();
            ParticleSet { position, velocity }
        };
        IncompressibleScene {
            fluid: Fluid {
                particles: self.particles.clone().unwrap_or_else(displaced),
                wall: lattice.below(wall_rows(self.numerics.smoothing_ratio)).sites().collect(),
                spacing: lattice.spacing,
                density: self.density,
                kinematic_viscosity: self.kinematic_viscosity,
                turbulence: self.turbulence,
                bed: self.bed,
                gravity: Vector::<2>::new(self.gravity * self.slope, -self.gravity),
            },
            sediment: self.sediment.clone(),
            domain: Domain {
                axes: [AxisBoundary::Periodic { lower: 0.0, upper: lattice.length() }, AxisBoundary::Open],
            },
            solid_fraction: self.solid_fraction.clone(),
            numerics: self.numerics,
        }
    }
}
