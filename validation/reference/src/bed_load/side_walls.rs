//! The bed's part of the shear stress in a flume between smooth side walls.
//!
//! Vanoni & Brooks 1957, Report E-68, Caltech: the velocity U and the slope S are those of the bed and of the walls; with friction factors
//! f = 8 g R S/U² of the whole section, f_w of smooth walls of the same Re/f and f_b = f + 2 (h/b)(f − f_w) of the bed, whose hydraulic
//! radius is R_b = R f_b/f. Guo & Julien 2005, J. Hydraul. Eng. 131(1), for channels that are smooth throughout.

use std::f64::consts::PI;

/// A steady stream in a rectangular flume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flume {
    /// Width b `[m]`.
    pub width: f64,
    /// Depth h of the water `[m]`.
    pub depth: f64,
    /// Mean velocity U of the section `[m/s]`.
    pub velocity: f64,
    /// Slope S of the energy line `[-]`.
    pub slope: f64,
}

impl Flume {
    /// Hydraulic radius R = b h/(b + 2 h) `[m]`.
    pub fn hydraulic_radius(&self) -> f64 {
        self.width * self.depth / (self.width + 2.0 * self.depth)
    }

    /// The bed's part of the shear stress after Vanoni & Brooks, τ_b/(ρ g h S) `[-]`, at a gravity `[m/s²]` and a kinematic viscosity
    /// `[m²/s]`; between 0 and 1.
    pub fn bed_share(&self, gravity: f64, viscosity: f64) -> f64 {
        let radius = self.hydraulic_radius();
        let whole = 8.0 * gravity * radius * self.slope / (self.velocity * self.velocity);
        let wall = smooth_friction(4.0 * self.velocity * radius / viscosity / whole);
        let bed = whole + 2.0 * self.depth / self.width * (whole - wall);
        (radius * bed / (whole * self.depth)).clamp(0.0, 1.0)
    }

    /// The bed's part of the shear stress where bed and walls are equally smooth `[-]`: second approximation of Guo & Julien.
    pub fn smooth_bed_share(&self) -> f64 {
        let ratio = self.depth / self.width;
        4.0 / PI * libm::atan(libm::exp(-PI * ratio)) + 0.25 * PI * ratio * libm::exp(-ratio)
    }
}

/// Friction factor of a smooth wall after Prandtl, 1/√f = 2 lg(Re √f) − 0.8, at a ratio Re/f `[-]`.
fn smooth_friction(ratio: f64) -> f64 {
    let mut friction = 0.02;
    // a contraction by less than a fifth: 40 steps end at rounding
    for _ in 0..40 {
        let inverse: f64 = 2.0 * libm::log10((ratio * friction * friction.sqrt()).max(100.0)) - 0.8;
        friction = inverse.powi(-2);
    }
    friction
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::shipped_table;

    #[test]
    fn the_measured_shields_numbers_are_those_of_the_bed_alone() {
        let table = shipped_table("bed-load/measured-transport.csv").expect("readable");
        let column = |name| table.numbers(name).expect("numbers");
        let (width, depth, velocity) = (column("width"), column("depth"), column("velocity"));
        let (slope, shields) = (column("slope"), column("Shields number"));
        let (diameter, density) = (column("grain diameter"), column("grain density"));
        let mut errors = [Vec::new(), Vec::new(), Vec::new(), Vec::new()];
        for run in 0..shields.len() {
            let flume = Flume { width: width[run], depth: depth[run], velocity: velocity[run], slope: slope[run] };
            let unit = flume.depth * flume.slope / ((density[run] / 1000.0 - 1.0) * 1e-3 * diameter[run]);
            let radius = flume.hydraulic_radius() / flume.depth;
            let shares = [flume.bed_share(9.81, 1e-6), 1.0, radius, flume.smooth_bed_share()];
            for (errors, share) in errors.iter_mut().zip(shares) {
                errors.push((share * unit / shields[run] - 1.0).powi(2));
            }
        }
        let rms = errors.map(|errors| (errors.iter().sum::<f64>() / errors.len() as f64).sqrt());
        println!(
            "rms of the Shields number's error by Vanoni & Brooks, depth, hydraulic radius, Guo & Julien: {rms:?}"
        );
        assert!(rms[0] < 0.016 && rms[1..].iter().all(|other| *other > 0.1), "{rms:?}");
    }

    #[test]
    fn wide_flumes_have_no_walls_and_equal_roughness_gives_the_hydraulic_radius() {
        let wide = Flume { width: 1e4, depth: 0.1, velocity: 0.5, slope: 0.01 };
        assert!((wide.bed_share(9.81, 1e-6) - 1.0).abs() < 1e-4 && (wide.smooth_bed_share() - 1.0).abs() < 1e-4);
        // a bed as smooth as the walls: f = f_w, so that R_b = R
        let mut flume = Flume { width: 0.3, depth: 0.1, velocity: 0.5, slope: 0.0 };
        let radius = flume.hydraulic_radius();
        let friction = {
            let mut friction: f64 = 0.02;
            for _ in 0..60 {
                friction = (2.0 * libm::log10(4.0 * 0.5 * radius / 1e-6 * friction.sqrt()) - 0.8).powi(-2);
            }
            friction
        };
        flume.slope = friction * 0.25 / (8.0 * 9.81 * radius);
        assert!((flume.bed_share(9.81, 1e-6) - radius / 0.1).abs() < 1e-9);
        // Guo & Julien: 0.7525 at h/b = 0.2
        let narrow = Flume { width: 0.5, ..wide };
        assert!((narrow.smooth_bed_share() - 0.7525).abs() < 1e-3, "{}", narrow.smooth_bed_share());
    }
}
