//! The stream: its depths, its slope and the two materials.

use crate::settling::SettlingGrains;
use serde::{Deserialize, Serialize};

/// A stream over a bed of grains, infinitely long. z is normal to the bed, 0 at the bed's top before anything moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stream {
    /// Slope i = tanθ `[-]`.
    pub slope: f64,
    /// Depth h of the water above z = 0 `[m]`.
    pub flow_depth: f64,
    /// Depth of the bed below z = 0 `[m]`; at its base neither phase slips.
    pub bed_depth: f64,
    /// Height above the base up to which grains are held still while the water seeps through them `[m]`.
    pub held_depth: f64,
    /// Gravity g `[m/s²]`.
    pub gravity: f64,
    /// Density ρ_f of the water `[kg/m³]`.
    pub fluid_density: f64,
    /// Kinematic viscosity ν of the water `[m²/s]`.
    pub kinematic_viscosity: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    pub grain_density: f64,
    /// Diameter d of the grains `[m]`.
    pub grain_diameter: f64,
    /// Diameter of the sphere with the drag of a grain, over d `[-]`; 1 for spheres, less for grains that settle slower.
    pub drag_diameter: f64,
}

impl Stream {
    /// Gravity along the slope, g sinθ `[m/s²]`.
    pub fn driving(&self) -> f64 {
        self.gravity * self.slope / self.root()
    }

    /// Submerged weight of grains that fill the space, (ρ_s − ρ_f) g cosθ `[N/m³]`.
    pub fn submerged_weight(&self) -> f64 {
        (self.grain_density - self.fluid_density) * self.gravity / self.root()
    }

    /// Shear velocity u_* = √(g h i) `[m/s]`.
    pub fn shear_velocity(&self) -> f64 {
        (self.gravity * self.flow_depth * self.slope).sqrt()
    }

    /// Unit of the stresses, ρ_f g h i `[Pa]`: what the water above the bed exerts on it.
    pub fn bed_stress(&self) -> f64 {
        self.fluid_density * self.gravity * self.flow_depth * self.slope
    }

    /// Shields number τ* = h i/((s − 1) d) `[-]`, s = ρ_s/ρ_f.
    pub fn shields_number(&self) -> f64 {
        self.flow_depth * self.slope / ((self.grain_density / self.fluid_density - 1.0) * self.grain_diameter)
    }

    /// Unit of the transport rate, √((s − 1) g d³) `[m²/s]`.
    pub fn transport_unit(&self) -> f64 {
        let d = self.grain_diameter;
        ((self.grain_density / self.fluid_density - 1.0) * self.gravity * d * d * d).sqrt()
    }

    /// Grains as they settle, with the diameter of their drag.
    pub(super) fn settling_grains(&self) -> SettlingGrains {
        SettlingGrains {
            grain_diameter: self.drag_diameter * self.grain_diameter,
            grain_density: self.grain_density,
            fluid_density: self.fluid_density,
            kinematic_viscosity: self.kinematic_viscosity,
            gravity: self.gravity / self.root(),
        }
    }

    /// d √ρ_s `[√(kg/m)]`: I = γ d √ρ_s/√p′.
    pub(super) fn inertia_unit(&self) -> f64 {
        self.grain_diameter * self.grain_density.sqrt()
    }

    /// 1/cosθ.
    fn root(&self) -> f64 {
        (1.0 + self.slope * self.slope).sqrt()
    }
}
