//! Parameters.

use super::grain_units::{LayerConditions, Onset};
use super::replacements::Sensitivities;
use super::suspension_inputs::SuspensionInputs;
use crate::case::ParameterError;
use crate::reference::bed_load::MeasuredBedLoad;
use crate::reference::one_dimension::bed_load::{Closures, Stream};
use crate::setup::rules;
use bagnold_solver::parameter::{between, each, positive, up_to};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaterStream {
    /// Depth h above the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Density ρ_f `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Kinematic viscosity ν `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s, 1e-6 for water"))]
    pub kinematic_viscosity: f64,
}

/// The grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedGrains {
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.04"))]
    pub bed_depth: f64,
    /// Depth of the lowest part of the bed, whose grains are held while water seeps through `[m]`.
    pub held_depth: f64,
    /// Density ρ_s `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub density: f64,
    /// Diameter d `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub diameter: f64,
    /// Diameter of the grains of the bed at rest that the moving bed is compared with, over d `[-]`; 1 is the same bed.
    #[schemars(transform = positive("1 compares with the same bed, 2 with a bed of twice the roughness"))]
    pub rest_diameter: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedLoad1dParameters {
    /// Slopes tanθ `[-]`.
    #[schemars(transform = each(positive("give tanθ, such as 0.03; without a slope nothing flows")))]
    #[schemars(transform = each(between(0.0, 0.2, "on steeper slopes the bed itself would slide")))]
    pub slopes: Vec<f64>,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Height of a cell `[m]`.
    #[schemars(transform = positive("give it in metres, such as 2.5e-4"))]
    pub cell_height: f64,
    /// Change of a step, of velocities over u_* and of fractions, below which a layer counts as steady `[-]`.
    #[schemars(transform = positive("1e-11 is hardly more than rounding; 1e-3 stops on the way"))]
    pub steady_change: f64,
    /// Speed of the water and the upper grains in the second start `[m/s]`.
    #[schemars(transform = up_to(100.0, "give it in m/s, such as 2; a state is called steady only if both starts lead there"))]
    pub fast_start: f64,
    /// Heights of cells for the order with dilation `[m]`, three or more, each half the one before; empty for none.
    #[schemars(transform = each(positive("give it in metres, such as 2.5e-4")))]
    pub dilating_cell_heights: Vec<f64>,
    /// The same with a given solid fraction `[m]`.
    #[schemars(transform = each(positive("give it in metres, such as 2.5e-4")))]
    pub frozen_cell_heights: Vec<f64>,
    /// The water.
    pub water: WaterStream,
    /// The grains.
    pub grains: BedGrains,
    /// Closures.
    pub closures: Closures,
    /// Other closures, one at a time.
    pub sensitivities: Sensitivities,
    /// A layer by its Shields number and its grains, for sweeps.
    pub similar: LayerConditions,
    /// Layers about the onset of motion.
    pub onset: Onset,
    /// Layers of others to compare with.
    pub measured: Vec<MeasuredBedLoad>,
    /// Grains in suspension; without the measured sheet flow no layer has them.
    pub suspension: SuspensionInputs,
}

impl BedLoad1dParameters {
    /// The stream on a slope tanθ.
    pub(super) fn stream(&self, slope: f64) -> Stream {
        Stream {
            slope,
            flow_depth: self.water.depth,
            bed_depth: self.grains.bed_depth,
            held_depth: self.grains.held_depth,
            gravity: self.gravity,
            fluid_density: self.water.density,
            kinematic_viscosity: self.water.kinematic_viscosity,
            grain_density: self.grains.density,
            grain_diameter: self.grains.diameter,
            drag_diameter: 1.0,
        }
    }

    /// A height of cells that divides all depths.
    pub(super) fn cells(&self, field: &str, height: f64) -> Result<(), ParameterError> {
        check_cells(field, height, &[self.water.depth, self.grains.bed_depth, self.grains.held_depth])
    }
}

/// A height of cells that divides depths `[m]`, that of the water first and that of the bed second.
pub(super) fn check_cells(field: &str, height: f64, depths: &[f64]) -> Result<(), ParameterError> {
    let fits = |depth: &f64| (depth / height - (depth / height).round()).abs() < 1e-6;
    if depths.iter().all(fits) && depths[0] / height >= 10.0 && (depths[0] + depths[1]) / height <= 1e5 {
        return Ok(());
    }
    let rule = "such that the depths of water, bed and held grains are whole multiples of it, at most 1e5 in all";
    let remedy = "2.5e-4 divides all depths that are given in quarters of a millimetre";
    Err(ParameterError::field(field, height, rule, remedy))
}
