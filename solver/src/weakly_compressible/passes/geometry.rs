//! One pass over the neighbours for all that depends on positions and pressure: the moment matrix with its
//! corrections, the corrected pressure gradient, and the stress as the divergence takes it.

use super::layout;
use super::pair_weights::{Weighing, Weights, flush_tensor, flush_vector};
use super::precision::Precision;
use super::records::{self, Records};
use crate::lanes::algebra::{
    accumulate, deviatoric_rate, load, load_tensor, matrix_product, product, scaled_tensor, store, store_tensor,
    store_vector, zero_tensor, zero_vector,
};
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, Real, store_symmetric};
use crate::parallel::prelude::*;
use crate::vector::{Tensor, Vector, shear_rate};
use crate::weakly_compressible::terms::kernel_correction::{corrections, corrections_and_eigenvalue};
use crate::weakly_compressible::terms::{common_motion, field_diffusion};
use crate::weakly_compressible::{BLOCK, Model, NeighbourGroup, PairData, Particles};
use std::ops::Range;

struct Output<'a, const D: usize> {
    correction: &'a mut [[f64; LANES]],
    force_correction: &'a mut [[f64; LANES]],
    pressure_gradient: &'a mut [Vector<D>],
    corrected_stress: &'a mut [Tensor<D>],
    weights: &'a mut [[f64; LANES]],
    /// Of as many particles as a field wants it of, or one value that is not written.
    eigenvalues: &'a mut [f64],
}

/// Updates corrections, pressure gradients and corrected stresses of the flow particles.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let flow = particles.flow_count();
    let share = share_of_correction(model, particles);
    let shared = &*particles;
    let PairData { weights, eigenvalues, geometry, single, .. } = pairs;
    let in_single = model.pairs_in_single();
    if in_single {
        fill(model, shared, single);
    } else {
        fill(model, shared, geometry);
    }
    let records = (&*geometry, &*single);
    let mut correction = std::mem::take(&mut particles.correction);
    let mut force_correction = std::mem::take(&mut particles.force_correction);
    correction.resize(flow);
    force_correction.resize(flow);
    let mut pressure_gradient = std::mem::take(&mut particles.pressure_gradient);
    let mut corrected_stress = std::mem::take(&mut particles.corrected_stress);
    // in single precision none is stored: a chunk a block, so that the loop is the same
    let region = if in_single { 1 } else { model.list.region };
    let blocks = flow.div_ceil(BLOCK);
    weights.resize(blocks * region, [0.0; LANES]);
    let meets_surface = model.field_meets_surface();
    eigenvalues.resize(if meets_surface { flow } else { blocks }, 0.0);
    let shared = &*particles;
    (
        correction.blocks_mut(BLOCK / LANES),
        force_correction.blocks_mut(BLOCK / LANES),
        pressure_gradient[..flow].par_chunks_mut(BLOCK),
        corrected_stress[..flow].par_chunks_mut(BLOCK),
        weights.par_chunks_mut(region),
        eigenvalues.par_chunks_mut(if meets_surface { BLOCK } else { 1 }),
    )
        .enumerate()
        .with_min_len(4)
        .for_each(
            |(block, (correction, force_correction, pressure_gradient, corrected_stress, weights, eigenvalues))| {
                let out =
                    Output { correction, force_correction, pressure_gradient, corrected_stress, weights, eigenvalues };
                model.instruction_set.run(Pass { model, particles: shared, records, block, share, out });
            },
        );
    particles.correction = correction;
    particles.force_correction = force_correction;
    particles.pressure_gradient = pressure_gradient;
    particles.corrected_stress = corrected_stress;
}

/// Records of position, volume and pressure.
fn fill<P: Precision, const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut Records<P>) {
    let (count, values) = (particles.position.len(), layout::geometry(D));
    records.fill(count, values, model.kernel.smoothing_length(), |index, record| {
        record.position(&particles.position[index]);
        record.scalar(particles.volume[index]);
        record.scalar(particles.pressure[index]);
    });
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    /// In double and in single precision.
    records: (&'a Records, &'a Records<f32>),
    block: usize,
    /// Share of the kernel correction in forces `[-]`.
    share: f64,
    out: Output<'a, D>,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let list = &self.model.list;
        let region_start = self.block * list.region;
        let count = self.out.corrected_stress.len();
        let meets_surface = self.model.field_meets_surface();
        let mut offset = 0;
        while offset < count {
            let first = self.block * BLOCK + offset;
            let group = list.group(first / LANES);
            let end = (offset + LANES).min(count);
            let sums: GeometrySums<V, D> = if self.model.pairs_in_single() {
                pair_sums(self.model, self.records.1, &group, &mut [])
            } else {
                pair_sums(self.model, self.records.0, &group, &mut self.out.weights[group.first_pair - region_start..])
            };
            let (for_gradients, mut for_forces) = if meets_surface {
                let (for_gradients, for_forces, eigenvalue) =
                    corrections_and_eigenvalue(&sums.moment, field_diffusion::CLOSED);
                store(eigenvalue, &mut self.out.eigenvalues[offset..end]);
                (for_gradients, for_forces)
            } else {
                corrections(&sums.moment)
            };
            if self.share < 1.0 {
                for_forces = shared_correction(&for_forces, self.share);
            }
            let stress = self.stress::<V>(first..first + end - offset);
            let out = &mut self.out;
            store_symmetric(out.correction, offset / LANES, &for_gradients);
            store_symmetric(out.force_correction, offset / LANES, &for_forces);
            store_vector(&product(&for_gradients, &sums.gradient), &mut out.pressure_gradient[offset..end]);
            store_tensor(&matrix_product(&stress, &for_forces), &mut out.corrected_stress[offset..end]);
            offset = end;
        }
    }
}

