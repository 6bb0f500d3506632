//! The paper's momentum equation: pressure (10), Cleary's viscosity (11), Schwaiger's correction (13)(14).
//!
//! Kept so that a report can show what it does. The continuum limit of (11) carries a bulk term η∇·v, so nearly
//! rigid material cannot decompress; use the single divergence for anything with a yield.

use super::artificial_viscosity;
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate, accumulate_outer, difference, dot, load_tensor, matrix_product, product, scaled, store_vector,
    zero_tensor, zero_vector,
};
use crate::lanes::{InstructionSet, LANES, LaneIndices, LanePass, Lanes, gather, gather_vectors};
use crate::vector::Vector;
use crate::weakly_compressible::neighbours::{Group, VerletList};
use crate::weakly_compressible::numerics::{MomentumOperator, ViscositySwitch};
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::records::{self, Records};
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

/// Values of a neighbour's record: position, velocity, volume, density, p/ρ², viscosity.
const fn values(dimension: usize) -> usize {
    2 * dimension + 4
}

impl<const D: usize> Pairwise<'_, D> {
    /// Accelerations `[m/s²]` of the flow particles. What walls and mirrors have of it is not kept: (13) is not a sum
    /// over pairs, so these operators have no momentum balance to close.
    pub(crate) fn run(&self, particles: &mut Particles<D>) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
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
        });
        particles.momentum_records = records;
        let mut acceleration = std::mem::take(&mut particles.acceleration);
        let mut pair_weights = std::mem::take(&mut particles.pair_weights);
        let region = self.list.region();
        pair_weights.resize(acceleration.len().div_ceil(BLOCK) * region, [0.0; LANES]);
        let shared = &*particles;
        (acceleration.par_chunks_mut(BLOCK), pair_weights.par_chunks_mut(region))
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (out, pair_weights))| {
                self.instruction_set.run(Pass { constants: self, particles: shared, block, out, pair_weights });
            });
        particles.acceleration = acceleration;
        particles.pair_weights = pair_weights;
    }
}

struct Pass<'a, const D: usize> {
    constants: &'a Pairwise<'a, D>,
    particles: &'a Particles<D>,
    block: usize,
    out: &'a mut [Vector<D>],
    pair_weights: &'a mut [[f64; LANES]],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let Self { constants, particles, block, out, pair_weights } = self;
        let region_start = block * constants.list.region();
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = constants.list.group(block * (BLOCK / LANES) + offset);
            let weights = &mut pair_weights[group.first_pair - region_start..];
            let mut sums = plain_sums::<V, D>(constants, particles, &group, weights);
            if constants.momentum_operator == MomentumOperator::PairwiseCorrected {
                let first = block * BLOCK + offset * LANES;
                // Γ of (14) is the moment matrix, whose blended inverse is the gradient correction
                let correction = load_tensor::<V, D>(&particles.correction[first..first + out.len()]);
                let excess = schwaiger::<V, D>(constants, particles, &group, weights, &correction);
                let mut scale = correction[0][0];
                for i in 1..D {
                    scale = scale + correction[i][i];
                }
                let scale = scale * V::splat(1.0 / D as f64);
                sums.viscous = scaled(scale, &difference(&sums.viscous, &excess));
            }
            let mut acceleration = sums.pressure;
            for i in 0..D {
                let viscous = sums.viscous[i] / sums.density;
                acceleration[i] = sums.pressure[i] + viscous + V::splat(constants.gravity[i]);
            }
            store_vector(&acceleration, out);
        }
    }
}

/// Pair sums of eight particles.
struct Sums<V, const D: usize> {
    /// Pressure and artificial viscosity `[m/s²]`.
    pressure: [V; D],
    /// (11) `[N/m³]`.
    viscous: [V; D],
    /// Their own densities `[kg/m³]`.
    density: V,
}

