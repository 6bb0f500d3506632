//! What the wall particles carry: pressure, stress and velocity extrapolated from the flow.
//!
//! Recipe step 3 (default) or Adami's pressure (22) with the density (23) (the paper). Both average over the flow
//! neighbours f of a wall particle w with the weights V_f W_wf. A wall far from any flow carries nothing.

use super::WallTreatment;
use crate::kernel::Kernel;
use crate::lanes::{InstructionSet, LaneIndices, LanePass, Lanes, gather, gather_tensors, gather_vectors};
use crate::neighbours::VerletList;
use crate::particles::Particles;
use crate::vector::{Tensor, Vector};
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
        let total = particles.position.len();
        // the flow's values are read while the walls' are made, so these go to a buffer of their own first
        let mut result = std::mem::take(&mut particles.wall_stress);
        result.resize(count, (0.0, Tensor::zeros()));
        let shared = &*particles;
        result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
            self.instruction_set.run(StressPass {
                constants: self,
                particles: shared,
                first: first + block * BLOCK,
                total,
                out,
            });
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
    /// surface that fits the flow best, relative to the wall's own velocity.
    pub(crate) fn velocity(&self, particles: &mut Particles<D>) {
        let (first, count) = (particles.flow_count(), particles.wall_count());
        let total = particles.position.len();
        let mut result = std::mem::take(&mut particles.wall_velocity_fit);
        result.resize(count, Vector::zeros());
        let shared = &*particles;
        result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
            self.instruction_set.run(VelocityPass {
                constants: self,
                particles: shared,
                first: first + block * BLOCK,
                total,
                out,
            });
        });
        particles.velocity[first..first + count].copy_from_slice(&result);
        particles.wall_velocity_fit = result;
    }
}

struct StressPass<'a, const D: usize> {
    constants: &'a WallExtrapolation<'a, D>,
    particles: &'a Particles<D>,
    first: usize,
    total: usize,
    out: &'a mut [(f64, Tensor<D>)],
}

impl<const D: usize> LanePass for StressPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, total, out } = self;
        let zero = V::splat(0.0);
        let weight_of_gravity = constants.reference_density * constants.gravity.norm() * constants.spacing;
        // a layer of half a spacing's weight carries the full hydrostatic increment, a weightless one none:
        // without this factor particles without pressure ride on a frictionless cushion
        let full_increment = V::splat((0.5 * weight_of_gravity).max(f64::MIN_POSITIVE));
        let smallest_pressure = V::splat((1e-3 * weight_of_gravity).max(f64::MIN_POSITIVE));
        for (offset, out) in out.iter_mut().enumerate() {
            let w = first + offset;
            let place = particles.position[w];
            let normal = particles.wall_normal[w];
            let gravity_along_normal = constants.gravity.dot(&normal);
            let (mut weights, mut pressures) = (zero, zero);
            let mut stresses = [[zero; D]; D];
            for chunk in constants.list.row(w).flow {
                let f = LaneIndices::new(chunk, total);
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let pressure: V = gather(&particles.pressure, &f);
                let density: V = gather(&particles.density, &f);
                let volume: V = gather(&particles.volume, &f);
                let (mut distance_squared, mut along_normal, mut along_gravity) = (zero, zero, zero);
                for axis in 0..D {
                    let r = V::splat(place[axis]) - position[axis];
                    distance_squared = distance_squared + r * r;
                    along_normal = along_normal + r * V::splat(normal[axis]);
                    along_gravity = along_gravity + r * V::splat(constants.gravity[axis]);
                }
                let weight = volume * constants.kernel.value(distance_squared);
                weights = weights + weight;
                match constants.treatment {
                    WallTreatment::Extrapolated => {
                        let share = (pressure / full_increment).min(V::splat(1.0)).max(zero);
                        let extrapolated = pressure + density * V::splat(gravity_along_normal) * along_normal * share;
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
                        pressures = pressures + weight * (pressure + density * along_gravity);
                    }
                }
            }
            let weight = weights.sum();
            *out = (0.0, Tensor::zeros());
            if weight > DRY {
                out.0 = (pressures.sum() / weight).max(0.0);
                for i in 0..D {
                    for j in 0..D {
                        out.1[(i, j)] = stresses[i][j].sum() / weight;
                    }
                }
            }
        }
    }
}

struct VelocityPass<'a, const D: usize> {
    constants: &'a WallExtrapolation<'a, D>,
    particles: &'a Particles<D>,
    first: usize,
    total: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for VelocityPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, total, out } = self;
        let zero = V::splat(0.0);
        let nearest = V::splat(NEAREST * constants.spacing);
        for (offset, out) in out.iter_mut().enumerate() {
            let w = first + offset;
            let place = particles.position[w];
            let normal = particles.wall_normal[w];
            let depth = particles.wall_depth[w];
            let wall_velocity = particles.wall_velocity[w];
            let mut moment = zero;
            let mut sums = [zero; D];
            for chunk in constants.list.row(w).flow {
                let f = LaneIndices::new(chunk, total);
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let velocity = gather_vectors::<V, D>(&particles.velocity, &f);
                let volume: V = gather(&particles.volume, &f);
                let (mut distance_squared, mut along_normal) = (zero, zero);
                for axis in 0..D {
                    let r = position[axis] - V::splat(place[axis]);
                    distance_squared = distance_squared + r * r;
                    along_normal = along_normal + r * V::splat(normal[axis]);
                }
                let distance = (along_normal - V::splat(depth)).max(nearest);
                let weight = volume * constants.kernel.value(distance_squared) * distance;
                moment = moment + weight * distance;
                for axis in 0..D {
                    sums[axis] = sums[axis] + weight * (velocity[axis] - V::splat(wall_velocity[axis]));
                }
            }
            let moment = moment.sum();
            *out = wall_velocity;
            if moment > DRY * constants.spacing * constants.spacing {
                for axis in 0..D {
                    out[axis] -= depth * sums[axis].sum() / moment;
                }
            }
        }
    }
}
