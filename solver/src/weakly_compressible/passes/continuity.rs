//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.

use super::PairData;
use super::records::{self, LaneRecord, Records};
use crate::lanes::algebra::{
    accumulate_outer, difference, dot, load, load_tensor, matrix_product, store, store_tensor, sum_of, zero_tensor,
};
use crate::lanes::{LANES, LaneIndices, LanePass, Lanes};
use crate::vector::{Tensor, shear_rate};
use crate::weakly_compressible::divergence::DENSITY_RANGE;
use crate::weakly_compressible::model::{GradientUse, Model};
use crate::weakly_compressible::neighbours::{BLOCK, NeighbourGroup};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{artificial_viscosity, continuity, density_coupling};
use rayon::prelude::*;
use std::ops::Range;

/// Values of a record: the layout of [`Partner`].
pub(super) const fn values(dimension: usize) -> usize {
    3 * dimension + 1
}

/// Values of a record if the density alone is updated: position, velocity.
const fn short_values(dimension: usize) -> usize {
    2 * dimension
}

/// What is read of a flow particle.
struct Partner<V, const D: usize> {
    position: [V; D],
    velocity: [V; D],
    pressure: V,
    pressure_gradient: [V; D],
}

impl<V: Lanes, const D: usize> Partner<V, D> {
    #[inline(always)]
    fn load(records: &Records, indices: &LaneIndices<'_>) -> Self {
        let record: LaneRecord<V> = records.load(const { values(D).div_ceil(4) }, indices);
        Self {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, D),
            pressure: records::scalar(&record, 2 * D),
            pressure_gradient: records::vector(&record, 2 * D + 1),
        }
    }
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

/// Advances density, velocity gradient and stress of the flow particles by one time step `[s]`.
pub(crate) fn run<const D: usize>(
    model: &Model<D>,
    particles: &mut Particles<D>,
    pairs: &mut PairData<D>,
    time_step: f64,
) -> Extremes {
    let flow = particles.flow_count();
    let gradient = model.gradient_use();
    fill_records(particles, pairs, gradient != GradientUse::None);
    let pairs = &*pairs;
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
            let advance = Advance { model, particles: shared, gradient, time_step, block_start: block * BLOCK };
            let mut extremes = Extremes::NONE;
            let extremes_of_block = &mut extremes;
            model.instruction_set.run(Pass { advance, pairs, out, extremes: extremes_of_block });
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

/// Records in the layout of [`Partner`], or the first part of it.
fn fill_records<const D: usize>(particles: &Particles<D>, pairs: &mut PairData<D>, full: bool) {
    pairs.continuity.set_values(if full { values(D) } else { short_values(D) });
    pairs.continuity.fill(particles.position.len(), |index, record| {
        record.vector(&particles.position[index]);
        record.vector(&particles.velocity[index]);
        if full {
            record.scalar(particles.pressure[index]);
            record.vector(&particles.pressure_gradient[index]);
        }
    });
}

struct Output<'a, const D: usize> {
    density: &'a mut [f64],
    velocity_gradient: &'a mut [Tensor<D>],
    stress: &'a mut [Tensor<D>],
    viscosity: &'a mut [f64],
    artificial_viscosity: &'a mut [f64],
}

struct Pass<'a, const D: usize> {
    advance: Advance<'a, D>,
    pairs: &'a PairData<D>,
    out: Output<'a, D>,
    extremes: &'a mut Extremes,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { advance, pairs, mut out, extremes } = self;
        let count = out.density.len();
        let mut offset = 0;
        while offset < count {
            let group = advance.model.list.group((advance.block_start + offset) / LANES);
            let sums = if advance.gradient == GradientUse::None {
                divergence_only::<V, D>(pairs, &group)
            } else {
                all_sums::<V, D>(pairs, &group)
            };
            let end = (offset + LANES).min(count);
            advance.particles_at(offset..end, &sums, &mut out, extremes);
            offset = end;
        }
    }
}

/// The pair sums of eight particles.
struct RateSums<V, const D: usize> {
    /// Σ V_b v_ab·∇_aW_ab = −∇·v `[1/s]`.
    compression: V,
    /// The coupling's pair sum `[Pa/m²]`.
    coupling: V,
    /// Velocity gradient before its correction `[1/s]`.
    gradient: [[V; D]; D],
}

