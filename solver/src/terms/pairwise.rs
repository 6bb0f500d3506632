//! The paper's momentum equation: pressure (10), Cleary's viscosity (11), Schwaiger's correction (13)(14).
//!
//! Kept so that a report can show what it does. The continuum limit of (11) carries a bulk term η∇·v, so nearly
//! rigid material cannot decompress; use the single divergence for anything with a yield.

use super::artificial_viscosity;
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate, accumulate_outer, difference, dot, reduce_tensor, reduce_vector, scaled, splat_vector,
};
use crate::lanes::{InstructionSet, LaneIndices, LanePass, Lanes, gather, gather_vectors};
use crate::neighbours::VerletList;
use crate::numerics::{MomentumOperator, ViscositySwitch};
use crate::particles::Particles;
use crate::records::{self, Records};
use crate::vector::Vector;
use rayon::prelude::*;

/// β_max of (20) `[-]`.
const MORRIS_LIMIT: f64 = 2.0;

/// The constants of the pass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pairwise<'a, const D: usize> {
    pub(crate) kernel: Kernel<D>,
    pub(crate) list: &'a VerletList,
    pub(crate) instruction_set: InstructionSet,
    pub(crate) momentum_operator: MomentumOperator,
    pub(crate) gravity: Vector<D>,
    pub(crate) reference_density: f64,
    pub(crate) bulk_modulus: f64,
    pub(crate) sound_speed: f64,
    pub(crate) artificial_viscosity: f64,
    pub(crate) viscosity_switch: ViscositySwitch,
}

/// Values of a neighbour's record: position, velocity, volume, density, p/ρ², viscosity, α.
const fn values(dimension: usize) -> usize {
    2 * dimension + 5
}

impl<const D: usize> Pairwise<'_, D> {
    /// Accelerations `[m/s²]` of the flow particles.
    pub(crate) fn run(&self, particles: &mut Particles<D>) {
        const BLOCK: usize = crate::neighbours::BLOCK;
        let mut records = std::mem::replace(&mut particles.momentum_records, Records::new(0));
        records.set_values(values(D));
        let shared = &*particles;
        records.fill(particles.position.len(), |index, record| {
            let density = shared.density[index];
            record.vector(&shared.position[index]);
            record.vector(&shared.velocity[index]);
            record.scalar(shared.volume[index]);
            record.scalar(density);
            record.scalar(shared.pressure[index] / (density * density));
            record.scalar(shared.viscosity[index]);
            record.scalar(shared.artificial_viscosity[index]);
        });
        particles.momentum_records = records;
        let mut acceleration = std::mem::take(&mut particles.acceleration);
        let shared = &*particles;
        acceleration.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
            self.instruction_set.run(Pass { constants: self, particles: shared, first: block * BLOCK, out });
        });
        particles.acceleration = acceleration;
    }
}

struct Pass<'a, const D: usize> {
    constants: &'a Pairwise<'a, D>,
    particles: &'a Particles<D>,
    first: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, out } = self;
        for (offset, out) in out.iter_mut().enumerate() {
            let a = first + offset;
            let mut sums = plain_sums::<V, D>(constants, particles, a);
            if constants.momentum_operator == MomentumOperator::PairwiseCorrected {
                let (scale, excess) = schwaiger::<V, D>(constants, particles, a);
                sums.viscous = (sums.viscous - excess) * scale;
            }
            *out = sums.pressure + sums.viscous / particles.density[a] + constants.gravity;
        }
    }
}

/// Pair sums of one particle.
struct Sums<const D: usize> {
    /// Pressure and artificial viscosity `[m/s²]`.
    pressure: Vector<D>,
    /// (11) `[N/m³]`.
    viscous: Vector<D>,
}

