//! The momentum equation with one divergence operator for the whole stress σ = s − pI.
//!
//! ρ_a a_a = Σ V_b F (σ_a E_a + σ_b E_b) r_ab, the same weight for stress and pressure, with E_w = E_a and
//! σ_w = s_w − p_w I for a wall partner. The paper takes (10) for the pressure and (11) for the viscous part: two
//! operators whose errors do not cancel (model notes: 10 % in Bagnold's profile against 0.4 %).
//! Artificial viscosity (15) and hourglass control ride in the same loop.

use super::{artificial_viscosity, hourglass};
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate, difference, dot, load_tensor, product, scaled, store_vector, sum_of, zero_vector,
};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes, gather};
use crate::vector::Vector;
use crate::weakly_compressible::neighbours::VerletList;
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::records::{self, Records};
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

/// Values of a neighbour's record: position, velocity, density, √(p/ρ0), α, flux, velocity gradient. A wall particle
/// has its depth in the place of the density, its smoothness in that of α, the velocity of the wall itself, and its
/// normal in the first places of the velocity gradient.
pub(crate) const fn values(dimension: usize) -> usize {
    2 * dimension + 3 + 2 * dimension * dimension
}

impl<const D: usize> Momentum<'_, D> {
    /// Accelerations `[m/s²]` of the flow particles, and what walls and mirrors have of it.
    pub(crate) fn run(&self, particles: &mut Particles<D>) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let mut records = std::mem::replace(&mut particles.momentum_records, Records::new(0));
        let shared = &*particles;
        let inverse_density = 1.0 / self.reference_density;
        records.fill(particles.position.len(), |index, record| {
            let wall = shared.wall_depth[index] > 0.0;
            record.vector(&shared.position[index]);
            record.vector(if wall { &shared.wall_velocity[index] } else { &shared.velocity[index] });
            record.scalar(if wall { shared.wall_depth[index] } else { shared.density[index] });
            record.scalar((shared.pressure[index].max(0.0) * inverse_density).sqrt());
            record.scalar(if wall { shared.wall_smoothness[index] } else { shared.artificial_viscosity[index] });
            record.tensor(&shared.flux[index]);
            if wall {
                record.vector(&shared.wall_normal[index]);
            } else {
                record.tensor(&shared.velocity_gradient[index]);
            }
        });
        particles.momentum_records = records;
        let mut acceleration = std::mem::take(&mut particles.acceleration);
        let mut support = std::mem::take(&mut particles.support);
        let shared = &*particles;
        (acceleration.par_chunks_mut(BLOCK), support.par_chunks_mut(BLOCK))
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (out, support))| {
                self.instruction_set.run(Pass { constants: self, particles: shared, block, out, support });
            });
        particles.acceleration = acceleration;
        particles.support = support;
    }
}

