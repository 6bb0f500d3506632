//! Settling of grains in a fluid at rest: a grain alone from each drag law, and a uniform suspension.
//!
//! A grain alone sinks at the velocity u at which its submerged weight is its drag, |ρ_s − ρ_f| g = c C_d ρ_f u²/d: c = ¾
//! for a sphere, ½ for the planar form (30) of the bed-load paper, in which a particle stands for the area d² and drags by
//! its width d. With the Reynolds number R = u d/ν this is c (C_d R) R = |ρ_s/ρ_f − 1| g d³/ν², the Archimedes number.
//!
//! In a suspension that shares the pressure gradient by volume the slip |u_r| obeys φ (1 − φ) |ρ_s − ρ_f| g = K |u_r|.
//! Without a net flux, φ u_s + (1 − φ) u_f = 0, its grains sink at (1 − φ) |u_r|.
//!
//! The drag laws are the solver's; its tests compare them with values computed by hand, and so do those here.

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use bagnold_solver::material::drag::{DragLaw, Settling};
use bagnold_solver::parameter::positive;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Exponents c Rᵏ of ranges of Reynolds numbers.
struct RichardsonZaki {
    confidence: Confidence,
    /// Upper end of the range, c and k.
    ranges: Vec<(f64, f64, f64)>,
}

static RICHARDSON_ZAKI: LazyLock<RichardsonZaki> = LazyLock::new(|| {
    read_shipped("settling/richardson-zaki.csv", |table| {
        let (coefficients, exponents) = (table.numbers("coefficient")?, table.numbers("exponent")?);
        let ends = table.upper_ends("up to, or open")?;
        let ranges = ends.iter().zip(coefficients).zip(exponents).map(|((&end, &c), &k)| (end, c, k)).collect();
        Ok(RichardsonZaki { confidence: table.metadata.confidence, ranges })
    })
});

/// Confidence in [`richardson_zaki_exponent`]: observed beside a run, never a gate.
pub fn richardson_zaki_confidence() -> Confidence {
    RICHARDSON_ZAKI.confidence
}

/// Form of a grain, which relates its submerged weight to its drag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GrainForm {
    /// A sphere of diameter d: c = ¾.
    Sphere,
    /// A particle of the planar form (30), of the area d² and the width d: c = ½.
    Planar,
}

impl GrainForm {
    /// c `[-]` of |ρ_s − ρ_f| g = c C_d ρ_f u²/d.
    pub fn drag_factor(self) -> f64 {
        match self {
            Self::Sphere => 0.75,
            Self::Planar => 0.5,
        }
    }
}

/// Grains in a fluid under gravity. They sink, or rise if they are the lighter ones: velocities are magnitudes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettlingGrains {
    /// Grain diameter d `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub grain_diameter: f64,
    /// Grain density ρ_s `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub grain_density: f64,
    /// Fluid density ρ_f `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub fluid_density: f64,
    /// Kinematic viscosity ν `[m²/s]` of the fluid.
    #[schemars(transform = positive("give it in m²/s, such as 1e-6 for water"))]
    pub kinematic_viscosity: f64,
    /// Gravity g `[m/s²]`.
    #[schemars(transform = positive("give it in m/s², such as 9.81"))]
    pub gravity: f64,
}

impl SettlingGrains {
    /// Submerged weight per volume |ρ_s − ρ_f| g `[N/m³]`.
    pub fn submerged_weight(&self) -> f64 {
        (self.grain_density - self.fluid_density).abs() * self.gravity
    }

    /// Input of the solver's own settling velocity.
    pub(crate) fn settling(&self) -> Settling {
        Settling {
            submerged_weight: self.submerged_weight(),
            grain_diameter: self.grain_diameter,
            fluid_density: self.fluid_density,
            kinematic_viscosity: self.kinematic_viscosity,
        }
    }

    /// Archimedes number |ρ_s/ρ_f − 1| g d³/ν² `[-]`.
    pub fn archimedes_number(&self) -> f64 {
        let (d, nu) = (self.grain_diameter, self.kinematic_viscosity);
        self.submerged_weight() / self.fluid_density * d * d * d / (nu * nu)
    }

