//! Variant of a number: the run or runs that it is of, as named values in one fixed order, with one text.

#[cfg(test)]
mod tests;
mod value;

pub use value::Value;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// Named values in the order in which a case gives them, such as `slope_angle=24,start=rest,resolution=40`; none where
/// a case has a single run.
///
/// A value is a word, a number, several of them joined by `_` (the runs behind a metric) or a range `3..8` (a part of a
/// single run). In files and on the page a variant is its text.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
#[must_use]
pub struct Variant {
    parts: Vec<(String, Value)>,
}

impl Variant {
    /// Variant with a single key.
    pub fn of(key: &str, value: impl Into<Value>) -> Self {
        Self::default().and(key, value)
    }

    /// This variant followed by another key.
    pub fn and(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.parts.push((key.to_owned(), value.into()));
        self
    }

    /// This variant followed by all keys of another one.
    pub fn followed_by(mut self, other: &Self) -> Self {
        self.parts.extend(other.parts.iter().cloned());
        self
    }

    /// Whether it has no key: the only run of its case.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.parts().find(|(other, _)| *other == key).map(|(_, value)| value)
    }

    /// Whether it has every key of another with the same value.
    pub fn includes(&self, other: &Self) -> bool {
        other.parts().all(|(key, value)| self.get(key) == Some(value))
    }

    /// Run to which a metric of this variant belongs: the run with most keys, all contained in the variant; `None` for several.
    pub fn run_among<'a>(&self, runs: &'a [Self]) -> Option<&'a Self> {
        runs.iter().filter(|run| self.includes(run)).max_by_key(|run| run.parts().count())
    }

    /// Whether a number of this variant may come from a run of another: what both name has a value in common.
    pub fn concerns(&self, run: &Self) -> bool {
        let in_common = |own: &Value, other: &Value| match (own.range(), other.number()) {
            (Some(range), Some(number)) => range.contains(&number),
            _ => own.joined().iter().any(|value| other.joined().contains(value)),
        };
        run.parts().all(|(key, other)| self.get(key).is_none_or(|own| in_common(own, other)))
    }

    /// Keys and values in order.
    pub fn parts(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.parts.iter().map(|(key, value)| (key.as_str(), value))
    }

    /// Values alone, in order.
    pub fn values(&self) -> impl Iterator<Item = &Value> {
        self.parts.iter().map(|(_, value)| value)
    }

    /// File name of this variant, such as `slope-angle-24-start-rest`: letters, digits, points and dashes.
    pub fn file_name(&self) -> String {
        file_name(&self.to_string())
    }

    /// End of a file name that distinguishes this variant; empty without keys.
    pub fn suffix(&self) -> String {
        if self.is_empty() { String::new() } else { format!("-{}", self.file_name()) }
    }

    /// File name of this variant if the keys are known, from its values alone: `rest-40`.
    pub fn file_name_of_values(&self) -> String {
        let values: Vec<String> = self.values().map(|value| file_name(value.text())).collect();
        values.join("-")
    }
}

fn file_name(text: &str) -> String {
    let is_kept = |letter: char| letter.is_ascii_alphanumeric() || letter == '.';
    text.replace("..", "-").replace(|letter| !is_kept(letter), "-")
}

impl fmt::Display for Variant {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text: Vec<String> = self.parts().map(|(key, value)| format!("{key}={}", value.text())).collect();
        formatter.pad(&text.join(","))
    }
}

impl FromStr for Variant {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut variant = Self::default();
        for part in text.split(',').filter(|_| !text.is_empty()) {
            let refuse = |defect: String| Err(format!("`{text}` must be `key=value,key=value`, but has {defect}"));
            let (key, value) = part.split_once('=').unwrap_or_default();
            if key.is_empty() || value.is_empty() || value.contains('=') {
                return refuse(format!("the part `{part}`"));
            }
            if variant.get(key).is_some() {
                return refuse(format!("`{key}` twice"));
            }
            variant = variant.and(key, value);
        }
        Ok(variant)
    }
}

/// By the text, which is how files and the report are sorted.
impl Ord for Variant {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.to_string().cmp(&other.to_string())
    }
}

impl PartialOrd for Variant {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Serialize for Variant {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Variant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}