struct Pass<'a, const D: usize> {
    constants: &'a Momentum<'a, D>,
    particles: &'a Particles<D>,
    block: usize,
    out: &'a mut [Vector<D>],
    support: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let Self { constants, particles, block, out, support } = self;
        let all = &particles.momentum_records;
        let smoothing_length = constants.kernel.smoothing_length();
        let singularity = V::splat(1e-4 * smoothing_length * smoothing_length);
        let speed = smoothing_length * constants.sound_speed;
        let hourglass_strength = constants.hourglass * smoothing_length;
        for (offset, (out, support)) in out.chunks_mut(LANES).zip(support.chunks_mut(LANES)).enumerate() {
            let group = constants.list.group(block * (BLOCK / LANES) + offset);
            let own = all.load::<V>(const { values(D).div_ceil(4) }, &group.own);
            let place = records::vector::<V, D>(&own, 0);
            let velocity_a = records::vector::<V, D>(&own, D);
            let density_a = records::scalar(&own, 2 * D);
            let pressure_speed_a = records::scalar(&own, 2 * D + 1);
            let alpha_a = records::scalar(&own, 2 * D + 2);
            let flux_a = records::tensor::<V, D>(&own, 2 * D + 3);
            let gradient_a = records::tensor::<V, D>(&own, 2 * D + 3 + D * D);
            let mut divergence = zero_vector::<V, D>();
            let mut damping = zero_vector::<V, D>();
            let (mut support_divergence, mut support_damping) = (divergence, damping);
            let weights = &particles.pair_weights[group.first_pair..];
            let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
            for (b, weight) in group.flow.zip(flow_weights) {
                let record = all.load::<V>(const { values(D).div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let velocity = records::vector::<V, D>(&record, D);
                let density = records::scalar(&record, 2 * D);
                let pressure_speed = records::scalar(&record, 2 * D + 1);
                let flux = records::tensor::<V, D>(&record, 2 * D + 3);
                let gradient = records::tensor::<V, D>(&record, 2 * D + 3 + D * D);
                let r = difference(&place, &position);
                let slip = difference(&velocity_a, &velocity);
                let weight = V::load(weight);
                let regular = dot(&r, &r) + singularity;
                // one division serves 1/(ρ̄ r²) of (15) and 2/(ρ_a + ρ_b) of the hourglass control
                let inverse = V::splat(2.0) / ((density_a + density) * regular);
                let alpha = match constants.viscosity_switch {
                    ViscositySwitch::Constant => V::splat(constants.artificial_viscosity * speed),
                    ViscositySwitch::MorrisMonaghan => {
                        let alpha = records::scalar(&record, 2 * D + 2);
                        (alpha + alpha_a) * V::splat(0.5 * speed)
                    }
                };
                let approach = dot(&r, &slip);
                let push = artificial_viscosity::pair_factor(alpha, approach, inverse);
                let drag = hourglass::twice_viscosity(hourglass_strength, pressure_speed_a + pressure_speed)
                    * (inverse * regular);
                let unexplained = hourglass::unexplained(&slip, &gradient_a, &gradient, &r);
                let mass_weight = weight * density;
                let traction = traction(&flux_a, &flux, &r);
                accumulate(&mut divergence, weight, &traction);
                accumulate(&mut damping, mass_weight * push, &r);
                accumulate(&mut damping, mass_weight * drag, &unexplained);
                if group.has_images {
                    let mirrored: V = gather(&particles.mirrored, &b);
                    accumulate(&mut support_divergence, mirrored * weight, &traction);
                    accumulate(&mut support_damping, mirrored * (mass_weight * push), &r);
                    accumulate(&mut support_damping, mirrored * (mass_weight * drag), &unexplained);
                }
            }
            let first = block * BLOCK + offset * LANES;
            let correction_a = load_tensor::<V, D>(&particles.force_correction[first..first + out.len()]);
            for (w, weight) in group.wall.zip(wall_weights) {
                let record = all.load::<V>(const { values(D).div_ceil(4) }, &w);
                let position = records::vector::<V, D>(&record, 0);
                let wall_velocity = records::vector::<V, D>(&record, D);
                let depth = records::scalar(&record, 2 * D);
                let pressure_speed = records::scalar(&record, 2 * D + 1);
                let smoothness = records::scalar(&record, 2 * D + 2);
                let stress = records::tensor::<V, D>(&record, 2 * D + 3);
                let normal = records::vector::<V, D>(&record, 2 * D + 3 + D * D);
                let r = difference(&place, &position);
                let weight = V::load(weight);
                let corrected = product(&correction_a, &r);
                // β = 1 + d_w/d_a as in (20); the distance of a to the surface is n·r − d_w
                let distance = (dot(&normal, &r) - depth).max(V::splat(1e-6 * smoothing_length));
                let factor = (V::splat(1.0) + depth / distance).min(V::splat(hourglass::WALL_FACTOR_LIMIT));
                let drag = hourglass::twice_viscosity::<V>(hourglass_strength, pressure_speed_a + pressure_speed);
                let traction = sum_of(&product(&flux_a, &r), &product(&stress, &corrected));
                accumulate(&mut divergence, weight, &traction);
                let slip = scaled(factor, &difference(&velocity_a, &wall_velocity));
                let mut unexplained = difference(&slip, &product(&gradient_a, &r));
                // a smooth wall resists along its normal only
                let along_normal = dot(&unexplained, &normal);
                for i in 0..D {
                    unexplained[i] = unexplained[i] + smoothness * (along_normal * normal[i] - unexplained[i]);
                }
                accumulate(&mut damping, weight * drag, &unexplained);
                accumulate(&mut support_divergence, weight, &traction);
                accumulate(&mut support_damping, weight * drag, &unexplained);
            }
            let (mut acceleration, mut supported) = (damping, damping);
            for i in 0..D {
                acceleration[i] = divergence[i] / density_a + damping[i] + V::splat(constants.gravity[i]);
                supported[i] = support_divergence[i] / density_a + support_damping[i];
            }
            store_vector(&acceleration, out);
            store_vector(&supported, support);
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
