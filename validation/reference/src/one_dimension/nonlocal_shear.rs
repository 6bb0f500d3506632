//! Steady shear of grains of nonlocal granular fluidity between two ends, under stresses that the balance of momentum gives.
//!
//! A² d² g″ + R(μ) g − c μ g² = 0 with μ(y) and p(y) prescribed (symbols of [`super::NonlocalLayer`]), y from the near end, which flows
//! fastest, to the far end, which stands still; du/dy = −g μ. Three flows have such stresses whatever the law:
//!
//! - a vertical chute between walls at ±W under a uniform pressure p: τ = ρ g y from the middle, so μ = μ_w y/W with μ_w = ρ g W/p.
//! - plane shear under gravity, below a plate with the load p_0 that drags with the traction τ: μ = τ/(p_0 + ρ g y).
//! - a heap between rough side walls a width B apart, inclined by θ: μ = tanθ − μ_B y/B (Jop, Forterre & Pouliquen 2005, J. Fluid Mech.
//!   541), p = ρ g cosθ y.
//!
//! For μ < μ_s a local law is at rest. Here the flow decays there, over ξ(μ) = A d/√|R| where μ no longer changes, at least over
//! ξ(0) = A d √(μ_2/(Δμ μ_s)).

use super::LayerError;
use super::fluidity_balance::steady_fluidity;
use bagnold_solver::material::rheology::MuI;
use bagnold_solver::material::rheology::field::FieldBoundary;

/// Source of the stresses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShearStress {
    /// A vertical chute from its middle to a wall.
    Chute {
        /// Pressure `[Pa]`, the same everywhere.
        pressure: f64,
        /// μ_w = ρ g W/p at the wall `[-]`.
        wall_friction: f64,
    },
    /// Grains below a plate that drags them.
    UnderGravity {
        /// Pressure below the plate `[Pa]`.
        load: f64,
        /// Shear stress of the plate `[Pa]`.
        traction: f64,
        /// Weight ρ g of the grains `[N/m³]`.
        weight: f64,
    },
    /// A deep heap with a free surface between side walls.
    Heap {
        /// tanθ of the surface `[-]`.
        slope: f64,
        /// Weight across the surface, ρ g cosθ `[N/m³]`.
        weight: f64,
        /// Rise of the side walls' friction with depth μ_B/B `[1/m]`.
        side_friction: f64,
    },
}

/// Grains in shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonlocalShear {
    /// The local law.
    pub grains: MuI,
    /// Amplitude A `[-]` of the cooperation.
    pub cooperativity: f64,
    /// Distance of the far end from the near one `[m]`: half the width of a chute.
    pub thickness: f64,
    /// The stresses.
    pub stress: ShearStress,
    /// Boundary conditions of g at the near and the far end.
    pub ends: [FieldBoundary; 2],
}

/// The steady flow over the distance from the near end.
#[derive(Clone, Debug, PartialEq)]
pub struct NonlocalShearProfile {
    /// Distances of the cells' centres from the near end `[m]`.
    pub distances: Vec<f64>,
    /// Stress ratio μ there `[-]`.
    pub frictions: Vec<f64>,
    /// Fluidity g there `[1/s]`.
    pub fluidities: Vec<f64>,
    /// Velocity there `[m/s]`.
    pub velocities: Vec<f64>,
    /// Velocity at the near end `[m/s]`.
    pub fastest: f64,
}

impl ShearStress {
    /// Pressure `[Pa]` and stress ratio `[-]` at a distance from the near end `[m]` of grains of a thickness `[m]`.
    pub fn at(&self, distance: f64, thickness: f64) -> (f64, f64) {
        match *self {
            Self::Chute { pressure, wall_friction } => (pressure, wall_friction * distance / thickness),
            Self::UnderGravity { load, traction, weight } => {
                let pressure = load + weight * distance;
                (pressure, traction / pressure)
            }
            Self::Heap { slope, weight, side_friction } => {
                (weight * distance, (slope - side_friction * distance).max(0.0))
            }
        }
    }

