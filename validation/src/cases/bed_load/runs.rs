//! The runs: what each depends on, and its scene.

use super::observation::{BedLoadObservation, Observer};
use super::parameters::{BedLoadParameters, Continuum, Grains, Materials, Stage, Yield};
use crate::case::{Progress, Run};
use crate::cases::channel::{Channel, Lattice, Until};
use crate::error::InputError;
use crate::observe::Recorded;
use crate::reference::bed_load_layer::{BedLoadLayer, Grains as LayerGrains, LayerState, SolidFraction, Start, Stream};
use bagnold_solver::incompressible as solver;
use bagnold_solver::incompressible::{Bed, PairLaw, ParticleSet, ProjectionNumerics, Sediment, Turbulence};
use bagnold_solver::turbulence::{MixingLength, MixingLengthShape};
use bagnold_solver::vector::Vector;
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
    jitter: f64,
    seed: u64,
}

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
                let material = Yield { yield_stress, viscosity };
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
        PairLaw::ArithmeticMean => "arithmetic-mean",
        PairLaw::HarmonicMean => "harmonic-mean",
    }
}

impl Run for BedLoadRun {
    fn variant(&self) -> String {
        let slope = self.slope;
        match &self.formulation {
            Formulation::Paper(_) => format!("formulation=paper,slope={slope}"),
            Formulation::Stabilised(_) => format!("formulation=stabilised,slope={slope}"),
            Formulation::Fit(grains) => {
                let Yield { yield_stress, viscosity } = grains.material;
                format!("formulation=fit,slope={slope},yield_stress={yield_stress},viscosity={viscosity}")
            }
            Formulation::Continuum { stage, pair_law, start, spacing, .. } => format!(
                "formulation={},slope={slope},pair_law={},start={start},spacing={spacing}",
                stage.name(),
                pair_law_name(*pair_law)
            ),
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
    pub(super) fn layer(&self) -> Result<Option<LayerState>, InputError> {
        let Formulation::Continuum { continuum, stage, .. } = &self.formulation else { return Ok(None) };
        let layer =
            |grains| BedLoadLayer { stream: self.stream(), closures: continuum.closures, grains, cell_height: 2.5e-4 };
        let refused = |error: crate::reference::ReferenceError| {
            InputError::field(
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

    pub(super) fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<BedLoadObservation>, InputError> {
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

    /// Clear water over a fixed bed of the same grains.
    #[must_use]
    pub fn clear_water(&self) -> crate::reference::RoughChannel {
        crate::reference::RoughChannel {
            depth: self.materials.depth,
            slope: self.slope,
            gravity: self.materials.gravity,
            density: self.materials.fluid_density,
            sand_roughness: self.materials.grain_diameter,
            origin_offset: 6e-4,
        }
    }

    fn grains_channel<'a>(&self, grains: &Grains, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let Materials { depth, gravity, fluid_density, grain_density, grain_diameter, .. } = self.materials;
        let rows = |length: f64, spacing: f64| (length / spacing).round() as usize;
        let printed = matches!(self.formulation, Formulation::Paper(_));
        // the printed set-up has water above the bed only, on the grains as on a floor
        let below = if printed { 0.0 } else { grains.bed_depth };
        let fluid = Lattice {
            spacing: grains.spacing,
            rows: rows(depth + below, grains.spacing),
            columns: rows(grains.length, grains.spacing),
            bottom: -below,
        };
        let bed = Lattice {
            spacing: grain_diameter,
            rows: rows(grains.bed_depth, grain_diameter),
            columns: rows(grains.length, grain_diameter),
            bottom: -grains.bed_depth,
        };
        let buoyant_weight = (grain_density - fluid_density) * gravity;
        let sediment = Sediment {
            particles: ParticleSet {
                position: bed.displaced(self.jitter, self.seed.wrapping_add(1)),
                velocity: vec![Vector::zeros(); bed.len()],
            },
            filling: vec![1.0; bed.len()],
            wall: bed.below(4).sites().collect(),
            spacing: grain_diameter,
            smoothing_ratio: grains.numerics.smoothing_ratio,
            density: grain_density,
            grain_diameter,
            law: solver::SedimentLaw::Bingham(solver::SedimentYield {
                yield_stress: grains.material.yield_stress,
                viscosity: grains.material.viscosity,
                overburden_friction: grains.overburden_friction,
                overburden_level: -grain_diameter,
                buoyant_weight,
                regularisation_rate: 0.01,
                largest_viscosity: 1e4,
            }),
            pressure: solver::SedimentPressure::Incompressible,
            drag: grains.drag,
            drag_form: solver::DragForm::Grain(grains.drag_factor),
            drag_smoothing_length: grains.drag_smoothing_length,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyant_weight / grain_density),
        };
        let law = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: grains.origin_offset };
        Channel {
            fluid,
            turbulence: Turbulence::MixingLength { level: 0.0, depth, law },
            bed: Bed::NoSlip(fluid.bottom),
            sediment: Some(sediment),
            solid_fraction: solver::SolidFraction::Overlapping,
            numerics: grains.numerics,
            may_diverge: printed,
            ..self.bare_channel(fluid, velocity)
        }
    }

    fn continuum_channel<'a>(
        &self,
        continuum: &Continuum,
        stage: Stage,
        (share, spacing): (f64, f64),
        numerics: ProjectionNumerics,
        layer: &LayerState,
        velocity: &'a (dyn Fn(f64) -> f64 + Sync),
    ) -> Channel<'a> {
        let Materials { depth, gravity, fluid_density, grain_density, grain_diameter, .. } = self.materials;
        let columns = (continuum.length / spacing).round() as usize;
        let fluid = Lattice {
            spacing,
            rows: ((depth + continuum.bed_depth) / spacing).round() as usize,
            columns,
            bottom: -continuum.bed_depth,
        };
        let closures = &continuum.closures;
        let packing = closures.largest_fraction;
        let held = continuum.held_depth - continuum.bed_depth;
        let mut stratification = solver::Stratification::new(
            layer.face[0],
            layer.cell_height,
            layer.solid_fraction.clone(),
            packing,
            (grain_density - fluid_density) * gravity,
            0.0,
            depth,
        );
        let lattice = Lattice { bottom: fluid.bottom - 3.0 * spacing, rows: fluid.rows + 3, ..fluid };
        let jitter = if stage == Stage::Dilating { continuum.sediment_jitter } else { 0.0 };
        let (mut free, mut wall, mut filling) = (ParticleSet::default(), Vec::new(), Vec::new());
        for (site, place) in lattice.sites().zip(lattice.displaced(jitter, self.seed.wrapping_add(1))) {
            let point = layer.at(site[1]);
            // the bed at rest, or the layer's own grains
            let fraction = match stage {
                Stage::Dilating => {
                    if site[1] < 0.0 {
                        packing
                    } else {
                        0.0
                    }
                }
                Stage::Porous | Stage::Frozen => point.solid_fraction,
            };
            if site[1] < held || (stage == Stage::Porous && fraction > LEAST_FRACTION) {
                wall.push(site);
            } else if fraction > LEAST_FRACTION {
                free.position.push(place);
                free.velocity.push(Vector::<2>::new(share * point.grain_velocity, 0.0));
                filling.push(fraction);
            }
        }
        let solid_fraction = if stage == Stage::Dilating {
            for (place, fraction) in stratification.fixed_fraction.iter_mut().enumerate() {
                let height = stratification.base + (place as f64 + 0.5) * stratification.interval;
                *fraction = if height < held { packing } else { 0.0 };
            }
            solver::SolidFraction::Averaged(stratification)
        } else {
            solver::SolidFraction::Given(stratification)
        };
        let buoyancy = if stage == Stage::Dilating { 1.0 - fluid_density / grain_density } else { 0.0 };
        let sediment = Sediment {
            particles: free,
            filling,
            wall,
            spacing,
            smoothing_ratio: if stage == Stage::Dilating {
                continuum.smoothing_ratio
            } else {
                numerics.smoothing_ratio
            },
            density: grain_density,
            grain_diameter,
            law: solver::SedimentLaw::MuI(solver::GranularFriction {
                static_friction: closures.static_friction,
                limiting_friction: closures.limiting_friction,
                reference_inertia: closures.reference_inertia,
                regularisation_rate: closures.regularisation_rate,
            }),
            pressure: match stage {
                Stage::Porous | Stage::Frozen => solver::SedimentPressure::AlongBed,
                Stage::Dilating => {
                    solver::SedimentPressure::Dilatant { dilation: closures.dilation, packing, fixed_filling: packing }
                }
            },
            drag: closures.drag,
            drag_form: solver::DragForm::Exchange,
            drag_smoothing_length: numerics.smoothing_ratio * spacing,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyancy * gravity),
        };
        Channel {
            fluid,
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(fluid.bottom),
            sediment: Some(sediment),
            solid_fraction,
            numerics,
            ..self.bare_channel(fluid, velocity)
        }
    }

    fn bare_channel<'a>(&self, fluid: Lattice, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        Channel {
            fluid,
            slope: self.slope,
            gravity: self.materials.gravity,
            density: self.materials.fluid_density,
            kinematic_viscosity: self.materials.kinematic_viscosity,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            jitter: self.jitter,
            seed: self.seed,
            velocity,
            sediment: None,
            solid_fraction: solver::SolidFraction::Overlapping,
            numerics: ProjectionNumerics::default(),
            until: Until::Time(self.duration),
            window: self.averaging_time,
            interval: 0.005,
            frames: 2,
            may_diverge: false,
        }
    }
}

/// Solid fraction below which a row of the layer carries no sediment particle `[-]`.
const LEAST_FRACTION: f64 = 2e-3;

fn no_layer() -> InputError {
    InputError::field("continuum", "no layer", "a run with its 1-D layer", "this is a defect of the program")
}
