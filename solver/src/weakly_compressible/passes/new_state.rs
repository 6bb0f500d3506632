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
use crate::weakly_compressible::energy::{CompressionStep, DeformationStep, DilationStep, EnergyLedger, StressWork};
use crate::weakly_compressible::memory;
use crate::weakly_compressible::model::{GradientUse, Model};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{artificial_viscosity, continuity};
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

/// Outputs of the pass over a block.
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

/// Eight particles before their step.
struct Before<V> {
    mass: V,
    density: V,
    pressure: V,
    kept: FieldStep<V>,
}

/// What eight particles go through in their step: the new density, and the velocity gradients before and after.
struct LawStep<V, const D: usize> {
    density: V,
    /// That of the new density with what the law kept before.
    pressure: V,
    /// Share by which the volume grows `[-]`.
    growth: V,
    gradient_before: [[V; D]; D],
    gradient: [[V; D]; D],
    /// Correction of gradients `[-]`.
    correction: [[V; D]; D],
}

/// What the law has made of eight particles.
struct LawEnd<V, const D: usize> {
    stress_before: [[V; D]; D],
    stress: [[V; D]; D],
    pressure: V,
    /// Stress beside the law's that acted, of elastic damping and eddies.
    added_stress: [[V; D]; D],
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
        let before = self.before(&places, out);
        let density = self.new_density(&before, sums);
        let pressure = self.model.pressure(density, &before.kept);
        let mut compression = self.compression(&before, density, pressure, sums);
        let law_moves_pressure = self.model.law_moves_pressure();
        if !law_moves_pressure {
            compression.add_to(work);
        }
        self.store_density(&places, density, out, extremes);
        self.switch_artificial_viscosity(&places, sums, out);
        if self.gradient != GradientUse::None {
            let step = self.law_step(&places, &before, (density, pressure), sums, out);
            if self.gradient == GradientUse::Stress {
                compression.pressure.1 = self.stress_step(&places, &before, &step, sums, out, work);
            }
            self.store_viscosity(&places, compression.pressure.1, out, extremes);
        }
        if law_moves_pressure {
            compression.add_to(work);
        }
    }

    /// Storage places of particles of the block.
    #[inline(always)]
    fn here(&self, places: &Range<usize>) -> Range<usize> {
        self.block_start + places.start..self.block_start + places.end
    }

    #[inline(always)]
    fn before<V: Lanes>(&self, places: &Range<usize>, out: &Output<'_, D>) -> Before<V> {
        let here = self.here(places);
        let mut kept = FieldStep::alone(V::splat(0.0));
        if let Some(field) = &out.field {
            kept.value = load::<V>(&field[places.clone()]);
        }
        if let Some(memory) = &out.memory {
            kept.memory = memory::load(&memory[places.clone()]);
        }
        Before {
            mass: load::<V>(&self.particles.mass[here.clone()]),
            density: load::<V>(&out.density[places.clone()]),
            pressure: load::<V>(&self.particles.pressure[here]),
            kept,
        }
    }

    /// Density (7) with the coupling (27), as low as a lone particle has it at least.
    #[inline(always)]
    fn new_density<V: Lanes>(&self, before: &Before<V>, sums: &RateSums<V, D>) -> V {
        let (previous, strength) = (before.density, self.model.density_coupling());
        let density = continuity::advanced(previous, sums.compression, sums.coupling, strength, self.time_step);
        continuity::held(density, previous, before.mass, self.model.lone_density_per_mass)
    }

    #[inline(always)]
    fn compression<V: Lanes>(
        &self,
        before: &Before<V>,
        density: V,
        pressure: V,
        sums: &RateSums<V, D>,
    ) -> CompressionStep<V> {
        let (time_step, strength) = (V::splat(self.time_step), self.model.density_coupling());
        CompressionStep {
            mass: before.mass,
            density: (before.density, density),
            pressure: (before.pressure, pressure),
            by_walls: time_step * before.density * sums.wall_compression,
            by_coupling: time_step * time_step * V::splat(strength) * sums.coupling,
            free: self.model.free_density(before.kept.value),
        }
    }

    #[inline(always)]
    fn store_density<V: Lanes>(
        &self,
        places: &Range<usize>,
        density: V,
        out: &mut Output<'_, D>,
        extremes: &mut Extremes,
    ) {
        store(density, &mut out.density[places.clone()]);
        let inverse_reference = 1.0 / self.model.equation_of_state.reference_density;
        for place in places.clone() {
            let relative = out.density[place] * inverse_reference;
            if !(relative > DENSITY_RANGE.0 && relative < DENSITY_RANGE.1) && extremes.bad_density.is_none() {
                extremes.bad_density = Some(self.block_start + place);
            }
        }
    }

    #[inline(always)]
    fn switch_artificial_viscosity<V: Lanes>(
        &self,
        places: &Range<usize>,
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
    ) {
        if self.model.numerics.viscosity_switch == ViscositySwitch::MorrisMonaghan {
            let decay_rate = self.model.equation_of_state.sound_speed() / self.model.kernel.smoothing_length();
            let alpha = load::<V>(&out.artificial_viscosity[places.clone()]);
            let switched = artificial_viscosity::switched(alpha, -sums.compression, decay_rate, self.time_step);
            store(switched, &mut out.artificial_viscosity[places.clone()]);
        }
    }

    /// New velocity gradient, and with it what the law needs.
    #[inline(always)]
    fn law_step<V: Lanes>(
        &self,
        places: &Range<usize>,
        before: &Before<V>,
        (density, pressure): (V, V),
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
    ) -> LawStep<V, D> {
        let correction = self.particles.correction.load::<V>(self.here(places).start / LANES);
        let gradient = matrix_product(&sums.gradient, &correction);
        let gradient_before = load_tensor::<V, D>(&out.velocity_gradient[places.clone()]);
        store_tensor(&gradient, &mut out.velocity_gradient[places.clone()]);
        let growth = (before.density - density) / density.max(V::splat(f64::MIN_POSITIVE));
        LawStep { density, pressure, growth, gradient_before, gradient, correction }
    }

    /// New stress and what the law keeps, with their entries in the ledger; returns the pressure of the new state.
    #[inline(always)]
    fn stress_step<V: Lanes>(
        &self,
        places: &Range<usize>,
        before: &Before<V>,
        step: &LawStep<V, D>,
        sums: &RateSums<V, D>,
        out: &mut Output<'_, D>,
        work: &mut StressWork<V>,
    ) -> V {
        let (law, moduli) = (&self.model.rheology, self.model.moduli());
        let volume = load::<V>(&self.particles.volume[self.here(places)]);
        let stress_before = load_tensor::<V, D>(&out.stress[places.clone()]);
        let mut kept = field_diffusion::diffusing(self.model, before.kept, &sums.exchanged.field);
        kept.growth = step.growth;
        let diffused = self.diffused(&stress_before, sums);
        let end = law.updated_states(&diffused, &step.gradient, step.pressure, &kept, moduli, self.time_step);
        store_state(places, &end, out);
        let pressure = self.model.pressure(step.density, &end.kept());
        if self.model.dilates {
            let strain = law.plastic_volume_strain(end.field) - law.plastic_volume_strain(before.kept.value);
            let pressure = (step.pressure, pressure);
            DilationStep { volume, bulk_modulus: moduli.bulk, pressure, strain }.add_to(work);
        }
        if self.model.pore_liquid.is_some() {
            let densities = (before.mass / volume.max(V::splat(f64::MIN_POSITIVE)), step.density);
            let stored_before = self.model.pore_energy(before.pressure, before.kept.value);
            let stored = (stored_before, self.model.pore_energy(pressure, end.field));
            work.add_pore_flow(before.mass, densities, (before.pressure, pressure), stored);
        }
        let added_stress = self.added_stress(before, step, &stress_before, &kept);
        let end = LawEnd { stress_before, stress: end.stress, pressure, added_stress };
        self.book_deformation(places, (before, volume), step, &end, sums, work);
        pressure
    }

    /// Stress after the diffusion of the stress ratio.
    #[inline(always)]
    fn diffused<V: Lanes>(&self, stress: &[[V; D]; D], sums: &RateSums<V, D>) -> [[V; D]; D] {
        let mut diffused = *stress;
        if self.model.stress_diffuses() {
            let strength = V::splat(self.time_step * self.model.stress_diffusivity());
            for i in 0..D {
                accumulate(&mut diffused[i], strength, &sums.exchanged.stress_ratio[i]);
            }
        }
        diffused
    }

    /// Stress of elastic damping and eddies that acted in the step.
    #[inline(always)]
    fn added_stress<V: Lanes>(
        &self,
        before: &Before<V>,
        step: &LawStep<V, D>,
        stress: &[[V; D]; D],
        kept: &FieldStep<V>,
    ) -> [[V; D]; D] {
        let mut added = zero_tensor::<V, D>();
        let gradient = &step.gradient_before;
        if let Some(viscosity) = self.model.added_viscosity(gradient, stress, before.pressure, step.density, kept) {
            let rate = deviatoric_rate(gradient);
            for i in 0..D {
                accumulate(&mut added[i], V::splat(2.0) * viscosity, &rate[i]);
            }
        }
        added
    }

    #[inline(always)]
    fn book_deformation<V: Lanes>(
        &self,
        places: &Range<usize>,
        (before, volume): (&Before<V>, V),
        step: &LawStep<V, D>,
        end: &LawEnd<V, D>,
        sums: &RateSums<V, D>,
        work: &mut StressWork<V>,
    ) {
        // as these velocities have it where the particles are now
        let mut gradient_then = step.gradient_before;
        let turned = matrix_product(&step.gradient_before, &step.gradient_before);
        let mut flow_gradient = sums.gradient;
        for i in 0..D {
            accumulate(&mut gradient_then[i], V::splat(-self.time_step), &turned[i]);
            flow_gradient[i] = difference(&sums.gradient[i], &sums.wall_gradient[i]);
        }
        DeformationStep {
            volume,
            time_step: self.time_step,
            shear_modulus: self.model.rheology.is_plastic().then_some(self.model.shear_modulus()),
            added_stress: &end.added_stress,
            pressure: (before.pressure, end.pressure),
            growth: step.growth,
            divergence: sums.wall_compression - sums.compression,
            raw_gradient: &flow_gradient,
            gradient: &sums.gradient,
            force_correction: &self.particles.force_correction.load::<V>(self.here(places).start / LANES),
            rate: &deviatoric_rate(&step.gradient),
            rate_by_walls: &deviatoric_rate(&matrix_product(&sums.wall_gradient, &step.correction)),
            rate_before: &deviatoric_rate(&gradient_then),
            stress_before: &end.stress_before,
            stress: &end.stress,
        }
        .add_to(work);
    }

    /// Apparent viscosity, where it is needed, and the diffusivity that bounds an explicit step.
    #[inline(always)]
    fn store_viscosity<V: Lanes>(
        &self,
        places: &Range<usize>,
        pressure: V,
        out: &mut Output<'_, D>,
        extremes: &mut Extremes,
    ) {
        let law = &self.model.rheology;
        if let Some(memory) = &out.memory {
            extremes.add_diffusivity(pore_pressure::diffusivity(self.model, &memory[places.clone()]));
        }
        if self.gradient == GradientUse::Viscosity || !law.is_plastic() {
            let pressures = pressure.to_array();
            for (lane, place) in places.clone().enumerate() {
                let viscosity = law.viscosity(shear_rate(&out.velocity_gradient[place]), pressures[lane]);
                out.viscosity[place] = viscosity;
                if !law.is_plastic() {
                    extremes.add_diffusivity(viscosity / out.density[place]);
                }
            }
        }
    }
}

/// Writes stress, field and memory.
#[inline(always)]
fn store_state<V: Lanes, const D: usize>(
    places: &Range<usize>,
    end: &StateReturn<[[V; D]; D], V>,
    out: &mut Output<'_, D>,
) {
    store_tensor(&end.stress, &mut out.stress[places.clone()]);
    if let Some(field) = &mut out.field {
        store(end.field, &mut field[places.clone()]);
    }
    if let Some(memory) = &mut out.memory {
        memory::store(&end.memory, &mut memory[places.clone()]);
    }
}
