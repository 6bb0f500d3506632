//! The runs: what each depends on, and its scene.

use super::observation::{BedLoadObservation, BedLoadObserver};
use super::parameters::{BedLoadParameters, Beside, Continuum, GrainParticles};
use super::run::{BedLoadFormulation, BedLoadRun, ContinuumRun, GrainKind};
use crate::case::{ParameterError, Progress, Run, cost};
use crate::channel::Channel;
use crate::metric::{FlowRegime, Variant};
use crate::observation::Recorded;
use crate::reference::one_dimension::bed_load::LayerState;
use crate::reference::water::RoughChannel;
use bagnold_solver::incompressible::PairLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};

/// Offset of the logarithmic law that a layer of grains is set beside `[m]`.
const LAYER_OFFSET: f64 = 6e-4;

pub(super) fn runs(parameters: &BedLoadParameters) -> Vec<BedLoadRun> {
    let BedLoadParameters { materials, paper, stabilised, beside, continuum, fit, jitter, seed } = parameters;
    let new = |formulation, slope, duration, averaging_time| BedLoadRun {
        formulation,
        slope,
        materials: *materials,
        duration,
        averaging_time,
        jitter: *jitter,
        seed: *seed,
    };
    let alone = |grains: &GrainParticles, slope: f64| GrainParticles { slopes: vec![slope], ..grains.clone() };
    let mut runs = Vec::new();
    for &slope in &paper.slopes {
        let formulation = BedLoadFormulation::Grains(GrainKind::Paper, alone(paper, slope));
        runs.push(new(formulation, slope, paper.duration, paper.averaging_time));
    }
    for &slope in &stabilised.slopes {
        let beside = beside.iter().map(|run| match run {
            Beside::AtRest => (GrainKind::AtRest, stabilised.start),
            Beside::OtherStart => (GrainKind::OtherStart, stabilised.other_start),
        });
        for (kind, start) in std::iter::once((GrainKind::Stabilised, stabilised.start)).chain(beside) {
            let grains = GrainParticles { start, ..alone(stabilised, slope) };
            let formulation = BedLoadFormulation::Grains(kind, grains);
            runs.push(new(formulation, slope, stabilised.duration, stabilised.averaging_time));
        }
    }
    for list in &continuum.runs {
        for &slope in &list.slopes {
            for pair_law in list.pair_laws() {
                for &start in &list.starts {
                    for &spacing in &list.spacings {
                        let spacing = list.stage.spacing(spacing, continuum.largest_spacing, slope, materials);
                        let formulation = BedLoadFormulation::Continuum(ContinuumRun {
                            continuum: Continuum { runs: Vec::new(), ..continuum.clone() },
                            stage: list.stage,
                            pair_law,
                            start,
                            spacing,
                        });
                        runs.push(new(formulation, slope, list.duration, list.averaging_time));
                    }
                }
            }
        }
    }
    // a case with a grid and another law is refused
    let Rheology::CoulombBingham(fitted) = stabilised.material else { return runs };
    for &yield_stress in &fit.yield_stresses {
        for &plastic_viscosity in &fit.viscosities {
            for &slope in &fit.slopes {
                let law = CoulombBingham { yield_stress, plastic_viscosity, ..fitted };
                let grains = GrainParticles { material: Rheology::CoulombBingham(law), ..alone(stabilised, slope) };
                let formulation = BedLoadFormulation::Grains(GrainKind::Fit(law), grains);
                runs.push(new(formulation, slope, fit.duration, fit.averaging_time));
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
    type Observation = BedLoadObservation;

    fn regime(&self, _: &BedLoadObservation) -> FlowRegime {
        FlowRegime::of_stream(self.slope, self.materials.depth, self.materials.grain_diameter)
    }

    fn laws(&self) -> Vec<Rheology> {
        match &self.formulation {
            BedLoadFormulation::Continuum(own) => vec![own.law(&self.materials)],
            BedLoadFormulation::Grains(..) => Vec::new(),
        }
    }

    fn variant(&self) -> Variant {
        let of = |formulation: &str| Variant::of("formulation", formulation).and("slope", self.slope);
        match &self.formulation {
            BedLoadFormulation::Grains(GrainKind::Fit(law), _) => {
                of("fit").and("yield_stress", law.yield_stress).and("viscosity", law.plastic_viscosity)
            }
            BedLoadFormulation::Grains(GrainKind::Paper, _) => of(GrainKind::Paper.name()),
            // runs of other tiers are longer, and others of their gates hold
            BedLoadFormulation::Grains(kind, _) => of(kind.name()).and("duration", self.duration),
            BedLoadFormulation::Continuum(ContinuumRun { stage, pair_law, start, spacing, .. }) => {
                let named = of(stage.name());
                let named = match pair_law {
                    Some(law) => named.and("pair_law", pair_law_name(*law)),
                    None => named,
                };
                named.and("start", *start).and("spacing", *spacing)
            }
        }
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn particles(&self) -> f64 {
        let (area, spacing, _) = self.size();
        area / spacing.powi(2)
    }

    fn seconds_per_particle_step(&self) -> f64 {
        // grains and their drag cost as much as the water's particles
        2.0 * cost::INCOMPRESSIBLE
    }

    fn particle_steps(&self) -> f64 {
        let (area, spacing, step) = self.size();
        area / spacing.powi(2) * self.duration / step
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        match &self.formulation {
            BedLoadFormulation::Grains(kind, grains) => {
                let law = self.clear_water();
                let start = |z: f64| if z > 0.0 { grains.start * law.velocity(z) } else { 0.0 };
                self.observe(&self.grains_channel(*kind, grains, &start), None, progress)
            }
            BedLoadFormulation::Continuum(own) => {
                let layer = own.layer(self.stream())?;
                let start = |z: f64| own.start * layer.at(z).fluid_velocity;
                self.observe(&own.channel(self, &layer, &start), Some(&layer), progress)
            }
        }
    }
}

impl BedLoadRun {
    /// Area of both phases `[m²]`, spacing `[m]` and time step `[s]`.
    fn size(&self) -> (f64, f64, f64) {
        let depth = self.materials.depth;
        match &self.formulation {
            BedLoadFormulation::Grains(_, grains) => {
                (grains.length * (depth + grains.bed_depth), grains.spacing, grains.numerics.time_step)
            }
            BedLoadFormulation::Continuum(own) => {
                let both = own.continuum.length * (depth + 2.0 * own.continuum.bed_depth);
                (both, own.spacing, own.numerics().time_step)
            }
        }
    }

    fn observe(
        &self,
        channel: &Channel<'_>,
        layer: Option<&LayerState>,
        progress: &dyn Progress,
    ) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        let (record, observer) = channel.run_observed(
            progress,
            BedLoadObserver::new(self, channel),
            |observer, simulation, in_window| {
                observer.observe(simulation, in_window);
            },
        )?;
        Ok(record.map(|channel| observer.finish(channel, layer)))
    }

    /// The logarithmic law of a rough bed of such grains, from which the water starts and by which velocities are scaled.
    #[must_use]
    pub fn clear_water(&self) -> RoughChannel {
        let origin_offset = match &self.formulation {
            BedLoadFormulation::Grains(_, grains) => grains.origin_offset,
            BedLoadFormulation::Continuum(_) => LAYER_OFFSET,
        };
        RoughChannel {
            depth: self.materials.depth,
            slope: self.slope,
            gravity: self.materials.gravity,
            density: self.materials.fluid_density,
            sand_roughness: self.materials.grain_diameter,
            origin_offset,
        }
    }
}
