//! The rows of M + Δt K: viscous pairs of each phase, the bed's friction, the drag.
//!
//! The viscous pair (18) is K_ab = −V_a V_b (η_a + η_b) F, over the mean of both moments as in the pressure Poisson
//! equation.

use super::closure::mean_rate;
use super::numerics::PairLaw;
use super::pairs::Pair;
use super::phase::{Phase, height_axis};
use super::scene::{Bed, Sediment};
use super::simulation::IncompressibleSimulation;
use super::velocity_solve::VelocitySystem;
use crate::lanes::LANES;
use crate::linear::{Row as Links, Single, single};
use crate::vector::Vector;
use rayon::prelude::*;

/// A row while it is filled.
struct Row<'a, 'b> {
    links: &'a mut Links<'b, Single>,
    coupled: f64,
    held: f64,
}

impl Row<'_, '_> {
    /// A pair with a free particle: Δt k_ab `[kg]`.
    #[inline(always)]
    fn couple(&mut self, partner: usize, coefficient: f64) {
        let coefficient = single(coefficient);
        self.links.push(partner as u32, coefficient);
        self.coupled += coefficient;
    }

    /// A pair with what stands still.
    #[inline(always)]
    fn hold(&mut self, coefficient: f64) {
        self.held += coefficient;
    }
}

/// Share by which the mirrored velocity of a wall particle may exceed its partner's `[-]`.
const LARGEST_MIRROR: f64 = 6.0;

/// Least height of a particle above a wall that it sticks to, in spacings `[-]`.
const LEAST_HEIGHT: f64 = 0.1;

impl<const D: usize> IncompressibleSimulation<D> {
    /// Fills the rows of M + Δt K and the momenta before the solve.
    pub(super) fn assemble_velocities(&mut self, time_step: f64) {
        let mut system = std::mem::replace(&mut self.system, VelocitySystem::new());
        let free_fluid = self.fluid.len();
        let free_sediment = self.sediment.as_ref().map_or(0, Phase::len);
        let fluid_stride = self.fluid.free_pairs.stride() + self.exchange.of_fluid.stride();
        let of_sediment = |s: &Phase<D>| s.free_pairs.stride() + self.exchange.of_sediment.stride();
        let stride = fluid_stride.max(self.sediment.as_ref().map_or(0, of_sediment));
        system.resize(free_fluid + free_sediment);
        let gravity =
            (self.scene.fluid.gravity, self.scene.sediment.as_ref().map_or_else(Vector::zeros, |s| s.gravity));
        let VelocitySystem { couplings, diagonal, of_constant, inertia, momentum, velocity, .. } = &mut system;
        let beside = (
            diagonal.par_chunks_mut(LANES),
            of_constant.par_chunks_mut(LANES),
            inertia.par_chunks_mut(LANES),
            momentum.par_chunks_mut(LANES),
            velocity.par_chunks_mut(LANES),
        );
        let beside = beside.into_par_iter();
        couplings.fill(free_fluid + free_sediment, stride, beside, |first, group, beside| {
            let (diagonal, sum, inertia, momentum, velocity) = beside;
            for lane in 0..diagonal.len() {
                let index = first + lane;
                let (coupled, held, force) = group.row(lane, |links| {
                    let mut row = Row { links, coupled: 0.0, held: 0.0 };
                    let force = match (&self.sediment, &self.scene.sediment) {
                        (Some(sediment), Some(material)) if index >= free_fluid => {
                            let a = index - free_fluid;
                            self.sediment_row(a, sediment, material, time_step, &mut row);
                            (inertia[lane], velocity[lane]) = (sediment.mass[a], sediment.velocity[a]);
                            gravity.1
                        }
                        _ => {
                            self.fluid_row(index, time_step, &mut row);
                            inertia[lane] = self.fluid.mass[index] * self.fluid_share[index];
                            velocity[lane] = self.fluid.velocity[index];
                            gravity.0
                        }
                    };
                    (row.coupled, row.held, force)
                });
                sum[lane] = inertia[lane] + held;
                diagonal[lane] = sum[lane] + coupled;
                momentum[lane] = (velocity[lane] + force * time_step) * inertia[lane];
            }
        });
        self.system = system;
    }

    fn fluid_row(&self, a: usize, time_step: f64, row: &mut Row<'_, '_>) {
        let (fluid, viscosity) = (&self.fluid, &self.fluid_viscosity);
        let scale = -2.0 * time_step;
        for pair in fluid.free_pairs.of(a) {
            let b = pair.source as usize;
            let moment = fluid.moment[a] + fluid.moment[b];
            let area = fluid.volume[a] * fluid.volume[b] * pair.gradient / moment;
            row.couple(b, scale * area * (viscosity[a] + viscosity[b]));
        }
        self.hold_by_bed(a, time_step, row);
        let (Some(sediment), Some(material)) = (&self.sediment, &self.scene.sediment) else { return };
        let free_sediment = sediment.len();
        for pair in self.exchange.of_fluid.of(a) {
            let b = pair.source as usize;
            let own = || sediment.velocity.get(b).copied().unwrap_or_else(Vector::zeros);
            let slip = || (own() - fluid.velocity[a]).norm();
            let factor = self.exchange.factor(b, material, slip, &self.scene);
            let coefficient = time_step * fluid.mass[a] * pair.value * factor;
            if b < free_sediment {
                row.couple(fluid.len() + b, coefficient);
            } else {
                row.hold(coefficient);
            }
        }
    }

