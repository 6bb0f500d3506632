//! Viscosities of both phases: eddies in the water, yield and friction of the grains.

use super::pairs::LEAST_TASK;
use super::phase::height_axis;
use super::scene::{Sediment, SedimentLaw, Turbulence};
use super::simulation::IncompressibleSimulation;
use super::stratification::Stratification;
use crate::vector::shear_rate;
use rayon::prelude::*;

/// 1/γ̇, bounded as (1 − exp(−γ̇/γ_r))/γ̇.
#[inline]
fn inverse_rate(rate: f64, regularisation: f64) -> f64 {
    let ratio = rate / regularisation;
    if ratio < 1e-6 { 1.0 / regularisation } else { -libm::expm1(-ratio) / rate }
}

impl<const D: usize> Sediment<D> {
    /// What the law's strength depends on at a height `[m]`: the yield stress, or the overburden `[Pa]`.
    pub(super) fn load(&self, height: f64, stratification: Option<&Stratification>) -> f64 {
        match self.law {
            SedimentLaw::Bingham(law) => {
                let overburden = law.buoyant_weight * (law.overburden_level - height).max(0.0);
                law.yield_stress + law.overburden_friction * overburden
            }
            SedimentLaw::MuI(_) => stratification.map_or(0.0, |layer| layer.at(height).overburden),
        }
    }

    /// Apparent viscosity `[Pa·s]` at a load `[Pa]` and a shear rate `[1/s]`.
    #[inline]
    pub(super) fn viscosity(&self, load: f64, rate: f64) -> f64 {
        match self.law {
            SedimentLaw::Bingham(law) => {
                (load * inverse_rate(rate, law.regularisation_rate)).min(law.largest_viscosity) + law.viscosity
            }
            SedimentLaw::MuI(law) => {
                let reference = law.reference_inertia * (load / self.density).sqrt() / self.grain_diameter;
                let span = law.limiting_friction - law.static_friction;
                let friction = law.static_friction + span * rate / (rate + reference).max(f64::MIN_POSITIVE);
                friction * load / (rate * rate + law.regularisation_rate * law.regularisation_rate).sqrt()
            }
        }
    }
}

/// Rate of a shear over that of its pairs, |u_ab|/r, as a mean over directions `[-]`.
///
/// A pair along the flow sees nothing of γ̇, one across it all: |u_ab|/r = γ̇ |cosα|. For a stress τ that does not depend on
/// the rate the pairs' viscosities τ π/(4 γ̇ |cosα|) then carry just τ: ⟨|cosα|⟩/⟨cos²α⟩ is 4/π in the plane, 3/2 in space.
pub(super) const fn mean_rate(dimensions: usize) -> f64 {
    if dimensions == 2 { 4.0 / std::f64::consts::PI } else { 1.5 }
}

/// Viscosity of water between grains over that of clear water `[-]`, as two-phase Eulerian codes take it.
fn suspension_factor(solid_fraction: f64) -> f64 {
    1.0 + 2.5 * solid_fraction / (1.0 - solid_fraction.min(0.59) / 0.62)
}

impl<const D: usize> IncompressibleSimulation<D> {
    /// Share of the space and dynamic viscosity of every fluid particle, load and viscosity of every sediment particle.
    pub(super) fn find_viscosities(&mut self) {
        let scene = &self.scene;
        let fluid = &self.fluid;
        let normal = height_axis(D);
        let layer = scene.solid_fraction.stratification();
        (&mut self.fluid_viscosity, &mut self.fluid_share)
            .into_par_iter()
            .enumerate()
            .with_min_len(LEAST_TASK)
            .for_each(|(a, (viscosity, share))| {
                let height = fluid.position[a][normal];
                let rate = shear_rate(&fluid.velocity_gradient[a]);
                let stratum = layer.map(|layer| layer.at(height));
                let eddy = match scene.fluid.turbulence {
                    Turbulence::Laminar => 0.0,
                    Turbulence::MixingLength { level, depth, law } => law.eddy_viscosity(height - level, depth, rate),
                    Turbulence::Smagorinsky(law) => law.eddy_viscosity(scene.fluid.spacing, rate),
                    Turbulence::Stratified => stratum.map_or(0.0, |s| s.mixing_length * s.mixing_length * rate),
                };
                let solid_fraction = stratum.map_or(0.0, |stratum| stratum.solid_fraction);
                let molecular = scene.fluid.kinematic_viscosity * suspension_factor(solid_fraction);
                *share = 1.0 - solid_fraction;
                *viscosity = *share * scene.fluid.density * (molecular + eddy);
            });
        if let (Some(sediment), Some(material)) = (&self.sediment, &scene.sediment) {
            for a in 0..sediment.len() {
                self.load[a] = material.load(sediment.position[a][normal], layer);
                let rate = shear_rate(&sediment.velocity_gradient[a]);
                self.sediment_viscosity[a] = material.viscosity(self.load[a], rate);
            }
        }
    }
}
