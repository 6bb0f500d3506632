//! The new state of particles whose pair sums are known: density, artificial viscosity, velocity gradient and stress, and
//! what that adds to the energy ledger. Only here does the weakly compressible model ask the law for a stress.

use super::exchange::{Exchanged, FieldSums};
use super::{field_diffusion, pore_pressure};
use crate::lanes::algebra::{
    accumulate, deviatoric_rate, difference, load, load_tensor, matrix_product, store, store_tensor, zero_tensor,
};
use crate::lanes::{LANES, Lanes, Real};
use crate::material::rheology::field::{FieldStep, Memory, StateReturn};
use crate::vector::{Tensor, shear_rate};
use crate::weakly_compressible::divergence::DENSITY_RANGE;
use crate::weakly_compressible::energy::{CompressionStep, DeformationStep, DilationStep, StressWork};
use crate::weakly_compressible::memory;
use crate::weakly_compressible::terms::{artificial_viscosity, continuity};
use crate::weakly_compressible::{EnergyLedger, GradientUse, Model, Particles, ViscositySwitch};
use std::ops::Range;

/// Extremes found by the pass over all blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremes {
    /// Largest diffusivity that bounds an explicit step `[m²/s]`: the apparent kinematic viscosity of a law that carries no stress along, or
    /// what stands for a pore liquid's in the same bound.
    pub(crate) diffusivity: f64,
    /// Flow particle of the lowest storage index whose density left its range or is not a number.
    pub(crate) bad_density: Option<usize>,
}

impl Extremes {
    pub(super) const NONE: Self = Self { diffusivity: 0.0, bad_density: None };

    fn add_diffusivity(&mut self, diffusivity: f64) {
        self.diffusivity = self.diffusivity.max(diffusivity);
    }

    pub(super) fn merge(self, other: Self) -> Self {
        let bad_density = match (self.bad_density, other.bad_density) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self { diffusivity: self.diffusivity.max(other.diffusivity), bad_density }
    }
}

/// Outputs of the pass for a block.
pub(super) struct Output<'a, const D: usize> {
    pub(super) density: &'a mut [f64],
    pub(super) velocity_gradient: &'a mut [Tensor<D>],
    pub(super) stress: &'a mut [Tensor<D>],
    pub(super) viscosity: &'a mut [f64],
    pub(super) artificial_viscosity: &'a mut [f64],
    /// The law's field, and its memory beside it.
    pub(super) field: Option<&'a mut [f64]>,
    pub(super) memory: Option<&'a mut [Memory<f64>]>,
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
    pub(super) exchanged: Exchanged<V, D>,
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
            exchanged: Exchanged { stress_ratio: none, field: FieldSums::none() },
        }
    }
}

/// A block of particles on its way to the next step.
#[derive(Clone, Copy)]
pub(super) struct Advance<'a, const D: usize> {
    pub(super) model: &'a Model<D>,
    pub(super) particles: &'a Particles<D>,
    pub(super) gradient: GradientUse,
    pub(super) time_step: f64,
    /// First particle of the block.
    pub(super) block_start: usize,
}

/// Eight particles on their way to the next step, with their pair sums and where what follows from these goes.
pub(super) struct Eight<'a, 'b, V, const D: usize> {
    pub(super) advance: Advance<'a, D>,
    /// Places of the particles in the block.
    pub(super) places: Range<usize>,
    pub(super) sums: RateSums<V, D>,
    pub(super) out: &'a mut Output<'b, D>,
    pub(super) work: &'a mut StressWork<V>,
    pub(super) extremes: &'a mut Extremes,
}

/// State before the step, and the new density.
struct DensityStep<V> {
    mass: V,
    density: (V, V),
    /// Before, and at the new density with what the law kept.
    pressure: (V, V),
    kept: FieldStep<V>,
    /// Share by which the volume grows `[-]`.
    growth: V,
}

/// Velocity gradients before and after the step, and the correction of the latter.
struct GradientStep<V, const D: usize> {
    before: [[V; D]; D],
    after: [[V; D]; D],
    correction: [[V; D]; D],
}

/// Stresses of a step: pressures before and after, the law's stress before and after, and what acted beside it.
struct Stresses<V, const D: usize> {
    volume: V,
    growth: V,
    pressure: (V, V),
    added: [[V; D]; D],
    before: [[V; D]; D],
    after: [[V; D]; D],
}

