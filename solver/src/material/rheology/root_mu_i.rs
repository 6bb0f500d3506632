//! The μ(I) law as a viscosity regularised by a root, as two-phase Eulerian codes of bed load take it
//! (Maurin et al. 2016 for the parameters; Chauchat 2018, J. Hydraul. Res. 56, for the form).
//!
//! η = μ(I) p/√(γ̇² + γ_r²), μ = μ_s + (μ_2 − μ_s) γ̇/(γ̇ + γ̇_0), where γ̇_0 = I_0 √(p/ρ_s)/D is the rate at which
//! I = γ̇ D √(ρ_s/p) is I_0. At rest η = μ_s p/γ_r. Unlike (35) of the collapse paper, which bounds the static part by an
//! exponential and shifts the rate of the other, the whole stress falls by γ̇/√(γ̇² + γ_r²): the two differ by
//! ½ (γ_r/γ̇)² in flow. For p ≤ 0 there is no stress.

use super::grain_parameters::{law_of_grains, reference_rate};
use super::regularisation::root_shear_rate;
use super::{ViscousLaw, rising_friction};
use crate::parameter::{ParameterProblem, above, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

law_of_grains! {
    /// Grains that creep below a rate instead of standing still.
    pub struct RootMuI {
        /// Regularisation rate γ_r `[1/s]`.
        #[schemars(transform = positive("give a creep rate in 1/s, such as 5e-3"))]
        pub regularisation_rate: f64,
    }
}

impl ViscousLaw for RootMuI {
    #[inline]
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        if pressure.is_nan() || pressure <= 0.0 {
            return 0.0;
        }
        let reference = reference_rate(self.reference_inertia, self.grain_diameter, self.grain_density, pressure);
        let span = self.limiting_friction - self.static_friction;
        let friction = self.static_friction + span * shear_rate / (shear_rate + reference).max(f64::MIN_POSITIVE);
        friction * pressure / root_shear_rate(shear_rate, self.regularisation_rate)
    }

    #[inline]
    fn largest_viscosity(&self, pressure: f64) -> f64 {
        // μ ≤ μ_2 and √ ≥ γ_r: a bound, for μ may grow faster with the rate than the root
        self.limiting_friction * pressure.max(0.0) / self.regularisation_rate
    }

    /// μ_s: a grain without neighbours has no pressure and so no viscosity, and would slide along a wall for ever.
    fn contact_friction(&self) -> f64 {
        self.static_friction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::rheology::MuI;

    const GRAVEL: RootMuI = RootMuI {
        static_friction: 0.35,
        limiting_friction: 0.97,
        reference_inertia: 0.69,
        grain_diameter: 5e-3,
        grain_density: 2600.0,
        regularisation_rate: 5e-3,
    };

    fn exact() -> MuI {
        let RootMuI { static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density, .. } =
            GRAVEL;
        MuI { static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density }
    }

    #[test]
    fn tends_to_the_friction_law_with_the_square_of_the_regularisation() {
        let (rate, pressure) = (0.3, 90.0);
        let stress = exact().friction_coefficient(exact().inertial_number(rate, pressure)) * pressure;
        let error = |regularisation_rate: f64| {
            let law = RootMuI { regularisation_rate, ..GRAVEL };
            (law.viscosity(rate, pressure) * rate - stress).abs()
        };
        let (coarse, fine) = (error(0.02), error(0.002));
        assert!(coarse < 3e-3 * stress);
        assert!((coarse / fine - 100.0).abs() < 1.0, "ratio {}", coarse / fine);
    }

    #[test]
    fn friction_has_its_limits_and_its_reference() {
        // p = 26.01 Pa and d √ρ_s = 0.255 √(kg/m): γ̇_0 = 0.69 · 5.1/0.255 = 13.8 1/s
        let friction = |rate: f64| GRAVEL.viscosity(rate, 26.01) * rate / 26.01;
        assert!((friction(13.8) - 0.66).abs() < 1e-3, "{}", friction(13.8));
        assert!((friction(1e9) - 0.97).abs() < 1e-6);
        assert!(friction(1e-5) < 1e-3);
    }

    #[test]
    fn is_finite_at_rest_below_its_bound_and_nothing_without_pressure() {
        assert!((GRAVEL.viscosity(0.0, 100.0) - 0.35 * 100.0 / 5e-3).abs() < 1e-9);
        for pressure in [0.0, -5.0, f64::NAN] {
            assert_eq!(GRAVEL.viscosity(1.0, pressure), 0.0);
        }
        let mut stress = 0.0;
        for k in -60..60 {
            let rate = libm::pow(1.3, f64::from(k));
            let viscosity = GRAVEL.viscosity(rate, 200.0);
            assert!(viscosity <= GRAVEL.largest_viscosity(200.0) && viscosity * rate > stress);
            stress = viscosity * rate;
        }
    }
}
