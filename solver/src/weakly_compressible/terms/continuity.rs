//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.
//!
//! The divergence in (7) is not corrected: the trace of the corrected gradient makes the layer shrink or blow up.

use super::{artificial_viscosity, density_coupling};
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate_outer, difference, dot, load, load_tensor, matrix_product, store, store_tensor, sum_of, zero_tensor,
};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes};
use crate::material::equation_of_state::EquationOfState;
use crate::material::rheology::Rheology;
use crate::vector::{Tensor, shear_rate};
use crate::weakly_compressible::divergence::DENSITY_RANGE;
use crate::weakly_compressible::neighbours::{Group, VerletList};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::records::{self, Records};
use rayon::prelude::*;
use std::ops::Range;

/// The constants of the pass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Continuity<'a, const D: usize> {
    pub(crate) kernel: Kernel<D>,
    pub(crate) list: &'a VerletList,
    pub(crate) instruction_set: InstructionSet,
    pub(crate) equation_of_state: EquationOfState,
    pub(crate) rheology: &'a Rheology,
    pub(crate) shear_modulus: f64,
    pub(crate) density_coupling: f64,
    pub(crate) viscosity_switch: ViscositySwitch,
    pub(crate) time_step: f64,
    /// Whether anything needs the velocity gradient.
    pub(crate) gradient: GradientUse,
}

/// Values of a neighbour's record: position, velocity, pressure, pressure gradient.
pub(crate) const fn values(dimension: usize) -> usize {
    3 * dimension + 1
}

/// Values of a record if the density alone is updated: position, velocity.
const fn short_values(dimension: usize) -> usize {
    2 * dimension
}

/// Whether the velocity gradient is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GradientUse {
    /// Gradient and stress are updated.
    Stress,
    /// Gradient and apparent viscosity are updated, for the pairwise operators.
    Viscosity,
    /// The density alone is updated: a Newtonian fluid with pairwise viscosity.
    None,
}

/// What the pass found on its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremes {
    /// Largest apparent kinematic viscosity of laws with an explicit viscous bound `[m²/s]`.
    pub(crate) kinematic_viscosity: f64,
    /// Flow particle of the lowest storage index whose density left its range or is not a number.
    pub(crate) bad_density: Option<usize>,
}

impl Extremes {
    const NONE: Self = Self { kinematic_viscosity: 0.0, bad_density: None };

    fn merge(self, other: Self) -> Self {
        let bad_density = match (self.bad_density, other.bad_density) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self { kinematic_viscosity: self.kinematic_viscosity.max(other.kinematic_viscosity), bad_density }
    }
}

struct Output<'a, const D: usize> {
    density: &'a mut [f64],
    velocity_gradient: &'a mut [Tensor<D>],
    stress: &'a mut [Tensor<D>],
    viscosity: &'a mut [f64],
    artificial_viscosity: &'a mut [f64],
}

impl<const D: usize> Continuity<'_, D> {
    /// Advances density, velocity gradient and stress of the flow particles by one time step.
    pub(crate) fn run(&self, particles: &mut Particles<D>) -> Extremes {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let flow = particles.flow_count();
        let mut records = std::mem::replace(&mut particles.continuity_records, Records::new(0));
        let shared = &*particles;
        let full = self.gradient != GradientUse::None;
        records.set_values(if full { values(D) } else { short_values(D) });
        records.fill(particles.position.len(), |index, record| {
            record.vector(&shared.position[index]);
            record.vector(&shared.velocity[index]);
            if full {
                record.scalar(shared.pressure[index]);
                record.vector(&shared.pressure_gradient[index]);
            }
        });
        particles.continuity_records = records;
        let mut density = std::mem::take(&mut particles.density);
        let mut velocity_gradient = std::mem::take(&mut particles.velocity_gradient);
        let mut stress = std::mem::take(&mut particles.stress);
        let mut viscosity = std::mem::take(&mut particles.viscosity);
        let mut artificial_viscosity = std::mem::take(&mut particles.artificial_viscosity);
        let shared = &*particles;
        let extremes = (
            density[..flow].par_chunks_mut(BLOCK),
            velocity_gradient[..flow].par_chunks_mut(BLOCK),
            stress[..flow].par_chunks_mut(BLOCK),
            viscosity[..flow].par_chunks_mut(BLOCK),
            artificial_viscosity[..flow].par_chunks_mut(BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .map(|(block, (density, velocity_gradient, stress, viscosity, artificial_viscosity))| {
                let out = Output { density, velocity_gradient, stress, viscosity, artificial_viscosity };
                let mut extremes = Extremes::NONE;
                let extremes_of_block = &mut extremes;
                self.instruction_set.run(Pass {
                    constants: self,
                    particles: shared,
                    block,
                    out,
                    extremes: extremes_of_block,
                });
                extremes
            })
            .reduce(|| Extremes::NONE, Extremes::merge);
        particles.density = density;
        particles.velocity_gradient = velocity_gradient;
        particles.stress = stress;
        particles.viscosity = viscosity;
        particles.artificial_viscosity = artificial_viscosity;
        extremes
    }
}

struct Pass<'a, const D: usize> {
    constants: &'a Continuity<'a, D>,
    particles: &'a Particles<D>,
    block: usize,
    out: Output<'a, D>,
    extremes: &'a mut Extremes,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let Self { constants, particles, block, mut out, extremes } = self;
        let count = out.density.len();
        let mut offset = 0;
        while offset < count {
            let group = constants.list.group((block * BLOCK + offset) / LANES);
            let sums = if constants.gradient == GradientUse::None {
                divergence_only::<V, D>(particles, &group)
            } else {
                all_sums::<V, D>(particles, &group)
            };
            let end = (offset + LANES).min(count);
            constants.advance(particles, block * BLOCK, offset..end, &sums, &mut out, extremes);
            offset = end;
        }
    }
}