impl<V: Lanes, const D: usize> Eight<'_, '_, V, D> {
    /// Makes the step: density, artificial viscosity, then gradient and stress.
    #[inline(always)]
    pub(super) fn step(mut self) {
        let model = self.advance.model;
        let density = self.density_step();
        let mut compression = self.compression(&density);
        let law_moves_pressure = model.law_moves_pressure();
        if !law_moves_pressure {
            compression.add_to(self.work);
        }
        self.store_density(density.density.1);
        self.switch_artificial_viscosity();
        if self.advance.gradient != GradientUse::None {
            let gradient = self.gradient_step();
            if self.advance.gradient == GradientUse::Stress {
                compression.pressure.1 = self.stress_step(&density, &gradient);
            }
            self.store_viscosity(compression.pressure.1);
        }
        if law_moves_pressure {
            compression.add_to(self.work);
        }
    }

    /// Their storage places.
    #[inline(always)]
    fn here(&self) -> Range<usize> {
        self.advance.block_start + self.places.start..self.advance.block_start + self.places.end
    }

    /// Density (7) with the coupling (27), at least that of a particle alone.
    #[inline(always)]
    fn density_step(&self) -> DensityStep<V> {
        let (Advance { model, particles, time_step, .. }, sums) = (self.advance, &self.sums);
        let previous = load::<V>(&self.out.density[self.places.clone()]);
        let mass = load::<V>(&particles.mass[self.here()]);
        let strength = model.density_coupling();
        let density = continuity::advanced(previous, sums.compression, sums.coupling, strength, time_step);
        let density = continuity::held(density, previous, mass, model.lone_density_per_mass);
        let mut kept = FieldStep::alone(V::splat(0.0));
        if let Some(field) = &self.out.field {
            kept.value = load::<V>(&field[self.places.clone()]);
        }
        if let Some(memory) = &self.out.memory {
            kept.memory = memory::load(&memory[self.places.clone()]);
        }
        DensityStep {
            mass,
            density: (previous, density),
            pressure: (load::<V>(&particles.pressure[self.here()]), model.pressure(density, &kept)),
            kept,
            growth: (previous - density) / density.max(V::splat(f64::MIN_POSITIVE)),
        }
    }

    #[inline(always)]
    fn compression(&self, step: &DensityStep<V>) -> CompressionStep<V> {
        let time_step = V::splat(self.advance.time_step);
        let strength = V::splat(self.advance.model.density_coupling());
        CompressionStep {
            mass: step.mass,
            density: step.density,
            pressure: step.pressure,
            by_walls: time_step * step.density.0 * self.sums.wall_compression,
            by_coupling: time_step * time_step * strength * self.sums.coupling,
            free: self.advance.model.free_density(step.kept.value),
        }
    }

    #[inline(always)]
    fn store_density(&mut self, density: V) {
        store(density, &mut self.out.density[self.places.clone()]);
        let inverse_reference = 1.0 / self.advance.model.equation_of_state.reference_density;
        for place in self.places.clone() {
            let relative = self.out.density[place] * inverse_reference;
            if !(relative > DENSITY_RANGE.0 && relative < DENSITY_RANGE.1) && self.extremes.bad_density.is_none() {
                self.extremes.bad_density = Some(self.advance.block_start + place);
            }
        }
    }

    #[inline(always)]
    fn switch_artificial_viscosity(&mut self) {
        let Advance { model, time_step, .. } = self.advance;
        if model.numerics.viscosity_switch == ViscositySwitch::MorrisMonaghan {
            let decay_rate = model.equation_of_state.sound_speed() / model.kernel.smoothing_length();
            let alpha = load::<V>(&self.out.artificial_viscosity[self.places.clone()]);
            let switched = artificial_viscosity::switched(alpha, -self.sums.compression, decay_rate, time_step);
            store(switched, &mut self.out.artificial_viscosity[self.places.clone()]);
        }
    }

    #[inline(always)]
    fn gradient_step(&mut self) -> GradientStep<V, D> {
        let (sums, out) = (&self.sums, &mut self.out.velocity_gradient[self.places.clone()]);
        let before = load_tensor::<V, D>(out);
        let group = (self.advance.block_start + self.places.start) / LANES;
        let correction = self.advance.particles.correction.load::<V>(group);
        let after = matrix_product(&sums.gradient, &correction);
        store_tensor(&after, out);
        GradientStep { before, after, correction }
    }

