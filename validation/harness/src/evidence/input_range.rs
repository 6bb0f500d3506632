//! An input that is known within a range: `[[range]]` of `reference-data/CASE/uncertainty.toml`.

use crate::metric::Variant;
use serde::Deserialize;

/// Basis of a stated number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// The source states it.
    Stated,
    /// It follows from numbers that the source states, as is said.
    Derived,
    /// It is the project's choice of a range that the field takes for granted, with the reason.
    Assumed,
}

impl Basis {
    /// Text for a reader.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::Derived => "derived",
            Self::Assumed => "assumed, range of the field",
        }
    }
}

/// Quantity that is uniformly distributed over a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// The input.
    #[default]
    Value,
    /// Logarithm: of an input that is known to a factor.
    Logarithm,
}

/// An input that is known within a range.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputRange {
    /// Name of the input.
    pub name: String,
    /// The case at the lower end, `path=value`.
    pub low: Vec<String>,
    /// The case at the upper end.
    pub high: Vec<String>,
    /// The case's own value of the first path, in the unit of that parameter.
    pub own: f64,
    /// Quantity that is uniformly distributed over the range.
    #[serde(default)]
    pub spread: Spread,
    /// The range in words, with its unit.
    pub range: String,
    /// Basis of the range.
    pub basis: Basis,
    /// Source of the range.
    pub source: String,
    /// Variants of comparisons to which the range does not apply.
    #[serde(default)]
    pub not_for: Vec<Variant>,
    /// Variants of comparisons to which the range applies; empty for all.
    #[serde(default)]
    pub only_for: Vec<Variant>,
}

impl InputRange {
    /// Path and value of the first setting of an end.
    fn first(settings: &[String]) -> Option<(&str, f64)> {
        let (path, value) = settings.first()?.split_once('=')?;
        Some((path, value.parse().ok()?))
    }

    /// Position of the case's own value in the range, 0 at the lower and 1 at the upper end `[-]`; none outside.
    pub fn place(&self) -> Option<f64> {
        let (low, high) = (Self::first(&self.low)?, Self::first(&self.high)?);
        let scale = |value: f64| match self.spread {
            Spread::Value => value,
            Spread::Logarithm => libm::log(value),
        };
        let place = (scale(self.own) - scale(low.1)) / (scale(high.1) - scale(low.1));
        (low.0 == high.0 && (0.0..=1.0).contains(&place)).then_some(place)
    }

    /// Whether a comparison's input is known so.
    pub fn is_of(&self, variant: &Variant) -> bool {
        let is_included = |other: &Variant| variant.includes(other);
        !self.not_for.iter().any(is_included) && (self.only_for.is_empty() || self.only_for.iter().any(is_included))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(text: &str) -> InputRange {
        let rest = "name = \"friction\"\nrange = \"a range\"\nbasis = \"assumed\"\nsource = \"a reason\"\n";
        toml::from_str(&format!("{rest}{text}")).expect("a range")
    }

    #[test]
    fn the_own_value_has_a_place_in_its_range_or_none() {
        let place = |low: f64, high: f64, rest: &str| {
            range(&format!("low = [\"law.friction={low}\"]\nhigh = [\"law.friction={high}\"]\n{rest}")).place()
        };
        assert_eq!(place(0.4, 0.6, "own = 0.4"), Some(0.0));
        assert!(place(0.4, 0.6, "own = 0.55").is_some_and(|place| (place - 0.75).abs() < 1e-12));
        assert_eq!(place(0.4, 0.6, "own = 0.7"), None);
        let middle = place(1.0, 100.0, "own = 10.0\nspread = \"logarithm\"");
        assert!(middle.is_some_and(|place| (place - 0.5).abs() < 1e-12), "{middle:?}");
    }

    #[test]
    fn a_range_is_of_what_it_names() {
        let own = range("low = [\"f=1\"]\nhigh = [\"f=2\"]\nown = 1.5\nonly_for = [\"a=1\"]\nnot_for = [\"b=2\"]");
        let is_of = |variant: &str| own.is_of(&variant.parse().expect("a variant"));
        assert_eq!([is_of("a=1"), is_of("a=1,b=2"), is_of("b=1")], [true, false, false]);
    }
}
