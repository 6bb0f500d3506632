//! Parameters and tiers.

use crate::case::Tier;
use crate::cases::rules;
use crate::error::InputError;
use crate::reference::bed_load_layer::Closures;
use bagnold_solver::drag::DragLaw;
use bagnold_solver::incompressible::{PairLaw, ProjectionNumerics};
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
    ("stabilised.drag_smoothing_length", "[m]"),
    ("stabilised.duration", "[s]"),
    ("stabilised.averaging_time", "[s], before the end"),
    ("continuum.runs.stage", "\"porous\", \"frozen\" or \"dilating\""),
    ("continuum.held_depth", "[m], lowest part of the bed, whose grains are held"),
    ("fit.yield_stresses", "[Pa], with fit.viscosities [Pa·s] the grid of the fits; empty for none"),
    ("jitter", "[-], largest random displacement in spacings"),
];

impl BedLoadParameters {
    pub(super) fn of_tier(tier: Tier) -> Self {
        let stabilised = Grains {
            slopes: vec![0.03],
            material: Yield { yield_stress: 9.0, viscosity: 0.3 },
            overburden_friction: 0.6,
            bed_depth: 0.03,
            length: 0.04,
            spacing: 2e-3,
            origin_offset: 6e-4,
            drag: DragLaw::MorsiAlexander,
            drag_factor: 1.0,
            drag_smoothing_length: 3e-3,
            duration: 1.0,
            averaging_time: 0.6,
            numerics: ProjectionNumerics::default(),
        };
        let paper = Grains {
            slopes: Vec::new(),
            material: Yield { yield_stress: 1220.0, viscosity: 0.26 },
            overburden_friction: 0.0,
            bed_depth: 0.08,
            drag_smoothing_length: 6e-3,
            duration: 1.0,
            averaging_time: 0.5,
            numerics: ProjectionNumerics::paper(),
            ..stabilised.clone()
        };
        let runs = |stage, slopes: &[f64], pair_laws: &[PairLaw], starts: &[f64], duration: f64| StageRuns {
            stage,
            slopes: slopes.to_vec(),
            pair_laws: pair_laws.to_vec(),
            starts: starts.to_vec(),
            spacings: vec![1e-3],
            duration,
            averaging_time: 0.4 * duration,
        };
        let best = [PairLaw::PairRateMeanLoad];
        let all = [0.02, 0.03, 0.05];
        let quick = Self {
            materials: Materials {
                depth: 0.046,
                gravity: 9.81,
                fluid_density: 1000.0,
                kinematic_viscosity: 1e-6,
                grain_density: 2600.0,
                grain_diameter: 5e-3,
            },
            paper,
            stabilised,
            continuum: Continuum {
                runs: vec![runs(Stage::Porous, &[0.03], &best, &[1.0], 0.5)],
                bed_depth: 0.016,
                held_depth: 0.004,
                length: 0.01,
                closures: Closures::default(),
                smoothing_ratio: 1.5,
                sediment_jitter: 0.3,
                numerics: ProjectionNumerics { time_step: 1.5e-4, ..ProjectionNumerics::default() },
            },
            fit: Fit {
                yield_stresses: Vec::new(),
                viscosities: Vec::new(),
                slopes: vec![0.02, 0.03, 0.05],
                duration: 3.0,
                averaging_time: 1.5,
            },
            jitter: 1e-3,
            seed: 1,
        };
        let paper_tier = Self {
            paper: Grains { slopes: vec![0.02, 0.03, 0.05], ..quick.paper.clone() },
            stabilised: Grains {
                slopes: vec![0.02, 0.03, 0.05],
                duration: 8.0,
                averaging_time: 3.0,
                ..quick.stabilised.clone()
            },
            continuum: Continuum {
                runs: vec![
                    runs(Stage::Porous, &all, &best, &[1.0], 4.0),
                    runs(Stage::Frozen, &all, &best, &[1.0], 4.0),
                    runs(Stage::Frozen, &[0.03], &[PairLaw::PairRate, PairLaw::HarmonicMean], &[1.0], 4.0),
                    runs(Stage::Dilating, &all, &best, &[1.0], 4.0),
                    runs(Stage::Dilating, &[0.03], &best, &[0.3], 4.0),
                    runs(Stage::Dilating, &[0.03], &[PairLaw::HarmonicMean], &[1.0], 4.0),
                ],
                ..quick.continuum.clone()
            },
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper_tier,
            Tier::Fine => Self {
                paper: Grains { slopes: Vec::new(), ..quick.paper.clone() },
                stabilised: Grains { slopes: Vec::new(), ..quick.stabilised.clone() },
                continuum: Continuum {
                    runs: vec![StageRuns {
                        spacings: vec![7e-4, 5e-4],
                        ..runs(Stage::Dilating, &all, &best, &[1.0, 0.3], 4.0)
                    }],
                    ..quick.continuum.clone()
                },
                fit: Fit {
                    yield_stresses: vec![5.0, 7.0, 9.0, 11.0],
                    viscosities: vec![0.2, 0.5],
                    ..quick.fit.clone()
                },
                ..quick
            },
        }
    }