#[inline(always)]
fn plain_sums<V: Lanes, const D: usize>(
    constants: &Pairwise<'_, D>,
    particles: &Particles<D>,
    group: &Group<'_>,
    weights: &mut [[f64; LANES]],
) -> Sums<V, D> {
    let smoothing_length = constants.kernel.smoothing_length();
    // δ = 0.01 h in (11); 2(d + 2) is 8 in the plane
    let singularity = V::splat(1e-4 * smoothing_length * smoothing_length);
    let factor = V::splat(2.0 * 2.0 * (D as f64 + 2.0));
    let speed = smoothing_length * constants.sound_speed;
    let all = &particles.momentum_records;
    let own = all.load::<V>(const { values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let density_a = records::scalar(&own, 2 * D + 1);
    let specific_a = records::scalar(&own, 2 * D + 2);
    let viscosity_a = records::scalar(&own, 2 * D + 3);
    let alpha_a: V = gather(&particles.artificial_viscosity, &group.own);
    let (mut pressure_sum, mut viscous_sum) = (zero_vector::<V, D>(), zero_vector::<V, D>());
    let (flow_weights, wall_weights) = weights.split_at_mut(group.flow.len());
    for (b, stored) in group.flow.zip(flow_weights) {
        let record = all.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let volume = records::scalar(&record, 2 * D);
        let density = records::scalar(&record, 2 * D + 1);
        let specific = records::scalar(&record, 2 * D + 2);
        let viscosity = records::scalar(&record, 2 * D + 3);
        let r = difference(&place, &position);
        let slip = difference(&velocity_a, &velocity);
        let distance_squared = dot(&r, &r);
        let weight = constants.kernel.gradient_weight(distance_squared, volume);
        *stored = weight.to_array();
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
                let alpha: V = gather(&particles.artificial_viscosity, &b);
                (alpha + alpha_a) * V::splat(0.5 * speed)
            }
        };
        let push = artificial_viscosity::pair_factor(alpha, approach, inverse_regular_density);
        let along = weight * density * (push - (specific_a + specific));
        let rub = weight * factor * harmonic * approach;
        accumulate(&mut pressure_sum, along, &r);
        accumulate(&mut viscous_sum, rub, &r);
    }
    for (w, stored) in group.wall.zip(wall_weights) {
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let volume: V = gather(&particles.volume, &w);
        let pressure: V = gather(&particles.pressure, &w);
        let r = difference(&place, &position);
        let distance_squared = dot(&r, &r);
        let weight = constants.kernel.gradient_weight(distance_squared, volume);
        *stored = weight.to_array();
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
    Sums { pressure: pressure_sum, viscous: viscous_sum, density: density_a }
}

/// v_aw = β v_a, β = min(β_max, 1 + d_w/d_a), (18)–(20), relative to the wall.
#[inline(always)]
fn wall_difference<V: Lanes, const D: usize>(
    particles: &Particles<D>,
    w: &LaneIndices<'_>,
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

/// The second term of (13), [∇(μv) − v∇μ + μ∇v]·Σ V ∇W, with the correction L `[-]` of the gradients.
#[inline(always)]
fn schwaiger<V: Lanes, const D: usize>(
    constants: &Pairwise<'_, D>,
    particles: &Particles<D>,
    group: &Group<'_>,
    weights: &[[f64; LANES]],
    correction: &[[V; D]; D],
) -> [V; D] {
    let smoothing_length = constants.kernel.smoothing_length();
    let all = &particles.momentum_records;
    let own = all.load::<V>(const { values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let viscosity_a = records::scalar(&own, 2 * D + 3);
    let mut deficit = zero_vector::<V, D>();
    // with (9), ∇(μv) − v_a∇μ = L Σ V μ_b (v_b − v_a) ∇W, and μ_a∇v likewise: one sum with (μ_b + μ_a)
    let mut gradient = zero_tensor::<V, D>();
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
    for (b, weight) in group.flow.zip(flow_weights) {
        let record = all.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let viscosity = records::scalar(&record, 2 * D + 3);
        let r = difference(&place, &position);
        let slip = difference(&velocity_a, &velocity);
        let weight = V::load(weight);
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (viscosity + viscosity_a), &slip, &r);
    }
    for (w, weight) in group.wall.zip(wall_weights) {
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let r = difference(&place, &position);
        let weight = V::load(weight);
        let slip = wall_difference::<V, D>(particles, &w, &r, &velocity_a, smoothing_length);
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (viscosity_a + viscosity_a), &slip, &r);
    }
    product(&matrix_product(&gradient, correction), &deficit)
}
