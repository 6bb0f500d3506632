//! Drucker & Prager's strength that softens from a peak to a residual value: dense sand, stiff and sensitive clay.
//!
//! Drucker & Prager (1952), Q. Appl. Math. 10, with strength lost along a line over the accumulated plastic shear strain κ, as
//! is usual for softening soils. Elastic of the shear modulus G up to
//!
//! Y(κ, p) = μ(κ) p + k(κ), μ = μ_r + (μ_p − μ_r) r, k = k_r + (k_p − k_r) r, r = max(0, 1 − κ/κ_r),
//!
//! with friction μ `[-]` and cohesion k `[Pa]` at their peak (p) for κ = 0 and at their residual (r) from κ_r on. Beyond it the
//! material flows along its deviatoric stress, at any rate alike: dκ = |γ̇_p| dt, and as it flows it dilates by β(κ) dκ
//! ([`PlasticDilation`]; β = 0 unless it is given). The pressure in the plane is the mean of the principal stresses in the plane, so that
//! Mohr and Coulomb's material of friction angle φ and cohesion c has exactly μ = sin φ and k = c cos φ there, and its dilation by the angle ψ is
//! β = sin ψ; β = μ is associated flow. In space the cone lies between the edges of their pyramid.
//!
//! Over a step stress and strain are solved together at its end: with the trial τ* > Y(κ⁰),
//!
//! τ* − G Δκ = Y(κ⁰ + Δκ).
//!
//! The left side less the right side is positive at Δκ = 0 and has one kink, at κ_r; behind it, it falls. So it has one root, however
//! steep the softening: Δκ = (τ* − Y_r)/G if that passes κ_r, else Δκ = (τ* − Y(κ⁰))/(G − H) with the modulus of softening
//! H = (Y_p − Y_r)/κ_r, which is below G then. What softens faster than it unloads (H > G) drops to the residual at once.
//! τ + G κ = G γ holds to rounding, so that a path is exact for every step. With dilation the pressure rises with Δκ, and the equation is that
//! of `dilating_return`.
//!
//! Cohesion reaches to p = −k/μ, the apex of the cone, where the equation of state keeps tension; Y = 0 beyond it.
//! With a tension cut-off, p = 0 means that the material has come apart: no shear stress, whatever the cohesion.
//!
//! Limits: no rate; a dilation that does not end (without κ_d) is for checks against limit analysis. Softening localises: in a body,
//! bands of shear are as narrow as the particles allow.

mod dilating_return;

