//! Parameters, their tiers and the runs that they ask for.

use super::run::{LayerPurpose, SubmergedLayerRun};
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::one_dimension::submerged::SubmergedLayer;
use bagnold_solver::parameter::{between, each, inside, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Solid fraction of the layers that are compared with exact solutions `[-]`: loose enough to become steady in an hour.
const EXACT_FRACTION: f64 = 0.578;

/// Consolidation of a compressible layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConsolidationCheck {
    /// Numbers of cells over the depth, each twice the one before; empty for none.
    #[schemars(transform = each(between(2.0, 2000.0, "10, 20 and 40 give an order")))]
    #[schemars(transform = unique("name every number once"))]
    pub cells: Vec<usize>,
    /// Slope angle `[°]`; 0 keeps the grains at rest.
    #[schemars(transform = between(0.0, 60.0, "0 keeps the grains at rest, as in Terzaghi's theory"))]
    pub slope_angle: f64,
    /// Compressibility of the skeleton `[1/Pa]`.
    #[schemars(transform = between(1e-9, 1.0, "give it in 1/Pa, such as 1e-4"))]
    pub compressibility: f64,
    /// Time of the comparison over h²/c_v `[-]`.
    #[schemars(transform = between(0.01, 10.0, "at 0.2 half of the pressure has drained"))]
    pub time_factor: f64,
    /// Number of time steps.
    #[schemars(transform = between(1.0, 1e6, "200 leave an error of the cells alone"))]
    pub steps: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SubmergedLayerParameters {
    /// Initial solid fractions `[-]`.
    #[schemars(transform = each(inside(0.4, 0.64, "measured are 0.562 to 0.592")))]
    #[schemars(transform = unique("name every solid fraction once"))]
    pub solid_fractions: Vec<f64>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(20.0, 1e4, "the longest measured curve ends at 520 s"))]
    pub duration: f64,
    /// Simulated time until the flow counts as steady `[s]`; 0 for no steady flow.
    #[schemars(transform = between(0.0, 1e5, "4000 leave 2e-6 of the velocity; 0 for no steady flow"))]
    pub steady_duration: f64,
    /// The layer.
    #[serde(flatten)]
    pub layer: SubmergedLayer,
    /// The consolidation.
    pub consolidation: ConsolidationCheck,
}

impl SubmergedLayerParameters {
    /// The consolidating layer of a number of cells.
    fn consolidation(&self, cells: usize) -> SubmergedLayerRun {
        let check = &self.consolidation;
        let layer = SubmergedLayer {
            slope_angle: check.slope_angle,
            compressibility: check.compressibility,
            fraction_diffusion: 0.0,
            cells,
            ..self.layer
        };
        let duration = check.time_factor * layer.depth * layer.depth / layer.consolidation_coefficient(EXACT_FRACTION);
        // a step that is longer by rounding alone leaves none over
        let layer = SubmergedLayer { longest_step: duration / check.steps * (1.0 + 1e-9), ..layer };
        SubmergedLayerRun { purpose: LayerPurpose::Consolidation, layer, solid_fraction: EXACT_FRACTION, duration }
    }
}

impl Parameters for SubmergedLayerParameters {
    type Run = SubmergedLayerRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            solid_fractions: vec![0.562, 0.568, 0.571, 0.578, 0.584, 0.588, 0.592],
            duration: 520.0,
            steady_duration: 4000.0,
            layer: SubmergedLayer::EXPERIMENT,
            consolidation: ConsolidationCheck {
                cells: vec![10, 20, 40],
                slope_angle: 0.0,
                compressibility: 1e-4,
                time_factor: 0.2,
                steps: 200.0,
            },
        };
        let finer = |cells| Self {
            layer: SubmergedLayer { cells, ..quick.layer },
            consolidation: ConsolidationCheck { cells: vec![10, 20, 40, 80], ..quick.consolidation.clone() },
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => finer(80),
            Tier::Fine => finer(160),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let layer = &self.layer;
        if layer.grain_density <= layer.liquid_density {
            let (rule, remedy) = ("greater than the density of the liquid", "grains that float form no layer");
            return Err(ParameterError::field("grain_density", layer.grain_density, rule, remedy));
        }
        for (index, pair) in self.consolidation.cells.windows(2).enumerate() {
            if pair[1] != 2 * pair[0] {
                let (field, rule) = (format!("consolidation.cells[{}]", index + 1), "twice the number before it");
                return Err(ParameterError::field(&field, pair[1], rule, "10, 20 and 40 give an order"));
            }
        }
        Ok(())
    }

    fn runs(&self) -> Vec<SubmergedLayerRun> {
        let run = |purpose, solid_fraction, duration| SubmergedLayerRun {
            purpose,
            layer: self.layer,
            solid_fraction,
            duration,
        };
        let fractions = self.solid_fractions.iter();
        let mut runs: Vec<_> =
            fractions.map(|&fraction| run(LayerPurpose::Experiment, fraction, self.duration)).collect();
        if self.steady_duration > 0.0 {
            runs.push(run(LayerPurpose::Steady, EXACT_FRACTION, self.steady_duration));
        }
        runs.extend(self.consolidation.cells.iter().map(|&cells| self.consolidation(cells)));
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_between_fields_name_the_field() {
        let quick = SubmergedLayerParameters::of_tier(Tier::Quick);
        let refusal = |change: fn(&mut SubmergedLayerParameters)| {
            let mut changed = quick.clone();
            change(&mut changed);
            changed.check().expect_err("out of range").to_string()
        };
        assert!(refusal(|own| own.layer.grain_density = 900.0).starts_with("`grain_density` is 900"));
        assert!(refusal(|own| own.consolidation.cells = vec![10, 30]).starts_with("`consolidation.cells[1]` is 30"));
        assert!(quick.check().is_ok());
        assert_eq!(quick.runs().len(), 11);
    }
}
