//! Layer of grains under a viscous liquid on a slope, without particles: the onset and the motion of a submerged avalanche.
//!
//! z is normal to the floor. Grains follow [`ViscousNumberLaw`]; where they dilate they draw water in, and the excess pore
//! pressure p_f changes their effective pressure p′ = P − p_f (`pore_pressure.rs`). Inertia is left out: shear stress and
//! pressure balance the buoyant weight, τ = P tanθ, P = (ρ_s − ρ_f) g cosθ ∫_z φ dz.
//!
//! - cells are Lagrangian: each keeps its grains and swells as they dilate;
//! - ∂φ/∂t = −φ D + ∂_z(A d² γ̇ ∂_z φ): without the diffusion by shear one cell at the floor takes all shear of a dense layer,
//!   whatever its height; it relaxes the fraction and moves no grains;
//! - the midpoint rule for φ, with a step that changes it by at most [`SubmergedLayer::largest_fraction_change`].
//!
//! The law's constants and the permeability are published; no number is fitted to avalanches.

mod column;
mod consolidation;
mod law;
mod pore_pressure;
#[cfg(test)]
mod tests;

pub use column::{SubmergedColumn, SubmergedProfile};
pub use consolidation::drained_pressure;
pub use law::{GrainFlow, ViscousNumberLaw};

use bagnold_solver::parameter::{between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A submerged layer and how it is computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SubmergedLayer {
    /// Slope angle θ `[°]`.
    #[schemars(transform = between(0.0, 60.0, "25 was measured"))]
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = positive("give it in m/s², such as 9.81"))]
    pub gravity: f64,
    /// Depth h at the start `[m]`.
    #[schemars(transform = between(1e-4, 10.0, "give it in metres, such as 0.0049"))]
    pub depth: f64,
    /// Diameter d of the grains `[m]`.
    #[schemars(transform = between(1e-6, 0.1, "give it in metres, such as 1.6e-4"))]
    pub grain_diameter: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2500"))]
    pub grain_density: f64,
    /// Density ρ_f of the liquid `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1041"))]
    pub liquid_density: f64,
    /// Viscosity η of the liquid `[Pa·s]`.
    #[schemars(transform = between(1e-4, 1e3, "give it in Pa·s, such as 0.096"))]
    pub viscosity: f64,
    /// Coefficient α of the permeability α d² (1 − φ)³/φ² `[-]`.
    #[schemars(transform = between(1e-5, 1.0, "1/180 by Kozeny and Carman"))]
    pub permeability_coefficient: f64,
    /// Coefficient A of the diffusion A d² γ̇ of the solid fraction by shear `[-]`.
    #[schemars(transform = between(0.0, 100.0, "1 spreads shear over a few grains; 0 for none"))]
    pub fraction_diffusion: f64,
    /// Compressibility S of the skeleton `[1/Pa]`; 0 for none.
    #[schemars(transform = between(0.0, 1.0, "1e-4 stores water for seconds; 0 for none"))]
    pub compressibility: f64,
    /// Number of cells over the depth.
    #[schemars(transform = between(2.0, 2000.0, "40 are used beside the experiment"))]
    pub cells: usize,
    /// Largest change of the solid fraction in a step `[-]`.
    #[schemars(transform = between(1e-7, 0.01, "5e-5 leaves 0.1 % of an onset time"))]
    pub largest_fraction_change: f64,
    /// Longest step `[s]`.
    #[schemars(transform = between(1e-3, 1e3, "give it in s, such as 0.5"))]
    pub longest_step: f64,
    /// Friction and dilatancy.
    pub law: ViscousNumberLaw,
}

impl SubmergedLayer {
    /// Glass beads in a viscous liquid on 25°, the experiment of Pailha, Nicolas & Pouliquen (2008).
    pub const EXPERIMENT: Self = Self {
        slope_angle: 25.0,
        gravity: 9.81,
        depth: 4.9e-3,
        grain_diameter: 160e-6,
        grain_density: 2500.0,
        liquid_density: 1041.0,
        viscosity: 0.096,
        permeability_coefficient: 1.0 / 180.0,
        fraction_diffusion: 1.0,
        compressibility: 0.0,
        cells: 40,
        largest_fraction_change: 5e-5,
        longest_step: 0.5,
        law: ViscousNumberLaw::GLASS_BEADS,
    };

    /// Slope tanθ `[-]`.
    #[must_use]
    pub fn slope(&self) -> f64 {
        libm::tan(self.slope_angle.to_radians())
    }

    /// Permeability k at a solid fraction `[m²]`.
    #[must_use]
    pub fn permeability(&self, fraction: f64) -> f64 {
        let pores = 1.0 - fraction;
        let grain = self.grain_diameter / fraction;
        self.permeability_coefficient * grain * grain * pores * pores * pores
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

    /// Consolidation coefficient k/(η S) at a solid fraction `[m²/s]`.
    #[must_use]
    pub fn consolidation_coefficient(&self, fraction: f64) -> f64 {
        self.permeability(fraction) / (self.viscosity * self.compressibility)
    }
}
