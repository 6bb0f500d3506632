//! The range of a parameter and its scale.

use serde::{Deserialize, Serialize};

/// Division of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios.
    Log,
}

/// "`lower` is `value`, but must be `rule`; `remedy`": a range that is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("`{end}` is {value}, but must be {rule}; {remedy}")]
pub struct BoundsError {
    /// The bound that is wrong: `lower` or `upper`.
    pub end: &'static str,
    /// Value, in the parameter's unit.
    pub value: f64,
    /// The rule that it breaks, completing "must be …".
    pub rule: String,
    /// Instruction to the user.
    pub remedy: &'static str,
}

/// A range and its scale: the map between a value and its coordinate in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lower bound, in the parameter's unit.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
    /// Spacing of values between the bounds: linear or logarithmic.
    pub spacing: Spacing,
}

impl Bounds {
    /// Checks a range.
    ///
    /// # Errors
    /// Bounds that are not finite or reversed, or not positive on a logarithmic scale.
    pub fn check(&self) -> Result<(), BoundsError> {
        let Self { lower, upper, spacing } = *self;
        for (end, value) in [("lower", lower), ("upper", upper)] {
            if !value.is_finite() {
                return Err(BoundsError { end, value, rule: "finite".to_owned(), remedy: "give a number" });
            }
        }
        let of_lower = |rule: String, remedy| Err(BoundsError { end: "lower", value: lower, rule, remedy });
        if lower >= upper {
            return of_lower(format!("below `upper`, which is {upper}"), "exchange the two bounds");
        }
        if spacing == Spacing::Log && lower <= 0.0 {
            let remedy = "raise it, or use scale = \"linear\"";
            return of_lower("positive on a logarithmic scale".to_owned(), remedy);
        }
        Ok(())
    }

    /// The value at a coordinate.
    pub fn value(&self, coordinate: f64) -> f64 {
        let between = |lower: f64, upper: f64| lower + (upper - lower) * coordinate;
        match self.spacing {
            Spacing::Linear => between(self.lower, self.upper),
            Spacing::Log => libm::exp(between(libm::log(self.lower), libm::log(self.upper))),
        }
    }

    /// The coordinate of a value; outside [0, 1] for a value outside the range.
    pub fn coordinate(&self, value: f64) -> f64 {
        let share = |lower: f64, upper: f64, value: f64| (value - lower) / (upper - lower);
        match self.spacing {
            Spacing::Linear => share(self.lower, self.upper, value),
            Spacing::Log => share(libm::log(self.lower), libm::log(self.upper), libm::log(value)),
        }
    }
}
