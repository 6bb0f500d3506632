//! One run: its formulation and what it depends on.

use super::parameters::{Continuum, GrainParticles, Materials, Stage};
use crate::reference::one_dimension::bed_load::Stream;
use bagnold_solver::incompressible::PairLaw;
use bagnold_solver::material::rheology::CoulombBingham;
use serde::Serialize;

/// Which formulation a run is of.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BedLoadFormulation {
    /// As printed.
    Paper(GrainParticles),
    /// By the recipe.
    Stabilised(GrainParticles),
    /// By the recipe, one point of the grid of the fits.
    Fit {
        /// Its grains, of the law of that point.
        grains: GrainParticles,
        /// That law.
        law: CoulombBingham,
    },
    /// Volume fractions.
    Continuum(ContinuumRun),
}

impl BedLoadFormulation {
    /// The parameters of a formulation with one particle a grain.
    pub(super) fn grains(&self) -> Option<&GrainParticles> {
        match self {
            Self::Paper(grains) | Self::Stabilised(grains) | Self::Fit { grains, .. } => Some(grains),
            Self::Continuum(_) => None,
        }
    }
}

/// What is special to one run.
#[derive(Debug, Clone, Serialize)]
pub struct ContinuumRun {
    /// The formulation's parameters, without its list of runs.
    pub continuum: Continuum,
    /// Stage.
    pub stage: Stage,
    /// Pair law; none of grains that dilate.
    pub pair_law: Option<PairLaw>,
    /// Velocities at the start over those of the 1-D layer `[-]`.
    pub start: f64,
    /// Spacing `[m]`.
    pub spacing: f64,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct BedLoadRun {
    /// Formulation.
    pub formulation: BedLoadFormulation,
    /// Slope `[-]`.
    pub slope: f64,
    /// Water and grains.
    pub materials: Materials,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
    pub(super) jitter: f64,
    pub(super) seed: u64,
}

impl BedLoadRun {
    /// The stream of the 1-D layer.
    #[must_use]
    pub fn stream(&self) -> Stream {
        let Materials { depth, gravity, fluid_density, kinematic_viscosity, grain_density, grain_diameter } =
            self.materials;
        let (bed_depth, held_depth) = match &self.formulation {
            BedLoadFormulation::Paper(grains)
            | BedLoadFormulation::Stabilised(grains)
            | BedLoadFormulation::Fit { grains, .. } => (grains.bed_depth, 0.0),
            BedLoadFormulation::Continuum(own) => (own.continuum.bed_depth, own.continuum.held_depth),
        };
        Stream {
            slope: self.slope,
            flow_depth: depth,
            bed_depth,
            held_depth,
            gravity,
            fluid_density,
            kinematic_viscosity,
            grain_density,
            grain_diameter,
        }
    }
}