    /// Values with their names that must be positive.
    fn parameters(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Chute { pressure, wall_friction } => vec![("pressure", pressure), ("wall_friction", wall_friction)],
            Self::UnderGravity { load, traction, weight } => {
                vec![("load", load), ("traction", traction), ("weight", weight)]
            }
            Self::Heap { slope, weight, side_friction } => {
                vec![("slope", slope), ("weight", weight), ("side_friction", side_friction)]
            }
        }
    }
}

impl NonlocalShear {
    /// The steady flow, solved on a number of cells; at rest where no fluidity can grow.
    ///
    /// # Errors
    /// A parameter out of its range, a stress ratio from μ_2 on, or a Newton's method that does not converge.
    pub fn steady(&self, cells: usize) -> Result<NonlocalShearProfile, LayerError> {
        let values = [("thickness", self.thickness), ("grain_diameter", self.grains.grain_diameter)];
        LayerError::unless_positive(values.into_iter().chain(self.stress.parameters()))?;
        LayerError::unless_several(cells)?;
        let width = self.thickness / cells as f64;
        let distances: Vec<f64> = (0..cells).map(|cell| (cell as f64 + 0.5) * width).collect();
        let stresses: Vec<(f64, f64)> = distances.iter().map(|&y| self.stress.at(y, self.thickness)).collect();
        if let Some(&(_, value)) = stresses.iter().find(|stress| stress.1 >= self.grains.limiting_friction) {
            let rule = "below limiting_friction everywhere";
            return Err(LayerError::Parameter { field: "stress ratio", value, rule });
        }
        let fluidities = steady_fluidity((&self.grains, self.cooperativity), width, &stresses, self.ends)?;
        let frictions: Vec<f64> = stresses.iter().map(|stress| stress.1).collect();
        let mut velocities = vec![0.0; cells];
        let mut beyond = 0.0;
        for cell in (0..cells).rev() {
            let growth = width * fluidities[cell] * frictions[cell];
            velocities[cell] = beyond + 0.5 * growth;
            beyond += growth;
        }
        Ok(NonlocalShearProfile { distances, frictions, fluidities, velocities, fastest: beyond })
    }
}

impl NonlocalShearProfile {
    /// A quantity of the cells at a distance from the near end `[m]`, linear between cells and constant beyond them.
    fn interpolated(&self, values: &[f64], distance: f64) -> f64 {
        let width = 2.0 * self.distances[0];
        let place = (distance / width - 0.5).clamp(0.0, (values.len() - 1) as f64);
        let before = (place as usize).min(values.len() - 2);
        let part = place - before as f64;
        values[before] + part * (values[before + 1] - values[before])
    }

    /// Velocity `[m/s]` at a distance from the near end `[m]`: that of the near end there, 0 at the far one.
    pub fn velocity(&self, distance: f64) -> f64 {
        let first = self.distances[0];
        let thickness = 2.0 * first * self.distances.len() as f64;
        let last = self.velocities[self.velocities.len() - 1];
        if distance < first {
            return self.fastest + (distance / first).max(0.0) * (self.velocities[0] - self.fastest);
        }
        if distance > thickness - first {
            return last * ((thickness - distance) / first).max(0.0);
        }
        self.interpolated(&self.velocities, distance)
    }

    /// Shear rate g μ `[1/s]` at a distance from the near end `[m]`.
    pub fn shear_rate(&self, distance: f64) -> f64 {
        self.interpolated(&self.fluidities, distance) * self.interpolated(&self.frictions, distance)
    }

    /// Distance from the far end `[m]` within which the velocity relative to the near end falls by e: the layer in which a chute
    /// shears at its wall. None at rest.
    pub fn wall_layer(&self) -> Option<f64> {
        let lagging = self.fastest * (1.0 - (-1.0_f64).exp());
        if self.fastest <= 0.0 {
            return None;
        }
        let width = 2.0 * self.distances[0];
        // velocities fall from the near end to the far one
        let beyond = self.velocities.iter().position(|&velocity| velocity < lagging)?;
        let (near, far) = match beyond {
            0 => return Some(width * self.distances.len() as f64),
            cell => (self.velocities[cell - 1], self.velocities[cell]),
        };
        let distance = self.distances[beyond] - width * (lagging - far) / (near - far);
        Some(width * self.distances.len() as f64 - distance)
    }
}

#[cfg(test)]
#[path = "nonlocal_shear_tests.rs"]
mod tests;
