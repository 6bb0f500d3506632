//! Bagnold profile: the steady flow of dry grains down an infinite rough incline, equations (36) and (37).
//!
//! Momentum asks for τ = ρ g sinθ (h − y), with p = ρ g cosθ (h − y): μ(I) = tanθ at every height y, so I is constant,
//! I = I_0 (tanθ − μ_s)/(μ_2 − tanθ). From (32), du/dy = I √(p/ρ_s)/D = (I/D) √(φ g cosθ (h − y)), and integrated
//! from u(0) = 0, (36): u = (2/3)(I/D) √(φ g cosθ) [h^{3/2} − (h − y)^{3/2}]. Its depth mean is (37): Ū = (3/5) u(h).
//! No steady flow below tanθ = μ_s (arrest) or from tanθ = μ_2 on (unbounded acceleration).

use super::LayerError;
use bagnold_solver::material::rheology::MuI;

/// A uniform layer of dry grains on an incline, and its steady flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BagnoldProfile {
    /// Thickness h `[m]` normal to the slope.
    pub layer_height: f64,
    /// Slope θ `[rad]`; `slope_angle` is the same in degrees, as files and messages give it.
    pub inclination: f64,
    /// Gravity g `[m/s²]`.
    pub gravity: f64,
    /// Grains: diameter D `[m]`, density ρ_s `[kg/m³]`, friction coefficients μ_s of slow flow and μ_2 that fast flow tends to `[-]`,
    /// and the inertial number I_0 `[-]` at which friction is midway.
    pub grains: MuI,
    /// Solid fraction φ `[-]`; the bulk density is φ ρ_s.
    pub solid_fraction: f64,
}

impl BagnoldProfile {
    /// The layer of a height `[m]` of grains of μ(I), at a solid fraction and a gravity `[m/s²]`, on a slope `[°]`.
    pub fn of(grains: &MuI, layer_height: f64, solid_fraction: f64, gravity: f64, slope_angle: f64) -> Self {
        Self { layer_height, inclination: slope_angle.to_radians(), gravity, grains: *grains, solid_fraction }
    }

    /// Refuses parameters for which neither the profile nor its transient is defined.
    pub fn check(&self) -> Result<(), LayerError> {
        LayerError::unless_positive([
            ("layer_height", self.layer_height),
            ("gravity", self.gravity),
            ("grain_diameter", self.grains.grain_diameter),
            ("grain_density", self.grains.grain_density),
            ("solid_fraction", self.solid_fraction),
            ("static_friction", self.grains.static_friction),
            ("reference_inertia", self.grains.reference_inertia),
        ])?;
        let refuse = |field, value, rule| Err(LayerError::Parameter { field, value, rule });
        if !(self.grains.limiting_friction > self.grains.static_friction && self.grains.limiting_friction.is_finite()) {
            let rule = "finite and greater than static_friction";
            return refuse("limiting_friction", self.grains.limiting_friction, rule);
        }
        if self.inclination.is_nan() || self.inclination.abs() >= std::f64::consts::FRAC_PI_2 {
            return refuse("inclination", self.inclination, "within ±π/2 rad");
        }
        Ok(())
    }

    /// Inertial number I `[-]` of the steady flow, the same at every height; none where there is no steady flow.
    pub fn inertial_number(&self) -> Option<f64> {
        let tangent = libm::tan(self.inclination);
        (tangent >= self.grains.static_friction && tangent < self.grains.limiting_friction).then(|| {
            self.grains.reference_inertia * (tangent - self.grains.static_friction)
                / (self.grains.limiting_friction - tangent)
        })
    }

    /// Velocity u `[m/s]` at a height y `[m]` above the bed, equation (36); that of the surface above the layer.
    pub fn velocity(&self, height: f64) -> Option<f64> {
        let depth = self.depth_below_surface(height);
        let integral = self.layer_height * self.layer_height.sqrt() - depth * depth.sqrt();
        Some(2.0 / 3.0 * self.inertial_number()? * self.fall_scale() / self.grains.grain_diameter * integral)
    }

    /// Shear rate du/dy `[1/s]` at a height `[m]`.
    pub fn shear_rate(&self, height: f64) -> Option<f64> {
        Some(
            self.inertial_number()? * self.fall_scale() / self.grains.grain_diameter
                * self.depth_below_surface(height).sqrt(),
        )
    }

    /// Velocity u(h) `[m/s]` at the surface.
    pub fn surface_velocity(&self) -> Option<f64> {
        self.velocity(self.layer_height)
    }