#[inline(always)]
fn all_sums<V: Lanes, const D: usize>(pairs: &PairData<D>, group: &NeighbourGroup<'_>) -> RateSums<V, D> {
    let all = &pairs.continuity;
    let own = Partner::<V, D>::load(all, &group.own);
    let mut coupling = V::splat(0.0);
    let mut gradient = zero_tensor::<V, D>();
    let (flow_weights, wall_weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
    for (b, weight) in group.flow.zip(flow_weights) {
        let other = Partner::<V, D>::load(all, &b);
        let r = difference(&own.position, &other.position);
        let weight = V::load(weight);
        let sum = sum_of(&own.pressure_gradient, &other.pressure_gradient);
        coupling = coupling + weight * density_coupling::bracket(own.pressure - other.pressure, &sum, &r);
        accumulate_outer(&mut gradient, weight, &difference(&other.velocity, &own.velocity), &r);
    }
    for (w, weight) in group.wall.zip(wall_weights) {
        let (quads, wanted) = const { (values(D).div_ceil(4), short_values(D).div_ceil(4)) };
        let record = all.load_start::<V>(quads, wanted, &w);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&own.position, &position);
        accumulate_outer(&mut gradient, V::load(weight), &difference(&velocity, &own.velocity), &r);
    }
    RateSums { compression: continuity::compression(&gradient), coupling, gradient }
}

#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(pairs: &PairData<D>, group: &NeighbourGroup<'_>) -> RateSums<V, D> {
    let all = &pairs.continuity;
    let own = all.load::<V>(const { short_values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let mut compression = V::splat(0.0);
    for (b, weight) in group.pairs.zip(&pairs.weights[group.first_pair..]) {
        let record = all.load::<V>(const { short_values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&place, &position);
        compression = compression + V::load(weight) * dot(&difference(&velocity_a, &velocity), &r);
    }
    RateSums { compression, coupling: V::splat(0.0), gradient: zero_tensor() }
}

/// A block of particles on its way to the next step.
struct Advance<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    gradient: GradientUse,
    time_step: f64,
    /// First particle of the block.
    block_start: usize,
}

impl<const D: usize> Advance<'_, D> {
    /// Advances the eight particles at `places` of the block: density, artificial viscosity, then gradient and stress.
    #[inline(always)]
    fn particles_at<V: Lanes>(
        &self,
        places: Range<usize>,
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
        extremes: &mut Extremes,
    ) {
        let equation_of_state = &self.model.equation_of_state;
        let previous = load::<V>(&out.density[places.clone()]);
        let strength = self.model.numerics.density_coupling;
        let density = continuity::advanced(previous, sums.compression, sums.coupling, strength, self.time_step);
        let inverse_reference = 1.0 / equation_of_state.reference_density;
        store(density, &mut out.density[places.clone()]);
        for place in places.clone() {
            let relative = out.density[place] * inverse_reference;
            if !(relative > DENSITY_RANGE.0 && relative < DENSITY_RANGE.1) && extremes.bad_density.is_none() {
                extremes.bad_density = Some(self.block_start + place);
            }
        }
        if self.model.numerics.viscosity_switch == ViscositySwitch::MorrisMonaghan {
            let decay_rate = equation_of_state.sound_speed() / self.model.kernel.smoothing_length();
            let alpha = load::<V>(&out.artificial_viscosity[places.clone()]);
            let switched = artificial_viscosity::switched(alpha, -sums.compression, decay_rate, self.time_step);
            store(switched, &mut out.artificial_viscosity[places.clone()]);
        }
        if self.gradient != GradientUse::None {
            self.stress_of(places, density, &sums.gradient, out, extremes);
        }
    }

    /// Velocity gradient, and the stress or the viscosity that the law gives with it.
    #[inline(always)]
    fn stress_of<V: Lanes>(
        &self,
        places: Range<usize>,
        density: V,
        gradient: &[[V; D]; D],
        out: &mut Output<'_, D>,
        extremes: &mut Extremes,
    ) {
        let law = &self.model.rheology;
        let particles_here = self.block_start + places.start..self.block_start + places.end;
        let correction = load_tensor::<V, D>(&self.particles.correction[particles_here]);
        let gradient = matrix_product(gradient, &correction);
        let pressure = self.model.equation_of_state.pressure(density);
        store_tensor(&gradient, &mut out.velocity_gradient[places.clone()]);
        if self.gradient == GradientUse::Stress {
            let stress = load_tensor::<V, D>(&out.stress[places.clone()]);
            let stress = law.updated_stresses(&stress, &gradient, pressure, self.model.shear_modulus(), self.time_step);
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
