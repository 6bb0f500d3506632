//! The steady film of any law on an incline, integrated over its depth.
//!
//! Momentum gives the shear stress τ(y) = ρ g sinθ (h − y) and the pressure p(y) = ρ g cosθ (h − y) whatever the law. Where
//! there is no closed form, the shear rate is found from η(γ̇, p) γ̇ = τ by bisection, and u = ∫ γ̇ dy by the midpoint rule.

use crate::film::Incline;
use bagnold_solver::material::rheology::Rheology;

/// Cells of the midpoint rule over the depth.
const CELLS: usize = 100;
/// Shear rates between which that of a height is sought `[1/s]`: below the first a film stands still, above the second
/// there is no steady flow.
const RATES: (f64, f64) = (1e-6, 1e6);

/// Film of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawFilm {
    /// The layer.
    pub incline: Incline,
    /// The law.
    pub law: Rheology,
}

impl LawFilm {
    /// Shear rate `[1/s]` at a height `[m]`: 0 where the law carries the stress at rest, ∞ where no rate carries it.
    pub fn shear_rate(&self, height: f64) -> f64 {
        let shear_stress = self.incline.shear_stress(height);
        let pressure = shear_stress / libm::tan(self.incline.inclination);
        let falls_short = |rate: f64| self.law.viscosity(rate, pressure) * rate < shear_stress;
        let (mut slow, mut fast) = RATES;
        if !falls_short(slow) {
            return 0.0;
        }
        if falls_short(fast) {
            return f64::INFINITY;
        }
        // halves the interval of the logarithm until it is one of rounding
        for _ in 0..60 {
            let middle = (slow * fast).sqrt();
            if falls_short(middle) { slow = middle } else { fast = middle }
        }
        fast
    }

    /// Velocity u `[m/s]` at a height `[m]`.
    pub fn velocity(&self, height: f64) -> f64 {
        self.integral(height, |_| 1.0)
    }

    /// Flux `[m²/s]`, ∫ γ̇ (h − y) dy.
    pub fn flux(&self) -> f64 {
        let thickness = self.incline.layer_height;
        self.integral(thickness, |y| thickness - y)
    }

    /// Apparent viscosity `[Pa·s]` at the bed, where the film is sheared most.
    pub fn viscosity_at_bed(&self) -> f64 {
        self.incline.shear_stress(0.0) / self.shear_rate(0.0)
    }

    fn integral(&self, height: f64, weight: impl Fn(f64) -> f64) -> f64 {
        let cell = height / CELLS as f64;
        let centres = (0..CELLS).map(|k| (k as f64 + 0.5) * cell);
        centres.map(|y| cell * weight(y) * self.shear_rate(y)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::NewtonianFilm;
    use crate::grains::GLASS_BEADS;
    use crate::one_dimension::BagnoldProfile;
    use bagnold_solver::material::rheology::Newtonian;

    const INCLINE: Incline = Incline { layer_height: 0.01, inclination: 0.42, gravity: 9.81, density: 1000.0 };

    #[test]
    fn the_newtonian_film_is_that_of_nusselt() {
        let film = LawFilm { incline: INCLINE, law: Rheology::Newtonian(Newtonian { viscosity: 0.7 }) };
        let exact = NewtonianFilm { incline: INCLINE, viscosity: 0.7 };
        for height in [0.002, 0.01] {
            assert!((film.velocity(height) / exact.velocity(height) - 1.0).abs() < 1e-9);
        }
        assert!((film.flux() / exact.flux() - 1.0).abs() < 1e-4);
        assert!((film.viscosity_at_bed() / 0.7 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn grains_have_bagnolds_profile() {
        let (grains, fraction) = (GLASS_BEADS.law, GLASS_BEADS.solid_fraction);
        let incline = Incline { density: fraction * grains.grain_density, ..INCLINE };
        let film = LawFilm { incline, law: Rheology::MuI(grains) };
        let exact = BagnoldProfile::of(&grains, 0.01, fraction, 9.81, 0.42f64.to_degrees());
        let surface = exact.surface_velocity().expect("between the friction angles");
        assert!((film.velocity(0.01) / surface - 1.0).abs() < 1e-3, "{} {surface}", film.velocity(0.01));
        // below the static friction they stand, above the limiting one nothing holds them
        let tilted = |inclination| LawFilm { incline: Incline { inclination, ..incline }, ..film };
        assert_eq!(tilted(0.3).velocity(0.01), 0.0);
        assert_eq!(tilted(0.7).velocity(0.01), f64::INFINITY);
    }
}
