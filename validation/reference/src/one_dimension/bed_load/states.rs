//! The steady state from two starts, at rest and fast: a state that remembers its start is not the only one.

use super::profile::LayerState;
use super::{BedLoadLayer, InitialVelocity};
use crate::one_dimension::LayerError;

/// Difference of two states, relative, below which they are one `[-]`.
pub const SAME_STATE: f64 = 1e-3;

/// Speed of a fast start over u_* `[-]`: that of clear water a third of the depth above a rough bed.
const FAST: f64 = 15.0;

/// Where two starts lead.
#[derive(Debug, Clone, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "made once a layer and taken apart at once")]
pub enum SteadyStates {
    /// To one state.
    One {
        /// From rest.
        state: LayerState,
        /// Difference of that from the fast start `[-]`.
        difference: f64,
    },
    /// To two states, each of them steady.
    Two(Box<TwoStates>),
}

/// Two steady states of one layer.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoStates {
    /// From rest.
    pub slow: LayerState,
    /// From a fast start.
    pub fast: LayerState,
    /// Their difference `[-]`.
    pub difference: f64,
}

impl SteadyStates {
    /// Of the states from rest and from a fast start.
    #[must_use]
    pub fn of(slow: LayerState, fast: LayerState) -> Self {
        let difference = slow.start_difference(&fast);
        if difference <= SAME_STATE {
            Self::One { state: slow, difference }
        } else {
            Self::Two(Box::new(TwoStates { slow, fast, difference }))
        }
    }

    /// The state from rest.
    #[must_use]
    pub fn slow(&self) -> &LayerState {
        match self {
            Self::One { state, .. } => state,
            Self::Two(states) => &states.slow,
        }
    }

    /// The state from the fast start, if it is another.
    #[must_use]
    pub fn second(&self) -> Option<&LayerState> {
        match self {
            Self::One { .. } => None,
            Self::Two(states) => Some(&states.fast),
        }
    }

    /// Difference between the starts `[-]`.
    #[must_use]
    pub fn difference(&self) -> f64 {
        match self {
            Self::One { difference, .. } => *difference,
            Self::Two(states) => states.difference,
        }
    }

    /// The one state.
    ///
    /// # Errors
    /// If there are two.
    pub fn single(self) -> Result<LayerState, LayerError> {
        match self {
            Self::One { state, .. } => Ok(state),
            Self::Two(states) => Err(LayerError::TwoStates {
                slow: states.slow.transport(),
                fast: states.fast.transport(),
                difference: states.difference,
            }),
        }
    }
}

impl BedLoadLayer {
    /// The steady states from rest and from a fast start.
    ///
    /// # Errors
    /// Parameters out of range, a bed that slides on its base, or no steady state from one of the starts.
    pub fn steady_states(&self) -> Result<SteadyStates, LayerError> {
        self.steady_states_unless(&|| false)
    }

    /// [`Self::steady_states`], unless `stopped` says between two steps that they are no longer wanted.
    ///
    /// # Errors
    /// Those of [`Self::steady_states`]; [`LayerError::NotSteady`] if it was stopped.
    pub fn steady_states_unless(&self, stopped: &dyn Fn() -> bool) -> Result<SteadyStates, LayerError> {
        let slow = self.steady_unless(InitialVelocity::Rest, stopped)?;
        let fast = self.steady_unless(self.fast_start(), stopped)?;
        Ok(SteadyStates::of(slow, fast))
    }
}

impl BedLoadLayer {
    /// A start that is faster than any steady state.
    #[must_use]
    pub fn fast_start(&self) -> InitialVelocity {
        InitialVelocity::Moving(FAST * self.stream.shear_velocity())
    }
}

impl LayerState {
    /// Relative difference from the state of another start: the largest of those of q*, u_f and φ u_s `[-]`.
    #[must_use]
    pub fn start_difference(&self, other: &Self) -> f64 {
        let transport = (other.transport() / self.transport() - 1.0).abs();
        let profiles = self.difference(other, f64::NEG_INFINITY);
        if transport.is_nan() { profiles } else { transport.max(profiles) }
    }
}
