//! The new state of particles whose pair sums are known: density, artificial viscosity, velocity gradient and stress, and
//! what that adds to the energy ledger. Only here does the weakly compressible model ask the law for a stress.

use crate::lanes::algebra::{
    accumulate, deviatoric_rate, load, load_tensor, matrix_product, store, store_tensor, zero_tensor,
};
use crate::lanes::{LANES, Lanes, Real};
use crate::material::pore_liquid::LARGEST_DIFFUSION;
use crate::material::rheology::field::{FieldBoundary, FieldStep, MOST_MEMORIES, Memory};
use crate::vector::{Tensor, shear_rate};
use crate::weakly_compressible::divergence::DENSITY_RANGE;
use crate::weakly_compressible::energy::{CompressionStep, DeformationStep, DilationStep, EnergyLedger, StressWork};
use crate::weakly_compressible::memory;
use crate::weakly_compressible::model::{GradientUse, Model};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{artificial_viscosity, continuity, field_diffusion};
use std::ops::Range;

/// Extremes found by the pass over all blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremes {
    /// Largest apparent kinematic viscosity of laws with an explicit viscous bound `[m²/s]`.
    pub(crate) kinematic_viscosity: f64,
    /// Flow particle of the lowest storage index whose density left its range or is not a number.
    pub(crate) bad_density: Option<usize>,
}

impl Extremes {
    pub(super) const NONE: Self = Self { kinematic_viscosity: 0.0, bad_density: None };

    pub(super) fn merge(self, other: Self) -> Self {
        let bad_density = match (self.bad_density, other.bad_density) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self { kinematic_viscosity: self.kinematic_viscosity.max(other.kinematic_viscosity), bad_density }
    }
}

/// Outputs of the pass over a block.
pub(super) struct Output<'a, const D: usize> {
    pub(super) density: &'a mut [f64],
    pub(super) velocity_gradient: &'a mut [Tensor<D>],
    pub(super) stress: &'a mut [Tensor<D>],
    pub(super) viscosity: &'a mut [f64],
    pub(super) artificial_viscosity: &'a mut [f64],
    /// The law's field, or one value that is not written.
    pub(super) field: &'a mut [f64],
    /// Memory of the law beside its field, or one value that is not written.
    pub(super) memory: &'a mut [Memory<f64>],
    pub(super) energy: &'a mut EnergyLedger,
}

/// The pair sums of eight particles.
pub(super) struct RateSums<V, const D: usize> {
    /// Σ V_b v_ab·∇_aW_ab = −∇·v `[1/s]`.
    pub(super) compression: V,
    /// Part of the compression that is due to walls.
    pub(super) wall_compression: V,
    /// The coupling's pair sum `[Pa/m²]`.
    pub(super) coupling: V,
    /// Velocity gradient before its correction `[1/s]`.
    pub(super) gradient: [[V; D]; D],
    /// Part of the velocity gradient that is due to walls.
    pub(super) wall_gradient: [[V; D]; D],
    /// The pair sum of the stress ratio's diffusion `[Pa/m²]`.
    pub(super) stress_diffusion: [[V; D]; D],
    pub(super) field: FieldSums<V>,
}

impl<V: Real, const D: usize> RateSums<V, D> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let (zero, none) = (V::splat(0.0), zero_tensor());
        Self {
            compression: zero,
            wall_compression: zero,
            coupling: zero,
            gradient: none,
            wall_gradient: none,
            stress_diffusion: none,
            field: FieldSums { taken: zero, given: zero, weights: zero, eigenvalue: V::splat(1.0) },
        }
    }
}

/// The pair sums of a field's diffusion, with the weights V F ≤ 0 `[1/m²]`.
pub(super) struct FieldSums<V> {
    /// Σ V F f_b over the flow.
    pub(super) taken: V,
    /// Σ V F over the flow, and with their factors over walls.
    pub(super) given: V,
    /// Σ V F over all.
    pub(super) weights: V,
    /// Smallest eigenvalue of the moment matrix `[-]`, where it is asked for.
    pub(super) eigenvalue: V,
}

/// Inputs of the law's step: the new density, and the pressure at it with the field before the step.
#[derive(Clone, Copy)]
struct LawStep<V> {
    /// `[kg/m³]`
    density: V,
    /// `[Pa]`
    pressure: V,
    field: V,
    memory: Memory<V>,
    /// Share by which the volume grows `[-]`.
    growth: V,
}

