//! Runs: their names, what they cost and how they are observed.

use super::flow::{BedLoadFlow, BedLoadFormulation};
use super::kept::KeptState;
use super::observation::{BedLoadObservation, BedLoadObserver};
use crate::case::{Flow, ParameterError, Progress, RunCost, cost};
use crate::channel::Channel;
use crate::metric::{FlowRegime, Variant};
use crate::observation::Recorded;
use crate::reference::one_dimension::bed_load::LayerState;
use crate::reference::water::RoughChannel;
use bagnold_solver::incompressible::PairLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};

/// Offset of the logarithmic law that a layer of grains is set beside `[m]`.
const LAYER_OFFSET: f64 = 6e-4;

pub(super) fn pair_law_name(law: PairLaw) -> &'static str {
    match law {
        PairLaw::PairRate => "pair-rate",
        PairLaw::PairRateMeanLoad => "pair-rate-mean-load",
        PairLaw::ArithmeticMean => "arithmetic-mean",
        PairLaw::HarmonicMean => "harmonic-mean",
    }
}

impl Flow for BedLoadFlow {
    const RUNS: &'static str = include_str!("../../../runs/bed-load.toml");
    type Observation = BedLoadObservation;

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()?;
        if self.is_kept() && KeptState::of(self).is_none() {
            let (rule, remedy) = ("\"layer\", because no state of this slope and set-up is kept", "use \"layer\"");
            return Err(ParameterError::field("continuum.start_state", "kept", rule, remedy));
        }
        Ok(())
    }

    fn regime(&self, _: &BedLoadObservation) -> FlowRegime {
        FlowRegime::of_stream(self.slope, self.depth, self.grain_diameter)
    }

    fn laws(&self) -> Vec<Rheology> {
        if self.formulation.is_continuum() { vec![self.continuum_law()] } else { Vec::new() }
    }

    fn variant(&self) -> Variant {
        let named = Variant::of("formulation", self.formulation.name()).and("slope", self.slope);
        match (self.formulation, self.particles.material) {
            (
                BedLoadFormulation::Fit,
                Rheology::CoulombBingham(CoulombBingham { yield_stress, plastic_viscosity, .. }),
            ) => named.and("yield_stress", yield_stress).and("viscosity", plastic_viscosity),
            (BedLoadFormulation::Paper | BedLoadFormulation::Fit, _) => named,
            // runs of other tiers are longer, and others of their gates hold
            (BedLoadFormulation::Stabilised | BedLoadFormulation::AtRest, _) => {
                let named = if self.starts_as_usual() { named } else { named.and("start", self.start()) };
                named.and("duration", self.duration)
            }
            (BedLoadFormulation::Porous | BedLoadFormulation::Frozen | BedLoadFormulation::Dilating, _) => {
                let laws = self.pair_law().into_iter();
                let named = laws.fold(named, |named, law| named.and("pair_law", pair_law_name(law)));
                let named = if self.rests() { named.and("grains", "held") } else { named };
                named.and("start", self.start()).and("spacing", self.spacing())
            }
        }
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn cost(&self) -> RunCost {
        let (grains, continuum) = (&self.particles, &self.continuum);
        let (area, time_step) = if self.formulation.is_continuum() {
            (continuum.length * (self.depth + 2.0 * continuum.bed_depth), self.continuum_numerics().time_step)
        } else {
            (grains.length * (self.depth + grains.bed_depth), grains.numerics.time_step)
        };
        let particles = area / self.spacing().powi(2);
        RunCost {
            // grains and their drag cost as much as the water's particles
            seconds_per_particle_step: 2.0 * cost::INCOMPRESSIBLE,
            ..RunCost::incompressible(particles, self.duration / time_step)
        }
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        if self.formulation.is_continuum() {
            let layer = self.layer()?;
            let start = |z: f64| self.start() * layer.at(z).fluid_velocity;
            return self.observe(&self.continuum_channel(&layer, &start), Some(&layer), progress);
        }
        let law = self.clear_water();
        let start = |z: f64| if z > 0.0 { self.start() * law.velocity(z) } else { 0.0 };
        self.observe(&self.grains_channel(&start), None, progress)
    }
}

impl BedLoadFlow {
    fn observe(
        &self,
        channel: &Channel<'_>,
        layer: Option<&LayerState>,
        progress: &Progress,
    ) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        let observer = BedLoadObserver::new(self, channel);
        let (record, observer) = channel.run_observed(progress, observer, BedLoadObserver::observe)?;
        Ok(record.map(|channel| observer.finish(channel, layer)))
    }

    /// The logarithmic law of a rough bed of such grains, from which the water starts and by which velocities are scaled.
    pub fn clear_water(&self) -> RoughChannel {
        let is_continuum = self.formulation.is_continuum();
        RoughChannel {
            depth: self.depth,
            slope: self.slope,
            gravity: self.gravity,
            density: self.fluid_density,
            sand_roughness: self.grain_diameter,
            origin_offset: if is_continuum { LAYER_OFFSET } else { self.particles.origin_offset },
        }
    }
}
