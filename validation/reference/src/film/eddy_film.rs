//! The film of a liquid with eddies on an incline: a Newtonian viscosity and a uniform mixing length.
//!
//! Smagorinsky's closure with the length l = C_s Δ carries τ = μ γ̇ + ρ l² γ̇². With τ = G (h − y) this is a quadratic in
//! γ̇; with D = √(μ² + 4 ρ l² τ) its root is γ̇ = 2τ/(μ + D), and since dD/dy = −2 ρ l² G/D, the velocity is
//!
//! u = ∫ (D − μ)/(2 ρ l²) dy = [(D_0³ − D³)/3 − μ (D_0² − D²)/2]/(4 ρ² l⁴ G), D_0 at the bed.

use crate::film::Incline;

/// Film of a liquid with eddies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EddyFilm {
    /// The layer.
    pub incline: Incline,
    /// Dynamic viscosity μ `[Pa·s]`, positive.
    pub viscosity: f64,
    /// Mixing length l `[m]`, positive.
    pub mixing_length: f64,
}

impl EddyFilm {
    /// ρ l² `[kg/m]`.
    fn eddy_inertia(&self) -> f64 {
        self.incline.density * self.mixing_length * self.mixing_length
    }

    /// D `[Pa·s]` at a height `[m]`: twice the eddy viscosity, and the molecular one.
    fn root(&self, height: f64) -> f64 {
        let shear_stress = self.incline.shear_stress(height);
        (self.viscosity * self.viscosity + 4.0 * self.eddy_inertia() * shear_stress).sqrt()
    }

    /// Shear rate `[1/s]` at a height `[m]`.
    pub fn shear_rate(&self, height: f64) -> f64 {
        2.0 * self.incline.shear_stress(height) / (self.viscosity + self.root(height))
    }

    /// Velocity `[m/s]` at a height `[m]`.
    pub fn velocity(&self, height: f64) -> f64 {
        let (bed, here, inertia) = (self.root(0.0), self.root(height), self.eddy_inertia());
        // (bed − here), of the differences of squares and cubes, without cancellation
        let stress_below = self.incline.driving_force() * height;
        let step = 4.0 * inertia * stress_below / (bed + here);
        let cubes = (bed * bed + bed * here + here * here) / 3.0;
        let squares = 0.5 * self.viscosity * (bed + here);
        step * (cubes - squares) / (4.0 * inertia * inertia * self.incline.driving_force())
    }

    /// Flux `[m²/s]`, ∫ γ̇ (h − y) dy by Simpson's rule.
    pub fn flux(&self) -> f64 {
        const CELLS: usize = 200;
        let (thickness, cell) = (self.incline.layer_height, self.incline.layer_height / CELLS as f64);
        let value = |y: f64| self.shear_rate(y) * (thickness - y);
        let of_cell = |k: usize| {
            let low = k as f64 * cell;
            cell / 6.0 * (value(low) + 4.0 * value(low + 0.5 * cell) + value(low + cell))
        };
        (0..CELLS).map(of_cell).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::NewtonianFilm;

    const INCLINE: Incline = Incline { layer_height: 0.01, inclination: 0.17, gravity: 9.81, density: 1000.0 };

    #[test]
    fn carries_the_shear_stress() {
        let film = EddyFilm { incline: INCLINE, viscosity: 0.1, mixing_length: 1e-3 };
        for k in 1..10 {
            let (y, step) = (1e-3 * f64::from(k), 1e-7);
            let rate = (film.velocity(y + step) - film.velocity(y - step)) / (2.0 * step);
            let stress = 0.1 * rate + 1000.0 * 1e-6 * rate * rate;
            assert!((stress / INCLINE.shear_stress(y) - 1.0).abs() < 1e-6, "{stress} at {y}");
            assert!((film.shear_rate(y) / rate - 1.0).abs() < 1e-6);
        }
        assert_eq!(film.velocity(0.0), 0.0);
    }

    #[test]
    fn flux_is_the_integral_of_the_velocity() {
        let film = EddyFilm { incline: INCLINE, viscosity: 0.1, mixing_length: 1e-3 };
        let cells = 2000;
        let sum: f64 = (0..cells).map(|k| film.velocity((f64::from(k) + 0.5) * 0.01 / f64::from(cells))).sum();
        assert!((film.flux() / (sum * 0.01 / f64::from(cells)) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn without_eddies_is_the_newtonian_film() {
        let film = EddyFilm { incline: INCLINE, viscosity: 1.0, mixing_length: 1e-6 };
        let exact = NewtonianFilm { incline: INCLINE, viscosity: 1.0 };
        assert!((film.velocity(0.007) / exact.velocity(0.007) - 1.0).abs() < 1e-4);
        assert!((film.flux() / exact.flux() - 1.0).abs() < 1e-4);
    }
}
