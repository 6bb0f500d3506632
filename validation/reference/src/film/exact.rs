//! Steady films of liquids and muds on an incline: Newtonian, Bingham and Herschel–Bulkley.
//!
//! The shear stress is τ(y) = G (h − y), G = ρ g sinθ, whatever the law. With |γ̇| = √(2 ε:ε) = du/dy and a yield
//! stress in the norm √(½ s:s) = τ, the film is sheared below the plug edge Y = h − τ_y/G and moves as a plug above.
//! (A yield stress in the norm √(s:s) is √2 times this one.) Fluxes are per unit width.

/// A layer of liquid of uniform thickness on an incline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incline {
    /// Thickness h `[m]` normal to the slope.
    pub layer_height: f64,
    /// Slope θ `[rad]`; `slope_angle` is the same in degrees, as files and messages give it.
    pub inclination: f64,
    /// Gravity g `[m/s²]`.
    pub gravity: f64,
    /// Density ρ `[kg/m³]`.
    pub density: f64,
}

impl Incline {
    /// G = ρ g sinθ `[Pa/m]`, the weight along the slope that shear has to carry.
    pub fn driving_force(&self) -> f64 {
        self.density * self.gravity * libm::sin(self.inclination)
    }

    /// Shear stress G (h − y) `[Pa]` at a height `[m]` above the bed.
    pub fn shear_stress(&self, height: f64) -> f64 {
        self.driving_force() * (self.layer_height - height)
    }

    /// Plug edge Y `[m]` of a yield stress `[Pa]`: 0 where the film stands still, h without a yield stress.
    fn plug_edge(&self, yield_stress: f64) -> f64 {
        let driving_force = self.driving_force();
        if driving_force > 0.0 { (self.layer_height - yield_stress / driving_force).max(0.0) } else { 0.0 }
    }
}

/// Film of a Newtonian liquid (Nusselt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonianFilm {
    /// The layer.
    pub incline: Incline,
    /// Dynamic viscosity μ `[Pa·s]`.
    pub viscosity: f64,
}

impl NewtonianFilm {
    /// Velocity u = (G/μ)(h y − y²/2) `[m/s]` at a height `[m]`.
    pub fn velocity(&self, height: f64) -> f64 {
        self.incline.driving_force() / self.viscosity * (self.incline.layer_height * height - 0.5 * height * height)
    }

    /// Flux G h³/(3μ) `[m²/s]`.
    pub fn flux(&self) -> f64 {
        let thickness = self.incline.layer_height;
        self.incline.driving_force() * thickness * thickness * thickness / (3.0 * self.viscosity)
    }
}

/// Film of a Bingham plastic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinghamFilm {
    /// The layer.
    pub incline: Incline,
    /// Yield stress τ_y `[Pa]`.
    pub yield_stress: f64,
    /// Plastic viscosity μ `[Pa·s]`.
    pub plastic_viscosity: f64,
}

impl BinghamFilm {
    /// Height Y = h − τ_y/G `[m]` above which the film moves as a plug.
    pub fn plug_edge(&self) -> f64 {
        self.incline.plug_edge(self.yield_stress)
    }

    /// Velocity U = G Y²/(2μ) `[m/s]` of the plug.
    pub fn plug_velocity(&self) -> f64 {
        self.incline.driving_force() * self.plug_edge() * self.plug_edge() / (2.0 * self.plastic_viscosity)
    }

    /// Velocity `[m/s]` at a height `[m]`: U [1 − ((y − Y)/Y)²] below Y, U above.
    pub fn velocity(&self, height: f64) -> f64 {
        let edge = self.plug_edge();
        if height >= edge {
            return self.plug_velocity();
        }
        let distance = (edge - height) / edge;
        self.plug_velocity() * (1.0 - distance * distance)
    }

    /// Flux U (h − Y/3) `[m²/s]`.
    pub fn flux(&self) -> f64 {
        self.plug_velocity() * (self.incline.layer_height - self.plug_edge() / 3.0)
    }
}

/// Film of a Herschel–Bulkley material, τ = τ_y + K |γ̇|ⁿ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HerschelBulkleyFilm {
    /// The layer.
    pub incline: Incline,
    /// Yield stress τ_y `[Pa]`.
    pub yield_stress: f64,
    /// Consistency K `[Pa·sⁿ]`.
    pub consistency: f64,
    /// Flow index n `[-]`.
    pub flow_index: f64,
}

impl HerschelBulkleyFilm {
    /// Height Y = h − τ_y/G `[m]` above which the film moves as a plug.
    pub fn plug_edge(&self) -> f64 {
        self.incline.plug_edge(self.yield_stress)
    }

    /// Velocity u_p = n/(n+1) (G/K)^{1/n} Y^{1+1/n} `[m/s]` of the plug.
    pub fn plug_velocity(&self) -> f64 {
        let (edge, index) = (self.plug_edge(), self.flow_index);
        if edge == 0.0 {
            return 0.0;
        }
        index / (index + 1.0) * libm::pow(self.incline.driving_force() * edge / self.consistency, 1.0 / index) * edge
    }

