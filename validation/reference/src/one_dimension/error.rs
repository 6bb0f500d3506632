//! Errors of a layer without a solution.

/// A layer that cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LayerError {
    /// A parameter of a reference solution is outside its range.
    #[error("compute the reference solution: {field} is {value}, but must be {rule}")]
    Parameter {
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        value: f64,
        /// Allowed range, completing "must be …".
        rule: &'static str,
    },
    /// A time step of the 1-D solver did not converge.
    #[error(
        "compute the layer's motion at t = {time} s: the residual stays at {residual} m/s; use a shorter time step"
    )]
    NotConverged {
        /// Time at the start of the step `[s]`.
        time: f64,
        /// Largest residual `[m/s]`.
        residual: f64,
    },
    /// Two starts lead to two steady states.
    #[error(
        "compute the steady layer: it has two states, q* = {slow:.3e} from rest and {fast:.3e} from a fast start, which \
         differ by {difference:.1e}; move away from the onset of motion"
    )]
    TwoStates {
        /// Transport from rest `[-]`.
        slow: f64,
        /// Transport from the fast start `[-]`.
        fast: f64,
        /// Relative difference of the states `[-]`.
        difference: f64,
    },
    /// The bed slides on its base.
    #[error(
        "compute the steady layer: slope is {slope}, but must be below {limit:.5}, where the bed slides on its base; {remedy}"
    )]
    BedSlides {
        /// Slope tanθ `[-]`.
        slope: f64,
        /// Slope from which on it slides `[-]`.
        limit: f64,
        /// Instruction to the user.
        remedy: String,
    },
    /// Time steps did not lead to a steady state.
    #[error("compute the steady layer: {reason} after {steps} time steps; use other cells or milder closures")]
    NotSteady {
        /// Obstacle to the steady state.
        reason: String,
        /// Time steps taken.
        steps: usize,
    },
}

impl LayerError {
    /// Refuses the first of some values, with their names, that is not positive and finite.
    pub(crate) fn unless_positive(values: impl IntoIterator<Item = (&'static str, f64)>) -> Result<(), Self> {
        let rule = "finite and greater than 0";
        let wrong = values.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite()));
        wrong.map_or(Ok(()), |(field, value)| Err(Self::Parameter { field, value, rule }))
    }

    /// Refuses fewer than two cells.
    pub(crate) fn unless_several(cells: usize) -> Result<(), Self> {
        let few = || Self::Parameter { field: "cells", value: cells as f64, rule: "at least 2" };
        if cells >= 2 { Ok(()) } else { Err(few()) }
    }
}
