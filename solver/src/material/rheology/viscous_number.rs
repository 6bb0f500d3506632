//! Grains in a viscous liquid: friction and dilatancy over the viscous number, with the pressure of the pore liquid.
//!
//! Pailha & Pouliquen (2009), J. Fluid Mech. 633, 115, for a mixture of one velocity ([`PoreLiquid`]):
//!
//! τ = (μ_c + K1 I + tanψ) p′, tanψ = K3 (φ − φ_c + K2 I), I = η γ̇/p′, dφ/dt = −φ D, D = γ̇ tanψ.
//!
//! The field is the excess pore pressure p_f, which drains at the free surface. Memories are the plastic solid fraction φ, as φ_0/φ − 1, and
//! the share of its volume that a particle has passed to the surface as water. Total pressures come in, p′ = p − p_f counts.
//!
//! γ̇ = (τ − m p′)₊/(η (K1 + K2 K3)) with m = (μ_c + K3 (φ − φ_c))₊ is linear in both stresses. At the end of a step
//! τ = τ* − G γ̇ Δt, so that γ̇ = (τ* − m p′)₊/B, B = η (K1 + K2 K3) + G Δt. Dilation is compressed elastically,
//! p′ = p* + (K_s + p*) D Δt: with K3 (φ − φ_c) γ̇ p′ + K2 K3 η γ̇² = D p′ this is a quadratic equation of p′. Its constant is not positive
//! and its value at γ̇ = 0 is positive, so that the positive root lies between. Where the skeleton would bear tension it opens:
//! φ falls until p′ = 0.
//!
//! Limits: all of the material lies under the liquid, whose own flow above the grains is left out; walls are sealed; grains do not settle one by one. K3 is no
//! constant of glass beads: published values reach from 4 to 40.

use super::TrialStress;
use super::field::{FieldBoundary, FieldDiffusion, FieldLaw, FieldReturn, FieldStep, LawField, Memory, PoreState};
use super::mu_i::REST_SHEAR_RATE;
use crate::lanes::Real;
use crate::material::pore_liquid::{PoreLiquid, SKELETON_SHARE};
use crate::parameter::{ParameterProblem, above, between, inside};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Grains under a viscous liquid that fills their pores and drains through their free surface.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ViscousNumber {
    /// Friction coefficient μ_c `[-]` at rest and at the critical solid fraction.
    #[schemars(transform = between(0.0, 2.0, "give 0.415 for glass beads"))]
    pub critical_friction: f64,
    /// Rise K1 of the friction coefficient with the viscous number `[-]`.
    #[schemars(transform = between(1.0, 1e4, "give 90.5 for glass beads"))]
    pub friction_slope: f64,
    /// Critical solid fraction φ_c of slow flow `[-]`.
    #[schemars(transform = inside(0.3, 0.75, "give 0.582 for glass beads"))]
    pub critical_fraction: f64,
    /// Fall K2 of the equilibrium solid fraction with the viscous number `[-]`.
    #[schemars(transform = between(0.0, 1e3, "give 25 for glass beads"))]
    pub fraction_slope: f64,
    /// Dilatancy K3 `[-]`: tanψ per difference of the solid fraction from equilibrium.
    #[schemars(transform = between(0.0, 100.0, "give 4.09 for glass beads, or 0 for no dilatancy"))]
    pub dilatancy: f64,
    /// Solid fraction φ `[-]` at the start.
    #[schemars(transform = inside(0.3, 0.75, "give 0.55 for a loose packing, 0.6 for a dense one"))]
    pub solid_fraction: f64,
    /// Grain diameter `[m]`.
    #[schemars(transform = above(0.0, "give the diameter in metres; 0.000225 for 225 µm"))]
    pub grain_diameter: f64,
    /// Density `[kg/m³]` of a grain.
    #[schemars(transform = above(0.0, "give the density of a grain in kg/m³; 2500 for glass"))]
    pub grain_density: f64,
    /// Density `[kg/m³]` of the liquid.
    #[schemars(transform = above(0.0, "give it in kg/m³, such as 1000 for water"))]
    pub liquid_density: f64,
    /// Viscosity η `[Pa·s]` of the liquid.
    #[schemars(transform = above(0.0, "give it in Pa·s, such as 0.001 for water"))]
    pub liquid_viscosity: f64,
    /// Coefficient α `[-]` of the permeability α d² (1 − φ)³/φ².
    #[serde(default = "kozeny_carman")]
    #[schemars(transform = between(1e-6, 1.0, "give 0.0056, which is 1/180, for the Kozeny–Carman relation"))]
    pub permeability_coefficient: f64,
}

