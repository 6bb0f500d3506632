//! The runs: what each depends on, and its scene.

use super::observation::{BedLoadObservation, Observer};
use super::parameters::{BedLoadParameters, Continuum, Grains, Materials, Stage, Yield};
use crate::case::{ParameterError, Progress, Run};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::bed_load_layer::{BedLoadLayer, Grains as LayerGrains, LayerState, SolidFraction, Start, Stream};
use bagnold_solver::incompressible::{PairLaw, ProjectionNumerics};
use serde::Serialize;

/// Which formulation a run is of.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// As printed.
    Paper(Grains),
    /// By the recipe.
    Stabilised(Grains),
    /// By the recipe, one point of the grid of the fits.
    Fit(Grains),
    /// Volume fractions.
    Continuum {
        /// The rest of its parameters, without its list of runs.
        continuum: Continuum,
        /// Stage.
        stage: Stage,
        /// Pair law.
        pair_law: PairLaw,
        /// Velocities at the start over those of the 1-D layer `[-]`.
        start: f64,
        /// Spacing `[m]`.
        spacing: f64,
    },
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct BedLoadRun {
    /// Formulation.
    pub formulation: Formulation,
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

/// Offset of the logarithmic law that a layer of grains is set beside `[m]`.
const LAYER_OFFSET: f64 = 6e-4;

/// Height of a cell of the 1-D layer `[m]`.
pub(super) const LAYER_CELL: f64 = 2.5e-4;

pub(super) fn runs(parameters: &BedLoadParameters) -> Vec<BedLoadRun> {
    let BedLoadParameters { materials, paper, stabilised, continuum, fit, jitter, seed } = parameters;
    let new = |formulation, slope, duration, averaging_time| BedLoadRun {
        formulation,
        slope,
        materials: *materials,
        duration,
        averaging_time,
        jitter: *jitter,
        seed: *seed,
    };
    let alone = |grains: &Grains, slope: f64| Grains { slopes: vec![slope], ..grains.clone() };
    let mut runs = Vec::new();
    for &slope in &paper.slopes {
        runs.push(new(Formulation::Paper(alone(paper, slope)), slope, paper.duration, paper.averaging_time));
    }
    for &slope in &stabilised.slopes {
        let formulation = Formulation::Stabilised(alone(stabilised, slope));
        runs.push(new(formulation, slope, stabilised.duration, stabilised.averaging_time));
    }
    for list in &continuum.runs {
        for &slope in &list.slopes {
            for &pair_law in &list.pair_laws {
                for &start in &list.starts {
                    for &spacing in &list.spacings {
                        let formulation = Formulation::Continuum {
                            continuum: Continuum { runs: Vec::new(), ..continuum.clone() },
                            stage: list.stage,
                            pair_law,
                            start,
                            spacing,
                        };
                        runs.push(new(formulation, slope, list.duration, list.averaging_time));
                    }
                }
            }
        }
    }
    for &yield_stress in &fit.yield_stresses {
        for &viscosity in &fit.viscosities {
            for &slope in &fit.slopes {
                let material = Yield { yield_stress, viscosity, ..stabilised.material };
                let grains = Grains { material, ..alone(stabilised, slope) };
                runs.push(new(Formulation::Fit(grains), slope, fit.duration, fit.averaging_time));
            }
        }
    }
    runs
}

pub(super) fn pair_law_name(law: PairLaw) -> &'static str {
    match law {
        PairLaw::PairRate => "pair-rate",
        PairLaw::PairRateMeanLoad => "pair-rate-mean-load",
        PairLaw::AveragedPairRate => "averaged-pair-rate",
        PairLaw::ArithmeticMean => "arithmetic-mean",
        PairLaw::HarmonicMean => "harmonic-mean",
    }
}

impl Run for BedLoadRun {
    type Observation = BedLoadObservation;

    fn variant(&self) -> Variant {
        let of = |formulation: &str| Variant::of("formulation", formulation).and("slope", self.slope);
        match &self.formulation {
            Formulation::Paper(_) => of("paper"),
            Formulation::Stabilised(_) => of("stabilised"),
            Formulation::Fit(grains) => {
                let Yield { yield_stress, viscosity, .. } = grains.material;
                of("fit").and("yield_stress", yield_stress).and("viscosity", viscosity)
            }
            Formulation::Continuum { stage, pair_law, start, spacing, .. } => {
                of(stage.name()).and("pair_law", pair_law_name(*pair_law)).and("start", *start).and("spacing", *spacing)
            }
        }
    }

