//! Liquid in the pores of grains: what of the weight and of a change of volume it takes, and how fast it passes.
//!
//! Mixture of one velocity (Biot 1941, in the form of excess pore pressure): the pressure is p = p′ + p_f, of the grains' contacts and of the
//! liquid beyond its hydrostatic pressure. Both are soft, with half of the mixture's bulk modulus K each:
//!
//! p′ = K_s (ρ φ_0/(ρ_0 φ) − 1), dp_f = K_f (dρ/ρ + ∇·(k/η ∇p_f) dt), K_s = K_f = K/2,
//!
//! with the density ρ of the mixture, ρ_0 at the start, and the plastic solid fraction φ, which dilation changes and elasticity does not. What
//! drains is stored by K_e = K_s K_f/(K_s + K_f) = K/4, so that pressures spread with c_v = K_e k/η. Permeability by Kozeny (1927) and Carman (1937):
//! k = α d² (1 − φ)³/φ², α = 1/180 for spheres.

/// Share of the bulk modulus that the skeleton of grains has `[-]`; the liquid has the rest.
pub const SKELETON_SHARE: f64 = 0.5;
/// Pore diffusion over h²/Δt up to which it is stepped explicitly `[-]`: sums of weights over a neighbourhood are near 5/h².
pub const LARGEST_DIFFUSION: f64 = 0.125;
/// Most steps that pore diffusion may make of one acoustic step `[-]`.
pub const MOST_SUBSTEPS: f64 = 10.0;
/// Solid fractions beyond which the permeability stays as it is `[-]`: Kozeny and Carman's grains touch, and leave pores.
const LOOSEST: f64 = 0.3;
const DENSEST: f64 = 0.75;

/// Grains with their pores full of a liquid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoreLiquid {
    /// Solid fraction φ_0 at the start `[-]`.
    pub solid_fraction: f64,
    /// Diameter d of the grains `[m]`.
    pub grain_diameter: f64,
    /// Density of the grains `[kg/m³]`.
    pub grain_density: f64,
    /// Density of the liquid `[kg/m³]`.
    pub liquid_density: f64,
    /// Viscosity η of the liquid `[Pa·s]`.
    pub liquid_viscosity: f64,
    /// α `[-]`.
    pub permeability_coefficient: f64,
}

impl PoreLiquid {
    /// Density ρ_0 of the mixture at the start `[kg/m³]`.
    #[must_use]
    pub fn mixture_density(&self) -> f64 {
        self.solid_fraction * self.grain_density + (1.0 - self.solid_fraction) * self.liquid_density
    }

    /// Share of the mixture's weight that is not carried by the hydrostatic pressure `[-]`. A grain keeps its buoyant weight, however
    /// loose the mixture becomes.
    #[must_use]
    pub fn buoyant_share(&self) -> f64 {
        self.solid_fraction * (self.grain_density - self.liquid_density) / self.mixture_density()
    }

    /// k/η `[m²/(Pa s)]` at a solid fraction `[-]`.
    #[must_use]
    pub fn conductivity(&self, solid_fraction: f64) -> f64 {
        let fraction = solid_fraction.clamp(LOOSEST, DENSEST);
        let pores = 1.0 - fraction;
        let area = self.permeability_coefficient * self.grain_diameter * self.grain_diameter;
        area * pores * pores * pores / (fraction * fraction * self.liquid_viscosity)
    }

    /// Smoothing length h `[m]` below which pore diffusion makes more than [`MOST_SUBSTEPS`] steps of one acoustic step, which lasts h times
    /// `step_per_length` `[s/m]`.
    #[must_use]
    pub fn least_length(&self, bulk_modulus: f64, step_per_length: f64) -> f64 {
        let diffusivity = self.diffusivity(self.solid_fraction, bulk_modulus);
        diffusivity * step_per_length / (LARGEST_DIFFUSION * MOST_SUBSTEPS)
    }

    /// Largest diffusivity K_f k/η of an undrained pore pressure `[m²/s]` at a solid fraction `[-]` and a bulk modulus `[Pa]`.
    #[must_use]
    pub fn diffusivity(&self, solid_fraction: f64, bulk_modulus: f64) -> f64 {
        (1.0 - SKELETON_SHARE) * bulk_modulus * self.conductivity(solid_fraction)
    }
}
