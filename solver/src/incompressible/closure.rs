//! Coefficients of the implicit velocities: viscous pairs of each phase, the bed's friction, the drag.

use super::numerics::PairLaw;
use super::pairs::LEAST_TASK;
use super::phase::height_axis;
use super::scene::{Bed, Sediment, SedimentLaw, Turbulence};
use super::simulation::IncompressibleSimulation;
use super::stratification::Stratification;
use crate::vector::{Vector, shear_rate};
use rayon::prelude::*;

/// 1/γ̇, bounded as (1 − exp(−γ̇/γ_r))/γ̇.
fn inverse_rate(rate: f64, regularisation: f64) -> f64 {
    let ratio = rate / regularisation;
    if ratio < 1e-6 { 1.0 / regularisation } else { -libm::expm1(-ratio) / rate }
}

impl<const D: usize> Sediment<D> {
    /// What the law's strength depends on at a height `[m]`: the yield stress, or the overburden `[Pa]`.
    fn load(&self, height: f64, stratification: Option<&Stratification>) -> f64 {
        match self.law {
            SedimentLaw::Bingham(law) => {
                let overburden = law.buoyant_weight * (law.overburden_level - height).max(0.0);
                law.yield_stress + law.overburden_friction * overburden
            }
            SedimentLaw::MuI(_) => stratification.map_or(0.0, |layer| layer.at(height).overburden),
        }
    }

