//! Layers whose lengths are counted in grains, so that only their Shields number and their grains differ: one that sweeps
//! vary, and those whose onset of motion is sought.

use crate::case::ParameterError;
use bagnold_solver::parameter::{between, each, positive, up_to};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Depths and cells in grain diameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainUnits {
    /// Depth of the water in grain diameters.
    #[schemars(transform = between(2.0, 1000.0, "20 to be many grains deep"))]
    pub relative_depth: f64,
    /// Depth of the bed in grain diameters.
    #[schemars(transform = between(1.0, 1000.0, "6, or more where the grains move deeper"))]
    pub relative_bed_depth: f64,
    /// Cells over a grain diameter; both depths are whole multiples of one.
    #[schemars(transform = between(2.0, 1000.0, "12 is quick, 20 is accurate"))]
    pub cells_per_diameter: f64,
}

impl GrainUnits {
    pub(super) fn check(&self, group: &str) -> Result<(), ParameterError> {
        let depths = [("relative_depth", self.relative_depth), ("relative_bed_depth", self.relative_bed_depth)];
        for (name, depth) in depths {
            let cells = depth * self.cells_per_diameter;
            if (cells - cells.round()).abs() > 1e-6 {
                let (rule, remedy) = ("a whole multiple of a cell", "choose whole numbers");
                return Err(ParameterError::field(&format!("{group}.{name}"), depth, rule, remedy));
            }
        }
        Ok(())
    }
}

/// Conditions of one layer: Shields number and grain size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LayerConditions {
    /// Shields number τ* `[-]`; 0 for no such layer.
    #[schemars(transform = between(0.0, 10.0, "0.03 to 0.7 for bed load, or 0 for no such layer"))]
    pub shields_number: f64,
    /// Diameter of the grains `[m]`.
    #[schemars(transform = positive("give it in metres; 0.002 for 2 mm"))]
    pub diameter: f64,
    /// Its lengths.
    #[serde(flatten)]
    pub lengths: GrainUnits,
}

/// The onset of motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Onset {
    /// Diameters of the grains `[m]`; empty for none.
    #[schemars(transform = each(positive("give it in metres; 0.002 for 2 mm")))]
    pub diameters: Vec<f64>,
    /// Rate γ_r `[1/s]` below which friction falls to zero: less than elsewhere, for the creep of a bed that rests is as
    /// much as the least transport that is sought.
    #[schemars(transform = up_to(1.0, "such as 5e-4"))]
    pub regularisation_rate: f64,
    /// Lengths.
    #[serde(flatten)]
    pub lengths: GrainUnits,
}

impl Onset {
    pub(super) fn of(diameters: &[f64], lengths: GrainUnits) -> Self {
        Self { diameters: diameters.to_vec(), regularisation_rate: 5e-4, lengths }
    }
}

impl GrainUnits {
    /// Few cells and a shallow bed: enough where little moves.
    pub(super) const SHALLOW: Self = Self { relative_depth: 12.0, relative_bed_depth: 4.0, cells_per_diameter: 10.0 };
    /// Accurate.
    pub(super) const DEEP: Self = Self { relative_depth: 20.0, relative_bed_depth: 6.0, cells_per_diameter: 20.0 };
}

impl LayerConditions {
    pub(super) const NONE: Self = Self {
        shields_number: 0.0,
        diameter: 2e-3,
        lengths: GrainUnits { relative_depth: 20.0, relative_bed_depth: 6.0, cells_per_diameter: 12.0 },
    };
}