    /// Velocity `[m/s]` at a height `[m]`: u_p [1 − (1 − y/Y)^{1+1/n}] below Y, u_p above.
    pub fn velocity(&self, height: f64) -> f64 {
        let edge = self.plug_edge();
        if height >= edge {
            return self.plug_velocity();
        }
        self.plug_velocity() * (1.0 - libm::pow(1.0 - height / edge, 1.0 + 1.0 / self.flow_index))
    }

    /// Flux u_p [h − n Y/(2n+1)] `[m²/s]`.
    pub fn flux(&self) -> f64 {
        let index = self.flow_index;
        self.plug_velocity() * (self.incline.layer_height - index * self.plug_edge() / (2.0 * index + 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BED: Incline = Incline { layer_height: 0.05, inclination: 0.3, gravity: 9.81, density: 1300.0 };
    const YIELD: f64 = 60.0;

    fn herschel_bulkley(flow_index: f64, yield_stress: f64) -> HerschelBulkleyFilm {
        HerschelBulkleyFilm { incline: BED, yield_stress, consistency: 4.0, flow_index }
    }

    /// Composite midpoint rule over the film.
    fn quadrature(velocity: impl Fn(f64) -> f64) -> f64 {
        let cells = 20_000;
        let width = BED.layer_height / f64::from(cells);
        (0..cells).map(|k| velocity((f64::from(k) + 0.5) * width) * width).sum()
    }

    /// The law applied to a finite difference of the profile must carry the weight above, or yield where it is plug.
    fn assert_momentum_balance(velocity: impl Fn(f64) -> f64, yield_stress: f64, flow_stress: impl Fn(f64) -> f64) {
        for k in 1..50 {
            let (height, step) = (0.001 * f64::from(k), 1e-6);
            let shear_rate = (velocity(height + step) - velocity(height - step)) / (2.0 * step);
            let carried = BED.shear_stress(height);
            if carried > 1.02 * yield_stress {
                assert!((flow_stress(shear_rate) / carried - 1.0).abs() < 1e-4, "y = {height}");
            } else if carried < 0.98 * yield_stress {
                assert_eq!(shear_rate, 0.0, "y = {height}");
            }
        }
    }

    #[test]
    fn newtonian_film_balances_momentum_and_volume() {
        let film = NewtonianFilm { incline: BED, viscosity: 4.0 };
        assert_momentum_balance(|y| film.velocity(y), 0.0, |rate| 4.0 * rate);
        assert!((film.flux() / quadrature(|y| film.velocity(y)) - 1.0).abs() < 1e-8);
        assert_eq!(film.velocity(0.0), 0.0);
    }

    #[test]
    fn bingham_film_balances_momentum_and_volume() {
        let film = BinghamFilm { incline: BED, yield_stress: YIELD, plastic_viscosity: 4.0 };
        assert!(film.plug_edge() > 0.01 && film.plug_edge() < 0.04);
        assert_momentum_balance(|y| film.velocity(y), YIELD, |rate| YIELD + 4.0 * rate);
        assert!((film.flux() / quadrature(|y| film.velocity(y)) - 1.0).abs() < 1e-7);
    }

    #[test]
    fn herschel_bulkley_film_balances_momentum_and_volume() {
        for index in [0.4, 0.7, 1.0, 1.6] {
            let film = herschel_bulkley(index, YIELD);
            assert_momentum_balance(|y| film.velocity(y), YIELD, |rate| YIELD + 4.0 * libm::pow(rate, index));
            assert!((film.flux() / quadrature(|y| film.velocity(y)) - 1.0).abs() < 1e-6, "n = {index}");
        }
    }

    #[test]
    fn the_general_film_contains_the_special_ones() {
        let bingham = BinghamFilm { incline: BED, yield_stress: YIELD, plastic_viscosity: 4.0 };
        let newtonian = NewtonianFilm { incline: BED, viscosity: 4.0 };
        for k in 0..=50 {
            let height = 0.001 * f64::from(k);
            assert!((herschel_bulkley(1.0, YIELD).velocity(height) - bingham.velocity(height)).abs() < 1e-14);
            assert!((herschel_bulkley(1.0, 0.0).velocity(height) - newtonian.velocity(height)).abs() < 1e-14);
        }
        assert!((herschel_bulkley(1.0, 0.0).flux() / newtonian.flux() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_film_below_yield_stands_still() {
        let film = herschel_bulkley(0.5, 1e4);
        assert_eq!((film.plug_edge(), film.flux(), film.velocity(0.02)), (0.0, 0.0, 0.0));
        let level =
            BinghamFilm { incline: Incline { inclination: 0.0, ..BED }, yield_stress: 0.0, plastic_viscosity: 1.0 };
        assert_eq!((level.flux(), level.velocity(0.02)), (0.0, 0.0));
    }
}
