//! What all cases of a layer ask for alike.

use super::{Layer, Preparation, Top, bulk_modulus};
use crate::case::ParameterError;
use crate::setup::rules;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A layer that is periodic along the slope: its size, its particles and their numerics. A case has it among its own
/// parameters, a run as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PeriodicLayer {
    /// Layer height h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.01"))]
    pub layer_height: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Rows of particles over the layer.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Preparation before the start.
    pub preparation: Preparation,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
}

impl PeriodicLayer {
    /// A settled layer of displaced particles, as high `[m]` and of as many rows and columns as are given.
    pub(crate) fn settled(layer_height: f64, resolution: usize, columns: usize) -> Self {
        Self {
            layer_height,
            gravity: 9.81,
            resolution,
            columns,
            jitter: 0.1,
            seed: 1,
            preparation: Preparation::Settled,
            numerics: Numerics::default(),
        }
    }

    /// The period must hold the reach of the kernel.
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        rules::columns("columns", self.columns, &self.numerics)
    }

    /// Number of particles.
    pub fn particles(&self) -> f64 {
        (self.resolution * self.columns) as f64
    }

    /// The layer of a law and a bulk density `[kg/m³]` on a slope `[°]`, at rest; how it is run is left to the case.
    pub fn of(&self, rheology: Rheology, reference_density: f64, slope_angle: f64) -> Layer<'static> {
        Layer {
            layer: *self,
            inclination: slope_angle.to_radians(),
            reference_density,
            bulk_modulus: bulk_modulus(reference_density, self.gravity, self.layer_height, 0.0),
            top: Top::Free,
            compressed: true,
            rheology,
            velocity: &|_| 0.0,
            shear_stress: &|_| 0.0,
            duration: 0.0,
            window: 0.0,
            interval: 0.0,
            stop_above: f64::INFINITY,
            frames: 2,
            may_diverge: false,
        }
    }
}
