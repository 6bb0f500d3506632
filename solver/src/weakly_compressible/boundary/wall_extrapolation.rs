//! What the wall particles carry: pressure, stress and velocity extrapolated from the flow.
//!
//! Recipe step 3 (default) or Adami's pressure (22) with the density (23) (the paper). Both average over the flow
//! neighbours f of a wall particle w with the weights V_f W_wf. A wall far from any flow carries nothing.

use super::WallTreatment;
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate_outer, difference, dot, matrix_product, splat_vector, store_vector, zero_tensor, zero_vector,
};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes, Real, gather, gather_tensors, gather_vectors};
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::neighbours::VerletList;
use crate::weakly_compressible::particles::Particles;
use rayon::prelude::*;

/// Below this share of a full neighbourhood Σ V W a wall particle counts as dry `[-]`.
const DRY: f64 = 1e-12;
/// Nearest distance at which the velocity fit weighs a flow particle, in spacings `[-]`.
const NEAREST: f64 = 0.25;
const BLOCK: usize = 64;

/// The constants of the extrapolation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallExtrapolation<'a, const D: usize> {
    pub(crate) kernel: Kernel<D>,
    pub(crate) list: &'a VerletList,
    pub(crate) instruction_set: InstructionSet,
    pub(crate) gravity: Vector<D>,
    pub(crate) spacing: f64,
    pub(crate) reference_density: f64,
    pub(crate) treatment: WallTreatment,
}

impl<const D: usize> WallExtrapolation<'_, D> {
    /// Pressure `[Pa]`, deviatoric stress `[Pa]` and momentum flux tensor of every wall particle.
    pub(crate) fn stress(&self, particles: &mut Particles<D>) {
        let (first, count) = (particles.flow_count(), particles.wall_count());
        // the flow's values are read while the walls' are made, so these go to a buffer of their own first
        let mut result = std::mem::take(&mut particles.wall_stress);
        result.resize(count, (0.0, Tensor::zeros()));
        let shared = &*particles;
        result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
            let first_group = self.list.flow_groups() + block * (BLOCK / LANES);
            self.instruction_set.run(StressPass { constants: self, particles: shared, first_group, out });
        });
        for (offset, (pressure, stress)) in result.iter().enumerate() {
            let wall = first + offset;
            particles.pressure[wall] = *pressure;
            particles.stress[wall] = *stress;
            particles.flux[wall] = stress - Tensor::identity() * *pressure;
        }
        particles.wall_stress = result;
    }

    /// Velocity `[m/s]` of every wall particle: −d_w Σ V W v_f d_f / Σ V W d_f², the line through zero at the
    /// surface that fits the flow best, relative to the wall's own velocity. A smooth wall has the flow's mean velocity
    /// along its surface.
    pub(crate) fn velocity(&self, particles: &mut Particles<D>) {
        let (first, count) = (particles.flow_count(), particles.wall_count());
        let mut result = std::mem::take(&mut particles.wall_velocity_fit);
        result.resize(count, Vector::zeros());
        let shared = &*particles;
        result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
            let first_group = self.list.flow_groups() + block * (BLOCK / LANES);
            self.instruction_set.run(VelocityPass { constants: self, particles: shared, first_group, out });
        });
        particles.velocity[first..first + count].copy_from_slice(&result);
        particles.wall_velocity_fit = result;
    }
}

struct StressPass<'a, const D: usize> {
    constants: &'a WallExtrapolation<'a, D>,
    particles: &'a Particles<D>,
    first_group: usize,
    out: &'a mut [(f64, Tensor<D>)],
}

impl<const D: usize> LanePass for StressPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first_group, out } = self;
        let zero = V::splat(0.0);
        let weight_of_gravity = constants.reference_density * constants.gravity.norm() * constants.spacing;
        // a layer of half a spacing's weight carries the full hydrostatic increment, a weightless one none:
        // without this factor particles without pressure ride on a frictionless cushion
        let full_increment = V::splat((0.5 * weight_of_gravity).max(f64::MIN_POSITIVE));
        let smallest_pressure = V::splat((1e-3 * weight_of_gravity).max(f64::MIN_POSITIVE));
        let gravity = splat_vector::<V, D>(&constants.gravity);
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = constants.list.group(first_group + offset);
            let place = gather_vectors::<V, D>(&particles.position, &group.own);
            let normal = gather_vectors::<V, D>(&particles.wall_normal, &group.own);
            let gravity_along_normal = dot(&gravity, &normal);
            let (mut weights, mut pressures) = (zero, zero);
            let mut stresses = zero_tensor::<V, D>();
            for f in group.flow {
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let pressure: V = gather(&particles.pressure, &f);
                let density: V = gather(&particles.density, &f);
                let volume: V = gather(&particles.volume, &f);
                let r = difference(&place, &position);
                let weight = volume * constants.kernel.value(dot(&r, &r));
                weights = weights + weight;
                match constants.treatment {
                    WallTreatment::Extrapolated => {
                        let share = (pressure / full_increment).min(V::splat(1.0)).max(zero);
                        let increment = density * gravity_along_normal * dot(&r, &normal) * share;
                        let extrapolated = pressure + increment;
                        pressures = pressures + weight * extrapolated;
                        let stress = gather_tensors::<V, D>(&particles.stress, &f);
                        let ratio = weight * extrapolated / pressure.max(smallest_pressure);
                        for i in 0..D {
                            for j in 0..D {
                                stresses[i][j] = stresses[i][j] + ratio * stress[i][j];
                            }
                        }
                    }
                    // (22), with the sign of hydrostatic growth along gravity
                    WallTreatment::Paper => {
                        pressures = pressures + weight * (pressure + density * dot(&r, &gravity));
                    }
                }
            }
            // a smooth wall mirrors the stress: what it carries along its surface is that of the flow with the other sign
            let smoothness: V = gather(&particles.wall_smoothness, &group.own);
            let reflection = reflection(smoothness, &normal);
            let stresses = matrix_product(&matrix_product(&reflection, &stresses), &reflection);
            // a dry wall carries nothing
            let wet = V::splat(1.0).where_less(V::splat(DRY), weights) / weights.max(V::splat(DRY));
            let pressure = (wet * pressures).max(zero).to_array();
            for (lane, out) in out.iter_mut().enumerate() {
                out.0 = pressure[lane];
            }
            for i in 0..D {
                for j in 0..D {
                    let stress = (wet * stresses[i][j]).to_array();
                    for (lane, out) in out.iter_mut().enumerate() {
                        out.1[(i, j)] = stress[lane];
                    }
                }
            }
        }
    }
}

