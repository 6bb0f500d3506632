//! Layer of grains under a viscous liquid on a slope, without particles: the onset and the motion of a submerged avalanche.
//!
//! z is normal to the floor. Grains follow [`ViscousNumberLaw`]; where they dilate they draw water in, and the excess pore
//! pressure p_f changes their effective pressure p′ = P − p_f (`pore_pressure.rs`). Inertia is left out: shear stress and
//! pressure balance the buoyant weight, τ = P tanθ, P = (ρ_s − ρ_f) g cosθ ∫_z φ dz.
//!
//! - cells are Lagrangian: each keeps its mass of grains and swells as they dilate;
//! - ∂φ/∂t = −φ D + ∂_z(A d² γ̇ ∂_z φ): shear diffuses the solid fraction, since otherwise one cell at the floor takes all shear of a
//!   dense layer, whatever its height; it relaxes the fraction and moves no grains;
//! - the midpoint rule for φ, with a step that changes it by at most [`SubmergedLayer::largest_fraction_change`].
//!
//! The law's constants and the permeability are published; no number is fitted to the avalanches.

mod column;
mod consolidation;
mod law;
mod pore_pressure;
#[cfg(test)]
mod tests;

pub use column::{SubmergedColumn, SubmergedProfile};
pub use consolidation::drained_pressure;
pub use law::{GrainFlow, ViscousNumberLaw};

use crate::one_dimension::LayerError;
use serde::{Deserialize, Serialize};

/// A submerged layer and how it is computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SubmergedLayer {
    /// Slope angle θ `[°]`.
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Depth h at the start `[m]`.
    pub depth: f64,
    /// Solid fraction φ at the start, uniform `[-]`.
    pub solid_fraction: f64,
    /// Diameter d of the grains `[m]`.
    pub grain_diameter: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    pub grain_density: f64,
    /// Density ρ_f of the liquid `[kg/m³]`.
    pub liquid_density: f64,
    /// Viscosity η of the liquid `[Pa·s]`.
    pub viscosity: f64,
    /// Friction and dilatancy.
    pub law: ViscousNumberLaw,
    /// α of the permeability α d² (1 − φ)³/φ² `[-]`.
    pub permeability_coefficient: f64,
    /// A of the diffusion A d² γ̇ of the solid fraction by shear `[-]`; 0 for none.
    pub fraction_diffusion: f64,
    /// Compressibility S of the skeleton `[1/Pa]`; 0 for incompressible grains.
    pub compressibility: f64,
    /// Number of cells over the depth.
    pub cells: usize,
    /// Largest change of φ in a step `[-]`.
    pub largest_fraction_change: f64,
    /// Longest step `[s]`.
    pub longest_step: f64,
}

impl SubmergedLayer {
    /// α of Kozeny and Carman for spheres `[-]`.
    pub const KOZENY_CARMAN: f64 = 1.0 / 180.0;

    /// tanθ `[-]`.
    #[must_use]
    pub fn slope(&self) -> f64 {
        libm::tan(self.slope_angle.to_radians())
    }

    /// Permeability k at a solid fraction `[m²]`.
    #[must_use]
    pub fn permeability(&self, fraction: f64) -> f64 {
        let pores = 1.0 - fraction;
        self.permeability_coefficient * self.grain_diameter * self.grain_diameter * pores * pores * pores
            / (fraction * fraction)
    }

    /// Pressure P of the buoyant weight at the floor `[Pa]`.
    #[must_use]
    pub fn floor_overburden(&self) -> f64 {
        self.buoyant_weight() * self.solid_fraction * self.depth
    }

    /// (ρ_s − ρ_f) g cosθ `[N/m³]`.
    fn buoyant_weight(&self) -> f64 {
        (self.grain_density - self.liquid_density) * self.gravity * libm::cos(self.slope_angle.to_radians())
    }

    /// Surface velocity of the steady flow, I P h/(2η) at the floor, with I of tanθ and the layer swollen to φ_eq(I) `[m/s]`.
    #[must_use]
    pub fn steady_surface_velocity(&self) -> f64 {
        let viscous_number = self.law.steady_viscous_number(self.slope());
        let depth = self.depth * self.solid_fraction / self.law.equilibrium_fraction(viscous_number);
        0.5 * viscous_number * self.floor_overburden() * depth / self.viscosity
    }

    /// Consolidation coefficient k/(η S) `[m²/s]`.
    #[must_use]
    pub fn consolidation_coefficient(&self) -> f64 {
        self.permeability(self.solid_fraction) / (self.viscosity * self.compressibility)
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// The first that is out of its range.
    pub fn check(&self) -> Result<(), LayerError> {
        let refuse = |field, value, rule| Err(LayerError::Parameter { field, value, rule });
        let positive = [
            ("gravity", self.gravity),
            ("depth", self.depth),
            ("grain_diameter", self.grain_diameter),
            ("liquid_density", self.liquid_density),
            ("viscosity", self.viscosity),
            ("friction_slope", self.law.friction_slope),
            ("permeability_coefficient", self.permeability_coefficient),
            ("largest_fraction_change", self.largest_fraction_change),
            ("longest_step", self.longest_step),
        ];
        for (field, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return refuse(field, value, "finite and greater than 0");
            }
        }
        let not_negative = [("fraction_diffusion", self.fraction_diffusion), ("compressibility", self.compressibility)];
        for (field, value) in not_negative {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(field, value, "finite and not negative");
            }
        }
        if !(self.solid_fraction > 0.0 && self.solid_fraction < 1.0) {
            return refuse("solid_fraction", self.solid_fraction, "between 0 and 1");
        }
        if !(self.grain_density > self.liquid_density && self.grain_density.is_finite()) {
            return refuse("grain_density", self.grain_density, "finite and greater than the liquid's");
        }
        if !(0.0..90.0).contains(&self.slope_angle) {
            return refuse("slope_angle", self.slope_angle, "at least 0 and below 90 degrees");
        }
        if !(2..=2000).contains(&self.cells) {
            return refuse("cells", self.cells as f64, "from 2 to 2000");
        }
        Ok(())
    }
}