/// The pair sums of eight particles.
struct GeometrySums<V, const D: usize> {
    /// M = −Σ V F r ⊗ r `[-]`.
    moment: [[V; D]; D],
    /// Pressure gradient before its correction `[Pa/m]`.
    gradient: [V; D],
}

impl<V: Real, const D: usize> GeometrySums<V, D> {
    #[inline(always)]
    fn none() -> Self {
        Self { moment: zero_tensor(), gradient: zero_vector() }
    }
}

/// Pair sums of a group. In double precision its weights are made first and kept for the other passes.
#[inline(always)]
fn pair_sums<V: Lanes, P: Precision, const D: usize>(
    model: &Model<D>,
    records: &Records<P>,
    group: &NeighbourGroup<'_>,
    weights: &mut [Weights<P>],
) -> GeometrySums<V, D> {
    let quads = const { layout::geometry(D).div_ceil(4) };
    let own = records.load::<V>(quads, &group.own);
    let pressure_a = records::scalar(&own, D + 1);
    let weighing = Weighing::<P, V, D> { kernel: &model.kernel, records, quads, place: records::vector(&own, 0) };
    if !P::SINGLE {
        weighing.weigh(group.pairs, weights);
    }
    let (mut sums, mut part) = (GeometrySums::<V, D>::none(), GeometrySums::<P::Lanes<V>, D>::none());
    let mut pairs = weighing.pairs(group.pairs, weights);
    while let Some(pairs) = pairs.next() {
        for (b, weight) in pairs {
            let other = records.load::<V>(quads, &b);
            let r = records.apart::<V, D>(&weighing.place, &records::vector(&other, 0));
            let weight = P::Lanes::<V>::load(weight);
            let step = records::scalar(&other, D + 1) - pressure_a;
            // M is symmetric: only the upper triangle is summed
            for i in 0..D {
                let weighted = weight * r[i];
                let rise = if P::SINGLE { step * weighted } else { (step * weight) * r[i] };
                part.gradient[i] = part.gradient[i] + rise;
                for j in i..D {
                    part.moment[i][j] = part.moment[i][j] - weighted * r[j];
                }
            }
        }
        flush_tensor::<V, P, D>(&mut sums.moment, &mut part.moment);
        flush_vector::<V, P, D>(&mut sums.gradient, &mut part.gradient);
    }
    for i in 1..D {
        for j in 0..i {
            sums.moment[i][j] = sums.moment[j][i];
        }
    }
    sums
}

/// I + β (E − I).
#[inline(always)]
fn shared_correction<V: Lanes, const D: usize>(whole: &[[V; D]; D], share: f64) -> [[V; D]; D] {
    let mut lanes = scaled_tensor(V::splat(share), whole);
    for i in 0..D {
        lanes[i][i] = lanes[i][i] + V::splat(1.0 - share);
    }
    lanes
}

/// Share of the kernel correction in forces `[-]`; of a liquid that of its motion at the start of the step, summed particle by particle.
fn share_of_correction<const D: usize>(model: &Model<D>, particles: &Particles<D>) -> f64 {
    if let Some(share) = model.numerics.force_correction(&model.rheology) {
        return share;
    }
    let flow = particles.flow_count();
    let (mut velocity, mut speed, mut shear, mut stress) = (Vector::<D>::zeros(), 0.0, 0.0, 0.0);
    let motion = particles.velocity[..flow].iter().zip(&particles.velocity_gradient);
    for ((own, gradient), deviator) in motion.zip(&particles.stress) {
        velocity += own;
        speed += own.norm_squared();
        shear += shear_rate(gradient).powi(2);
        stress += 0.5 * deviator.norm_squared();
    }
    let (count, sound_speed) = (flow.max(1) as f64, model.equation_of_state.sound_speed());
    let about_the_mean = (speed / count - (velocity / count).norm_squared()).max(0.0);
    let shear = (shear / count).sqrt() * model.spacing / sound_speed;
    let modulus = model.equation_of_state.bulk_modulus;
    common_motion::correction_share(about_the_mean.sqrt() / sound_speed, shear)
        * common_motion::fluidity((stress / count).sqrt() / modulus, shear)
}

impl<const D: usize> Pass<'_, D> {
    /// σ = s − pI `[Pa]` of eight particles with the stresses that their law does not carry.
    #[inline(always)]
    fn stress<V: Lanes>(&self, places: Range<usize>) -> [[V; D]; D] {
        let particles = self.particles;
        let pressure = load::<V>(&particles.pressure[places.clone()]);
        let mut stress = load_tensor::<V, D>(&particles.stress[places.clone()]);
        let gradient = load_tensor::<V, D>(&particles.velocity_gradient[places.clone()]);
        let density = load::<V>(&particles.density[places.clone()]);
        let kept = particles.kept_by::<V>(places);
        if let Some(viscosity) = self.model.added_viscosity(&gradient, &stress, pressure, density, &kept) {
            let rate = deviatoric_rate(&gradient);
            for i in 0..D {
                accumulate(&mut stress[i], V::splat(2.0) * viscosity, &rate[i]);
            }
        }
        for axis in 0..D {
            stress[axis][axis] = stress[axis][axis] - pressure;
        }
        stress
    }
}