    /// Depth mean Ū = (3/5) u(h) `[m/s]` of the velocity, equation (37).
    pub fn depth_mean(&self) -> Option<f64> {
        Some(0.6 * self.surface_velocity()?)
    }

    /// Bulk density φ ρ_s `[kg/m³]`.
    pub fn bulk_density(&self) -> f64 {
        self.solid_fraction * self.grains.grain_density
    }

    /// Pressure ρ g cosθ (h − y) `[Pa]` at a height `[m]`, steady or not.
    pub fn pressure(&self, height: f64) -> f64 {
        self.bulk_density() * self.gravity * libm::cos(self.inclination) * self.depth_below_surface(height)
    }

    /// Shear stress ρ g sinθ (h − y) `[Pa]` at a height `[m]` of the steady flow.
    pub fn shear_stress(&self, height: f64) -> f64 {
        self.bulk_density() * self.gravity * libm::sin(self.inclination) * self.depth_below_surface(height)
    }

    /// h − y `[m]`, 0 above the layer.
    fn depth_below_surface(&self, height: f64) -> f64 {
        (self.layer_height - height).max(0.0)
    }

    /// √(φ g cosθ) `[m^½/s]`.
    fn fall_scale(&self) -> f64 {
        (self.solid_fraction * self.gravity * libm::cos(self.inclination)).sqrt()
    }
}

/// Glass beads of Table 1, 10 mm deep, at a slope in degrees.
#[cfg(test)]
pub(crate) fn glass_beads(degrees: f64) -> BagnoldProfile {
    BagnoldProfile {
        layer_height: 0.01,
        inclination: degrees.to_radians(),
        gravity: 9.81,
        grains: MuI {
            static_friction: 0.382,
            limiting_friction: 0.643,
            reference_inertia: 0.279,
            grain_diameter: 0.5e-3,
            grain_density: 2500.0,
        },
        solid_fraction: 0.6,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::one_dimension::table::{number, rows};

    #[test]
    fn momentum_balance_holds_with_a_differentiated_velocity() {
        // μ(I) p from a finite difference of u and the friction law itself must carry the weight above.
        let layer = glass_beads(24.0);
        for k in 1..20 {
            let (height, step) = (0.0005 * f64::from(k), 1e-7);
            let velocity = |y: f64| layer.velocity(y).expect("steady");
            let shear_rate = (velocity(height + step) - velocity(height - step)) / (2.0 * step);
            assert!((shear_rate / layer.shear_rate(height).expect("steady") - 1.0).abs() < 1e-6);
            let inertia =
                shear_rate * layer.grains.grain_diameter / (layer.pressure(height) / layer.grains.grain_density).sqrt();
            let friction = 0.382 + (0.643 - 0.382) / (1.0 + 0.279 / inertia);
            let weight = 1500.0 * 9.81 * libm::sin(layer.inclination) * (0.01 - height);
            assert!((friction * layer.pressure(height) / weight - 1.0).abs() < 1e-6);
            assert!((layer.shear_stress(height) / weight - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn agrees_with_the_tabulated_quadrature() {
        let table = rows(include_str!("../../reference-data/bagnold/steady.csv"));
        assert_eq!(table.len(), 4);
        for row in table {
            let slope = number(&row, "slope angle [deg]");
            let layer = glass_beads(slope);
            let close = |value: Option<f64>, name: &str| {
                let expected = number(&row, name);
                assert!((value.expect("steady") / expected - 1.0).abs() < 1e-6, "{name} at {slope}°");
            };
            close(layer.inertial_number(), "inertial number [-]");
            close(layer.depth_mean(), "depth-mean velocity [m/s]");
            close(layer.surface_velocity(), "surface velocity [m/s]");
        }
    }

    #[test]
    fn there_is_no_steady_flow_outside_the_friction_range() {
        for degrees in [0.0, 20.0, 33.0, 34.0] {
            assert_eq!(glass_beads(degrees).velocity(0.005), None, "{degrees}°");
        }
        assert!(glass_beads(34.0).check().is_ok());
        assert_eq!(glass_beads(24.0).velocity(0.0), Some(0.0));
    }

    #[test]
    fn bad_parameters_are_named() {
        let good = glass_beads(24.0);
        for bad in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
            assert!(BagnoldProfile { layer_height: bad, ..good }.check().is_err());
            let error = BagnoldProfile { grains: MuI { limiting_friction: bad, ..good.grains }, ..good }
                .check()
                .expect_err("refused");
            assert!(error.to_string().contains("limiting_friction"), "{error}");
        }
        assert!(BagnoldProfile { inclination: 1.6, ..good }.check().is_err());
    }
}
