//! The μ(I) law as a regularised viscosity, equation (35) of the collapse paper.
//!
//! η = μ_s p (1 − exp(−|γ̇|/α_r))/|γ̇| + (μ_2 − μ_s) p/(ξ √p + |γ̇| + α_r), ξ = I_0/(D √ρ_s).
//! At rest η = μ_s p/α_r + (μ_2 − μ_s) p/(ξ √p + α_r): finite, but tens of kPa·s for α_r = 0.01 1/s and p = 1 kPa,
//! so that an explicit step is hundreds of times shorter than the acoustic one. For p ≤ 0 there is no stress.

use super::grain_parameters::{law_of_grains, reference_rate};
use super::regularisation::inverse_shear_rate;
use super::{ViscousLaw, rising_friction};
use crate::parameter::{ParameterProblem, above};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

law_of_grains! {
    /// Dry grains as a liquid that creeps below the yield stress: the paper's own setting.
    pub struct RegularisedMuI {
        /// Regularisation rate α_r `[1/s]`; the paper's value is 0.01.
        #[schemars(transform = above(0.0, "give a creep rate in 1/s, such as 0.01 as in the paper"))]
        pub regularisation_rate: f64,
    }
}

impl ViscousLaw for RegularisedMuI {
    #[inline]
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        if pressure.is_nan() || pressure <= 0.0 {
            return 0.0;
        }
        // ξ √p
        let rate_scale = reference_rate(self.reference_inertia, self.grain_diameter, self.grain_density, pressure);
        self.static_friction * pressure * inverse_shear_rate(shear_rate, self.regularisation_rate)
            + (self.limiting_friction - self.static_friction) * pressure
                / (rate_scale + shear_rate + self.regularisation_rate)
    }

    #[inline]
    fn largest_viscosity(&self, pressure: f64) -> f64 {
        // Both terms of (35) fall with the shear rate.
        self.viscosity(0.0, pressure)
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

    const GLASS: MuI = MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };

    #[test]
    fn is_38_kilopascal_seconds_at_one_kilopascal_at_rest() {
        // collapse.md: "for p = 1 kPa η reaches 38 kPa·s", dominated by μ_s p/α_r = 38.2 kPa·s.
        let viscosity = GLASS.regularised(0.01).largest_viscosity(1000.0);
        assert!((viscosity - 38.2e3).abs() < 5.0, "{viscosity}");
    }

    #[test]
    fn tends_to_the_friction_law_in_proportion_to_the_regularisation() {
        let (rate, pressure) = (3.0, 90.0);
        let exact = GLASS.friction_coefficient(GLASS.inertial_number(rate, pressure)) * pressure;
        let error =
            |regularisation: f64| (GLASS.regularised(regularisation).viscosity(rate, pressure) * rate - exact).abs();
        let (coarse, fine) = (error(0.02), error(0.002));
        assert!(coarse < 1e-3 * exact);
        assert!((coarse / fine - 10.0).abs() < 0.1, "ratio {}", coarse / fine);
    }

    #[test]
    fn falls_with_the_rate_and_vanishes_without_pressure() {
        let law = GLASS.regularised(0.01);
        assert_eq!(law.viscosity(1.0, 0.0), 0.0);
        assert_eq!(law.viscosity(0.0, -5.0), 0.0);
        assert_eq!(law.viscosity(0.0, f64::NAN), 0.0);
        let mut previous = law.largest_viscosity(200.0);
        let mut previous_stress = 0.0;
        for k in -60..60 {
            let rate = libm::pow(1.3, f64::from(k));
            let viscosity = law.viscosity(rate, 200.0);
            assert!(viscosity <= previous && viscosity * rate > previous_stress);
            (previous, previous_stress) = (viscosity, viscosity * rate);
        }
    }
}
