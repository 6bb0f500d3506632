//! The μ(I) law of dry grains as an elasto-viscoplastic return mapping: the default law.
//!
//! Equations (30)–(34) of the collapse paper; the implicit stress update after Dunatunga & Kamrin (2015), J. Fluid Mech. 779.
//!
//! In flow τ = μ(I) p with (31) μ(I) = μ_s + (μ_2 − μ_s)/(1 + I_0/I) and (32) I = |γ̇| D/√(p/ρ_s). With
//! ξ = I_0/(D √ρ_s), S_0 = μ_s p and S_2 = μ_2 p this is solved for the plastic shear rate,
//!
//! γ̇_p(τ) = ξ √p (τ − S_0)/(S_2 − τ) for S_0 < τ < S_2, and 0 up to S_0.
//!
//! An elastic trial stress τ* > S_0 relaxes by the plastic rate at the *end* of the step (implicit Euler):
//! τ = τ* − G Δt γ̇_p(τ). Multiplied by (S_2 − τ), with A = ξ G Δt √p,
//!
//! (τ* − τ)(S_2 − τ) = A (τ − S_0), or τ² − B τ + H = 0, B = S_2 + τ* + A, H = S_2 τ* + S_0 A.
//!
//! At τ = S_0 the left side is the larger, at τ = min(S_2, τ*) the right side: the smaller root lies between them.
//! It is taken as τ = 2H/(B + √(B² − 4H)), free of cancellation. The discriminant is written as
//! B² − 4H = (τ* + A − S_2)² + 4 A (S_2 − S_0), which rounding cannot make negative. For μ_2 = μ_s this is τ = S_0.

use super::grain_parameters::law_of_grains;
use super::{PlasticLaw, RegularisedMuI, TrialStress, rising_friction};
use crate::lanes::Real;
use crate::parameter::{ParameterProblem, above};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shear rate `[1/s]` below which the apparent viscosity no longer grows: a strain of 1e-6 in a second is rest.
pub(super) const REST_SHEAR_RATE: f64 = 1e-6;

law_of_grains! {
    /// Dry grains with a true yield stress: elastic below μ_s p, μ(I) p in flow, no stress without pressure.
    pub struct MuI {}
}

impl MuI {
    /// Friction coefficient μ(I) `[-]` of equation (31) at an inertial number `[-]`; I = ∞ gives μ_2.
    #[inline]
    #[must_use]
    pub fn friction_coefficient(&self, inertial_number: f64) -> f64 {
        self.static_friction
            + (self.limiting_friction - self.static_friction) / (1.0 + self.reference_inertia / inertial_number)
    }

    /// Inertial number I `[-]` of equation (32) at a shear rate `[1/s]` and a pressure `[Pa]`; ∞ without pressure.
    #[inline]
    #[must_use]
    pub fn inertial_number(&self, shear_rate: f64, pressure: f64) -> f64 {
        if pressure.is_nan() || pressure <= 0.0 {
            return f64::INFINITY;
        }
        shear_rate * self.grain_diameter / (pressure / self.grain_density).sqrt()
    }

    /// The same friction as a regularised viscosity (35) with a regularisation rate `[1/s]`.
    #[must_use]
    pub fn regularised(&self, regularisation_rate: f64) -> RegularisedMuI {
        RegularisedMuI {
            static_friction: self.static_friction,
            limiting_friction: self.limiting_friction,
            reference_inertia: self.reference_inertia,
            grain_diameter: self.grain_diameter,
            grain_density: self.grain_density,
            regularisation_rate,
        }
    }
}

impl PlasticLaw for MuI {
    #[inline(always)]
    fn admissible_shear_stress<R: Real>(&self, trial: &TrialStress<R>) -> R {
        let TrialStress { shear_stress: trial_shear_stress, shear_modulus, time_step, .. } = *trial;
        let pressure = trial.pressure.max(R::splat(0.0));
        let static_stress = R::splat(self.static_friction) * pressure; // S_0
        let limiting_stress = R::splat(self.limiting_friction) * pressure; // S_2
        // A = G Δt ξ √p, where ξ √p is the shear rate at which I = I_0
        let square = pressure / R::splat(self.grain_density);
        let rate = R::splat(self.reference_inertia / self.grain_diameter * shear_modulus * time_step);
        let relaxation = square.sqrt() * rate;
        let sum = limiting_stress + trial_shear_stress + relaxation; // B
        let product = limiting_stress * trial_shear_stress + static_stress * relaxation; // H
        let gap = trial_shear_stress + relaxation - limiting_stress;
        let discriminant = gap * gap + R::splat(4.0) * relaxation * (limiting_stress - static_stress);
        let admissible = R::splat(2.0) * product / (sum + discriminant.sqrt());
        admissible.if_less(static_stress, trial_shear_stress, trial_shear_stress)
    }