/// A block of particles on its way to the next step.
pub(super) struct Advance<'a, const D: usize> {
    pub(super) model: &'a Model<D>,
    pub(super) particles: &'a Particles<D>,
    pub(super) gradient: GradientUse,
    pub(super) time_step: f64,
    /// First particle of the block.
    pub(super) block_start: usize,
}

impl<const D: usize> Advance<'_, D> {
    /// Advances the eight particles at `places` of the block: density, artificial viscosity, then gradient and stress.
    #[inline(always)]
    pub(super) fn particles_at<V: Lanes>(
        &self,
        places: Range<usize>,
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
        work: &mut StressWork<V>,
        extremes: &mut Extremes,
    ) {
        let equation_of_state = &self.model.equation_of_state;
        let previous = load::<V>(&out.density[places.clone()]);
        let strength = self.model.density_coupling();
        let here = self.block_start + places.start..self.block_start + places.end;
        let pressure_before = load::<V>(&self.particles.pressure[here.clone()]);
        let density = continuity::advanced(previous, sums.compression, sums.coupling, strength, self.time_step);
        let mass = load::<V>(&self.particles.mass[here]);
        let density = continuity::held(density, previous, mass, self.model.lone_density_per_mass);
        let time_step = V::splat(self.time_step);
        let field_before =
            if self.model.field.is_some() { load::<V>(&out.field[places.clone()]) } else { V::splat(0.0) };
        let memory = if self.model.keeps_memory {
            memory::load(&out.memory[places.clone()])
        } else {
            [V::splat(0.0); MOST_MEMORIES]
        };
        let pressure = self.model.pressure(density, field_before, memory[0]);
        let mut compression = CompressionStep {
            mass,
            density: (previous, density),
            pressure: (pressure_before, pressure),
            by_walls: time_step * previous * sums.wall_compression,
            by_coupling: time_step * time_step * V::splat(strength) * sums.coupling,
            free: self.model.free_density(field_before),
        };
        let follows = self.model.dilates || self.model.pore_liquid.is_some();
        if !follows {
            compression.add_to(work);
        }
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
            let start = LawStep {
                density,
                pressure,
                field: field_before,
                memory,
                growth: (previous - density) / density.max(V::splat(f64::MIN_POSITIVE)),
            };
            compression.pressure.1 = self.stress_of(places, start, sums, out, work, extremes);
        }
        if follows {
            compression.add_to(work);
        }
    }

    /// Velocity gradient, and the stress or the viscosity that the law gives with it; returns the pressure of the new state.
    #[inline(always)]
    fn stress_of<V: Lanes>(
        &self,
        places: Range<usize>,
        start: LawStep<V>,
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
        work: &mut StressWork<V>,
        extremes: &mut Extremes,
    ) -> V {
        let LawStep { density, mut pressure, field: field_before, .. } = start;
        let law = &self.model.rheology;
        let particles_here = self.block_start + places.start..self.block_start + places.end;
        let correction = self.particles.correction.load::<V>(particles_here.start / LANES);
        let gradient = matrix_product(&sums.gradient, &correction);
        let gradient_before = load_tensor::<V, D>(&out.velocity_gradient[places.clone()]);
        store_tensor(&gradient, &mut out.velocity_gradient[places.clone()]);
        if self.gradient == GradientUse::Stress {
            let before = load_tensor::<V, D>(&out.stress[places.clone()]);
            let mut diffused = before;
            if self.model.stress_diffuses() {
                let strength = V::splat(self.time_step * self.model.stress_diffusivity());
                for i in 0..D {
                    accumulate(&mut diffused[i], strength, &sums.stress_diffusion[i]);
                }
            }
            let moduli = self.model.moduli();
            let volume = load::<V>(&self.particles.volume[particles_here.clone()]);
            let keeps_memory = self.model.keeps_memory;
            let mut kept = self.field_step(field_before, start.memory[0], &sums.field);
            kept.growth = start.growth;
            kept.memory = start.memory;
            let end = law.updated_states(&diffused, &gradient, pressure, &kept, moduli, self.time_step);
            let (stress, field) = (end.stress, end.field);
            if self.model.field.is_some() {
                store(field, &mut out.field[places.clone()]);
            }
            if keeps_memory {
                memory::store(&end.memory, &mut out.memory[places.clone()]);
            }
            if self.model.dilates {
                let dilated = self.model.pressure(density, field, end.memory[0]);
                let strain = law.plastic_volume_strain(field) - law.plastic_volume_strain(field_before);
                DilationStep { volume, bulk_modulus: moduli.bulk, pressure: (pressure, dilated), strain }.add_to(work);
                pressure = dilated;
            }
            store_tensor(&stress, &mut out.stress[places.clone()]);
            let pressure_before = load::<V>(&self.particles.pressure[particles_here.clone()]);
            if let Some(pore) = &self.model.pore_liquid {
                pressure = self.model.pressure(density, field, end.memory[0]);
                let mass = load::<V>(&self.particles.mass[particles_here.clone()]);
                let densities = (mass / volume.max(V::splat(f64::MIN_POSITIVE)), density);
                let before = self.model.pore_energy(pressure_before, field_before);
                let stored = (before, self.model.pore_energy(pressure, field));
                work.add_pore_flow(mass, densities, (pressure_before, pressure), stored);
                let stable = self.model.numerics.viscous_courant / LARGEST_DIFFUSION;
                for memory in &out.memory[places.clone()] {
                    let fraction = pore.solid_fraction / (1.0 + memory[0]);
                    let diffusivity = stable * pore.diffusivity(fraction, moduli.bulk);
                    extremes.kinematic_viscosity = extremes.kinematic_viscosity.max(diffusivity);
                }
            }
            let mut added = zero_tensor::<V, D>();
            let added_viscosity =
                self.model.added_viscosity(&gradient_before, &before, pressure_before, density, &kept);
            let rate_before = deviatoric_rate(&gradient_before);
            if let Some(viscosity) = added_viscosity {
                for i in 0..D {
                    accumulate(&mut added[i], V::splat(2.0) * viscosity, &rate_before[i]);
                }
            }
            // as these velocities have it where the particles are now
            let mut gradient_then = gradient_before;
            let turned = matrix_product(&gradient_before, &gradient_before);
            for i in 0..D {
                accumulate(&mut gradient_then[i], V::splat(-self.time_step), &turned[i]);
            }
            let mut flow_gradient = sums.gradient;
            for i in 0..D {
                accumulate(&mut flow_gradient[i], V::splat(-1.0), &sums.wall_gradient[i]);
            }
            DeformationStep {
                volume,
                time_step: self.time_step,
                shear_modulus: law.is_plastic().then_some(moduli.shear),
                added_stress: &added,
                pressure: (pressure_before, pressure),
                growth: start.growth,
                divergence: sums.wall_compression - sums.compression,
                raw_gradient: &flow_gradient,
                gradient: &sums.gradient,
                force_correction: &self.particles.force_correction.load::<V>(particles_here.start / LANES),
                rate: &deviatoric_rate(&gradient),
                rate_by_walls: &deviatoric_rate(&matrix_product(&sums.wall_gradient, &correction)),
                rate_before: &deviatoric_rate(&gradient_then),
                stress_before: &before,
                stress: &stress,
            }
            .add_to(work);
        }
        if self.gradient == GradientUse::Viscosity || !law.is_plastic() {
            let pressures = pressure.to_array();
            for (lane, place) in places.enumerate() {
                let viscosity = law.viscosity(shear_rate(&out.velocity_gradient[place]), pressures[lane]);
                out.viscosity[place] = viscosity;
                if !law.is_plastic() {
                    extremes.kinematic_viscosity = extremes.kinematic_viscosity.max(viscosity / out.density[place]);
                }
            }
        }
        pressure
    }

    /// A field with what its diffusion brings and takes.
    #[inline(always)]
    fn field_step<V: Lanes>(&self, value: V, growth: V, sums: &FieldSums<V>) -> FieldStep<V> {
        let Some(diffusion) = self.model.field_diffusion() else { return FieldStep::alone(value) };
        // V F is negative
        let strength = V::splat(-2.0 * diffusion.strength);
        let mut loss = strength * sums.given;
        if diffusion.surface == FieldBoundary::Vanishing {
            let weights = V::splat(-2.0) * sums.weights;
            let sink = field_diffusion::surface_sink(weights, self.model.full_weight, sums.eigenvalue);
            let sink = match &self.model.pore_liquid {
                Some(_) => V::lane_by_lane([growth], &|[growth]| self.model.relative_conductivity(growth)) * sink,
                None => sink,
            };
            loss = loss + V::splat(diffusion.strength) * sink;
        }
        FieldStep::new(value, strength * sums.taken, loss)
    }
}
