//! The momentum equation with one divergence operator for the whole stress σ = s − pI.
//!
//! ρ_a a_a = Σ V_b F (σ_a E_a + σ_b E_b) r_ab, the same weight for stress and pressure, with E_w = E_a and
//! σ_w = s_w − p_w I for a wall partner. The paper takes (10) for the pressure and (11) for the viscous part: two
//! operators whose errors do not cancel (model notes: 10 % in Bagnold's profile against 0.4 %).
//! Artificial viscosity (15) and hourglass control ride in the same loop.

use super::{artificial_viscosity, hourglass};
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate, difference, dot, product, reduce_vector, scaled, splat_tensor, splat_vector, sum_of,
};
use crate::lanes::{InstructionSet, LaneIndices, LanePass, Lanes, gather, gather_tensors, gather_vectors};
use crate::neighbours::VerletList;
use crate::numerics::ViscositySwitch;
use crate::particles::Particles;
use crate::records::{self, Records};
use crate::vector::Vector;
use rayon::prelude::*;

/// The constants of the pass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Momentum<'a, const D: usize> {
    pub(crate) kernel: Kernel<D>,
    pub(crate) list: &'a VerletList,
    pub(crate) instruction_set: InstructionSet,
    pub(crate) gravity: Vector<D>,
    pub(crate) reference_density: f64,
    pub(crate) sound_speed: f64,
    pub(crate) artificial_viscosity: f64,
    pub(crate) viscosity_switch: ViscositySwitch,
    pub(crate) hourglass: f64,
}

/// Values of a neighbour's record: position, velocity, volume, density, √(p/ρ0), α, flux, velocity gradient.
pub(crate) const fn values(dimension: usize) -> usize {
    2 * dimension + 4 + 2 * dimension * dimension
}

