//! Sides of a scene's domain.

use crate::case::ParameterError;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::weakly_compressible::boundary::enclosure::Exits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is at a side of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DomainSide {
    /// Nothing: walls hold the flow, or it goes on without end.
    None,
    /// A plane of symmetry at this coordinate `[m]`.
    Mirror(f64),
    /// What crosses this coordinate `[m]` has left, and is counted.
    Open(f64),
    /// The flow comes in again at the other side, periodic too, at its coordinate `[m]`.
    Periodic(f64),
}

/// The lower and the upper side along an axis.
pub(in crate::cases) type Pair = (DomainSide, DomainSide);

/// The boundary of the solver along an axis.
pub(in crate::cases) fn boundary(pair: Pair) -> AxisBoundary {
    let mirror = |side| if let DomainSide::Mirror(plane) = side { Some(plane) } else { None };
    match pair {
        (DomainSide::Periodic(lower), DomainSide::Periodic(upper)) => AxisBoundary::Periodic { lower, upper },
        (lower, upper) if mirror(lower).or(mirror(upper)).is_some() => {
            AxisBoundary::Mirror { lower: mirror(lower), upper: mirror(upper) }
        }
        _ => AxisBoundary::Open,
    }
}

/// The planes of the open sides.
pub(in crate::cases) fn exits<const D: usize>(pairs: [Pair; D]) -> Exits<D> {
    let mut exits = Exits::default();
    for (axis, (lower, upper)) in pairs.into_iter().enumerate() {
        let open = |side| if matches!(side, DomainSide::Open(_)) { coordinate(side) } else { None };
        exits.lower[axis] = open(lower).unwrap_or(exits.lower[axis]);
        exits.upper[axis] = open(upper).unwrap_or(exits.upper[axis]);
    }
    exits
}

/// Whether any side is a plane of symmetry.
pub(in crate::cases) fn has_mirror(pairs: &[Pair]) -> bool {
    pairs.iter().any(|(lower, upper)| [lower, upper].iter().any(|side| matches!(side, DomainSide::Mirror(_))))
}

/// Refuses a period with one end, and ends in the wrong order; `names` are the fields' of each axis.
pub(in crate::cases) fn check<const D: usize>(
    pairs: [Pair; D],
    names: [(&str, &str); D],
) -> Result<(), ParameterError> {
    for ((lower, upper), (low, high)) in pairs.into_iter().zip(names) {
        let (low, high) = (format!("sides.{low}"), format!("sides.{high}"));
        let periodic = |side| matches!(side, DomainSide::Periodic(_));
        if periodic(lower) != periodic(upper) {
            let (field, other) = if periodic(lower) { (high, low) } else { (low, high) };
            let rule = format!("periodic as `{other}` is");
            return Err(ParameterError::field(&field, "not periodic", &rule, "a period has two ends"));
        }
        if let (Some(below), Some(above)) = (coordinate(lower), coordinate(upper))
            && below >= above
        {
            let rule = format!("greater than that of `{low}`, {below}");
            return Err(ParameterError::field(&high, above, &rule, "exchange the two"));
        }
    }
    Ok(())
}

/// Where a side stands `[m]`.
pub(in crate::cases) fn coordinate(side: DomainSide) -> Option<f64> {
    match side {
        DomainSide::None => None,
        DomainSide::Mirror(place) | DomainSide::Open(place) | DomainSide::Periodic(place) => Some(place),
    }
}
