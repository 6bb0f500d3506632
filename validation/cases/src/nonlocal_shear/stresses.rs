//! The stresses of a flow, which the balance of momentum gives, and the steady flow under them.

use super::channel::STIFFNESS;
use super::exact::{CELLS, ExactShear, distance, local_profile};
use super::flow::{Drive, MOST_FRICTION, NonlocalShearFlow, ShearedGrains};
use crate::reference::one_dimension::{LayerError, NonlocalShear, ShearStress};
use bagnold_solver::material::rheology::field::FieldBoundary;

/// Halvings of a bracket, which leave less than rounding of the solution.
const HALVINGS: usize = 40;

impl NonlocalShearFlow {
    /// Distance of its walls, or of its surface from the bed `[m]`.
    pub fn width(&self) -> f64 {
        let thickness = self.thickness * self.diameter();
        if self.drive == Drive::Chute { 2.0 * thickness } else { thickness }
    }

    /// Distance `[m]` from where it flows fastest, the middle of a chute, the plate or the surface, of a height above the lower wall `[m]`.
    pub fn distance(&self, height: f64) -> f64 {
        distance(self.drive == Drive::Chute, self.thickness * self.diameter(), height)
    }

    /// Gravity along the walls and across them `[m/s²]`.
    pub fn driving(&self, grains: &ShearedGrains) -> [f64; 2] {
        match self.drive {
            Drive::Chute => {
                // the compression makes the grains denser by p/K
                let density = grains.density * (1.0 + 1.0 / STIFFNESS);
                [self.wall_friction * grains.load / (density * (self.thickness * self.diameter())), 0.0]
            }
            Drive::DraggedBed => [0.0, -self.gravity],
            Drive::Heap => {
                let inclination = self.slope_angle.to_radians();
                [self.gravity * libm::sin(inclination), -self.gravity * libm::cos(inclination)]
            }
        }
    }

    /// Pressure at a height `[Pa]`.
    pub fn pressure(&self, grains: &ShearedGrains, height: f64) -> f64 {
        match self.drive {
            Drive::Chute => grains.load,
            Drive::DraggedBed => grains.load + grains.density * self.gravity * self.distance(height),
            Drive::Heap => -grains.density * self.driving(grains)[1] * self.distance(height).max(0.0),
        }
    }

    /// The steady flow: of a chute at its friction, below a plate with the traction at which the plate moves as it does; none
    /// where there is no such flow.
    pub fn steady(&self, grains: &ShearedGrains) -> Option<ExactShear> {
        let friction = match self.drive {
            Drive::Chute => self.wall_friction,
            Drive::DraggedBed => self.friction_of(grains, self.plate_speed()).ok().flatten()?,
            // beyond μ_2 no law of these grains bears the weight
            Drive::Heap => {
                Some(libm::tan(self.slope_angle.to_radians())).filter(|slope| *slope < self.law().limiting_friction)?
            }
        };
        let shear = self.stressed(grains, friction);
        let profile = if self.is_local() { local_profile(&shear) } else { shear.steady(CELLS).ok()? };
        (profile.fastest > 0.0).then_some(ExactShear { shear, profile })
    }

    /// The stresses under a friction of the walls or the plate, or a slope of the surface `[-]`.
    fn stressed(&self, grains: &ShearedGrains, friction: f64) -> NonlocalShear {
        let (load, law) = (grains.load, self.law());
        let (stress, near) = match self.drive {
            Drive::Chute => (ShearStress::Chute { pressure: load, wall_friction: friction }, FieldBoundary::NoFlux),
            Drive::DraggedBed => {
                let weight = grains.density * self.gravity;
                (ShearStress::UnderGravity { load, traction: friction * load, weight }, FieldBoundary::Vanishing)
            }
            Drive::Heap => {
                let weight = -grains.density * self.driving(grains)[1];
                let side_friction = self.side_walls().friction_per_width();
                (ShearStress::Heap { slope: friction, weight, side_friction }, law.surface)
            }
        };
        NonlocalShear {
            grains: law.local(),
            cooperativity: law.cooperativity,
            thickness: self.thickness * law.grain_diameter,
            stress,
            ends: [near, FieldBoundary::Vanishing],
        }
    }

    /// Friction of the walls or the plate `[-]` at which the flow is as fast as is asked for `[m/s]`; none beyond what it can be.
    ///
    /// # Errors
    /// A solution that does not converge.
    pub fn friction_of(&self, grains: &ShearedGrains, fastest: f64) -> Result<Option<f64>, LayerError> {
        let law = self.law();
        let (mut slow, mut fast) = (law.static_friction, MOST_FRICTION * law.limiting_friction);
        if self.stressed(grains, fast).steady(CELLS)?.fastest < fastest {
            return Ok(None);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (slow + fast);
            let reached = self.stressed(grains, middle).steady(CELLS)?.fastest;
            if reached < fastest { slow = middle } else { fast = middle }
        }
        Ok(Some(fast))
    }
}

#[cfg(test)]
#[path = "stresses_tests.rs"]
mod tests;
