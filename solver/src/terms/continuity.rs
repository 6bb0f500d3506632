//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.
//!
//! The divergence in (7) is not corrected: the trace of the corrected gradient makes the layer shrink or blow up.

use super::{artificial_viscosity, density_coupling};
use crate::equation_of_state::EquationOfState;
use crate::kernel::Kernel;
use crate::lanes::algebra::{accumulate_outer, difference, dot, reduce_tensor, splat_vector, sum_of};
use crate::lanes::{InstructionSet, LaneIndices, LanePass, Lanes};
use crate::neighbours::VerletList;
use crate::numerics::ViscositySwitch;
use crate::particles::Particles;
use crate::records::{self, Records};
use crate::rheology::Rheology;
use crate::vector::{Tensor, shear_rate};
use rayon::prelude::*;

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

/// Values of a neighbour's record: position, velocity, volume, pressure, pressure gradient.
pub(crate) const fn values(dimension: usize) -> usize {
    3 * dimension + 2
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

/// Range of ρ/ρ0 beyond which a run has diverged `[-]`: dry grains may fly apart, nothing may be crushed.
const DENSITY_RANGE: (f64, f64) = (0.02, 2.0);

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
        const BLOCK: usize = crate::neighbours::BLOCK;
        let flow = particles.flow_count();
        let mut records = std::mem::replace(&mut particles.continuity_records, Records::new(0));
        let shared = &*particles;
        records.fill(particles.position.len(), |index, record| {
            record.vector(&shared.position[index]);
            record.vector(&shared.velocity[index]);
            record.scalar(shared.volume[index]);
            record.scalar(shared.pressure[index]);
            record.vector(&shared.pressure_gradient[index]);
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
                let first = block * BLOCK;
                self.instruction_set.run(Pass {
                    constants: self,
                    particles: shared,
                    first,
                    out,
                    extremes: &mut extremes,
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
    first: usize,
    out: Output<'a, D>,
    extremes: &'a mut Extremes,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, mut out, extremes } = self;
        for offset in 0..out.density.len() {
            let a = first + offset;
            let sums = if constants.gradient == GradientUse::None {
                divergence_only::<V, D>(constants, particles, a)
            } else {
                all_sums::<V, D>(constants, particles, a)
            };
            advance(constants, a, offset, &sums, &mut out, extremes);
        }
    }
}

/// The pair sums of one particle.
struct Sums<const D: usize> {
    /// Σ V_b v_ab·∇_aW_ab = −∇·v `[1/s]`.
    compression: f64,
    /// The coupling's pair sum `[Pa/m²]`.
    coupling: f64,
    /// Corrected velocity gradient `[1/s]`.
    gradient: Tensor<D>,
}

#[inline(always)]
fn all_sums<V: Lanes, const D: usize>(constants: &Continuity<'_, D>, particles: &Particles<D>, a: usize) -> Sums<D> {
    let total = particles.position.len();
    let zero = V::splat(0.0);
    let place = splat_vector::<V, D>(&particles.position[a]);
    let velocity_a = splat_vector::<V, D>(&particles.velocity[a]);
    let pressure_gradient_a = splat_vector::<V, D>(&particles.pressure_gradient[a]);
    let pressure_a = V::splat(particles.pressure[a]);
    let mut coupling = zero;
    let mut gradient = [[zero; D]; D];
    let row = constants.list.row(a);
    let weights = &particles.pair_weights[a * constants.list.stride()..];
    let (flow_weights, wall_weights) = weights.split_at(row.flow.len());
    for (chunk, weight) in row.flow.iter().zip(flow_weights) {
        let b = LaneIndices::new(chunk, total);
        let record = particles.continuity_records.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let pressure = records::scalar(&record, 2 * D + 1);
        let pressure_gradient = records::vector::<V, D>(&record, 2 * D + 2);
        let r = difference(&place, &position);
        let weight = V::load(weight);
        let sum = sum_of(&pressure_gradient_a, &pressure_gradient);
        coupling = coupling + weight * density_coupling::bracket(pressure_a - pressure, &sum, &r);
        accumulate_outer(&mut gradient, weight, &difference(&velocity, &velocity_a), &r);
    }
    for (chunk, weight) in row.wall.iter().zip(wall_weights) {
        let w = LaneIndices::new(chunk, total);
        let record = particles.continuity_records.load::<V>(const { values(D).div_ceil(4) }, &w);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&place, &position);
        let weight = V::load(weight);
        accumulate_outer(&mut gradient, weight, &difference(&velocity, &velocity_a), &r);
    }
    let gradient = reduce_tensor(&gradient);
    // the trace of the uncorrected gradient Σ V (v_b − v_a) ⊗ ∇W is ∇·v of (7)
    Sums { compression: -gradient.trace(), coupling: coupling.sum(), gradient: gradient * particles.correction[a] }
}

#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(
    constants: &Continuity<'_, D>,
    particles: &Particles<D>,
    a: usize,
) -> Sums<D> {
    let total = particles.position.len();
    let place = splat_vector::<V, D>(&particles.position[a]);
    let velocity_a = splat_vector::<V, D>(&particles.velocity[a]);
    let mut compression = V::splat(0.0);
    let row = constants.list.row(a);
    for chunk in row.flow.iter().chain(row.wall) {
        let b = LaneIndices::new(chunk, total);
        let record = particles.continuity_records.load::<V>(const { values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let volume = records::scalar(&record, 2 * D);
        let r = difference(&place, &position);
        let weight = volume * constants.kernel.gradient_factor(dot(&r, &r));
        compression = compression + weight * dot(&difference(&velocity_a, &velocity), &r);
    }
    Sums { compression: compression.sum(), coupling: 0.0, gradient: Tensor::zeros() }
}

#[inline(always)]
fn advance<const D: usize>(
    constants: &Continuity<'_, D>,
    a: usize,
    offset: usize,
    sums: &Sums<D>,
    out: &mut Output<'_, D>,
    extremes: &mut Extremes,
) {
    let dt = constants.time_step;
    let equation_of_state = &constants.equation_of_state;
    // (24) with (27); ρ is never floored: a floor opens voids
    let density = out.density[offset]
        + dt * out.density[offset] * sums.compression
        + dt * dt * constants.density_coupling * sums.coupling;
    out.density[offset] = density;
    let relative = density / equation_of_state.reference_density;
    if !(relative > DENSITY_RANGE.0 && relative < DENSITY_RANGE.1) && extremes.bad_density.is_none() {
        extremes.bad_density = Some(a);
    }
    if constants.viscosity_switch == ViscositySwitch::MorrisMonaghan {
        let decay_rate = equation_of_state.sound_speed() / constants.kernel.smoothing_length();
        out.artificial_viscosity[offset] =
            artificial_viscosity::switched(out.artificial_viscosity[offset], -sums.compression, decay_rate, dt);
    }
    let pressure = equation_of_state.pressure(density);
    let law = constants.rheology;
    match constants.gradient {
        GradientUse::None => {}
        GradientUse::Stress => {
            out.velocity_gradient[offset] = sums.gradient;
            out.stress[offset] =
                law.updated_stress(&out.stress[offset], &sums.gradient, pressure, constants.shear_modulus, dt);
        }
        GradientUse::Viscosity => {
            out.velocity_gradient[offset] = sums.gradient;
            out.viscosity[offset] = law.viscosity(shear_rate(&sums.gradient), pressure);
        }
    }
    if !law.is_plastic() && constants.gradient != GradientUse::None {
        let viscosity = law.viscosity(shear_rate(&sums.gradient), pressure);
        extremes.kinematic_viscosity = extremes.kinematic_viscosity.max(viscosity / density);
    }
}
