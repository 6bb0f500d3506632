//! Parameters, their tiers and the runs that they ask for.

use super::run::{LayerPurpose, SubmergedLayerRun, refused};
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::one_dimension::submerged::{self, ViscousNumberLaw};
use crate::setup::rules;
use bagnold_solver::parameter::{between, each, inside, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Least and largest number of cells.
const CELLS: (usize, usize) = (2, 2000);

/// The grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SubmergedGrains {
    /// Diameter d `[m]`.
    #[schemars(transform = between(1e-6, 0.1, "give it in metres, such as 1.6e-4"))]
    pub diameter: f64,
    /// Density ρ_s `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2500"))]
    pub density: f64,
}

/// The liquid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ViscousLiquid {
    /// Density ρ_f `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1041"))]
    pub density: f64,
    /// Viscosity η `[Pa·s]`.
    #[schemars(transform = between(1e-4, 1e3, "give it in Pa·s, such as 0.096"))]
    pub viscosity: f64,
}

/// A run until the flow is steady.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SteadyCheck {
    /// Initial solid fraction `[-]`.
    #[schemars(transform = between(0.4, 0.64, "0.578 becomes steady in an hour"))]
    pub solid_fraction: f64,
    /// Simulated time `[s]`; 0 for none.
    #[schemars(transform = between(0.0, 1e5, "4000 leave 2e-6 of the velocity; 0 for none"))]
    pub duration: f64,
}

/// Consolidation of a compressible layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConsolidationCheck {
    /// Numbers of cells over the depth, each twice the one before; empty for none.
    #[schemars(transform = unique("name every number once"))]
    pub cells: Vec<usize>,
    /// Slope angle `[°]`; 0 keeps the grains at rest.
    #[schemars(transform = between(0.0, 60.0, "0 keeps the grains at rest, as in Terzaghi's theory"))]
    pub slope_angle: f64,
    /// Solid fraction `[-]`.
    #[schemars(transform = between(0.4, 0.64, "such as 0.578"))]
    pub solid_fraction: f64,
    /// Compressibility of the skeleton `[1/Pa]`.
    #[schemars(transform = between(1e-9, 1.0, "give it in 1/Pa, such as 1e-4"))]
    pub compressibility: f64,
    /// Time c_v t/h² of the comparison `[-]`.
    #[schemars(transform = between(0.01, 10.0, "at 0.2 half of the pressure has drained"))]
    pub time_factor: f64,
    /// Number of time steps.
    #[schemars(transform = between(1.0, 1e6, "200 leave an error of the cells alone"))]
    pub steps: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SubmergedLayerParameters {
    /// Slope angle θ `[°]`.
    #[schemars(transform = between(0.0, 60.0, "25 was measured"))]
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Depth h of the layer at the start `[m]`.
    #[schemars(transform = between(1e-4, 10.0, "give it in metres, such as 0.0049"))]
    pub depth: f64,
    /// Initial solid fractions `[-]`.
    #[schemars(transform = each(inside(0.4, 0.64, "measured are 0.562 to 0.592")))]
    #[schemars(transform = unique("name every solid fraction once"))]
    pub solid_fractions: Vec<f64>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(20.0, 1e4, "the longest measured curve ends at 520 s"))]
    pub duration: f64,
    /// Number of cells over the depth.
    pub cells: usize,
    /// Largest change of the solid fraction in a step `[-]`.
    #[schemars(transform = between(1e-7, 0.01, "5e-5 leaves 0.1 % of an onset time"))]
    pub largest_fraction_change: f64,
    /// Longest step `[s]`.
    #[schemars(transform = between(1e-3, 1e3, "give it in s, such as 0.5"))]
    pub longest_step: f64,
    /// α of the permeability α d² (1 − φ)³/φ² `[-]`.
    #[schemars(transform = between(1e-5, 1.0, "1/180 by Kozeny and Carman"))]
    pub permeability_coefficient: f64,
    /// A of the diffusion A d² γ̇ of the solid fraction by shear `[-]`.
    #[schemars(transform = between(0.0, 100.0, "1 spreads shear over a few grains; 0 for none"))]
    pub fraction_diffusion: f64,
    /// The grains.
    pub grains: SubmergedGrains,
    /// The liquid.
    pub liquid: ViscousLiquid,
    /// Friction and dilatancy.
    pub law: ViscousNumberLaw,
    /// The steady flow.
    pub steady: SteadyCheck,
    /// The consolidation.
    pub consolidation: ConsolidationCheck,
}

