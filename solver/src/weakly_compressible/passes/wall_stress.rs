//! Pressure and stress of the wall particles, extrapolated from the flow: averages over the flow neighbours f of a wall
//! particle w with the weights V_f W_wf. A wall far from any flow carries nothing.

use crate::lanes::algebra::{difference, dot, product, splat_vector, zero_tensor};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_tensors, gather_vectors};
use crate::parallel::prelude::*;
use crate::vector::Tensor;
use crate::weakly_compressible::WallTreatment;
use crate::weakly_compressible::terms::wall_extrapolation as terms;
use crate::weakly_compressible::{Model, NeighbourGroup, PairData, Particles};

/// Wall particles per block of the parallel loops over walls.
pub(super) const BLOCK: usize = 64;

/// Pressure `[Pa]`, deviatoric stress `[Pa]` and corrected stress of every wall particle. At a wall that turns, the flow is pulled by gravity less
/// the acceleration of the wall, as in (22): its spin times its velocity.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let (first, count) = (particles.flow_count(), particles.wall_count());
    // the flow's values are read while the walls' are made, so these go to a buffer of their own first
    let result = &mut pairs.wall_stress;
    result.resize(count, (0.0, Tensor::zeros()));
    let shared = &*particles;
    result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
        let first_group = model.list.flow_groups() + block * (BLOCK / LANES);
        model.instruction_set.run(Pass { model, particles: shared, first_group, out });
    });
    for (offset, (pressure, stress)) in result.iter().enumerate() {
        let wall = first + offset;
        particles.pressure[wall] = *pressure;
        particles.stress[wall] = *stress;
        particles.corrected_stress[wall] = stress - Tensor::identity() * *pressure;
    }
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    first_group: usize,
    out: &'a mut [(f64, Tensor<D>)],
}

/// Weighted sums over the flow neighbours of eight wall particles.
struct WallSums<V, const D: usize> {
    /// Σ V W `[-]`.
    weight: V,
    pressure: V,
    stress: [[V; D]; D],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, first_group, out } = self;
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = model.list.group(first_group + offset);
            let places = group.own.places_from(particles.flow_count());
            let places = places.indices();
            let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
            let spin = gather_tensors::<V, D>(&particles.walls.spin, &places);
            let velocity = gather_vectors::<V, D>(&particles.walls.velocity, &places);
            let pull = difference(&splat_vector::<V, D>(&model.gravity), &product(&spin, &velocity));
            let sums = sums::<V, D>(model, particles, &group, (&normal, &pull));
            let smoothness: V = gather(&particles.walls.smoothness, &places);
            let stresses = terms::mirrored(&sums.stress, smoothness, &normal);
            let wet = terms::wet_inverse(sums.weight);
            let pressure = (wet * sums.pressure).max(V::splat(0.0)).to_array();
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

#[inline(always)]
fn sums<V: Lanes, const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    group: &NeighbourGroup<'_>,
    (normal, pull): (&[V; D], &[V; D]),
) -> WallSums<V, D> {
    let weight_of_gravity = model.equation_of_state.reference_density * model.gravity.norm() * model.spacing;
    let full_increment = V::splat((0.5 * weight_of_gravity).max(f64::MIN_POSITIVE));
    let smallest_pressure = V::splat((1e-3 * weight_of_gravity).max(f64::MIN_POSITIVE));
    let grows = model.rheology.is_solid();
    let pull_along_normal = dot(pull, normal);
    let place = gather_vectors::<V, D>(&particles.position, &group.own);
    let mut sums = WallSums { weight: V::splat(0.0), pressure: V::splat(0.0), stress: zero_tensor::<V, D>() };
    for f in group.flow {
        let position = gather_vectors::<V, D>(&particles.position, &f);
        let pressure: V = gather(&particles.pressure, &f);
        let density: V = gather(&particles.density, &f);
        let volume: V = gather(&particles.volume, &f);
        let r = difference(&place, &position);
        let weight = volume * model.kernel.value(dot(&r, &r));
        sums.weight = sums.weight + weight;
        match model.numerics.wall_treatment {
            WallTreatment::Extrapolated => {
                let distance = dot(&r, normal);
                let growth = terms::growth_along_normal(pressure, density, pull_along_normal, distance, full_increment);
                let extrapolated = pressure + growth;
                sums.pressure = sums.pressure + weight * extrapolated;
                let stress = gather_tensors::<V, D>(&particles.stress, &f);
                // friction grows with the pressure, but not under tension; what a liquid has across a smooth wall does not
                let growth = if grows { extrapolated / pressure.max(smallest_pressure) } else { V::splat(1.0) };
                let ratio = weight * V::splat(1.0).if_less(pressure, V::splat(0.0), growth);
                for i in 0..D {
                    for j in 0..D {
                        sums.stress[i][j] = sums.stress[i][j] + ratio * stress[i][j];
                    }
                }
            }
            WallTreatment::Paper => {
                let growth = terms::growth_along_gravity(density, &r, pull);
                sums.pressure = sums.pressure + weight * (pressure + growth);
            }
        }
    }
    sums
}