use super::field::{FieldLaw, FieldReturn, FieldStep, LawField};
use super::mu_i::REST_SHEAR_RATE;
use super::plastic_dilation::PlasticDilation;
use super::{MuI, TrialStress};
use crate::lanes::Real;
use crate::parameter::{ParameterProblem, between, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Soil whose friction and cohesion fall from a peak to a residual value over a plastic shear strain.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SofteningDruckerPrager {
    /// Friction coefficient μ_p `[-]` before any plastic strain: shear strength gained per pressure, the sine of Mohr and Coulomb's angle.
    #[schemars(transform = between(0.0, 1.0, "give the sine of the peak friction angle, such as 0.6 for dense sand, 0 for undrained clay"))]
    pub peak_friction: f64,
    /// Friction coefficient μ_r `[-]` after the softening, ≤ μ_p.
    #[schemars(transform = between(0.0, 1.0, "give the sine of the residual friction angle, at most `peak_friction`"))]
    pub residual_friction: f64,
    /// Cohesion k_p `[Pa]` before any plastic strain: shear strength without pressure, c cos φ of Mohr and Coulomb's c.
    #[schemars(transform = not_negative("give the shear strength without pressure in Pa, or 0 for sand"))]
    pub peak_cohesion: f64,
    /// Cohesion k_r `[Pa]` after the softening, ≤ k_p.
    #[schemars(transform = not_negative("give the residual shear strength without pressure in Pa, at most `peak_cohesion`"))]
    pub residual_cohesion: f64,
    /// Plastic shear strain κ_r `[-]` over which strength falls to its residual.
    #[schemars(transform = positive("give the plastic shear strain at which the strength is residual, such as 0.1"))]
    pub softening_strain: f64,
    /// Dilation β_p `[-]` before any plastic strain: plastic volume strain gained per plastic shear strain, the sine of the dilation angle, ≤ μ_p.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(transform = between(0.0, 1.0, "give the sine of the dilation angle, at most `peak_friction`; 0.2 for dense sand, 0 for none"))]
    pub peak_dilation: f64,
    /// Plastic shear strain κ_d `[-]` over which dilation falls to nothing; without it dilation never ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = positive("give the plastic shear strain from which the volume is constant, such as 0.2"))]
    pub dilation_strain: Option<f64>,
}

/// Whether a value stands for nothing, and so is not written.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Most plastic volume strain `[-]`: what sand gains from its densest to its loosest state.
const LARGEST_LOOSENING: f64 = 0.25;

/// Below its yield stress by more than this part of it a material is wholly elastic `[-]`.
const YIELDING: f64 = 0.01;

/// A value where there is a pressure or a tension, another one where there is none or where it is lost.
#[inline(always)]
pub(super) fn where_held<R: Real>(value: R, pressure: R, other: R) -> R {
    let zero = R::splat(0.0);
    value.if_less(zero, pressure, value.if_less(pressure, zero, other))
}

impl SofteningDruckerPrager {
    /// Shear strength Y `[Pa]` at a pressure `[Pa]` and a plastic shear strain `[-]`.
    #[inline(always)]
    pub fn strength<R: Real>(&self, pressure: R, strain: R) -> R {
        let (residual, lost) = self.residual_and_lost(pressure);
        residual + lost * self.retained(self.strain_left(strain))
    }

    /// Residual strength and what softening takes of the peak strength `[Pa]`, at a pressure `[Pa]`.
    #[inline(always)]
    pub(super) fn residual_and_lost<R: Real>(&self, pressure: R) -> (R, R) {
        let at = |friction: f64, cohesion: f64| (R::splat(friction) * pressure + R::splat(cohesion)).max(R::splat(0.0));
        let peak = at(self.peak_friction, self.peak_cohesion);
        // under tension less friction would be more strength
        let residual = at(self.residual_friction, self.residual_cohesion).min(peak);
        (residual, peak - residual)
    }

    /// Plastic shear strain up to the residual strength `[-]`.
    #[inline(always)]
    pub(super) fn strain_left<R: Real>(&self, strain: R) -> R {
        (R::splat(self.softening_strain) - strain).max(R::splat(0.0))
    }

    /// r `[-]`.
    #[inline(always)]
    pub(super) fn retained<R: Real>(&self, strain_left: R) -> R {
        strain_left / R::splat(self.softening_strain)
    }

    /// Plastic dilation of the material.
    #[inline(always)]
    pub(super) fn dilation(&self) -> PlasticDilation {
        PlasticDilation { peak: self.peak_dilation, strain: self.dilation_strain.unwrap_or(f64::INFINITY) }
    }

    pub(super) fn strength_problem(&self) -> Option<ParameterProblem> {
        let rises = |field: &str, peak_field: &str, residual: f64, peak: f64| {
            let remedy = "give the peak value itself for a material that does not soften";
            (residual > peak)
                .then(|| ParameterProblem::new(field, residual, &format!("at most `{peak_field}`"), remedy))
        };
        rises("residual_friction", "peak_friction", self.residual_friction, self.peak_friction)
            .or_else(|| rises("residual_cohesion", "peak_cohesion", self.residual_cohesion, self.peak_cohesion))
            .or_else(|| self.dilation_problem())
    }

    /// Range error of the dilation, if any. A material with more dilation than friction gains energy from its flow
    /// under a great pressure.
    fn dilation_problem(&self) -> Option<ParameterProblem> {
        let (dilation, peak) = (self.dilation(), self.peak_dilation);
        let problem = |value: f64, field: &str, rule: String, remedy: &str| {
            Some(ParameterProblem::new(field, value, &rule, remedy))
        };
        if peak > self.peak_friction {
            let remedy = "give the sine of the dilation angle, no greater than that of the angle of friction";
            return problem(peak, "peak_dilation", "at most `peak_friction`".to_owned(), remedy);
        }
        // both fall along lines, so that the ends of the softening are enough
        let at_residual = dilation.ratio(self.softening_strain);
        if at_residual > self.residual_friction {
            let rule = format!(
                "so small that the dilation at `softening_strain`, {at_residual:.3}, is at most `residual_friction`, {}",
                self.residual_friction
            );
            return problem(peak, "peak_dilation", rule, "give a smaller value, or a smaller `dilation_strain`");
        }
        let (strain, most) = (self.dilation_strain?, LARGEST_LOOSENING);
        if dilation.largest_volume_strain() > most {
            let rule = format!("at most {:.3}, so that the volume grows by no more than {most}", 2.0 * most / peak);
            return problem(
                strain,
                "dilation_strain",
                rule,
                "give the strain at which the soil reaches its critical density",
            );
        }
        None
    }
}

impl From<MuI> for SofteningDruckerPrager {
    /// Grains in slow flow, which do not soften.
    fn from(grains: MuI) -> Self {
        Self {
            peak_friction: grains.static_friction,
            residual_friction: grains.static_friction,
            peak_cohesion: 0.0,
            residual_cohesion: 0.0,
            softening_strain: 1.0,
            peak_dilation: 0.0,
            dilation_strain: None,
        }
    }
}

impl FieldLaw for SofteningDruckerPrager {
    fn field(&self) -> LawField {
        LawField {
            name: "plastic_shear_strain",
            unit: "-",
            description: "plastic shear strain accumulated so far",
            initial: 0.0,
            bounds: (0.0, f64::MAX),
            diffusion: None,
        }
    }

    #[inline(always)]
    fn end_of_step<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> FieldReturn<R> {
        let (zero, before) = (R::splat(0.0), field.value);
        let (residual, lost) = self.residual_and_lost(trial.pressure);
        let left = self.strain_left(before);
        let strength = residual + lost * self.retained(left);
        if trial.time_step <= 0.0 {
            let shear_stress = trial.shear_stress.min(strength);
            return FieldReturn { shear_stress: where_held(shear_stress, trial.pressure, zero), field: before };
        }
        if self.dilates() && trial.bulk_modulus > 0.0 {
            return self.dilating_end_of_step(trial, before);
        }
        let modulus = R::splat(trial.shear_modulus);
        let softening = lost / R::splat(self.softening_strain); // H
        let to_residual = (trial.shear_stress - residual) / modulus;
        // G > H but for rounding, which the bounds of the strain that is left take
        let on_slope = ((trial.shear_stress - strength) / (modulus - softening)).min(left).max(zero);
        let strain = on_slope.if_less(to_residual, left, to_residual);
        let returned = residual + lost * self.retained((left - strain).max(zero));
        let shear_stress = returned.min(trial.shear_stress).if_less(strength, trial.shear_stress, trial.shear_stress);
        let after = (before + strain).if_less(strength, trial.shear_stress, before);
        FieldReturn {
            shear_stress: where_held(shear_stress, trial.pressure, zero),
            // what has come apart stays as soft as it was
            field: where_held(after, trial.pressure, before),
        }
    }

    fn dilates(&self) -> bool {
        self.peak_dilation > 0.0
    }

    #[inline(always)]
    fn plastic_volume_strain<R: Real>(&self, field: R) -> R {
        self.dilation().volume_strain(field)
    }

    #[inline(always)]
    fn elasticity<R: Real>(&self, shear_stress: R, pressure: R, field: &FieldStep<R>, _elastic_viscosity: f64) -> R {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let strength = self.strength(pressure, field.value);
        let distance = (one - shear_stress / strength) / R::splat(YIELDING);
        where_held(distance.max(zero).min(one).where_less(zero, strength), pressure, zero)
    }

    /// All of it below the yield, nothing beyond: as under the laws without a field.
    #[inline(always)]
    fn turned_part<R: Real>(
        &self,
        trial: &TrialStress<R>,
        before: &FieldStep<R>,
        _end: &FieldReturn<R>,
        _vorticity: R,
    ) -> R {
        R::splat(0.0).if_less(self.strength(trial.pressure, before.value), trial.shear_stress, R::splat(1.0))
    }

    /// The residual friction: what slides along a wall has softened.
    fn contact_friction(&self) -> f64 {
        self.residual_friction
    }

    fn is_solid(&self) -> bool {
        self.peak_friction > 0.0 || self.peak_cohesion > 0.0
    }

    fn bears_tension(&self) -> bool {
        true
    }

    fn strength_is_friction(&self) -> bool {
        self.peak_cohesion == 0.0
    }

    /// That of the residual strength.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        if pressure.is_nan() || pressure <= 0.0 {
            return 0.0;
        }
        self.strength(pressure, self.softening_strain) / shear_rate.max(REST_SHEAR_RATE)
    }

    /// Field in steady flow: the strain at which the material has softened.
    fn field_in_flow(&self, shear_rate: f64, stress_ratio: f64) -> f64 {
        if shear_rate != 0.0 && stress_ratio > 0.0 { self.softening_strain } else { 0.0 }
    }
}
