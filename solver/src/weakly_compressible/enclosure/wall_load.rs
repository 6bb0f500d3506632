//! Walls under a load: a force presses a wall along one direction, in which it moves freely.
//!
//! M dV/dt = F − R − M r V
//!
//! with the mass M, the force F of the load, the force R of the flow and the rate r of a damper that takes nothing at rest. Gravity does not
//! act on the wall. The velocity of a step follows from the impulses that the wall has given to the flow since the last one, contacts of
//! that step included: over a run their sum is the impulse of the load and the damper less the momentum of the wall, up to rounding.

use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// Relative error of a unit vector, and of a place on a facet over the range of contact `[-]`: walls slide along each other.
pub(super) const ROUNDING: f64 = 1e-6;

/// Load on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallLoad<const D: usize> {
    /// Unit vector along which it presses and the wall moves `[-]`.
    pub direction: Vector<D>,
    /// Force `[N]`, per metre of depth in 2-D.
    pub force: f64,
    /// Mass of the wall `[kg]`, per metre of depth in 2-D.
    pub mass: f64,
    /// Rate of the damper `[1/s]`.
    pub damping: f64,
    /// Travel from the place of the facets to the start `[m]`.
    pub travel: f64,
}

impl<const D: usize> WallLoad<D> {
    /// Whether it can move a wall.
    pub(super) fn is_sound(&self) -> bool {
        let finite = self.force.is_finite() && self.travel.is_finite() && self.damping >= 0.0;
        finite && self.mass > 0.0 && (self.direction.norm() - 1.0).abs() < ROUNDING
    }
}

/// State of a wall under a load; zero of other walls.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct WallTravel {
    /// Distance from the place of the facets `[m]`.
    pub(super) distance: f64,
    /// `[m/s]`
    pub(super) speed: f64,
    /// Impulse along the load that the flow had got at the last step `[kg m/s]`.
    given: f64,
}

impl WallTravel {
    /// Start under a load.
    pub(super) fn of<const D: usize>(load: Option<&WallLoad<D>>) -> Self {
        Self { distance: load.map_or(0.0, |load| load.travel), ..Self::default() }
    }

    /// Takes a step `[s]`, after the flow has got an impulse along the load `[kg m/s]`.
    pub(super) fn advance<const D: usize>(&mut self, load: &WallLoad<D>, given: f64, time_step: f64) {
        let pushed = load.force * time_step - (given - self.given);
        self.speed = (self.speed + pushed / load.mass) / (1.0 + load.damping * time_step);
        self.distance += self.speed * time_step;
        self.given = given;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_falls_freely_and_a_damper_ends_at_its_speed() {
        let load =
            WallLoad::<2> { direction: Vector::<2>::new(0.0, -1.0), force: 6.0, mass: 2.0, damping: 0.0, travel: 0.5 };
        let mut travel = WallTravel::of(Some(&load));
        (0..1000).for_each(|_| travel.advance(&load, 0.0, 1e-3));
        assert!((travel.speed - 3.0).abs() < 1e-12 && (travel.distance - 2.0).abs() < 2e-3, "{travel:?}");
        // an impulse to the flow is the wall's loss
        travel.advance(&load, 6.0, 0.0);
        assert!(travel.speed.abs() < 1e-12);
        let damped = WallLoad { damping: 1e3, ..load };
        (0..100).for_each(|_| travel.advance(&damped, 6.0, 1e-2));
        assert!((travel.speed - 3e-3).abs() < 1e-9, "F/(M r): {travel:?}");
    }
}
