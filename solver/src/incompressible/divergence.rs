//! Quantities that can leave their range in an incompressible run, and the rules. A failed step, as the passes see it,
//! is a row of the velocity system and such a quantity, without a place and a time.

use super::MOST_ITERATIONS;

const RESIDUAL: &str = "(residual over its right-hand side)";

/// The quantity that left its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Residual of the implicit velocities over its right-hand side.
    VelocityResidual,
    /// Residual of the pressure Poisson equation over its right-hand side.
    PressureResidual,
    /// Way of a particle in one step, in spacings, or not a number.
    Displacement,
    /// Change of the velocity of a column's node that the last iteration of its friction still made.
    GrainFriction,
    /// Reynolds number of a grain outside the range of its drag law.
    Reynolds,
}

impl Quantity {
    /// Name in messages, its unit or what is counted, and the rule that it broke, as that follows the value; `limit` is the largest
    /// value allowed.
    pub(super) fn texts(self, limit: f64) -> (&'static str, &'static str, String) {
        let of_solve = format!(" after at most {MOST_ITERATIONS} iterations, above the tolerance of {limit:.1e}");
        match self {
            Self::VelocityResidual => ("implicit velocity", RESIDUAL, of_solve),
            Self::PressureResidual => ("pressure Poisson equation", RESIDUAL, of_solve),
            Self::GrainFriction => ("friction of the grains", "m/s (last change of a velocity)", of_solve),
            Self::Displacement => {
                let rule = ", above the 1 that the model allows; the run needs a smaller time step, or its choice of operators is \
                            unstable";
                ("way in one step", "spacings", rule.to_owned())
            }
            Self::Reynolds => {
                ("Reynolds number", "of a grain", format!(", above the {limit:.4e} at which its drag law ends"))
            }
        }
    }
}

/// Failure of a step: a row of the velocity system, and its quantity that left its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Failure {
    /// Row of the velocity system: the fluid's free particles first, then the sediment's.
    pub(super) row: usize,
    pub(super) quantity: Quantity,
    pub(super) value: f64,
    /// Largest value allowed.
    pub(super) limit: f64,
}

impl Failure {
    /// A particle that would move by more than its spacing in a step, or by no number, in spacings `[-]`.
    pub(super) fn displacement((row, spacings): (usize, f64)) -> Self {
        Self { row, quantity: Quantity::Displacement, value: spacings, limit: 1.0 }
    }
}