impl SubmergedLayerParameters {
    /// The layer of a solid fraction.
    fn layer(&self, solid_fraction: f64) -> submerged::SubmergedLayer {
        submerged::SubmergedLayer {
            slope_angle: self.slope_angle,
            gravity: self.gravity,
            depth: self.depth,
            solid_fraction,
            grain_diameter: self.grains.diameter,
            grain_density: self.grains.density,
            liquid_density: self.liquid.density,
            viscosity: self.liquid.viscosity,
            law: self.law,
            permeability_coefficient: self.permeability_coefficient,
            fraction_diffusion: self.fraction_diffusion,
            compressibility: 0.0,
            cells: self.cells,
            largest_fraction_change: self.largest_fraction_change,
            longest_step: self.longest_step,
        }
    }

    /// The consolidating layer of a number of cells.
    fn consolidation(&self, cells: usize) -> SubmergedLayerRun {
        let check = &self.consolidation;
        let layer = submerged::SubmergedLayer {
            slope_angle: check.slope_angle,
            compressibility: check.compressibility,
            fraction_diffusion: 0.0,
            cells,
            ..self.layer(check.solid_fraction)
        };
        let duration = check.time_factor * layer.depth * layer.depth / layer.consolidation_coefficient();
        // a step that is longer by rounding alone leaves none over
        let longest_step = duration / check.steps * (1.0 + 1e-9);
        let layer = submerged::SubmergedLayer { longest_step, ..layer };
        SubmergedLayerRun { purpose: LayerPurpose::Consolidation, layer, duration }
    }
}

impl Parameters for SubmergedLayerParameters {
    type Run = SubmergedLayerRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            slope_angle: 25.0,
            gravity: 9.81,
            depth: 4.9e-3,
            solid_fractions: vec![0.562, 0.568, 0.571, 0.578, 0.584, 0.588, 0.592],
            duration: 520.0,
            cells: 40,
            largest_fraction_change: 5e-5,
            longest_step: 0.5,
            permeability_coefficient: submerged::SubmergedLayer::KOZENY_CARMAN,
            fraction_diffusion: 1.0,
            grains: SubmergedGrains { diameter: 160e-6, density: 2500.0 },
            liquid: ViscousLiquid { density: 1041.0, viscosity: 0.096 },
            law: ViscousNumberLaw::GLASS_BEADS,
            steady: SteadyCheck { solid_fraction: 0.578, duration: 4000.0 },
            consolidation: ConsolidationCheck {
                cells: vec![10, 20, 40],
                slope_angle: 0.0,
                solid_fraction: 0.578,
                compressibility: 1e-4,
                time_factor: 0.2,
                steps: 200.0,
            },
        };
        let cells = vec![10, 20, 40, 80];
        let consolidation = ConsolidationCheck { cells, ..quick.consolidation.clone() };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => Self { cells: 80, consolidation, ..quick },
            Tier::Fine => Self { cells: 160, consolidation, ..quick },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let remedy = "40 are used beside the experiment";
        rules::count("cells", self.cells, CELLS.0, CELLS.1, remedy)?;
        for (index, &cells) in self.consolidation.cells.iter().enumerate() {
            rules::count(&format!("consolidation.cells[{index}]"), cells, CELLS.0, CELLS.1, remedy)?;
        }
        for (index, pair) in self.consolidation.cells.windows(2).enumerate() {
            if pair[1] != 2 * pair[0] {
                let (field, rule) = (format!("consolidation.cells[{}]", index + 1), "twice the number before it");
                return Err(ParameterError::field(&field, pair[1], rule, "10, 20 and 40 give an order"));
            }
        }
        for run in self.runs() {
            run.layer.check().map_err(refused)?;
        }
        Ok(())
    }

    fn runs(&self) -> Vec<SubmergedLayerRun> {
        let run = |purpose, solid_fraction, duration| SubmergedLayerRun {
            purpose,
            layer: self.layer(solid_fraction),
            duration,
        };
        let fractions = self.solid_fractions.iter();
        let mut runs: Vec<_> =
            fractions.map(|&fraction| run(LayerPurpose::Experiment, fraction, self.duration)).collect();
        if self.steady.duration > 0.0 {
            runs.push(run(LayerPurpose::Steady, self.steady.solid_fraction, self.steady.duration));
        }
        runs.extend(self.consolidation.cells.iter().map(|&cells| self.consolidation(cells)));
        runs
    }
}
