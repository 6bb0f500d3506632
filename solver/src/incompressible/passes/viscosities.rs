//! Viscosities of both phases: eddies in the water, yield and friction of the grains.
//!
//! A mixing length takes the strain of the mean flow, |⟨∇u⟩|. Particles that pass each other move at random, with strain rates
//! like the flow's own in a deep stream, and |∇u| would count them as shear. The mean is one over time along the way of
//! each particle, d⟨∇u⟩/dt = (∇u − ⟨∇u⟩)/T: of the tensor, in which random parts cancel, not of its norm.

use super::super::{IncompressibleScene, LEAST_TASK, Phase, Phases, Turbulence, height_axis};
use crate::material::turbulence::eddy_viscosity;
use crate::parallel::prelude::*;
use crate::run::ForeignState;
use crate::vector::{Tensor, shear_rate};

/// Viscosities, shear rates and loads of the laws at every free particle.
#[derive(Debug)]
pub struct Viscosities<const D: usize> {
    /// Dynamic viscosity of every fluid particle `[Pa·s]`, times its voidage.
    pub fluid: Vec<f64>,
    /// ⟨∇u⟩ of every fluid particle `[1/s]`; empty before the first step, which starts it with ∇u.
    pub(crate) mean_gradient: Vec<Tensor<D>>,
    /// Shear rate of every fluid particle that its turbulence takes `[1/s]`.
    pub fluid_rate: Vec<f64>,
    /// Part 1 − φ of the space that the fluid has at every fluid particle `[-]`.
    pub voidage: Vec<f64>,
    /// Apparent viscosity of every sediment particle `[Pa·s]`.
    pub(crate) sediment: Vec<f64>,
    /// Load on the grains of every sediment particle `[Pa]`.
    pub(crate) load: Vec<f64>,
}

impl<const D: usize> Viscosities<D> {
    pub(crate) fn new(phases: &Phases<D>) -> Self {
        let (free_fluid, free_sediment) = (phases.fluid.len(), phases.sediment.as_ref().map_or(0, Phase::len));
        Self {
            fluid: vec![0.0; free_fluid],
            mean_gradient: Vec::with_capacity(free_fluid),
            fluid_rate: vec![0.0; free_fluid],
            voidage: vec![1.0; free_fluid],
            sediment: vec![0.0; free_sediment],
            load: vec![0.0; free_sediment],
        }
    }

    /// Continues from a saved ⟨∇u⟩ `[1/s]`, which is empty before the first step.
    pub(crate) fn restore(&mut self, mean_gradient: Vec<Tensor<D>>) -> Result<(), ForeignState> {
        if !mean_gradient.is_empty() {
            ForeignState::check("mean velocity gradients", mean_gradient.len(), self.fluid.len())?;
        }
        self.mean_gradient = mean_gradient;
        Ok(())
    }

    /// Evaluates the laws at the present heights and velocity gradients, a step `[s]` after the last time.
    pub fn find(&mut self, scene: &IncompressibleScene<D>, phases: &Phases<D>, time_step: f64) {
        let fluid = &phases.fluid;
        let layer = scene.solid_fraction.stratification();
        // what is larger than the particles Smagorinsky's closure leaves to their motion
        let time = match scene.fluid.turbulence {
            Turbulence::Laminar | Turbulence::Smagorinsky(_) => 0.0,
            Turbulence::MixingLength { .. } | Turbulence::Stratified => scene.numerics.mean_flow_time,
        };
        let share = time_step / (time + time_step);
        if self.mean_gradient.is_empty() {
            self.mean_gradient.extend_from_slice(&fluid.velocity_gradient);
        }
        (&mut self.fluid, &mut self.fluid_rate, &mut self.voidage, &mut self.mean_gradient)
            .enumerate()
            .with_min_len(LEAST_TASK)
            .for_each(|(a, (viscosity, rate_of, voidage, mean))| {
                let height = fluid.position[a][height_axis(D)];
                *mean += (fluid.velocity_gradient[a] - *mean) * share;
                let rate = shear_rate(mean);
                let stratum = layer.map(|layer| layer.at(&fluid.position[a]));
                let eddy = match scene.fluid.turbulence {
                    Turbulence::Laminar => 0.0,
                    Turbulence::MixingLength { level, depth, law } => law.eddy_viscosity(height - level, depth, rate),
                    Turbulence::Smagorinsky(law) => law.eddy_viscosity(scene.fluid.spacing, rate),
                    Turbulence::Stratified => stratum.map_or(0.0, |s| eddy_viscosity(s.mixing_length, rate)),
                };
                *voidage = 1.0 - stratum.map_or(0.0, |stratum| stratum.solid_fraction);
                *viscosity = *voidage * scene.fluid.density * (scene.fluid.kinematic_viscosity + eddy);
                *rate_of = rate;
            });
        if let (Some(sediment), Some(material)) = (&phases.sediment, &scene.sediment) {
            for a in 0..sediment.len() {
                self.load[a] = material.load.at(&sediment.position[a], layer);
                let rate = shear_rate(&sediment.velocity_gradient[a]);
                self.sediment[a] = material.law.viscosity(rate, self.load[a]);
            }
        }
    }
}
