//! The value of a key: a word, a number, several of them, or a range.

use std::fmt;
use std::ops::RangeInclusive;

/// Value of a key of a variant, by its text: a name `rest`, a number `40`, a range `3..8`, or numbers of several runs `10_20_40`.
/// It is built by `From`, which gives each number one text: 1 and 1.0 are the same.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Value(String);

impl Value {
    /// Text.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// The number.
    pub fn number(&self) -> Option<f64> {
        number_in(&self.0)
    }

    /// The range.
    pub fn range(&self) -> Option<RangeInclusive<f64>> {
        let (lower, upper) = self.0.split_once("..")?;
        Some(number_in(lower)?..=number_in(upper)?)
    }

    /// The numbers that are joined; a value that joins nothing is alone.
    pub fn joined(&self) -> Vec<Self> {
        let parts: Vec<&str> = self.0.split('_').collect();
        let is_list = parts.iter().all(|part| number_in(part).is_some());
        if is_list { parts.into_iter().map(Self::from).collect() } else { vec![self.clone()] }
    }

    /// Several numbers as one value, or the number itself if there is one.
    pub fn list(numbers: impl IntoIterator<Item = impl Into<Self>>) -> Self {
        let text: Vec<String> = numbers.into_iter().map(|number| number.into().0).collect();
        Self(text.join("_"))
    }
}

/// The number of a text; none for one that would be written in another way, such as `1e3`.
fn number_in(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|number| number.is_finite() && number.to_string() == text)
}

/// Value of a text or number; `=` and `,`, which separate the keys, become dashes.
impl<T: fmt::Display> From<T> for Value {
    fn from(value: T) -> Self {
        let text = value.to_string().replace(['=', ','], "-");
        Self(match text.as_str() {
            "" => "-".to_owned(),
            "-0" => "0".to_owned(),
            _ => text,
        })
    }
}
