//! The steady state from two starts, at rest and fast: a state that remembers its start is not the only one.

use super::profile::LayerState;
use super::{BedLoadLayer, InitialVelocity};
use crate::one_dimension::LayerError;

/// Difference of two states, relative, below which they are one `[-]`.
pub const SAME_STATE: f64 = 1e-3;

/// Speed of a fast start over u_* `[-]`: that of clear water a third of the depth above a rough bed.
const FAST: f64 = 15.0;

/// The steady states from two starts: one, unless they differ by more than [`SAME_STATE`].
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyStates {
    /// State from rest.
    pub slow: LayerState,
    /// State from a fast start.
    pub fast: LayerState,
    /// Difference of the two states `[-]`.
    pub difference: f64,
}

impl SteadyStates {
    /// Pair of the states from rest and from a fast start.
    pub fn of(slow: LayerState, fast: LayerState) -> Self {
        Self { difference: slow.start_difference(&fast), slow, fast }
    }

    /// The one state, which is that from rest.
    ///
    /// # Errors
    /// If there are two.
    pub fn single(self) -> Result<LayerState, LayerError> {
        if self.difference <= SAME_STATE {
            return Ok(self.slow);
        }
        Err(LayerError::TwoStates {
            slow: self.slow.transport(),
            fast: self.fast.transport(),
            difference: self.difference,
        })
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
    pub fn steady_states_unless(&self, stopped: &(dyn Fn() -> bool + Sync)) -> Result<SteadyStates, LayerError> {
        let steady = |start| self.steady_unless(start, stopped);
        let (slow, fast) = rayon::join(|| steady(InitialVelocity::Rest), || steady(self.fast_start()));
        Ok(SteadyStates::of(slow?, fast?))
    }
}

impl BedLoadLayer {
    /// A start faster than any steady state.
    pub fn fast_start(&self) -> InitialVelocity {
        InitialVelocity::Moving(FAST * self.stream.shear_velocity())
    }
}

impl LayerState {
    /// Relative difference from the state of another start: the largest of those of q*, u_f and φ u_s `[-]`.
    pub fn start_difference(&self, other: &Self) -> f64 {
        let transport = (other.transport() / self.transport() - 1.0).abs();
        let profiles = self.difference(other, f64::NEG_INFINITY);
        if transport.is_nan() { profiles } else { transport.max(profiles) }
    }
}