fn kozeny_carman() -> f64 {
    1.0 / 180.0
}

/// Below its yield stress by more than this part of it a material is wholly elastic `[-]`.
const YIELDING: f64 = 0.01;
/// Largest volume over that at the start to which the skeleton opens `[-]`.
const MOST_OPEN: f64 = 10.0;

const MEMORIES: &[LawField] = &[
    LawField {
        name: "plastic_volume_growth",
        unit: "-",
        description: "φ_0/φ − 1 of the plastic solid fraction",
        initial: 0.0,
        bounds: (-0.7, MOST_OPEN - 1.0),
        diffusion: None,
    },
    LawField {
        name: "expelled_water",
        unit: "-",
        description: "water passed to the free surface over the particle's volume",
        initial: 0.0,
        bounds: (f64::MIN, f64::MAX),
        diffusion: None,
    },
];

/// End of a step of the skeleton.
struct SkeletonStep<R> {
    /// τ `[Pa]`.
    shear_stress: R,
    /// φ_0/φ `[-]`.
    volume: R,
}

impl ViscousNumber {
    pub(super) fn density_problem(&self) -> Option<ParameterProblem> {
        (self.liquid_density >= self.grain_density).then(|| {
            let remedy = "give the density of the liquid in kg/m³; the model needs grains that sink";
            ParameterProblem::new("liquid_density", self.liquid_density, "below `grain_density`", remedy)
        })
    }

    /// m `[-]`: the stress ratio from which on grains of a solid fraction flow; none where they are so loose that nothing holds them.
    #[inline(always)]
    fn yield_friction<R: Real>(&self, solid_fraction: R) -> R {
        let excess = solid_fraction - R::splat(self.critical_fraction);
        (R::splat(self.critical_friction) + R::splat(self.dilatancy) * excess).max(R::splat(0.0))
    }

    /// η (K1 + K2 K3) `[Pa·s]`: growth of the shear stress with the shear rate.
    fn resistance(&self) -> f64 {
        self.liquid_viscosity * (self.friction_slope + self.fraction_slope * self.dilatancy)
    }

    #[inline(always)]
    fn skeleton<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> SkeletonStep<R> {
        let (zero, one, tiny) = (R::splat(0.0), R::splat(1.0), R::splat(f64::MIN_POSITIVE));
        let modulus = R::splat(SKELETON_SHARE * trial.bulk_modulus); // K_s
        let pore = field.pore();
        let found = trial.pressure - pore.pressure;
        let start = found.max(zero); // p*
        // tension opens the skeleton, until φ_0/φ = ρ_0/ρ
        let kept = one + found.min(zero) / modulus.max(tiny);
        let volume = ((pore.growth + one) / kept.max(tiny)).min(R::splat(MOST_OPEN));
        let volume = volume.if_less(found, zero, pore.growth + one);
        let fraction = R::splat(self.solid_fraction) / volume;
        let excess = fraction - R::splat(self.critical_fraction);
        let friction = self.yield_friction(fraction); // m
        let unloading = R::splat(trial.shear_modulus * trial.time_step); // G Δt
        let resistance = R::splat(self.resistance()) + unloading; // B
        let (free, per_pressure) = (trial.shear_stress / resistance, friction / resistance);
        let swelling = (modulus + start) * R::splat(trial.time_step * self.dilatancy);
        let swelling = swelling.if_less(zero, modulus, zero);
        let thinning = R::splat(self.fraction_slope * self.liquid_viscosity); // K2 η
        let factor = one + swelling * per_pressure * (excess - thinning * per_pressure);
        let linear = swelling * free * (R::splat(2.0) * thinning * per_pressure - excess) - start;
        let constant = swelling * thinning * free * free;
        let root = (linear * linear + R::splat(4.0) * factor * constant).max(zero).sqrt();
        let pressure = ((root - linear) / (R::splat(2.0) * factor)).if_less(
            linear,
            zero,
            (constant + constant) / (root + linear).max(tiny),
        );
        let rate = (free - per_pressure * pressure).max(zero);
        let yields = friction * start;
        let shear_stress = (trial.shear_stress - unloading * rate).max(zero);
        let dilated = (volume * ((modulus + pressure) / (modulus + start).max(tiny))).min(R::splat(MOST_OPEN));
        let dilated = dilated.if_less(zero, modulus, volume);
        SkeletonStep {
            shear_stress: shear_stress.if_less(yields, trial.shear_stress, trial.shear_stress),
            volume: dilated.if_less(yields, trial.shear_stress, volume),
        }
    }

