//! Viscosities of both phases: eddies in the water, yield and friction of the grains.

use super::super::neighbours::LEAST_TASK;
use super::super::phase::{Phase, Phases};
use super::super::scene::{IncompressibleScene, Turbulence, height_axis};
use crate::material::turbulence::eddy_viscosity;
use crate::parallel::prelude::*;
use crate::vector::shear_rate;

/// Viscosities, shear rates and loads of the laws at every free particle.
#[derive(Debug)]
pub(crate) struct Viscosities {
    /// Dynamic viscosity of every fluid particle `[Pa·s]`, times its voidage.
    pub(crate) fluid: Vec<f64>,
    /// Shear rate of every fluid particle `[1/s]`.
    pub(crate) fluid_rate: Vec<f64>,
    /// Part 1 − φ of the space that the fluid has at every fluid particle `[-]`.
    pub(crate) voidage: Vec<f64>,
    /// Apparent viscosity of every sediment particle `[Pa·s]`.
    pub(crate) sediment: Vec<f64>,
    /// Load on the grains of every sediment particle `[Pa]`.
    pub(crate) load: Vec<f64>,
}

impl Viscosities {
    pub(crate) fn new<const D: usize>(phases: &Phases<D>) -> Self {
        let (free_fluid, free_sediment) = (phases.fluid.len(), phases.sediment.as_ref().map_or(0, Phase::len));
        Self {
            fluid: vec![0.0; free_fluid],
            fluid_rate: vec![0.0; free_fluid],
            voidage: vec![1.0; free_fluid],
            sediment: vec![0.0; free_sediment],
            load: vec![0.0; free_sediment],
        }
    }

    /// Evaluates the laws at the present heights and velocity gradients.
    pub(crate) fn find<const D: usize>(&mut self, scene: &IncompressibleScene<D>, phases: &Phases<D>) {
        let fluid = &phases.fluid;
        let layer = scene.solid_fraction.stratification();
        (&mut self.fluid, &mut self.fluid_rate, &mut self.voidage)
            .into_par_iter()
            .enumerate()
            .with_min_len(LEAST_TASK)
            .for_each(|(a, (viscosity, rate_of, voidage))| {
                let height = fluid.position[a][height_axis(D)];
                let rate = shear_rate(&fluid.velocity_gradient[a]);
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