    /// New stress and what the law keeps, with their entries in the ledger; returns the pressure of the new state.
    #[inline(always)]
    fn stress_step(&mut self, density: &DensityStep<V>, gradient: &GradientStep<V, D>) -> V {
        let Advance { model, particles, time_step, .. } = self.advance;
        let (law, moduli) = (&model.rheology, model.moduli());
        let before = load_tensor::<V, D>(&self.out.stress[self.places.clone()]);
        let volume = load::<V>(&particles.volume[self.here()]);
        let mut kept = field_diffusion::diffusing(model, density.kept, &self.sums.exchanged.field);
        kept.growth = density.growth;
        let trial = self.after_diffusion(&before);
        let end = law.updated_states(&trial, &gradient.after, density.pressure.1, &kept, moduli, time_step);
        self.store_state(&end);
        let pressure = model.pressure(density.density.1, &end.kept());
        if model.dilates {
            let strain = law.plastic_volume_strain(end.field) - law.plastic_volume_strain(density.kept.value);
            let pressure = (density.pressure.1, pressure);
            DilationStep { volume, bulk_modulus: moduli.bulk, pressure, strain }.add_to(self.work);
        }
        let pressure = (density.pressure.0, pressure);
        if model.pore_liquid.is_some() {
            let densities = (density.mass / volume.max(V::splat(f64::MIN_POSITIVE)), density.density.1);
            let stored_before = model.pore_energy(pressure.0, density.kept.value);
            let stored = (stored_before, model.pore_energy(pressure.1, end.field));
            self.work.add_pore_flow(density.mass, densities, pressure, stored);
        }
        let mut added = zero_tensor::<V, D>();
        let viscosity = model.added_viscosity(&gradient.before, &before, pressure.0, density.density.1, &kept);
        if let Some(viscosity) = viscosity {
            let rate = deviatoric_rate(&gradient.before);
            for i in 0..D {
                accumulate(&mut added[i], V::splat(2.0) * viscosity, &rate[i]);
            }
        }
        let stresses = Stresses { volume, growth: density.growth, pressure, added, before, after: end.stress };
        self.book_deformation(&stresses, gradient);
        pressure.1
    }

    /// Stress before the law's step: that of before after the diffusion of the stress ratio.
    #[inline(always)]
    fn after_diffusion(&self, stress: &[[V; D]; D]) -> [[V; D]; D] {
        let mut diffused = *stress;
        if self.advance.model.stress_diffuses() {
            let strength = V::splat(self.advance.time_step * self.advance.model.stress_diffusivity());
            for i in 0..D {
                accumulate(&mut diffused[i], strength, &self.sums.exchanged.stress_ratio[i]);
            }
        }
        diffused
    }

    #[inline(always)]
    fn store_state(&mut self, end: &StateReturn<[[V; D]; D], V>) {
        store_tensor(&end.stress, &mut self.out.stress[self.places.clone()]);
        if let Some(field) = &mut self.out.field {
            store(end.field, &mut field[self.places.clone()]);
        }
        if let Some(memory) = &mut self.out.memory {
            memory::store(&end.memory, &mut memory[self.places.clone()]);
        }
    }

    #[inline(always)]
    fn book_deformation(&mut self, stresses: &Stresses<V, D>, gradient: &GradientStep<V, D>) {
        let (Advance { model, particles, time_step, .. }, sums) = (self.advance, &self.sums);
        // as these velocities have it where the particles are now
        let mut gradient_then = gradient.before;
        let turned = matrix_product(&gradient.before, &gradient.before);
        let mut flow_gradient = sums.gradient;
        for i in 0..D {
            accumulate(&mut gradient_then[i], V::splat(-time_step), &turned[i]);
            flow_gradient[i] = difference(&sums.gradient[i], &sums.wall_gradient[i]);
        }
        DeformationStep {
            volume: stresses.volume,
            time_step,
            shear_modulus: model.rheology.is_plastic().then_some(model.shear_modulus()),
            added_stress: &stresses.added,
            pressure: stresses.pressure,
            growth: stresses.growth,
            divergence: sums.wall_compression - sums.compression,
            raw_gradient: &flow_gradient,
            gradient: &sums.gradient,
            force_correction: &particles.force_correction.load::<V>(self.here().start / LANES),
            rate: &deviatoric_rate(&gradient.after),
            rate_by_walls: &deviatoric_rate(&matrix_product(&sums.wall_gradient, &gradient.correction)),
            rate_before: &deviatoric_rate(&gradient_then),
            stress_before: &stresses.before,
            stress: &stresses.after,
        }
        .add_to(self.work);
    }

    /// Apparent viscosity, where it is needed, and the diffusivity that bounds an explicit step.
    #[inline(always)]
    fn store_viscosity(&mut self, pressure: V) {
        let (Advance { model, gradient, .. }, out) = (self.advance, &mut *self.out);
        if let Some(memory) = &out.memory {
            self.extremes.add_diffusivity(pore_pressure::diffusivity(model, &memory[self.places.clone()]));
        }
        let explicit = !model.rheology.is_plastic();
        if gradient == GradientUse::Viscosity || explicit {
            let pressures = pressure.to_array();
            for (lane, place) in self.places.clone().enumerate() {
                let viscosity = model.rheology.viscosity(shear_rate(&out.velocity_gradient[place]), pressures[lane]);
                out.viscosity[place] = viscosity;
                if explicit {
                    self.extremes.add_diffusivity(viscosity / out.density[place]);
                }
            }
        }
    }
}