/// R = I − 2 k n nᵀ, which mirrors at the plane with the normal n for k = 1; for k = 0 it is the identity to the last
/// bit, and so R s R is s.
#[inline(always)]
fn reflection<V: Real, const D: usize>(k: V, normal: &[V; D]) -> [[V; D]; D] {
    let mut reflection = zero_tensor::<V, D>();
    for i in 0..D {
        reflection[i][i] = V::splat(1.0);
    }
    accumulate_outer(&mut reflection, V::splat(-2.0) * k, normal, normal);
    reflection
}

struct VelocityPass<'a, const D: usize> {
    constants: &'a WallExtrapolation<'a, D>,
    particles: &'a Particles<D>,
    first_group: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for VelocityPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first_group, out } = self;
        let nearest = V::splat(NEAREST * constants.spacing);
        let smallest = V::splat(DRY * constants.spacing * constants.spacing);
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = constants.list.group(first_group + offset);
            let place = gather_vectors::<V, D>(&particles.position, &group.own);
            let normal = gather_vectors::<V, D>(&particles.wall_normal, &group.own);
            let wall_velocity = gather_vectors::<V, D>(&particles.wall_velocity, &group.own);
            let depth: V = gather(&particles.wall_depth, &group.own);
            let smoothness: V = gather(&particles.wall_smoothness, &group.own);
            let (mut moment, mut weights) = (V::splat(0.0), V::splat(0.0));
            let (mut sums, mut means) = (zero_vector::<V, D>(), zero_vector::<V, D>());
            for f in group.flow {
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let velocity = gather_vectors::<V, D>(&particles.velocity, &f);
                let volume: V = gather(&particles.volume, &f);
                let r = difference(&position, &place);
                let distance = (dot(&r, &normal) - depth).max(nearest);
                let share = volume * constants.kernel.value(dot(&r, &r));
                let weight = share * distance;
                moment = moment + weight * distance;
                weights = weights + share;
                for axis in 0..D {
                    let slip = velocity[axis] - wall_velocity[axis];
                    sums[axis] = sums[axis] + weight * slip;
                    means[axis] = means[axis] + share * slip;
                }
            }
            // a dry wall moves as it is told
            let slope = (depth / moment.max(smallest)).where_less(smallest, moment);
            let wet = V::splat(1.0).where_less(V::splat(DRY), weights) / weights.max(V::splat(DRY));
            let mut sliding = means;
            for axis in 0..D {
                sliding[axis] = wet * means[axis] + slope * sums[axis];
            }
            let along_normal = dot(&sliding, &normal);
            let mut velocity = wall_velocity;
            for axis in 0..D {
                let slides = smoothness * (sliding[axis] - along_normal * normal[axis]);
                velocity[axis] = wall_velocity[axis] - slope * sums[axis] + slides;
            }
            store_vector(&velocity, out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRESS: [[f64; 3]; 3] = [[0.3, -1.7, 0.9], [-1.7, 2.1, 0.1], [0.9, 0.1, -2.4]];
    const NORMAL: [f64; 3] = [2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0];
    /// Across the normal.
    const ALONG: [f64; 3] = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];

    fn mirrored(smoothness: f64) -> [[f64; 3]; 3] {
        let reflection = reflection(smoothness, &NORMAL);
        matrix_product(&matrix_product(&reflection, &STRESS), &reflection)
    }

    #[test]
    fn a_smooth_wall_turns_the_traction_along_its_surface_around_and_nothing_else() {
        let traction = |stress: &[[f64; 3]; 3], direction: &[f64; 3]| -> f64 {
            (0..3).map(|i| direction[i] * (0..3).map(|j| stress[i][j] * NORMAL[j]).sum::<f64>()).sum()
        };
        let smooth = mirrored(1.0);
        assert!(traction(&STRESS, &ALONG).abs() > 0.1);
        assert!((traction(&smooth, &ALONG) + traction(&STRESS, &ALONG)).abs() < 1e-14);
        assert!((traction(&smooth, &NORMAL) - traction(&STRESS, &NORMAL)).abs() < 1e-14);
    }

    #[test]
    fn a_rough_wall_has_the_stress_of_the_flow_to_the_last_bit() {
        assert_eq!(mirrored(0.0).map(|row| row.map(f64::to_bits)), STRESS.map(|row| row.map(f64::to_bits)));
    }
}