    /// Reynolds number u d/ν `[-]` of a velocity `[m/s]`.
    pub fn reynolds(&self, velocity: f64) -> f64 {
        velocity * self.grain_diameter / self.kinematic_viscosity
    }

    /// Velocity `[m/s]` of Stokes' drag, C_d R = 24.
    pub fn stokes_velocity(&self, form: GrainForm) -> f64 {
        self.archimedes_number() / (24.0 * form.drag_factor()) * self.kinematic_viscosity / self.grain_diameter
    }

    /// Terminal velocity `[m/s]` of a grain alone; none where the law has no drag of one, or beyond the law's range.
    pub fn terminal_velocity(&self, law: DragLaw, form: GrainForm) -> Option<f64> {
        law.drag_times_reynolds(0.0)?;
        let drag = |r: f64| form.drag_factor() * law.drag_times_reynolds(r).unwrap_or(f64::INFINITY) * r;
        let stokes = self.reynolds(self.stokes_velocity(form));
        let reynolds = root_of_increasing(self.archimedes_number(), stokes, drag);
        let velocity = reynolds * self.kinematic_viscosity / self.grain_diameter;
        law.reynolds_range().contains(&reynolds).then_some(velocity)
    }

    /// Slip `[m/s]` at which (C_d R) u is a value ≥ 0 `[m/s]`, which the drag of a grain alone is proportional to. None
    /// where the law has no drag of one.
    pub fn slip_of_drag(&self, law: DragLaw, value: f64) -> Option<f64> {
        let start = value / law.drag_times_reynolds(0.0)?;
        let product = |slip: f64| law.drag_times_reynolds(self.reynolds(slip)).unwrap_or(f64::INFINITY) * slip;
        Some(root_of_increasing(value, start, product))
    }

    /// Slip |u_f − u_s| `[m/s]` of a uniform suspension of a solid fraction φ `[-]` in (0, 1), none outside of it or
    /// beyond the law's range. Spheres: K has no planar form.
    pub fn hindered_slip(&self, law: DragLaw, solid_fraction: f64) -> Option<f64> {
        if !(solid_fraction > 0.0 && solid_fraction < 1.0) {
            return None;
        }
        let drag = |slip: f64| {
            let (d, rho, nu) = (self.grain_diameter, self.fluid_density, self.kinematic_viscosity);
            law.exchange_coefficient(solid_fraction, slip, d, rho, nu) * slip
        };
        let weight = solid_fraction * (1.0 - solid_fraction) * self.submerged_weight();
        let slip = root_of_increasing(weight, self.stokes_velocity(GrainForm::Sphere), drag);
        law.reynolds_range().contains(&self.reynolds(slip)).then_some(slip)
    }

    /// Velocity (1 − φ) |u_r| `[m/s]` at which the grains of a suspension sink in a vessel; none as for the slip.
    pub fn hindered_velocity(&self, law: DragLaw, solid_fraction: f64) -> Option<f64> {
        Some((1.0 - solid_fraction) * self.hindered_slip(law, solid_fraction)?)
    }
}

/// Exponent n `[-]` of Richardson & Zaki (1954), u/u_t = (1 − φ)ⁿ, at the Reynolds number u_t d/ν `[-]` of a grain alone,
/// in a vessel much wider than a grain. Confidence: [`richardson_zaki_confidence`].
pub fn richardson_zaki_exponent(terminal_reynolds: f64) -> f64 {
    let ranges = &RICHARDSON_ZAKI.ranges;
    let found = ranges.iter().find(|range| terminal_reynolds < range.0).or(ranges.last());
    found.map_or(f64::NAN, |&(_, coefficient, exponent)| coefficient * libm::pow(terminal_reynolds, exponent))
}

/// x ≥ 0 with f(x) = target ≥ 0 for an f that grows from f(0) = 0, to the last bit, by doubling an upper bound from
/// `start` on and bisecting. Where f steps down, as a table may, the root is one of its crossings, always the same.
fn root_of_increasing(target: f64, start: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, start);
    while f(high) < target {
        (low, high) = (high, 2.0 * high);
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if f(middle) < target { low = middle } else { high = middle }
    }
}

#[cfg(test)]
#[path = "grains_tests.rs"]
mod tests;
