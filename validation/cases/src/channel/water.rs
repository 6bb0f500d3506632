//! Water over a floor, as the cases without a sediment declare it.

use super::Channel;
use crate::case::ParameterError;
use crate::setup::{Lattice, rules};
use bagnold_solver::incompressible::ProjectionNumerics;
use bagnold_solver::parameter::positive;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Water in rows and columns of particles: a group of parameters that a case flattens into its own, and that its runs hold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Water {
    /// Depth h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Rows of particles over the depth.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Seed of the displacements.
    pub seed: u64,
    /// Numerical scheme of the incompressible model.
    pub numerics: ProjectionNumerics,
}

impl Water {
    /// Water as deep as in the bed-load paper, with a given number of rows and few columns, so that it is quick.
    pub(crate) fn of_rows(resolution: usize) -> Self {
        Self {
            depth: 0.046,
            gravity: 9.81,
            density: 1000.0,
            resolution,
            columns: 12,
            seed: 1,
            numerics: ProjectionNumerics::default(),
        }
    }

    /// The rules between its fields.
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        rules::channel_columns("columns", self.columns, &self.numerics)?;
        rules::projection("numerics", &self.numerics)
    }

    /// Particle spacing `[m]`.
    pub fn spacing(&self) -> f64 {
        self.depth / self.resolution as f64
    }

    /// Particles.
    pub fn particles(&self) -> f64 {
        (self.resolution * self.columns) as f64
    }

    /// A channel of this water, as [`Channel::of`] has it.
    pub(crate) fn channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let fluid = Lattice { spacing: self.spacing(), rows: self.resolution, columns: self.columns, bottom: 0.0 };
        Channel { seed: self.seed, numerics: self.numerics, ..Channel::of(fluid, self.density, self.gravity, velocity) }
    }
}
