//! Parameters.

use super::experiment::{Experiment, Vessel};
use super::formulation::GrainFormulation;
use crate::reference::settling::SettlingGrains;
use crate::setup::rules;
use bagnold_solver::incompressible::ProjectionNumerics;
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::parameter::{between, each, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The fluid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SuspendingFluid {
    /// Density ρ_f `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Kinematic viscosity ν `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s, 1e-6 for water"))]
    pub kinematic_viscosity: f64,
}

/// A grain alone in a periodic box of fluid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SingleGrain {
    /// The box.
    #[serde(flatten)]
    pub vessel: Vessel,
    /// Drag laws; Ergun's has no grain alone; empty for none.
    pub laws: Vec<DragLaw>,
    /// Formulations.
    pub formulations: Vec<GrainFormulation>,
    /// Simulated time over the time u_t ρ_s/(2 (ρ_s − ρ_f) g) in which a grain gets to its terminal velocity `[-]`.
    #[schemars(transform = between(10.0, 1e4, "40 leaves a window of 24 to average over"))]
    pub relaxation_times: f64,
}

/// A uniform suspension in a periodic column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SuspendedGrains {
    /// The column.
    #[serde(flatten)]
    pub vessel: Vessel,
    /// Drag laws; Ergun's at φ ≥ 0.2 only; empty for none.
    pub laws: Vec<DragLaw>,
    /// Solid fractions φ `[-]`.
    #[schemars(transform = each(between(0.01, 0.64, "grains fill up to 0.64 of the space")))]
    pub solid_fractions: Vec<f64>,
    /// Solid fraction that stands for a grain alone `[-]`; 0 for none.
    #[schemars(transform = between(0.0, 0.005, "0.002 hinders by less than 1 %; 0 for none"))]
    pub dilute_fraction: f64,
    /// Simulated time over |u_r| ρ_s/((ρ_s − ρ_f) g) `[-]`.
    #[schemars(transform = between(10.0, 1e4, "12 leave a window of 7 to average over"))]
    pub relaxation_times: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettlingParameters {
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density of the grains ρ_s `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub grain_density: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// The fluid.
    pub water: SuspendingFluid,
    /// A grain alone.
    pub grain: SingleGrain,
    /// A suspension.
    pub suspension: SuspendedGrains,
    /// Numerics of the formulation "stabilised"; "paper" takes the paper's own, with these steps and tolerances.
    pub numerics: ProjectionNumerics,
}

impl SettlingParameters {
    /// An experiment in a vessel for so many of the relaxation times `[s]` that `relaxation` gives.
    pub(super) fn experiment(
        &self,
        vessel: Vessel,
        law: DragLaw,
        times: f64,
        relaxation: impl Fn(&SettlingGrains) -> f64,
    ) -> Experiment {
        let grains = self.grains(vessel.diameter);
        let duration = times * relaxation(&grains);
        Experiment { law, grains, vessel, seed: self.seed, duration, numerics: self.numerics }
    }

    /// Grains of a diameter `[m]` in the fluid.
    pub(super) fn grains(&self, diameter: f64) -> SettlingGrains {
        SettlingGrains {
            grain_diameter: diameter,
            grain_density: self.grain_density,
            fluid_density: self.water.density,
            kinematic_viscosity: self.water.kinematic_viscosity,
            gravity: self.gravity,
        }
    }
}
