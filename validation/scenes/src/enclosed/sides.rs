//! Sides of a scene's domain.

use super::given::PlainData;
use crate::case::ParameterError;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::boundary_set::Exits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Condition at a side of the domain.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DomainSide {
    /// Nothing: walls hold the flow, or it is unbounded.
    #[default]
    None,
    /// A plane of symmetry at this coordinate `[m]`.
    Mirror(f64),
    /// Open side at this coordinate `[m]`: material that crosses it leaves and is counted.
    Open(f64),
    /// The flow comes in again at the other side, periodic too, at its coordinate `[m]`.
    Periodic(f64),
}

impl DomainSide {
    /// Coordinate of the side `[m]`.
    pub(super) fn coordinate(self) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Mirror(place) | Self::Open(place) | Self::Periodic(place) => Some(place),
        }
    }

    /// Coordinate of the plane of symmetry `[m]`.
    fn mirror(self) -> Option<f64> {
        if let Self::Mirror(plane) = self { Some(plane) } else { None }
    }

    /// Coordinate of the open side, through which the flow leaves `[m]`.
    fn open(self) -> Option<f64> {
        if let Self::Open(plane) = self { Some(plane) } else { None }
    }

    pub(super) fn is_periodic(self) -> bool {
        matches!(self, Self::Periodic(_))
    }
}

/// The lower and the upper side along an axis.
pub type SidePair = (DomainSide, DomainSide);

/// All sides of a domain.
pub trait SceneSides<const D: usize>: PlainData + Default {
    /// Names of the lower and the upper side along each axis.
    const NAMES: [(&'static str, &'static str); D];

    /// The lower and the upper side along each axis.
    fn pairs(&self) -> [SidePair; D];

    /// The boundary of the solver along each axis.
    fn axes(&self) -> [AxisBoundary; D] {
        self.pairs().map(|(lower, upper)| match (lower, upper) {
            (DomainSide::Periodic(lower), DomainSide::Periodic(upper)) => AxisBoundary::Periodic { lower, upper },
            _ if lower.mirror().or(upper.mirror()).is_some() => {
                AxisBoundary::Mirror { lower: lower.mirror(), upper: upper.mirror() }
            }
            _ => AxisBoundary::Open,
        })
    }

    /// The planes of the open sides.
    fn exits(&self) -> Exits<D> {
        let mut exits = Exits::default();
        for (axis, (lower, upper)) in self.pairs().into_iter().enumerate() {
            exits.lower[axis] = lower.open().unwrap_or(exits.lower[axis]);
            exits.upper[axis] = upper.open().unwrap_or(exits.upper[axis]);
        }
        exits
    }

    /// Whether any side is a plane of symmetry.
    fn has_mirror(&self) -> bool {
        self.pairs().into_iter().any(|(lower, upper)| lower.mirror().or(upper.mirror()).is_some())
    }

    /// Whether a place lies between them.
    fn hold(&self, place: &Vector<D>) -> bool {
        self.lie_around(place, DomainSide::coordinate)
    }

    /// Whether a place lies between those of them beyond which the flow goes on: periods and planes of symmetry.
    fn continue_to(&self, place: &Vector<D>) -> bool {
        self.lie_around(place, |side| if side.open().is_some() { None } else { side.coordinate() })
    }

    /// Whether a place lies between the planes that they have.
    fn lie_around(&self, place: &Vector<D>, plane_of: fn(DomainSide) -> Option<f64>) -> bool {
        self.pairs().into_iter().enumerate().all(|(axis, (lower, upper))| {
            plane_of(lower).is_none_or(|plane| place[axis] > plane)
                && plane_of(upper).is_none_or(|plane| place[axis] < plane)
        })
    }

    /// A box, by its lower and upper corner `[m]`, as far as they reach at least.
    fn widen(&self, (mut lower, mut upper): (Vector<D>, Vector<D>)) -> (Vector<D>, Vector<D>) {
        for (axis, (below, above)) in self.pairs().into_iter().enumerate() {
            lower[axis] = below.coordinate().map_or(lower[axis], |plane| lower[axis].min(plane));
            upper[axis] = above.coordinate().map_or(upper[axis], |plane| upper[axis].max(plane));
        }
        (lower, upper)
    }

    /// Part of a box, by its lower and upper corner `[m]`, that lies between them.
    fn clip(&self, (mut lower, mut upper): (Vector<D>, Vector<D>)) -> (Vector<D>, Vector<D>) {
        for (axis, (below, above)) in self.pairs().into_iter().enumerate() {
            lower[axis] = below.coordinate().map_or(lower[axis], |plane| lower[axis].max(plane));
            upper[axis] = above.coordinate().map_or(upper[axis], |plane| upper[axis].min(plane));
        }
        (lower, upper)
    }

    /// Refuses a period with one end, and ends in the wrong order.
    ///
    /// # Errors
    /// The side, as a field of `sides`.
    fn check(&self) -> Result<(), ParameterError> {
        for ((lower, upper), (low, high)) in self.pairs().into_iter().zip(Self::NAMES) {
            let (low, high) = (format!("sides.{low}"), format!("sides.{high}"));
            if lower.is_periodic() != upper.is_periodic() {
                let (field, other) = if lower.is_periodic() { (high, low) } else { (low, high) };
                let rule = format!("periodic as `{other}` is");
                return Err(ParameterError::field(&field, "not periodic", &rule, "make both sides periodic"));
            }
            if let (Some(below), Some(above)) = (lower.coordinate(), upper.coordinate())
                && below >= above
            {
                let rule = format!("greater than that of `{low}`, {below} m");
                return Err(ParameterError::field(&high, format!("{above} m"), &rule, "exchange the two"));
            }
        }
        Ok(())
    }
}
