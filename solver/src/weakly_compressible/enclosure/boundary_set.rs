//! Boundaries of a scene beside plane walls: walls of facets, open sides by which the flow leaves, inlets by which it comes in.

use super::facet_wall::FacetWall;
use super::inlet::Inlet;
use super::wall_turn::WallTurn;
use crate::parameter::ParameterProblem;
use crate::run::SceneError;
use crate::vector::Vector;
use crate::weakly_compressible::Numerics;
use serde::{Deserialize, Serialize};

/// Facet walls, open sides and inlets of a scene; by default there are none.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundarySet<const D: usize> {
    /// Walls of facets.
    pub walls: Vec<FacetWall<D>>,
    /// Planes beyond which a particle has left and is taken out.
    pub exits: Exits<D>,
    /// Openings by which material comes in.
    pub inlets: Vec<Inlet<D>>,
    /// Velocity that speeds are relative to `[m/s]`: the length of a step and the largest speed are those of the flow seen from there.
    pub frame: Vector<D>,
}

impl<const D: usize> Default for BoundarySet<D> {
    fn default() -> Self {
        Self { walls: Vec::new(), exits: Exits::default(), inlets: Vec::new(), frame: Vector::zeros() }
    }
}

impl<const D: usize> BoundarySet<D> {
    /// Checks that facets are finite, that tables of motion rise and begin where the facets are, and that inlets let their rates pass
    /// into particles at a spacing `[m]` with a sound speed `[m/s]`.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub(crate) fn check(&self, spacing: f64, sound_speed: f64) -> Result<(), SceneError> {
        for (particle, wall) in self.walls.iter().enumerate() {
            let corners = wall.facets.iter().flat_map(|facet| &facet.corners);
            let begun = wall.motion.displacement(0.0) == Vector::<D>::zeros();
            for (quantity, sound) in [
                ("corner of a wall's segments", corners.into_iter().all(|corner| corner.sum().is_finite())),
                ("table of a wall's motion", wall.motion.is_sound() && begun),
                ("turn of a wall", wall.motion.turn.as_ref().is_none_or(WallTurn::is_sound)),
                ("load of a wall", wall.motion.load.is_none_or(|load| load.is_sound())),
            ] {
                if !sound {
                    let rule = "finite, with times that rise from rest";
                    return Err(SceneError::Value { quantity, particle, value: f64::NAN, rule });
                }
            }
        }
        for (index, inlet) in self.inlets.iter().enumerate() {
            if let Some(problem) = inlet.problem(spacing, sound_speed) {
                return Err(problem.within(&format!("inlets[{index}]")).into());
            }
        }
        Ok(())
    }

    /// Problem of numerics that go neither with facet walls nor with exits or inlets: only the single divergence books forces of walls.
    #[must_use]
    pub fn numerics_problem(&self, numerics: &Numerics) -> Option<ParameterProblem> {
        if *self == (Self { frame: self.frame, ..Self::default() }) {
            return None;
        }
        let operator = numerics.pairwise_operator()?;
        let rule = "\"single-divergence\" or \"uncorrected-divergence\" with walls of segments or open sides";
        let remedy = "choose one of these: only they account for the force on such walls and for outflow";
        Some(ParameterProblem::new("momentum_operator", operator, rule, remedy))
    }
}

/// Planes normal to the axes beyond which a particle has left; infinite where a side is not open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exits<const D: usize> {
    /// Planes below the flow, one per axis `[m]`.
    pub lower: Vector<D>,
    /// Planes above the flow, one per axis `[m]`.
    pub upper: Vector<D>,
}

impl<const D: usize> Default for Exits<D> {
    fn default() -> Self {
        Self { lower: Vector::repeat(f64::NEG_INFINITY), upper: Vector::repeat(f64::INFINITY) }
    }
}

impl<const D: usize> Exits<D> {
    /// The side by which a place lies outside, as [`OutflowBySide::sides`] counts them.
    #[must_use]
    pub fn side(&self, place: &Vector<D>) -> Option<usize> {
        let out = |axis: &usize| place[*axis] < self.lower[*axis] || place[*axis] > self.upper[*axis];
        (0..D).find(out).map(|axis| 2 * axis + usize::from(place[axis] > self.upper[axis]))
    }
}

/// Outflow through one side since the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Outflow<const D: usize> {
    /// Particles.
    pub particles: u64,
    /// Mass `[kg]`, per metre of depth in 2-D.
    pub mass: f64,
    /// Σ m t with the times at which they left `[kg s]`: gravity has given g times that.
    pub mass_times_time: f64,
    /// Momentum `[kg m/s]`.
    pub momentum: Vector<D>,
    /// Impulse that walls, mirrors and contacts had given it `[kg m/s]`.
    pub support: Vector<D>,
    /// Kinetic and elastic energy `[J]`.
    pub energy: f64,
}

/// Outflow through each side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OutflowBySide<const D: usize> {
    /// Outflow by the lower and the upper side of the first axis, then of the next, shape `[2 D]`.
    pub sides: Vec<Outflow<D>>,
}

impl<const D: usize> Default for OutflowBySide<D> {
    fn default() -> Self {
        let (momentum, support) = (Vector::zeros(), Vector::zeros());
        let none = Outflow { particles: 0, mass: 0.0, mass_times_time: 0.0, momentum, support, energy: 0.0 };
        Self { sides: vec![none; 2 * D] }
    }
}

impl<const D: usize> OutflowBySide<D> {
    /// Particles that have left.
    #[must_use]
    pub fn particles(&self) -> u64 {
        self.sides.iter().map(|side| side.particles).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_leaves_by_the_first_side_that_it_lies_beyond() {
        let exits =
            Exits { lower: Vector::<3>::new(-1.0, -2.0, -3.0), upper: Vector::<3>::new(1.0, 2.0, f64::INFINITY) };
        for (place, side) in [
            ([-1.1, 0.0, 0.0], Some(0)),
            ([1.1, 0.0, 0.0], Some(1)),
            ([0.0, -2.1, 0.0], Some(2)),
            ([0.0, 2.1, 0.0], Some(3)),
            ([0.0, 0.0, -3.1], Some(4)),
            ([0.0, 0.0, 9.9], None),
            ([1.0, -2.0, -3.0], None),
            ([0.9, 2.1, -3.1], Some(3)),
        ] {
            assert_eq!(exits.side(&Vector::<3>::from(place)), side, "{place:?}");
        }
        assert_eq!(OutflowBySide::<3>::default().sides.len(), 6);
    }
}
