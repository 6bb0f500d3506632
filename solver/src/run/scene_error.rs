//! Errors of scenes that cannot be simulated.

use crate::domain::{AxisBoundary, Domain};
use crate::parameter::ParameterProblem;

/// A scene that cannot be simulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// No flow particles.
    #[error("the scene has no flow particles")]
    Empty,
    /// Arrays of different lengths.
    #[error("the flow's {array} has {found} entries, but there are {expected} positions")]
    Length {
        /// Name of the array.
        array: &'static str,
        /// Length.
        found: usize,
        /// The number of positions.
        expected: usize,
    },
    /// A field of particles whose law keeps none.
    #[error("the flow gives {found} particles a field, but its law `{law}` has none; leave the field out")]
    NoField {
        /// The law.
        law: &'static str,
        /// Number of values.
        found: usize,
    },
    /// A memory of particles whose law keeps nothing beside its field.
    #[error(
        "the flow gives {found} particles internal variables, but its law `{law}` has none beside its field; leave `memory` out"
    )]
    NoMemory {
        /// The law.
        law: &'static str,
        /// Number of particles with a memory.
        found: usize,
    },
    /// A value that is not finite or not positive where it must be.
    #[error("the {quantity} of particle {particle} is {value}, but must be {rule}")]
    Value {
        /// Name of the quantity.
        quantity: &'static str,
        /// Index of the particle.
        particle: usize,
        /// The value.
        value: f64,
        /// The rule.
        rule: &'static str,
    },
    /// A parameter out of its range, or a choice that another one excludes.
    #[error(transparent)]
    Parameter(#[from] ParameterProblem),
    /// A periodic axis shorter than the neighbour search radius.
    #[error(
        "the period along axis {axis} is {length} m, but must be at least {least} m, the reach of the kernel; make the domain longer or the particles smaller"
    )]
    Period {
        /// Index of the axis.
        axis: usize,
        /// Period.
        length: f64,
        /// The least that works.
        least: f64,
    },
    /// More particles than the neighbour list can address.
    #[error("the scene has {0} particles, more than the neighbour list can address; use larger particles")]
    TooLarge(usize),
}

impl SceneError {
    /// Periods hold the reach of the kernel: no particle may see another one twice.
    pub(crate) fn check_periods<const D: usize>(domain: &Domain<D>, least: f64) -> Result<(), Self> {
        for (axis, boundary) in domain.axes.iter().enumerate() {
            if let AxisBoundary::Periodic { lower, upper } = boundary {
                let length = upper - lower;
                if length.is_nan() || length < least {
                    return Err(Self::Period { axis, length, least });
                }
            }
        }
        Ok(())
    }
}