impl<const D: usize> Momentum<'_, D> {
    /// Accelerations `[m/s²]` of the flow particles.
    pub(crate) fn run(&self, particles: &mut Particles<D>) {
        const BLOCK: usize = crate::neighbours::BLOCK;
        let mut records = std::mem::replace(&mut particles.momentum_records, Records::new(0));
        let shared = &*particles;
        let inverse_density = 1.0 / self.reference_density;
        records.fill(particles.position.len(), |index, record| {
            record.vector(&shared.position[index]);
            record.vector(&shared.velocity[index]);
            record.scalar(shared.volume[index]);
            record.scalar(shared.density[index]);
            record.scalar((shared.pressure[index].max(0.0) * inverse_density).sqrt());
            record.scalar(shared.artificial_viscosity[index]);
            record.tensor(&shared.flux[index]);
            record.tensor(&shared.velocity_gradient[index]);
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
    constants: &'a Momentum<'a, D>,
    particles: &'a Particles<D>,
    first: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, out } = self;
        let total = particles.position.len();
        let zero = V::splat(0.0);
        let smoothing_length = constants.kernel.smoothing_length();
        let singularity = V::splat(1e-4 * smoothing_length * smoothing_length);
        let speed = smoothing_length * constants.sound_speed;
        let hourglass_strength = constants.hourglass * smoothing_length;
        let inverse_density = 1.0 / constants.reference_density;
        for (offset, out) in out.iter_mut().enumerate() {
            let a = first + offset;
            let place = splat_vector::<V, D>(&particles.position[a]);
            let velocity_a = splat_vector::<V, D>(&particles.velocity[a]);
            let gradient_a = splat_tensor::<V, D>(&particles.velocity_gradient[a]);
            let flux_a = splat_tensor::<V, D>(&particles.flux[a]);
            let density_a = V::splat(particles.density[a]);
            let pressure_speed_a = V::splat((particles.pressure[a].max(0.0) * inverse_density).sqrt());
            let alpha_a = V::splat(particles.artificial_viscosity[a]);
            let mut divergence = [zero; D];
            let mut damping = [zero; D];
            let row = constants.list.row(a);
            let weights = &particles.pair_weights[a * constants.list.stride()..];
            let (flow_weights, wall_weights) = weights.split_at(row.flow.len());
            for (chunk, weight) in row.flow.iter().zip(flow_weights) {
                let b = LaneIndices::new(chunk, total);
                let record = particles.momentum_records.load::<V>(const { values(D).div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let velocity = records::vector::<V, D>(&record, D);
                let density = records::scalar(&record, 2 * D + 1);
                let pressure_speed = records::scalar(&record, 2 * D + 2);
                let flux = records::tensor::<V, D>(&record, 2 * D + 4);
                let gradient = records::tensor::<V, D>(&record, 2 * D + 4 + D * D);
                let r = difference(&place, &position);
                let slip = difference(&velocity_a, &velocity);
                let distance_squared = dot(&r, &r);
                let weight = V::load(weight);
                let regular = distance_squared + singularity;
                // one division serves 1/(ρ̄ r²) of (15) and 2/(ρ_a + ρ_b) of the hourglass control
                let inverse = V::splat(2.0) / ((density_a + density) * regular);
                let alpha = match constants.viscosity_switch {
                    ViscositySwitch::Constant => V::splat(constants.artificial_viscosity * speed),
                    ViscositySwitch::MorrisMonaghan => {
                        let alpha = records::scalar(&record, 2 * D + 3);
                        (alpha + alpha_a) * V::splat(0.5 * speed)
                    }
                };
                let approach = dot(&r, &slip);
                let push = artificial_viscosity::pair_factor(alpha, approach, inverse);
                let drag = hourglass::twice_viscosity(hourglass_strength, pressure_speed_a + pressure_speed)
                    * (inverse * regular);
                let unexplained = hourglass::unexplained(&slip, &gradient_a, &gradient, &r);
                let mass_weight = weight * density;
                accumulate(&mut divergence, weight, &traction(&flux_a, &flux, &r));
                accumulate(&mut damping, mass_weight * push, &r);
                accumulate(&mut damping, mass_weight * drag, &unexplained);
            }
            let correction_a = splat_tensor::<V, D>(&particles.force_correction[a]);
            for (chunk, weight) in row.wall.iter().zip(wall_weights) {
                let w = LaneIndices::new(chunk, total);
                let position = gather_vectors::<V, D>(&particles.position, &w);
                let stress = gather_tensors::<V, D>(&particles.flux, &w);
                let pressure: V = gather(&particles.pressure, &w);
                let normal = gather_vectors::<V, D>(&particles.wall_normal, &w);
                let depth: V = gather(&particles.wall_depth, &w);
                let wall_velocity = gather_vectors::<V, D>(&particles.wall_velocity, &w);
                let r = difference(&place, &position);
                let weight = V::load(weight);
                let corrected = product(&correction_a, &r);
                // β = 1 + d_w/d_a as in (20); the distance of a to the surface is n·r − d_w
                let distance = (dot(&normal, &r) - depth).max(V::splat(1e-6 * smoothing_length));
                let factor = (V::splat(1.0) + depth / distance).min(V::splat(hourglass::WALL_FACTOR_LIMIT));
                let pressure_speed = (pressure * V::splat(inverse_density)).sqrt();
                let drag = hourglass::twice_viscosity::<V>(hourglass_strength, pressure_speed_a + pressure_speed);
                let traction = sum_of(&product(&flux_a, &r), &product(&stress, &corrected));
                accumulate(&mut divergence, weight, &traction);
                let slip = scaled(factor, &difference(&velocity_a, &wall_velocity));
                let unexplained = difference(&slip, &product(&gradient_a, &r));
                accumulate(&mut damping, weight * drag, &unexplained);
            }
            let specific_volume = 1.0 / particles.density[a];
            *out = reduce_vector(&divergence) * specific_volume + reduce_vector(&damping) + constants.gravity;
        }
    }
}

/// (σ_a E_a + σ_b E_b) r lane by lane.
#[inline(always)]
fn traction<V: Lanes, const D: usize>(flux_a: &[[V; D]; D], flux_b: &[[V; D]; D], r: &[V; D]) -> [V; D] {
    let mut lanes = *r;
    for i in 0..D {
        lanes[i] = dot(&sum_of(&flux_a[i], &flux_b[i]), r);
    }
    lanes
}
