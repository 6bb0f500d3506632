//! Errors of saved simulations that cannot be continued, common to both models.

use super::SceneError;

/// Reason why a saved simulation is not continued.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ContinueError {
    /// Scene breaks a rule.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It is that of another scene.
    #[error(transparent)]
    Foreign(#[from] ForeignState),
    /// Clock shows a time that no run reaches, up to which it would be simulated for ever.
    #[error("the saved state is damaged: its time is {0} s, but must be between 0 and the end of a run")]
    Time(f64),
}

impl ContinueError {
    /// Refuses a time `[s]` that is negative, infinite or not a number.
    pub(crate) fn check_time(time: f64) -> Result<(), Self> {
        if (0.0..f64::INFINITY).contains(&time) { Ok(()) } else { Err(Self::Time(time)) }
    }
}

/// A saved simulation that does not belong to the scene it is to be continued with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the saved state has {found} {what}, but its scene has {expected}")]
pub struct ForeignState {
    /// Name of the items that were counted.
    pub what: &'static str,
    /// Value in the saved state.
    pub found: usize,
    /// Value in the scene.
    pub expected: usize,
}

impl ForeignState {
    /// Compares two numbers.
    pub(crate) fn check(what: &'static str, found: usize, expected: usize) -> Result<(), Self> {
        if found == expected { Ok(()) } else { Err(Self { what, found, expected }) }
    }
}
