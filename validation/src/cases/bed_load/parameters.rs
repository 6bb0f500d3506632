//! Parameters.

use crate::cases::channel::TurbulenceClosure;
use crate::reference::bed_load_layer::Closures;
use bagnold_solver::incompressible::{PairLaw, ProjectionNumerics};
use bagnold_solver::material::dilatancy::PressureBounds;
use bagnold_solver::material::drag::DragLaw;
use serde::{Deserialize, Serialize};

/// Water and grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Materials {
    /// Depth h of the water above the bed `[m]`.
    pub depth: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Density of the water `[kg/m³]`.
    pub fluid_density: f64,
    /// Kinematic viscosity of the water `[m²/s]`.
    pub kinematic_viscosity: f64,
    /// Density of the grains `[kg/m³]`.
    pub grain_density: f64,
    /// Diameter of the grains `[m]`.
    pub grain_diameter: f64,
}

/// The yield of a bed of single grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Yield {
    /// τ_y `[Pa]`.
    pub yield_stress: f64,
    /// μ `[Pa·s]`.
    pub viscosity: f64,
    /// Shear rate below which the bed creeps instead of standing still `[1/s]`.
    pub regularisation_rate: f64,
    /// Largest viscosity of the yield `[Pa·s]`: that of a deep bed at rest.
    pub largest_viscosity: f64,
}

/// One particle a grain, over a bed whose pores hold water: `paper` as printed, `stabilised` by the recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// Slopes, one run each `[-]`; empty for none.
    pub slopes: Vec<f64>,
    /// Yield stress and viscosity.
    pub material: Yield,
    /// Friction on the overburden below the top row of grains `[-]`.
    pub overburden_friction: f64,
    /// Depth of the bed `[m]`.
    pub bed_depth: f64,
    /// Length of the period `[m]`.
    pub length: f64,
    /// Spacing of the water's particles `[m]`.
    pub spacing: f64,
    /// Closure of the water's turbulence above the bed.
    pub turbulence: TurbulenceClosure,
    /// Depth of the origin of the mixing length below the bed `[m]`.
    pub origin_offset: f64,
    /// Drag law.
    pub drag: DragLaw,
    /// Factor of the drag `[-]`.
    pub drag_factor: f64,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
    /// Numerics.
    pub numerics: ProjectionNumerics,
}

/// How much of the 1-D layer the grains of a `continuum` run are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// They rest at the layer's solid fraction.
    Porous,
    /// They move at the layer's solid fraction.
    Frozen,
    /// They dilate.
    Dilating,
}

impl Stage {
    /// The pair law whose runs are judged; runs of others show what a law does. Grains in rows have no rate but that of
    /// the flow. Grains that dilate jostle: with the pair's own rate a raft of them slides on a thin layer, the faster the
    /// finer the spacing, while the averaged rate comes nearer to the layer.
    pub(super) fn judged_pair_law(self) -> PairLaw {
        match self {
            Self::Porous | Self::Frozen => PairLaw::PairRateMeanLoad,
            Self::Dilating => PairLaw::AveragedPairRate,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Porous => "porous",
            Self::Frozen => "frozen",
            Self::Dilating => "dilating",
        }
    }
}

/// Runs of one stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageRuns {
    /// Stage.
    pub stage: Stage,
    /// Slopes `[-]`.
    pub slopes: Vec<f64>,
    /// Pair laws.
    pub pair_laws: Vec<PairLaw>,
    /// Velocities at the start over those of the 1-D layer `[-]`.
    pub starts: Vec<f64>,
    /// Spacings of the particles of both phases `[m]`.
    pub spacings: Vec<f64>,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
}

/// Volume fractions, literature closures, nothing fitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Continuum {
    /// Runs.
    pub runs: Vec<StageRuns>,
    /// Depth of the bed `[m]`.
    pub bed_depth: f64,
    /// Lowest part of the bed whose grains are held `[m]`.
    pub held_depth: f64,
    /// Length of the period `[m]`.
    pub length: f64,
    /// Closures of particles and of the layer.
    pub closures: Closures,
    /// Solid fraction of the layer below which a row carries no sediment particle `[-]`.
    pub least_fraction: f64,
    /// Bounds of the pressure of dilating sediment.
    pub pressure_bounds: PressureBounds,
    /// Smoothing length of dilating sediment over its spacing `[-]`.
    pub smoothing_ratio: f64,
    /// Largest random displacement of dilating sediment in spacings `[-]`.
    pub sediment_jitter: f64,
    /// Numerics at a spacing of 1 mm; the time step goes with the spacing.
    pub numerics: ProjectionNumerics,
}

/// The grid of yield stresses and viscosities that the fits interpolate in; empty for none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// τ_y `[Pa]`, rising.
    pub yield_stresses: Vec<f64>,
    /// μ `[Pa·s]`, rising.
    pub viscosities: Vec<f64>,
    /// Slopes, three or more `[-]`; each is held out once.
    pub slopes: Vec<f64>,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedLoadParameters {
    /// Water and grains.
    pub materials: Materials,
    /// As printed.
    pub paper: Grains,
    /// By the recipe.
    pub stabilised: Grains,
    /// Volume fractions.
    pub continuum: Continuum,
    /// Fits of `stabilised`.
    pub fit: Fit,
    /// Largest random displacement of a fluid particle in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
}

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("materials.depth", "[m], of the water above the bed"),
    ("materials.grain_diameter", "[m]"),
    ("stabilised.slopes", "[-], tangents: 0.03 is 3 %, one run each"),
    ("stabilised.material.yield_stress", "[Pa], in the norm √(½ s:s)"),
    ("stabilised.material.viscosity", "[Pa·s]"),
    ("stabilised.overburden_friction", "[-], on the weight of the grains below the top row"),
    ("stabilised.turbulence", "`mixing_length` or `smagorinsky`"),
    ("stabilised.drag_smoothing_length", "[m]"),
    ("stabilised.duration", "[s]"),
    ("stabilised.averaging_time", "[s], before the end"),
    ("continuum.runs.stage", "\"porous\", \"frozen\" or \"dilating\""),
    ("stabilised.material.regularisation_rate", "[1/s], below it the bed creeps"),
    ("stabilised.material.largest_viscosity", "[Pa·s], of the yield: a deep bed at rest"),
    ("continuum.least_fraction", "[-], a row of the layer below it carries no sediment particle"),
    ("continuum.pressure_bounds.stiffness", "[Pa], dp/dφ of packed grains"),
    ("continuum.pressure_bounds.least_room", "[-], least φ_max − φ"),
    ("continuum.pressure_bounds.largest_load_ratio", "[-], largest pressure of sheared grains over their load"),
    ("continuum.pressure_bounds.largest_excess", "[Pa], and beyond that"),
    ("continuum.held_depth", "[m], lowest part of the bed, whose grains are held"),
    ("fit.yield_stresses", "[Pa], with fit.viscosities [Pa·s] the grid of the fits; empty for none"),
    ("jitter", "[-], largest random displacement in spacings"),
];
