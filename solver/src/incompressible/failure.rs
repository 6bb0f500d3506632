//! Why a step failed, as the passes see it: a row of the velocity system and a quantity, without a place and a time.

use crate::run::divergence::Quantity;

/// What left its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Failure {
    /// Row of the velocity system: the fluid's free particles first, then the sediment's.
    pub(super) row: usize,
    pub(super) quantity: Quantity,
    pub(super) value: f64,
    /// Least and largest value allowed.
    pub(super) limits: (f64, f64),
}

impl Failure {
    /// A particle that would move by more than its spacing in a step, or by no number, in spacings `[-]`.
    pub(super) fn displacement(row: usize, spacings: f64) -> Self {
        Self { row, quantity: Quantity::Displacement, value: spacings, limits: (0.0, 1.0) }
    }
}
