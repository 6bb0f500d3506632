//! Where a parameter stands in the cases' files, and its range.

use crate::input::FieldError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where a parameter stands.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Paths {
    /// At the same dotted path of every case.
    Everywhere(String),
    /// At a dotted path for each case by name.
    ByCase(BTreeMap<String, String>),
}

impl Paths {
    /// The dotted path in a case.
    #[must_use]
    pub fn in_case(&self, case: &str) -> Option<&str> {
        match self {
            Self::Everywhere(path) => Some(path),
            Self::ByCase(paths) => paths.get(case).map(String::as_str),
        }
    }

    /// A short name: the last key of the path.
    #[must_use]
    pub fn name(&self) -> String {
        let path = match self {
            Self::Everywhere(path) => Some(path),
            Self::ByCase(paths) => paths.values().next(),
        };
        path.and_then(|path| path.rsplit('.').next()).unwrap_or_default().to_owned()
    }
}

/// How a range is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios.
    Log,
}

/// A range and its scale: the map between a value and its coordinate in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lower bound, in the parameter's unit.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
    /// Scale.
    pub spacing: Spacing,
}

impl Bounds {
    /// Checks a range; `field` names the table that holds it.
    ///
    /// # Errors
    /// Bounds that are not finite or reversed, or not positive on a logarithmic scale.
    pub fn check(&self, field: &str) -> Result<(), FieldError> {
        let Self { lower, upper, spacing } = *self;
        for (name, value) in [("lower", lower), ("upper", upper)] {
            if !value.is_finite() {
                return Err(FieldError::new(&format!("{field}.{name}"), value, "finite", "give a number"));
            }
        }
        if lower >= upper {
            let rule = format!("below `upper`, which is {upper}");
            return Err(FieldError::new(&format!("{field}.lower"), lower, &rule, "exchange the two bounds"));
        }
        if spacing == Spacing::Log && lower <= 0.0 {
            let remedy = "raise it, or use scale = \"linear\"";
            return Err(FieldError::new(&format!("{field}.lower"), lower, "positive on a logarithmic scale", remedy));
        }
        Ok(())
    }

    /// The value at a coordinate.
    #[must_use]
    pub fn value(&self, coordinate: f64) -> f64 {
        let between = |lower: f64, upper: f64| lower + (upper - lower) * coordinate;
        match self.spacing {
            Spacing::Linear => between(self.lower, self.upper),
            Spacing::Log => libm::exp(between(libm::log(self.lower), libm::log(self.upper))),
        }
    }

    /// The coordinate of a value; outside [0, 1] for a value outside the range.
    #[must_use]
    pub fn coordinate(&self, value: f64) -> f64 {
        let share = |lower: f64, upper: f64, value: f64| (value - lower) / (upper - lower);
        match self.spacing {
            Spacing::Linear => share(self.lower, self.upper, value),
            Spacing::Log => share(libm::log(self.lower), libm::log(self.upper), libm::log(value)),
        }
    }
}

/// A number as TOML writes it, with all its digits.
#[must_use]
pub fn float(value: f64) -> String {
    toml::Value::Float(value).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_coordinates_are_inverse_on_both_scales() {
        for spacing in [Spacing::Linear, Spacing::Log] {
            let bounds = Bounds { lower: 0.1, upper: 10.0, spacing };
            for k in 0..=10 {
                let coordinate = f64::from(k) / 10.0;
                assert!((bounds.coordinate(bounds.value(coordinate)) - coordinate).abs() < 1e-14);
            }
        }
        let log = Bounds { lower: 0.1, upper: 10.0, spacing: Spacing::Log };
        assert!((log.value(0.5) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn reversed_bounds_and_logarithms_of_zero_are_refused() {
        let message = |lower, upper, spacing| {
            Bounds { lower, upper, spacing }.check("parameters[0]").map_err(|error| error.to_string())
        };
        assert_eq!(message(1.0, 2.0, Spacing::Log), Ok(()));
        assert_eq!(
            message(3.0, 2.0, Spacing::Linear),
            Err("`parameters[0].lower` is 3, but must be below `upper`, which is 2; exchange the two bounds".to_owned())
        );
        assert_eq!(
            message(0.0, 2.0, Spacing::Log),
            Err("`parameters[0].lower` is 0, but must be positive on a logarithmic scale; raise it, or use scale = \"linear\"".to_owned())
        );
        assert!(message(f64::NAN, 2.0, Spacing::Linear).is_err());
    }

    #[test]
    fn a_path_may_differ_from_case_to_case() {
        #[derive(Deserialize)]
        struct Holder {
            path: Paths,
        }
        let read = |text: &str| toml::from_str::<Holder>(text).expect("valid").path;
        let everywhere = read("path = \"grains.static_friction\"");
        assert_eq!(everywhere.in_case("film"), Some("grains.static_friction"));
        assert_eq!(everywhere.name(), "static_friction");
        let by_case = read("path = { film = \"a.b\", bagnold = \"c\" }");
        assert_eq!((by_case.in_case("film"), by_case.in_case("settling")), (Some("a.b"), None));
    }
}
