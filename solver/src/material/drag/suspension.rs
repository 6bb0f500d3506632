//! Grains that slip through a fluid, and what the laws make their exchange coefficient from.

/// Inputs of a drag law in a suspension.
#[derive(Clone, Copy, Debug)]
pub(super) struct Suspension {
    /// Volume fraction φ `[-]` of the grains.
    pub(super) solid_fraction: f64,
    /// Magnitude |u_r| = |u_f − u_s| `[m/s]` of the difference of the phases' own velocities.
    pub(super) slip: f64,
    /// Grain diameter d `[m]`.
    pub(super) grain_diameter: f64,
    /// Density ρ_f `[kg/m³]` of the fluid.
    pub(super) fluid_density: f64,
    /// Kinematic viscosity ν `[m²/s]` of the fluid.
    pub(super) kinematic_viscosity: f64,
}

impl Suspension {
    /// Volume fraction ε = 1 − φ `[-]` of the fluid.
    #[inline]
    pub(super) fn voidage(&self) -> f64 {
        1.0 - self.solid_fraction
    }

    /// Reynolds number |u_r| d/ν `[-]` of a grain alone.
    #[inline]
    pub(super) fn grain_reynolds(&self) -> f64 {
        self.slip * self.grain_diameter / self.kinematic_viscosity
    }

    /// Reynolds number R = ε |u_r| d/ν `[-]` of the superficial velocity.
    #[inline]
    pub(super) fn superficial_reynolds(&self) -> f64 {
        self.voidage() * self.grain_reynolds()
    }

    /// Dynamic viscosity over the grain's area μ/d² `[kg/(m³ s)]`: the unit of viscous exchange.
    #[inline]
    pub(super) fn viscous_exchange(&self) -> f64 {
        self.fluid_density * self.kinematic_viscosity / (self.grain_diameter * self.grain_diameter)
    }

    /// K = ¾ C_d φ ρ_f |u_r|/d `[kg/(m³ s)]` from C_d R `[-]` at R = |u_r| d/ν, as ¾ (C_d R) φ μ/d²: finite without slip.
    #[inline]
    pub(super) fn exchange(&self, drag_times_reynolds: f64) -> f64 {
        0.75 * drag_times_reynolds * self.solid_fraction * self.viscous_exchange()
    }
}