    /// φ `[-]` of what is kept.
    #[inline(always)]
    fn fraction<R: Real>(&self, field: &FieldStep<R>) -> R {
        R::splat(self.solid_fraction) / (field.pore().growth + R::splat(1.0))
    }
}

impl FieldLaw for ViscousNumber {
    fn field(&self) -> LawField {
        let strength = self.pore_liquid().map_or(0.0, |pore| pore.conductivity(self.solid_fraction));
        let (wall, surface) = (FieldBoundary::NoFlux, FieldBoundary::Vanishing);
        LawField {
            name: "pore_pressure",
            unit: "Pa",
            description: "pore pressure beyond the hydrostatic one",
            initial: 0.0,
            bounds: (-f64::MAX, f64::MAX),
            diffusion: Some(FieldDiffusion { strength, wall, surface }),
        }
    }

    fn memories(&self) -> &[LawField] {
        MEMORIES
    }

    #[inline(always)]
    fn end_of_step<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> FieldReturn<R> {
        if trial.time_step <= 0.0 {
            return FieldReturn { shear_stress: trial.shear_stress, field: field.value };
        }
        let modulus = R::splat((1.0 - SKELETON_SHARE) * trial.bulk_modulus); // K_f
        let step = R::splat(trial.time_step);
        let pressure = (field.value + modulus * (step * field.gain - field.growth))
            / (R::splat(1.0) + modulus * step * field.loss);
        FieldReturn { shear_stress: self.skeleton(trial, field).shear_stress, field: pressure }
    }

    #[inline(always)]
    fn memory_after<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>, end: &FieldReturn<R>) -> Memory<R> {
        if trial.time_step <= 0.0 {
            return field.memory;
        }
        let drained = R::splat(trial.time_step) * field.loss * end.field;
        let growth = self.skeleton(trial, field).volume - R::splat(1.0);
        PoreState { pressure: end.field, growth, expelled: field.pore().expelled + drained }.memory()
    }

    fn pore_liquid(&self) -> Option<PoreLiquid> {
        let &Self { solid_fraction, grain_diameter, grain_density, liquid_density, liquid_viscosity, .. } = self;
        let permeability_coefficient = self.permeability_coefficient;
        Some(PoreLiquid {
            solid_fraction,
            grain_diameter,
            grain_density,
            liquid_density,
            liquid_viscosity,
            permeability_coefficient,
        })
    }

    #[inline(always)]
    fn elasticity<R: Real>(&self, shear_stress: R, pressure: R, field: &FieldStep<R>, _elastic_viscosity: f64) -> R {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let yields = self.yield_friction(self.fraction(field)) * (pressure - field.value);
        let distance = (one - shear_stress / yields) / R::splat(YIELDING);
        distance.max(zero).min(one).where_less(zero, yields)
    }

    /// All of it below the yield, nothing beyond.
    #[inline(always)]
    fn turned_part<R: Real>(
        &self,
        trial: &TrialStress<R>,
        before: &FieldStep<R>,
        _end: &FieldReturn<R>,
        _vorticity: R,
    ) -> R {
        let yields = self.yield_friction(self.fraction(before)) * (trial.pressure - before.value).max(R::splat(0.0));
        R::splat(0.0).if_less(yields, trial.shear_stress, R::splat(1.0))
    }

    fn contact_friction(&self) -> f64 {
        self.critical_friction
    }

    /// Suction of the pore liquid may exceed the pressure of the grains.
    fn bears_tension(&self) -> bool {
        true
    }

    /// That of steady flow, where tanψ = 0 and the pore liquid bears nothing.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        let grains = self.critical_friction * pressure.max(0.0) / shear_rate.max(REST_SHEAR_RATE);
        grains + self.friction_slope * self.liquid_viscosity
    }

    fn field_in_flow(&self, _shear_rate: f64, _stress_ratio: f64) -> f64 {
        0.0
    }
}