    #[inline(always)]
    fn yield_stress<R: Real>(&self, pressure: R) -> R {
        R::splat(self.static_friction) * pressure.max(R::splat(0.0))
    }

    fn contact_friction(&self) -> f64 {
        self.static_friction
    }

    #[inline]
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        if pressure.is_nan() || pressure <= 0.0 {
            return 0.0;
        }
        let rate = shear_rate.max(REST_SHEAR_RATE);
        self.friction_coefficient(self.inertial_number(rate, pressure)) * pressure / rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    const GLASS: MuI = MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };

    /// Bisection of g(τ) = τ − τ* + G Δt γ̇_p(τ), which grows, over [S_0, min(S_2, τ*)]. It takes γ̇_p from
    /// μ(I) itself by a second bisection over log γ̇, and so shares no algebra with the closed form.
    fn bisected_stress(law: &MuI, trial: f64, pressure: f64, modulus: f64, step: f64) -> f64 {
        let plastic_rate = |stress: f64| {
            let (mut low, mut high) = (-80.0f64, 80.0f64);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                let flow_stress = law.friction_coefficient(law.inertial_number(middle.exp(), pressure)) * pressure;
                if flow_stress < stress { low = middle } else { high = middle }
            }
            low.exp()
        };
        let (mut low, mut high) = (law.static_friction * pressure, trial.min(law.limiting_friction * pressure));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle - trial + modulus * step * plastic_rate(middle) < 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    #[test]
    fn return_mapping_solves_the_implicit_equation() {
        let mut random = Pcg64Mcg::seed_from_u64(7);
        for _ in 0..400 {
            let law = MuI {
                static_friction: random.random_range(0.1..0.6),
                limiting_friction: random.random_range(0.61..1.3),
                reference_inertia: libm::exp(random.random_range(-3.0..1.5)),
                grain_diameter: libm::exp(random.random_range(-9.0..-3.0)),
                grain_density: random.random_range(1000.0..4000.0),
            };
            let pressure = libm::exp(random.random_range(-3.0..9.0));
            let trial = law.static_friction * pressure * (1.0 + libm::exp(random.random_range(-9.0..3.0)));
            let modulus = libm::exp(random.random_range(5.0..14.0));
            let step = libm::exp(random.random_range(-14.0..-5.0));
            let closed = law.admissible_shear_stress(&TrialStress::new(trial, pressure, modulus, step));
            let bisected = bisected_stress(&law, trial, pressure, modulus, step);
            assert!((closed - bisected).abs() < 1e-11 * bisected, "{closed} against {bisected} for {law:?}");
            assert!(
                closed >= law.static_friction * pressure
                    && closed <= trial.min(law.limiting_friction * pressure) * (1.0 + 1e-15)
            );
        }
    }

    #[test]
    fn stays_elastic_below_yield_and_carries_nothing_without_pressure() {
        assert_eq!(GLASS.admissible_shear_stress(&TrialStress::new(38.0, 100.0, 1e5, 1e-4)), 38.0);
        for pressure in [0.0, -10.0, f64::NAN] {
            assert_eq!(GLASS.admissible_shear_stress(&TrialStress::new(38.0, pressure, 1e5, 1e-4)), 0.0);
            assert_eq!(GLASS.viscosity(1.0, pressure), 0.0);
        }
        assert_eq!(GLASS.yield_stress(-10.0), 0.0);
    }

    #[test]
    fn without_rate_dependence_the_stress_returns_to_the_yield_stress() {
        let law = MuI { limiting_friction: 0.382, ..GLASS };
        let stress = law.admissible_shear_stress(&TrialStress::new(500.0, 100.0, 1e5, 1e-4));
        assert!((stress - 38.2).abs() < 1e-11);
    }

    #[test]
    fn friction_rises_from_static_to_limiting_and_is_midway_at_the_reference() {
        assert_eq!(GLASS.friction_coefficient(0.0), 0.382);
        assert!((GLASS.friction_coefficient(0.279) - 0.5 * (0.382 + 0.643)).abs() < 1e-15);
        assert!((GLASS.friction_coefficient(f64::INFINITY) - 0.643).abs() < 1e-15);
        assert_eq!(GLASS.inertial_number(1.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn equation_34_gives_the_same_viscosity() {
        // η = μ_s p/|γ̇| + (μ_2 − μ_s) p/(|γ̇| + ξ √p), ξ = I_0/(D √ρ_s).
        let (rate, pressure): (f64, f64) = (12.0, 700.0);
        let xi = 0.279 / (0.5e-3 * 2500.0f64.sqrt());
        let expected = 0.382 * pressure / rate + (0.643 - 0.382) * pressure / (rate + xi * pressure.sqrt());
        assert!((GLASS.viscosity(rate, pressure) - expected).abs() < 1e-12 * expected);
        assert!(GLASS.viscosity(0.0, pressure).is_finite());
    }
}