    /// Apparent viscosity `[Pa·s]` at a load `[Pa]` and a shear rate `[1/s]`.
    fn viscosity(&self, load: f64, rate: f64) -> f64 {
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
const fn mean_rate(dimensions: usize) -> f64 {
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

    /// Fills the rows of M + Δt K and the momenta before the solve.
    pub(super) fn assemble_velocities(&mut self, time_step: f64) {
        let Self {
            scene,
            fluid,
            sediment,
            exchange,
            system,
            fluid_viscosity,
            sediment_viscosity,
            fluid_share,
            load,
            ..
        } = self;
        let numerics = scene.numerics;
        let free_fluid = fluid.len();
        let free_sediment = sediment.as_ref().map_or(0, |s| s.len());
        let stride = fluid.free_pairs.stride() + exchange.of_fluid.stride();
        let sediment_stride = sediment.as_ref().map_or(0, |s| s.free_pairs.stride() + exchange.of_sediment.stride());
        system.resize(free_fluid + free_sediment, stride.max(sediment_stride));
        let stride = system.stride;
        let normal = height_axis(D);
        let (fluid_links, sediment_links) = system.link.split_at_mut(free_fluid * stride);
        let (fluid_counts, sediment_counts) = system.count.split_at_mut(free_fluid);
        let (fluid_diagonals, sediment_diagonals) = system.diagonal.split_at_mut(free_fluid);
        let (fluid_sums, sediment_sums) = system.of_constant.split_at_mut(free_fluid);

        // the fluid's rows
        let material = scene.sediment.as_ref();
        let scale = -2.0 * time_step;
        let wall_scale = 2.0 * fluid.lattice_volume / fluid.lattice.gradient;
        let sediment_velocity = sediment.as_ref().map(|s| &s.velocity);
        let exchange = &*exchange;
        (fluid_links.par_chunks_mut(stride), fluid_counts, fluid_diagonals, fluid_sums)
            .into_par_iter()
            .enumerate()
            .with_min_len(LEAST_TASK)
            .for_each(|(a, (links, count, diagonal, sum))| {
                let mut filled = 0;
                let mut total = 0.0;
                for pair in fluid.free_pairs.of(a) {
                    let b = pair.source as usize;
                    let moment = fluid.moment[a] + fluid.moment[b];
                    let area = fluid.volume[a] * fluid.volume[b] * pair.gradient / moment;
                    let coefficient = scale * area * (fluid_viscosity[a] + fluid_viscosity[b]);
                    links[filled] = (pair.source, coefficient);
                    filled += 1;
                    total += coefficient;
                }
                let mut held = 0.0;
                match scene.fluid.bed {
                    Bed::Slip => {}
                    Bed::NoSlip(level) => {
                        // the wall particle moves against the partner, so that the velocity is 0 at the wall
                        let height = (fluid.position[a][normal] - level).max(0.1 * fluid.spacing);
                        for pair in fluid.wall_pairs.of(a) {
                            let area = fluid.volume[a] * fluid.lattice_volume * pair.gradient / (2.0 * fluid.moment[a]);
                            let depth = (pair.separation[normal] - height).max(0.0);
                            held += scale * area * 2.0 * fluid_viscosity[a] * (1.0 + depth / height).min(6.0);
                        }
                    }
                    Bed::Rough { level, origin_offset, law } => {
                        let mut share = 0.0;
                        for pair in fluid.wall_pairs.of(a) {
                            share -= wall_scale * pair.gradient * pair.separation[normal];
                        }
                        if share > 0.0 {
                            let mut along = fluid.velocity[a];
                            along[normal] = 0.0;
                            let distance = fluid.position[a][normal] - level + origin_offset;
                            held += time_step
                                * fluid.volume[a]
                                * share
                                * law.stress_coefficient(along.norm(), distance, fluid.density);
                        }
                    }
                }
                if let (Some(material), Some(velocity)) = (material, sediment_velocity) {
                    for pair in exchange.of_fluid.of(a) {
                        let b = pair.source as usize;
                        let slip = |b: usize| {
                            (velocity.get(b).copied().unwrap_or_else(Vector::zeros) - fluid.velocity[a]).norm()
                        };
                        let coefficient =
                            time_step * fluid.mass[a] * pair.value * exchange.factor(b, material, || slip(b), scene);
                        if b < free_sediment {
                            links[filled] = ((free_fluid + b) as u32, coefficient);
                            filled += 1;
                            total += coefficient;
                        } else {
                            held += coefficient;
                        }
                    }
                }
                *count = filled as u32;
                *sum = fluid.mass[a] * fluid_share[a] + held;
                *diagonal = *sum + total;
            });

        // the sediment's rows
        if let (Some(sediment), Some(material)) = (sediment.as_ref(), material) {
            let scale = -2.0 * time_step;
            let layer = scene.solid_fraction.stratification();
            (sediment_links.par_chunks_mut(stride), sediment_counts, sediment_diagonals, sediment_sums)
                .into_par_iter()
                .enumerate()
                .with_min_len(LEAST_TASK)
                .for_each(|(a, (links, count, diagonal, sum))| {
                    let mut filled = 0;
                    let (mut total, mut held) = (0.0, 0.0);
                    let pair_viscosity = |b: Option<usize>, distance_squared: f64, height: f64| {
                        let (other_load, other_velocity) = match b {
                            Some(b) => (load[b], sediment.velocity[b]),
                            None => (material.load(height, layer), Vector::zeros()),
                        };
                        let rate = || {
                            let squared = (sediment.velocity[a] - other_velocity).norm_squared();
                            mean_rate(D) * (squared / distance_squared).sqrt()
                        };
                        match numerics.pair_law {
                            PairLaw::PairRate => 2.0 * material.viscosity(load[a].min(other_load), rate()),
                            PairLaw::PairRateMeanLoad => 2.0 * material.viscosity(0.5 * (load[a] + other_load), rate()),
                            PairLaw::ArithmeticMean => {
                                sediment_viscosity[a] + b.map_or(sediment_viscosity[a], |b| sediment_viscosity[b])
                            }
                            PairLaw::HarmonicMean => {
                                let (one, other) =
                                    (sediment_viscosity[a], b.map_or(sediment_viscosity[a], |b| sediment_viscosity[b]));
                                4.0 * one * other / (one + other)
                            }
                        }
                    };
                    for pair in sediment.free_pairs.of(a) {
                        let b = pair.source as usize;
                        let square = pair.distance_squared;
                        let moment = sediment.moment[a] + sediment.moment[b];
                        let area = sediment.volume[a] * sediment.volume[b] * pair.gradient / moment;
                        let coefficient = scale * area * pair_viscosity(Some(b), square, 0.0);
                        links[filled] = ((free_fluid + b) as u32, coefficient);
                        filled += 1;
                        total += coefficient;
                    }
                    for pair in sediment.wall_pairs.of(a) {
                        let square = pair.distance_squared;
                        let area =
                            sediment.volume[a] * sediment.lattice_volume * pair.gradient / (2.0 * sediment.moment[a]);
                        let height = sediment.wall[pair.source as usize][normal];
                        held += scale * area * pair_viscosity(None, square, height);
                    }
                    for pair in exchange.of_sediment.of(a) {
                        let b = pair.source as usize;
                        let slip = || (fluid.velocity[b] - sediment.velocity[a]).norm();
                        let coefficient =
                            time_step * fluid.mass[b] * pair.value * exchange.factor(a, material, slip, scene);
                        links[filled] = (pair.source, coefficient);
                        filled += 1;
                        total += coefficient;
                    }
                    *count = filled as u32;
                    *sum = sediment.mass[a] + held;
                    *diagonal = *sum + total;
                });
        }
        for a in 0..free_fluid {
            system.inertia[a] = fluid.mass[a] * fluid_share[a];
            system.momentum[a] = (fluid.velocity[a] + scene.fluid.gravity * time_step) * system.inertia[a];
            system.velocity[a] = fluid.velocity[a];
        }
        if let (Some(sediment), Some(material)) = (sediment.as_ref(), material) {
            for a in 0..free_sediment {
                let row = free_fluid + a;
                system.inertia[row] = sediment.mass[a];
                system.momentum[row] = (sediment.velocity[a] + material.gravity * time_step) * sediment.mass[a];
                system.velocity[row] = sediment.velocity[a];
            }
        }
    }
}