/// The pair sums of eight particles.
struct Sums<V, const D: usize> {
    /// Σ V_b v_ab·∇_aW_ab = −∇·v `[1/s]`.
    compression: V,
    /// The coupling's pair sum `[Pa/m²]`.
    coupling: V,
    /// Velocity gradient before its correction `[1/s]`.
    gradient: [[V; D]; D],
}

#[inline(always)]
fn all_sums<V: Lanes, const D: usize>(particles: &Particles<D>, group: &Group<'_>) -> Sums<V, D> {
    let all = &particles.continuity_records;
    let own = all.load::<V>(const { values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let pressure_a = records::scalar(&own, 2 * D);
    let pressure_gradient_a = records::vector::<V, D>(&own, 2 * D + 1);
    let mut coupling = V::splat(0.0);
    let mut gradient = zero_tensor::<V, D>();
    let weights = &particles.pair_weights[group.first_pair..];
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
    for (b, weight) in group.flow.zip(flow_weights) {
        let record = all.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let pressure = records::scalar(&record, 2 * D);
        let pressure_gradient = records::vector::<V, D>(&record, 2 * D + 1);
        let r = difference(&place, &position);
        let weight = V::load(weight);
        let sum = sum_of(&pressure_gradient_a, &pressure_gradient);
        coupling = coupling + weight * density_coupling::bracket(pressure_a - pressure, &sum, &r);
        accumulate_outer(&mut gradient, weight, &difference(&velocity, &velocity_a), &r);
    }
    for (w, weight) in group.wall.zip(wall_weights) {
        let (quads, wanted) = const { (values(D).div_ceil(4), short_values(D).div_ceil(4)) };
        let record = all.load_start::<V>(quads, wanted, &w);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&place, &position);
        accumulate_outer(&mut gradient, V::load(weight), &difference(&velocity, &velocity_a), &r);
    }
    // the trace of the uncorrected gradient Σ V (v_b − v_a) ⊗ ∇W is ∇·v of (7)
    let mut compression = -gradient[0][0];
    for i in 1..D {
        compression = compression - gradient[i][i];
    }
    Sums { compression, coupling, gradient }
}

#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(particles: &Particles<D>, group: &Group<'_>) -> Sums<V, D> {
    let all = &particles.continuity_records;
    let own = all.load::<V>(const { short_values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let mut compression = V::splat(0.0);
    for (b, weight) in group.pairs.zip(&particles.pair_weights[group.first_pair..]) {
        let record = all.load::<V>(const { short_values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&place, &position);
        compression = compression + V::load(weight) * dot(&difference(&velocity_a, &velocity), &r);
    }
    Sums { compression, coupling: V::splat(0.0), gradient: zero_tensor() }
}

impl<const D: usize> Continuity<'_, D> {
    /// Advances the eight particles at `places` of a block.
    #[inline(always)]
    fn advance<V: Lanes>(
        &self,
        particles: &Particles<D>,
        block_start: usize,
        places: Range<usize>,
        sums: &Sums<V, D>,
        out: &mut Output<'_, D>,
        extremes: &mut Extremes,
    ) {
        let dt = self.time_step;
        let equation_of_state = &self.equation_of_state;
        let law = self.rheology;
        // (24) with (27); ρ is never floored: a floor opens voids
        let previous = load::<V>(&out.density[places.clone()]);
        let density = previous
            + V::splat(dt) * previous * sums.compression
            + V::splat(dt * dt * self.density_coupling) * sums.coupling;
        let inverse_reference = 1.0 / equation_of_state.reference_density;
        store(density, &mut out.density[places.clone()]);
        for place in places.clone() {
            let relative = out.density[place] * inverse_reference;
            if !(relative > DENSITY_RANGE.0 && relative < DENSITY_RANGE.1) && extremes.bad_density.is_none() {
                extremes.bad_density = Some(block_start + place);
            }
        }
        if self.viscosity_switch == ViscositySwitch::MorrisMonaghan {
            let decay_rate = equation_of_state.sound_speed() / self.kernel.smoothing_length();
            let alpha = load::<V>(&out.artificial_viscosity[places.clone()]);
            let switched = artificial_viscosity::switched(alpha, -sums.compression, decay_rate, dt);
            store(switched, &mut out.artificial_viscosity[places.clone()]);
        }
        if self.gradient == GradientUse::None {
            return;
        }
        let particles_here = block_start + places.start..block_start + places.end;
        let correction = load_tensor::<V, D>(&particles.correction[particles_here]);
        let gradient = matrix_product(&sums.gradient, &correction);
        let pressure = equation_of_state.pressure(density);
        store_tensor(&gradient, &mut out.velocity_gradient[places.clone()]);
        if self.gradient == GradientUse::Stress {
            let stress = load_tensor::<V, D>(&out.stress[places.clone()]);
            let stress = law.updated_stresses(&stress, &gradient, pressure, self.shear_modulus, dt);
            store_tensor(&stress, &mut out.stress[places.clone()]);
        }
        if self.gradient == GradientUse::Viscosity || !law.is_plastic() {
            let pressure = pressure.to_array();
            for (lane, place) in places.enumerate() {
                let viscosity = law.viscosity(shear_rate(&out.velocity_gradient[place]), pressure[lane]);
                out.viscosity[place] = viscosity;
                if !law.is_plastic() {
                    extremes.kinematic_viscosity = extremes.kinematic_viscosity.max(viscosity / out.density[place]);
                }
            }
        }
    }
}