#[inline(always)]
fn plain_sums<V: Lanes, const D: usize>(constants: &Pairwise<'_, D>, particles: &Particles<D>, a: usize) -> Sums<D> {
    let total = particles.position.len();
    let zero = V::splat(0.0);
    let smoothing_length = constants.kernel.smoothing_length();
    // δ = 0.01 h in (11); 2(d + 2) is 8 in the plane
    let singularity = V::splat(1e-4 * smoothing_length * smoothing_length);
    let factor = V::splat(2.0 * 2.0 * (D as f64 + 2.0));
    let speed = smoothing_length * constants.sound_speed;
    let place = splat_vector::<V, D>(&particles.position[a]);
    let velocity_a = splat_vector::<V, D>(&particles.velocity[a]);
    let density_a = V::splat(particles.density[a]);
    let viscosity_a = V::splat(particles.viscosity[a]);
    let alpha_a = V::splat(particles.artificial_viscosity[a]);
    let specific_a = V::splat(particles.pressure[a] / (particles.density[a] * particles.density[a]));
    let (mut pressure_sum, mut viscous_sum) = ([zero; D], [zero; D]);
    let row = constants.list.row(a);
    for chunk in row.flow {
        let b = LaneIndices::new(chunk, total);
        let record = particles.momentum_records.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let volume = records::scalar(&record, 2 * D);
        let density = records::scalar(&record, 2 * D + 1);
        let specific = records::scalar(&record, 2 * D + 2);
        let viscosity = records::scalar(&record, 2 * D + 3);
        let r = difference(&place, &position);
        let slip = difference(&velocity_a, &velocity);
        let distance_squared = dot(&r, &r);
        let weight = volume * constants.kernel.gradient_factor(distance_squared);
        let regular = distance_squared + singularity;
        let approach = dot(&r, &slip);
        // one division for the harmonic mean of the viscosities over r² and for 1/(ρ̄ r²)
        let density_sum = density_a + density;
        let viscosity_sum = viscosity_a + viscosity + V::splat(1e-30);
        let common = V::splat(1.0) / (viscosity_sum * regular * density_sum);
        let inverse_regular_density = common * viscosity_sum * V::splat(2.0);
        let harmonic = viscosity_a * viscosity * (common * density_sum);
        let alpha = match constants.viscosity_switch {
            ViscositySwitch::Constant => V::splat(constants.artificial_viscosity * speed),
            ViscositySwitch::MorrisMonaghan => {
                let alpha = records::scalar(&record, 2 * D + 4);
                (alpha + alpha_a) * V::splat(0.5 * speed)
            }
        };
        let push = artificial_viscosity::pair_factor(alpha, approach, inverse_regular_density);
        let along = weight * density * (push - (specific_a + specific));
        let rub = weight * factor * harmonic * approach;
        accumulate(&mut pressure_sum, along, &r);
        accumulate(&mut viscous_sum, rub, &r);
    }
    for chunk in row.wall {
        let w = LaneIndices::new(chunk, total);
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let volume: V = gather(&particles.volume, &w);
        let pressure: V = gather(&particles.pressure, &w);
        let r = difference(&place, &position);
        let distance_squared = dot(&r, &r);
        let weight = volume * constants.kernel.gradient_factor(distance_squared);
        // (23): ρ_w = ρ0 (p_w/K + 1)
        let density = V::splat(constants.reference_density)
            + pressure * V::splat(constants.reference_density / constants.bulk_modulus);
        let slip = wall_difference::<V, D>(particles, &w, &r, &velocity_a, smoothing_length);
        let along = weight * density * (specific_a + pressure / (density * density));
        // a wall particle carries the viscosity of the flow, so the harmonic mean is μ_a
        let rub = weight * factor * V::splat(0.5) * viscosity_a * dot(&r, &slip) / (distance_squared + singularity);
        accumulate(&mut pressure_sum, -along, &r);
        accumulate(&mut viscous_sum, rub, &r);
    }
    Sums { pressure: reduce_vector(&pressure_sum), viscous: reduce_vector(&viscous_sum) }
}

/// v_aw = β v_a, β = min(β_max, 1 + d_w/d_a), (18)–(20), relative to the wall.
#[inline(always)]
fn wall_difference<V: Lanes, const D: usize>(
    particles: &Particles<D>,
    w: &LaneIndices,
    r: &[V; D],
    velocity_a: &[V; D],
    smoothing_length: f64,
) -> [V; D] {
    let normal = gather_vectors::<V, D>(&particles.wall_normal, w);
    let wall_velocity = gather_vectors::<V, D>(&particles.wall_velocity, w);
    let depth: V = gather(&particles.wall_depth, w);
    let distance = (dot(&normal, r) - depth).max(V::splat(1e-6 * smoothing_length));
    let factor = (V::splat(1.0) + depth / distance).min(V::splat(MORRIS_LIMIT));
    scaled(factor, &difference(velocity_a, &wall_velocity))
}

/// tr(Γ⁻¹)/d of (14) and the second term of (13): [∇(μv) − v∇μ + μ∇v]·Σ V ∇W.
#[inline(always)]
fn schwaiger<V: Lanes, const D: usize>(
    constants: &Pairwise<'_, D>,
    particles: &Particles<D>,
    a: usize,
) -> (f64, Vector<D>) {
    let total = particles.position.len();
    let zero = V::splat(0.0);
    let smoothing_length = constants.kernel.smoothing_length();
    let place = splat_vector::<V, D>(&particles.position[a]);
    let velocity_a = splat_vector::<V, D>(&particles.velocity[a]);
    let viscosity_a = V::splat(particles.viscosity[a]);
    let mut deficit = [zero; D];
    // with (9), ∇(μv) − v_a∇μ = L Σ V μ_b (v_b − v_a) ∇W, and μ_a∇v likewise: one sum with (μ_b + μ_a)
    let mut gradient = [[zero; D]; D];
    let row = constants.list.row(a);
    for chunk in row.flow {
        let b = LaneIndices::new(chunk, total);
        let record = particles.momentum_records.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let volume = records::scalar(&record, 2 * D);
        let viscosity = records::scalar(&record, 2 * D + 3);
        let r = difference(&place, &position);
        let slip = difference(&velocity_a, &velocity);
        let weight = volume * constants.kernel.gradient_factor(dot(&r, &r));
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (viscosity + viscosity_a), &slip, &r);
    }
    for chunk in row.wall {
        let w = LaneIndices::new(chunk, total);
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let volume: V = gather(&particles.volume, &w);
        let r = difference(&place, &position);
        let weight = volume * constants.kernel.gradient_factor(dot(&r, &r));
        let slip = wall_difference::<V, D>(particles, &w, &r, &velocity_a, smoothing_length);
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (viscosity_a + viscosity_a), &slip, &r);
    }
    let correction = particles.correction[a];
    let gradient = reduce_tensor(&gradient) * correction;
    let deficit = reduce_vector(&deficit);
    // Γ of (14) is the moment matrix, whose blended inverse is the gradient correction
    (correction.trace() / D as f64, gradient * deficit)
}