    /// Friction of what the fluid flows over.
    fn hold_by_bed(&self, a: usize, time_step: f64, row: &mut Row<'_, '_>) {
        let fluid = &self.fluid;
        let normal = height_axis(D);
        match self.scene.fluid.bed {
            Bed::Slip => {}
            Bed::NoSlip(level) => {
                // the wall particle moves against the partner, so that the velocity is 0 at the wall
                let height = (fluid.position[a][normal] - level).max(LEAST_HEIGHT * fluid.spacing);
                for pair in fluid.wall_pairs.of(a) {
                    let area = fluid.volume[a] * fluid.lattice_volume * pair.gradient / (2.0 * fluid.moment[a]);
                    let depth = (pair.separation[normal] - height).max(0.0);
                    let mirror = (1.0 + depth / height).min(LARGEST_MIRROR);
                    row.hold(-2.0 * time_step * area * 2.0 * self.fluid_viscosity[a] * mirror);
                }
            }
            Bed::Rough { level, origin_offset, law } => {
                // twice Σ V |∂W| over the wall is a particle's share of the bed's area
                let scale = -2.0 * fluid.lattice_volume / fluid.lattice.gradient;
                let arms = |sum, pair: &Pair<D>| sum + pair.gradient * pair.separation[normal];
                let share = scale * fluid.wall_pairs.of(a).iter().fold(0.0, arms);
                if share > 0.0 {
                    let mut along = fluid.velocity[a];
                    along[normal] = 0.0;
                    let distance = fluid.position[a][normal] - level + origin_offset;
                    let friction = law.stress_coefficient(along.norm(), distance, fluid.density);
                    row.hold(time_step * fluid.volume[a] * share * friction);
                }
            }
        }
    }

    fn sediment_row(
        &self,
        a: usize,
        sediment: &Phase<D>,
        material: &Sediment<D>,
        time_step: f64,
        row: &mut Row<'_, '_>,
    ) {
        let first = self.fluid.len();
        let scale = -2.0 * time_step;
        let normal = height_axis(D);
        for pair in sediment.free_pairs.of(a) {
            let b = pair.source as usize;
            let moment = sediment.moment[a] + sediment.moment[b];
            let area = sediment.volume[a] * sediment.volume[b] * pair.gradient / moment;
            let partner = Partner {
                particle: Some(b),
                load: self.load[b],
                velocity: sediment.velocity[b],
                viscosity: self.sediment_viscosity[b],
            };
            row.couple(first + b, scale * area * self.pair_viscosity(a, material, &partner, pair));
        }
        let layer = self.scene.solid_fraction.stratification();
        for pair in sediment.wall_pairs.of(a) {
            let area = sediment.volume[a] * sediment.lattice_volume * pair.gradient / (2.0 * sediment.moment[a]);
            let load = material.load(sediment.wall[pair.source as usize][normal], layer);
            let partner =
                Partner { particle: None, load, velocity: Vector::zeros(), viscosity: self.sediment_viscosity[a] };
            row.hold(scale * area * self.pair_viscosity(a, material, &partner, pair));
        }
        for pair in self.exchange.of_sediment.of(a) {
            let b = pair.source as usize;
            let slip = || (self.fluid.velocity[b] - sediment.velocity[a]).norm();
            let factor = self.exchange.factor(a, material, slip, &self.scene);
            row.couple(b, time_step * self.fluid.mass[b] * pair.value * factor);
        }
    }

    /// η_a + η_b of a pair of sediment particles `[Pa·s]`.
    #[inline]
    fn pair_viscosity(&self, a: usize, material: &Sediment<D>, partner: &Partner<D>, pair: &Pair<D>) -> f64 {
        let (own_load, own) = (self.load[a], self.sediment_viscosity[a]);
        let rate = || {
            let velocity = self.sediment.as_ref().map_or_else(Vector::zeros, |sediment| sediment.velocity[a]);
            mean_rate(D) * ((velocity - partner.velocity).norm_squared() / pair.separation.norm_squared()).sqrt()
        };
        match self.scene.numerics.pair_law {
            PairLaw::PairRate => 2.0 * material.viscosity(own_load.min(partner.load), rate()),
            PairLaw::PairRateMeanLoad => 2.0 * material.viscosity(0.5 * (own_load + partner.load), rate()),
            PairLaw::AveragedPairRate => {
                let rate = mean_rate(D) * self.sediment_rates.pair_rate(a, partner.particle, pair);
                2.0 * material.viscosity(0.5 * (own_load + partner.load), rate)
            }
            PairLaw::ArithmeticMean => own + partner.viscosity,
            PairLaw::HarmonicMean => 4.0 * own * partner.viscosity / (own + partner.viscosity),
        }
    }
}

/// What a pair reads of its other particle.
struct Partner<const D: usize> {
    /// Its index; none of a wall.
    particle: Option<usize>,
    /// Yield stress or overburden `[Pa]`.
    load: f64,
    /// Velocity `[m/s]`.
    velocity: Vector<D>,
    /// Apparent viscosity `[Pa·s]`.
    viscosity: f64,
}
