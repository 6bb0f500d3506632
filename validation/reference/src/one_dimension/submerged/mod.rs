//! Layer of grains under a viscous liquid on a slope, without particles: the onset and the motion of a submerged avalanche.
//!
//! z is normal to the floor. Grains follow [`ViscousNumberLaw`]; where they dilate they draw water in, and the excess pore
//! pressure p_f changes their effective pressure p′ = P − p_f (`pore_pressure.rs`). Inertia is left out: shear stress and
//! pressure balance the buoyant weight, τ = P tanθ, P = (ρ_s − ρ_f) g cosθ ∫_z φ dz.
//!
//! - cells are Lagrangian: each keeps its grains and swells as they dilate, ∂φ/∂t = −φ D;
//! - the midpoint rule for φ, with a step that changes it by at most [`SubmergedLayer::largest_fraction_change`].
//!
//! The law's constants and the permeability are published; no number is fitted to avalanches. The study `submerged-slope` has its
//! references from here.

mod column;
mod law;
mod pore_pressure;
#[cfg(test)]
mod tests;

pub use column::SubmergedColumn;
pub use law::{GrainFlow, ViscousNumberLaw};

/// Coefficient of the permeability by Kozeny and Carman `[-]`.
const PERMEABILITY: f64 = 1.0 / 180.0;

/// A submerged layer and how it is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubmergedLayer {
    /// Slope angle θ `[°]`.
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Depth h at the start `[m]`.
    pub depth: f64,
    /// Diameter d of the grains `[m]`.
    pub grain_diameter: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    pub grain_density: f64,
    /// Density ρ_f of the liquid `[kg/m³]`.
    pub liquid_density: f64,
    /// Viscosity η of the liquid `[Pa·s]`.
    pub viscosity: f64,
    /// Compressibility S of the skeleton, above 0 `[1/Pa]`.
    pub compressibility: f64,
    /// Number of cells over the depth.
    pub cells: usize,
    /// Largest change of the solid fraction in a step `[-]`.
    pub largest_fraction_change: f64,
    /// Longest step `[s]`.
    pub longest_step: f64,
    /// Friction and dilatancy.
    pub law: ViscousNumberLaw,
}

impl SubmergedLayer {
    /// Glass beads on 25° as in the experiment of Pailha, Nicolas & Pouliquen (2008), in a liquid thirty times as thin.
    pub const GLASS_BEADS: Self = Self {
        slope_angle: 25.0,
        gravity: 9.81,
        depth: 4.9e-3,
        grain_diameter: 160e-6,
        grain_density: 2500.0,
        liquid_density: 1041.0,
        viscosity: 0.096 / 30.0,
        compressibility: 2.5e-4,
        cells: 40,
        largest_fraction_change: 5e-5,
        longest_step: 0.5 / 30.0,
        law: ViscousNumberLaw::GLASS_BEADS,
    };

    /// Slope tanθ `[-]`.
    #[must_use]
    pub fn slope(&self) -> f64 {
        libm::tan(self.slope_angle.to_radians())
    }

    /// Permeability k = d² (1 − φ)³/(180 φ²) at a solid fraction `[m²]`.
    #[must_use]
    pub fn permeability(&self, fraction: f64) -> f64 {
        let pores = 1.0 - fraction;
        let grain = self.grain_diameter / fraction;
        PERMEABILITY * grain * grain * pores * pores * pores
    }

    /// Pressure P of the buoyant weight at the floor, from the solid fraction at the start `[Pa]`.
    #[must_use]
    pub fn floor_overburden(&self, fraction: f64) -> f64 {
        self.buoyant_weight() * fraction * self.depth
    }

    /// Buoyant weight (ρ_s − ρ_f) g cosθ of a volume of grains `[N/m³]`.
    fn buoyant_weight(&self) -> f64 {
        (self.grain_density - self.liquid_density) * self.gravity * libm::cos(self.slope_angle.to_radians())
    }

    /// Solid fraction of the steady flow, φ_eq(I) with I of tanθ `[-]`.
    #[must_use]
    pub fn steady_fraction(&self) -> f64 {
        self.law.equilibrium_fraction(self.law.steady_viscous_number(self.slope()))
    }

    /// Surface velocity of the steady flow, I P h/(2η) of the swollen layer, from the solid fraction at the start `[m/s]`.
    #[must_use]
    pub fn steady_surface_velocity(&self, fraction: f64) -> f64 {
        let depth = self.depth * fraction / self.steady_fraction();
        let viscous_number = self.law.steady_viscous_number(self.slope());
        0.5 * viscous_number * self.floor_overburden(fraction) * depth / self.viscosity
    }
}