    pub(super) fn check(&self) -> Result<(), InputError> {
        let Materials { depth, gravity, fluid_density, kinematic_viscosity, grain_density, grain_diameter } =
            self.materials;
        rules::positive("materials.depth", depth, "give it in metres, such as 0.046")?;
        rules::positive("materials.gravity", gravity, "give it in m/s², such as 9.81")?;
        rules::positive("materials.fluid_density", fluid_density, "give it in kg/m³, such as 1000")?;
        rules::positive("materials.kinematic_viscosity", kinematic_viscosity, "give it in m²/s; water has 1e-6")?;
        rules::positive("materials.grain_diameter", grain_diameter, "give it in metres; 0.005 for 5 mm")?;
        let remedy = "grains that float are no bed load";
        rules::between("materials.grain_density", grain_density, 1.01 * fluid_density, 1e5, remedy)?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.001 breaks the lattice without waves")?;
        for (path, grains) in [("paper", &self.paper), ("stabilised", &self.stabilised)] {
            self.check_grains(path, grains)?;
        }
        self.check_continuum()?;
        let fit = &self.fit;
        for (field, values) in [("fit.yield_stresses", &fit.yield_stresses), ("fit.viscosities", &fit.viscosities)] {
            if !values.is_empty() && (values.len() < 2 || !values.is_sorted_by(|a, b| a < b)) {
                let shown = format!("{values:?}");
                let (rule, remedy) = ("empty or two or more rising values", "the fits interpolate between them");
                return Err(InputError::field(field, shown, rule, remedy));
            }
            for (index, &value) in values.iter().enumerate() {
                rules::positive(&format!("{field}[{index}]"), value, "give it in Pa or Pa·s")?;
            }
        }
        check_slopes("fit.slopes", &fit.slopes)?;
        check_time("fit", fit.duration, fit.averaging_time)
    }