    fn particle_steps(&self) -> f64 {
        let (particles, step) = match &self.formulation {
            Formulation::Paper(grains) | Formulation::Stabilised(grains) | Formulation::Fit(grains) => {
                let fluid = grains.length * (self.materials.depth + grains.bed_depth) / grains.spacing.powi(2);
                (fluid, grains.numerics.time_step)
            }
            Formulation::Continuum { continuum, spacing, .. } => {
                let both = continuum.length * (self.materials.depth + 2.0 * continuum.bed_depth) / spacing.powi(2);
                (both, continuum.numerics.time_step * spacing / 1e-3)
            }
        };
        particles * self.duration / step
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        let layer = self.layer()?;
        let law = self.clear_water();
        let start = |z: f64| match (&layer, &self.formulation) {
            (Some(layer), Formulation::Continuum { start, .. }) => start * layer.at(z).fluid_velocity,
            _ if z > 0.0 => 0.9 * law.velocity(z),
            _ => 0.0,
        };
        let channel = match &self.formulation {
            Formulation::Paper(grains) | Formulation::Stabilised(grains) | Formulation::Fit(grains) => {
                self.grains_channel(grains, &start)
            }
            Formulation::Continuum { continuum, stage, pair_law, start: share, spacing } => {
                let Some(layer) = &layer else { return Err(no_layer()) };
                let numerics = ProjectionNumerics {
                    pair_law: *pair_law,
                    time_step: continuum.numerics.time_step * spacing / 1e-3,
                    ..continuum.numerics
                };
                self.continuum_channel(continuum, *stage, (*share, *spacing), numerics, layer, &start)
            }
        };
        let mut observer = Observer::new(self, &channel);
        let record = channel.run_observed(progress, |simulation, in_window| observer.observe(simulation, in_window))?;
        Ok(record.map(|channel| observer.finish(channel, layer.as_ref())))
    }
}

impl BedLoadRun {
    /// The stream of the 1-D layer.
    #[must_use]
    pub fn stream(&self) -> Stream {
        let Materials { depth, gravity, fluid_density, kinematic_viscosity, grain_density, grain_diameter } =
            self.materials;
        let (bed_depth, held_depth) = match &self.formulation {
            Formulation::Paper(grains) | Formulation::Stabilised(grains) | Formulation::Fit(grains) => {
                (grains.bed_depth, 0.0)
            }
            Formulation::Continuum { continuum, .. } => (continuum.bed_depth, continuum.held_depth),
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

    /// The 1-D layer that a `continuum` run is verified against.
    pub(super) fn layer(&self) -> Result<Option<LayerState>, ParameterError> {
        let Formulation::Continuum { continuum, stage, .. } = &self.formulation else { return Ok(None) };
        let layer = |grains| BedLoadLayer {
            stream: self.stream(),
            closures: continuum.closures,
            grains,
            cell_height: LAYER_CELL,
        };
        let refused = |error: crate::reference::ReferenceError| {
            ParameterError::field(
                "continuum.closures",
                error.to_string(),
                "such that the 1-D layer has a steady state",
                "see bed-load-1d",
            )
        };
        let dilating = layer(LayerGrains::Dilating).steady(Start::Moving(2.0)).map_err(refused)?;
        let state = match stage {
            Stage::Frozen | Stage::Dilating => dilating,
            Stage::Porous => {
                let resting = LayerGrains::Resting(SolidFraction::of_cells(&dilating));
                layer(resting).steady(Start::Moving(2.0)).map_err(refused)?
            }
        };
        Ok(Some(state))
    }

    /// Clear water over a fixed bed of the same grains.
    #[must_use]
    pub fn clear_water(&self) -> crate::reference::RoughChannel {
        let origin_offset = match &self.formulation {
            Formulation::Paper(grains) | Formulation::Stabilised(grains) | Formulation::Fit(grains) => {
                grains.origin_offset
            }
            Formulation::Continuum { .. } => LAYER_OFFSET,
        };
        crate::reference::RoughChannel {
            depth: self.materials.depth,
            slope: self.slope,
            gravity: self.materials.gravity,
            density: self.materials.fluid_density,
            sand_roughness: self.materials.grain_diameter,
            origin_offset,
        }
    }
}

fn no_layer() -> ParameterError {
    ParameterError::field("continuum", "no layer", "a run with its 1-D layer", "this is a defect of the program")
}
