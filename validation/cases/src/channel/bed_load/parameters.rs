//! Parameters.

use crate::channel::TurbulenceClosure;
use crate::reference::one_dimension::bed_load::Closures;
use crate::setup::rules;
use bagnold_solver::incompressible::{ColumnNumerics, PairLaw, ProjectionNumerics};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, each, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Water and grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Materials {
    /// Depth h of the water above the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density of the water `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub fluid_density: f64,
    /// Kinematic viscosity of the water `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Density of the grains `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub grain_density: f64,
    /// Diameter of the grains `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub grain_diameter: f64,
}

/// One particle a grain, over a bed whose pores hold water: `paper` as printed, `stabilised` by the recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainParticles {
    /// Slopes, tangents, one run each `[-]`; 0.03 is 3 %, empty for none.
    #[schemars(transform = each(rules::driving_slope()))]
    pub slopes: Vec<f64>,
    /// How the grains resist a shear, a law by its name; its pressure is the weight of the grains below the top row.
    pub material: Rheology,
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.03"))]
    pub bed_depth: f64,
    /// Length of the period `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.04"))]
    pub length: f64,
    /// Spacing of the water's particles `[m]`.
    #[schemars(transform = positive("give it in metres; 0.002 for the paper's"))]
    pub spacing: f64,
    /// Closure of the water's turbulence above the bed.
    pub turbulence: TurbulenceClosure,
    /// Depth of the origin of the mixing length below the bed `[m]`.
    #[schemars(transform = not_negative("a fraction of a grain diameter, such as 0.0006"))]
    pub origin_offset: f64,
    /// Drag law.
    pub drag: DragLaw,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Velocity of the water at the start over that of the logarithmic law of a rough bed `[-]`.
    #[schemars(transform = between(0.0, 3.0, "0.9 is near the steady flow"))]
    pub start: f64,
    /// The same of a second run, which shows whether the start is forgotten `[-]`.
    #[schemars(transform = between(0.0, 3.0, "another than `start`, such as 0.45"))]
    pub other_start: f64,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.1, 1e4, "a few seconds, more to be stationary"))]
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
    /// Numerics.
    pub numerics: ProjectionNumerics,
}

/// A run beside one of `stabilised`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Beside {
    /// The same water over the same bed at rest: all grains are held.
    AtRest,
    /// The same from another start.
    OtherStart,
}

/// Tenths of a millimetre in a metre.
const TENTHS: f64 = 1e4;

/// How much of the 1-D layer the grains of a `continuum` run are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
    /// The pair law whose runs are judged; runs of others show what a law does. Grains that dilate know columns and no
    /// pairs.
    pub(super) const fn judged_pair_law(self) -> Option<PairLaw> {
        match self {
            Self::Porous | Self::Frozen => Some(PairLaw::PairRateMeanLoad),
            Self::Dilating => None,
        }
    }

    /// Spacing of a run `[m]` whose file asks for one, by the largest over τ* d, in whole tenths of a millimetre.
    pub(super) fn spacing(self, asked: f64, largest: f64, slope: f64, materials: &Materials) -> f64 {
        let weight = materials.grain_density / materials.fluid_density - 1.0;
        // τ* d
        let scale = materials.depth * slope / weight;
        match self {
            Self::Porous | Self::Dilating => asked,
            Self::Frozen => asked.min((largest * scale * TENTHS).floor().max(1.0) / TENTHS),
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageRuns {
    /// Stage.
    pub stage: Stage,
    /// Slopes `[-]`.
    #[schemars(transform = each(rules::driving_slope()))]
    pub slopes: Vec<f64>,
    /// Pair laws; none of grains that dilate.
    pub pair_laws: Vec<PairLaw>,
    /// Velocities at the start over those of the 1-D layer `[-]`.
    #[schemars(transform = each(between(0.0, 3.0, "1 starts as the 1-D layer flows")))]
    pub starts: Vec<f64>,
    /// Spacings of the particles of both phases `[m]`; `frozen` takes a smaller one where `largest_spacing` says so.
    pub spacings: Vec<f64>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.1, 1e4, "a few seconds, more to be stationary"))]
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
}

impl StageRuns {
    /// One for each run, none where grains know no pairs.
    pub(super) fn pair_laws(&self) -> Vec<Option<PairLaw>> {
        match self.stage {
            Stage::Porous | Stage::Frozen => self.pair_laws.iter().copied().map(Some).collect(),
            Stage::Dilating => vec![None],
        }
    }
}

/// Volume fractions, closures of the literature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Continuum {
    /// Runs.
    pub runs: Vec<StageRuns>,
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.016"))]
    pub bed_depth: f64,
    /// Depth of the lowest part of the bed, whose grains are held `[m]`.
    pub held_depth: f64,
    /// Length of the period `[m]`.
    pub length: f64,
    /// Closures of particles and of the layer.
    pub closures: Closures,
    /// Diameter of the sphere with the drag of a grain, over d `[-]`.
    #[schemars(transform = between(0.01, 2.0, "it counts grain diameters: 1 for spheres, 0.5 for crushed plastic"))]
    pub drag_diameter: f64,
    /// Largest spacing of grains that move at a given fraction, over τ* d `[-]`: their velocity falls by e over some
    /// 0.9 τ* d, and a layer thinner than that needs finer particles than a file asks for.
    #[schemars(transform = between(0.1, 100.0, "0.9 puts three rows into the layer that moves"))]
    pub largest_spacing: f64,
    /// Solid fraction of the layer below which a row carries no sediment particle `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.002 leaves out what carries nothing"))]
    pub least_fraction: f64,
    /// Solid fraction below which the topmost row of grains at a given fraction gives its grains to the row below `[-]`.
    #[schemars(transform = between(0.0, 0.3, "0.03; 0 leaves every row as it is"))]
    pub sparse_row_fraction: f64,
    /// Particles of dilating sediment along a spacing of the water: they cost little, and a layer of a grain's thickness
    /// wants many.
    #[schemars(transform = between(1.0, 8.0, "2 for an error below 1 % in given water"))]
    pub sediment_refinement: u32,
    /// Largest random displacement of dilating sediment in its spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.3 breaks the rows"))]
    pub sediment_jitter: f64,
    /// The columns of dilating sediment.
    pub columns: ColumnNumerics,
    /// Numerics at a spacing of 1 mm; the time step goes with the spacing.
    pub numerics: ProjectionNumerics,
}

/// The grid of yield stresses and viscosities that the fits interpolate in; empty for none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Fit {
    /// Yield stresses τ_y of the grid `[Pa]`, rising; empty for none.
    #[schemars(transform = each(positive("give it in Pa")))]
    pub yield_stresses: Vec<f64>,
    /// Plastic viscosities μ of the grid `[Pa·s]`, rising; empty for none.
    #[schemars(transform = each(positive("give it in Pa·s")))]
    pub viscosities: Vec<f64>,
    /// Slopes, three or more `[-]`; each is held out once.
    #[schemars(transform = each(rules::driving_slope()))]
    pub slopes: Vec<f64>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.1, 1e4, "a few seconds, more to be stationary"))]
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedLoadParameters {
    /// Water and grains.
    pub materials: Materials,
    /// As printed.
    pub paper: GrainParticles,
    /// By the recipe.
    pub stabilised: GrainParticles,
    /// Volume fractions.
    pub continuum: Continuum,
    /// Runs beside each of `stabilised`: `at-rest`, whose grains are held, and `other-start`.
    pub beside: Vec<Beside>,
    /// Fits of `stabilised`.
    pub fit: Fit,
    /// Largest random displacement of a fluid particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.001 breaks the lattice without waves"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
}
