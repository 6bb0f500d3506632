//! A layer of grains of nonlocal granular fluidity on an incline: when it stops, and its steady flow.
//!
//! A² d² g″ + R(μ) g − c μ g² = 0, R = Δμ (μ − μ_s)/(μ_2 − μ), c = (Δμ/I_0) d √(ρ_s/p), Δμ = μ_2 − μ_s, with μ = tanθ at
//! every height (the momentum of a steady layer) and du/dy = g μ; g = 0 at the bed, at the surface g = 0 or g′ = 0.
//!
//! A small g grows if R exceeds A² d² k² of the first mode, k = π/h for a g that vanishes on both sides and π/(2h)
//! for one that the bed alone holds. So the layer flows if it is thicker than h_stop = π ξ or ½ π ξ, ξ = A d/√R, an exact
//! statement of the model, and solved for θ: R(tanθ) = (A d k)², tanθ = (Δμ μ_s + R μ_2)/(Δμ + R).
//!
//! The steady flow is solved in finite volumes by Newton's method from above, where the equation is concave in g.

use super::fluidity_balance::{cooperativity_length, steady_fluidity};
use super::{BagnoldProfile, LayerError};
use bagnold_solver::material::rheology::field::FieldBoundary;
use std::f64::consts::{FRAC_PI_2, PI};

/// A layer on an incline under the nonlocal law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonlocalLayer {
    /// The layer and the local law.
    pub layer: BagnoldProfile,
    /// Amplitude A `[-]` of the cooperation.
    pub cooperativity: f64,
    /// Boundary condition of g at the surface.
    pub surface: FieldBoundary,
}

/// Fluidity and velocity of a steady layer, from the bed up.
#[derive(Clone, Debug, PartialEq)]
pub struct NonlocalProfile {
    /// Heights of the cells' centres `[m]`.
    pub heights: Vec<f64>,
    /// Fluidity g there `[1/s]`.
    pub fluidities: Vec<f64>,
    /// Velocity there `[m/s]`.
    pub velocities: Vec<f64>,
    /// Velocity of the surface `[m/s]`.
    pub surface_velocity: f64,
}

impl NonlocalProfile {
    /// Depth mean of the velocity `[m/s]`.
    pub fn depth_mean(&self) -> f64 {
        self.velocities.iter().sum::<f64>() / self.velocities.len() as f64
    }

    /// Velocity at a height `[m]`, linear between cells; 0 at the bed and that of the surface above.
    pub fn velocity(&self, height: f64) -> f64 {
        let (cells, first) = (self.heights.len(), self.heights[0]);
        let place = (height - first) / (2.0 * first);
        if place <= 0.0 {
            return self.velocities[0] * (height / first).max(0.0);
        }
        let below = (place as usize).min(cells - 1);
        if below + 1 == cells {
            let part = ((height - self.heights[below]) / first).min(1.0);
            return self.velocities[below] + part * (self.surface_velocity - self.velocities[below]);
        }
        let part = place - below as f64;
        self.velocities[below] + part * (self.velocities[below + 1] - self.velocities[below])
    }
}

impl NonlocalLayer {
    /// Thickness h_stop `[m]` above which a layer on this slope flows; none where the local law stops every layer or none.
    pub fn stopping_thickness(&self) -> Option<f64> {
        let tangent = libm::tan(self.layer.inclination);
        (tangent > self.layer.grains.static_friction && tangent < self.layer.grains.limiting_friction)
            .then(|| self.phase() * cooperativity_length(&self.layer.grains, self.cooperativity, tangent))
    }

    /// Slope `[rad]` below which this layer stops.
    pub fn stopping_angle(&self) -> f64 {
        let (low, high) = (self.layer.grains.static_friction, self.layer.grains.limiting_friction);
        let growth =
            (self.cooperativity * self.layer.grains.grain_diameter * self.phase() / self.layer.layer_height).powi(2);
        libm::atan(((high - low) * low + growth * high) / (high - low + growth))
    }

    /// k h of the first mode `[-]`.
    fn phase(&self) -> f64 {
        match self.surface {
            FieldBoundary::Vanishing => PI,
            FieldBoundary::NoFlux => FRAC_PI_2,
        }
    }

    /// The steady flow, solved on a number of cells; at rest where the layer is too thin or the slope too flat.
    ///
    /// # Errors
    /// A parameter out of its range, a slope from μ_2 on, or a Newton's method that does not converge.
    pub fn steady(&self, cells: usize) -> Result<NonlocalProfile, LayerError> {
        self.layer.check()?;
        LayerError::unless_several(cells)?;
        let friction = libm::tan(self.layer.inclination);
        if friction >= self.layer.grains.limiting_friction {
            let rule = "below the arctangent of limiting_friction";
            return Err(LayerError::Parameter { field: "inclination", value: self.layer.inclination, rule });
        }
        let width = self.layer.layer_height / cells as f64;
        let heights: Vec<f64> = (0..cells).map(|cell| (cell as f64 + 0.5) * width).collect();
        let stresses: Vec<(f64, f64)> = heights.iter().map(|&height| (self.layer.pressure(height), friction)).collect();
        let fluidities = steady_fluidity((&self.layer.grains, self.cooperativity), width, &stresses, self.ends())?;
        let mut below = 0.0;
        let velocities = fluidities
            .iter()
            .map(|fluidity| {
                let middle = below + 0.5 * width * fluidity * friction;
                below += width * fluidity * friction;
                middle
            })
            .collect();
        Ok(NonlocalProfile { heights, fluidities, velocities, surface_velocity: below })
    }

    /// Boundary conditions of g at the bed and at the surface.
    pub(crate) fn ends(&self) -> [FieldBoundary; 2] {
        [FieldBoundary::Vanishing, self.surface]
    }
}

#[cfg(test)]
#[path = "nonlocal_layer_tests.rs"]
mod tests;