    fn check_grains(&self, path: &str, grains: &Grains) -> Result<(), InputError> {
        let field = |name: &str| format!("{path}.{name}");
        check_slopes(&field("slopes"), &grains.slopes)?;
        let Yield { yield_stress, viscosity } = grains.material;
        rules::between(&field("material.yield_stress"), yield_stress, 0.0, 1e6, "give it in Pa, or 0 for none")?;
        rules::between(&field("material.viscosity"), viscosity, 0.0, 1e4, "give it in Pa·s, or 0 for none")?;
        rules::between(&field("overburden_friction"), grains.overburden_friction, 0.0, 2.0, "0.6 for sand and gravel")?;
        rules::between(&field("drag_factor"), grains.drag_factor, 0.0, 10.0, "1 is the drag law's")?;
        rules::positive(&field("spacing"), grains.spacing, "give it in metres; 0.002 for the paper's")?;
        let diameter = self.materials.grain_diameter;
        whole(&field("bed_depth"), grains.bed_depth, diameter, "of the grain diameter")?;
        whole(&field("bed_depth"), grains.bed_depth, grains.spacing, "of the spacing")?;
        whole(&field("length"), grains.length, diameter, "of the grain diameter")?;
        whole(&field("length"), grains.length, grains.spacing, "of the spacing")?;
        let least = 4.8 * diameter;
        rules::between(&field("length"), grains.length, least, 10.0, "the period must hold twice the grains' kernel")?;
        whole("materials.depth", self.materials.depth, grains.spacing, "of the spacing of every formulation")?;
        let remedy = "it must hold grains and reach less than a quarter of the period";
        rules::between(
            &field("drag_smoothing_length"),
            grains.drag_smoothing_length,
            1e-4,
            0.25 * grains.length,
            remedy,
        )?;
        check_time(path, grains.duration, grains.averaging_time)?;
        rules::projection(&field("numerics"), &grains.numerics)
    }

    fn check_continuum(&self) -> Result<(), InputError> {
        let continuum = &self.continuum;
        rules::positive("continuum.bed_depth", continuum.bed_depth, "give it in metres, such as 0.016")?;
        let remedy = "hold less than the whole bed";
        rules::between("continuum.held_depth", continuum.held_depth, 0.0, 0.9 * continuum.bed_depth, remedy)?;
        rules::between("continuum.smoothing_ratio", continuum.smoothing_ratio, 1.0, 3.0, "1.5 for dilating sediment")?;
        rules::between("continuum.sediment_jitter", continuum.sediment_jitter, 0.0, 0.5, "0.3 breaks the rows")?;
        let packing = continuum.closures.largest_fraction;
        rules::between("continuum.closures.largest_fraction", packing, 0.1, 0.74, "grains at rest fill 0.5 to 0.64")?;
        for (index, runs) in continuum.runs.iter().enumerate() {
            let path = format!("continuum.runs[{index}]");
            check_slopes(&format!("{path}.slopes"), &runs.slopes)?;
            for (place, &spacing) in runs.spacings.iter().enumerate() {
                let field = format!("{path}.spacings[{place}]");
                rules::between(
                    &field,
                    spacing,
                    1e-4,
                    continuum.length / 7.2,
                    "0.001 for 1 mm; the period must hold 7",
                )?;
            }
            for (place, &start) in runs.starts.iter().enumerate() {
                rules::between(&format!("{path}.starts[{place}]"), start, 0.0, 3.0, "1 starts as the 1-D layer flows")?;
            }
            check_time(&path, runs.duration, runs.averaging_time)?;
        }
        rules::projection("continuum.numerics", &continuum.numerics)
    }
}

fn check_slopes(field: &str, slopes: &[f64]) -> Result<(), InputError> {
    slopes.iter().enumerate().try_for_each(|(index, &slope)| rules::driving_slope(&format!("{field}[{index}]"), slope))
}

fn check_time(path: &str, duration: f64, averaging_time: f64) -> Result<(), InputError> {
    rules::between(&format!("{path}.duration"), duration, 0.1, 1e4, "a few seconds, more to be stationary")?;
    let field = format!("{path}.averaging_time");
    rules::between(&field, averaging_time, 0.05, duration, "the window lies within the run")
}

/// A length that is a whole multiple of another.
fn whole(field: &str, length: f64, part: f64, of: &str) -> Result<(), InputError> {
    let parts = length / part;
    if parts >= 0.99 && (parts - parts.round()).abs() < 1e-6 * parts.max(1.0) && parts < 1e4 {
        return Ok(());
    }
    let rule = format!("a whole multiple {of}, {part} m");
    Err(InputError::field(field, length, &rule, "choose lengths that divide each other"))
}
