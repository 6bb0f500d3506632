//! The rules that stand on a field: they write the range into the field's schema, with the remedy.
//!
//! Beside the keywords of JSON Schema a schema holds, for messages, `x-rule` (the rule in words, where the keywords'
//! own words do not do), `x-remedy`, and `x-finite` (JSON has no infinity, TOML has).

use schemars::Schema;
use schemars::transform::Transform;
use serde_json::{Map, Value, json};

/// A rule of a field's value.
#[derive(Debug, Clone)]
pub struct Rule {
    keywords: Map<String, Value>,
}

impl Rule {
    fn new<const N: usize>(keywords: [(&str, Value); N], remedy: &str) -> Self {
        let mut keywords: Map<String, Value> =
            keywords.into_iter().map(|(keyword, value)| (keyword.to_owned(), value)).collect();
        keywords.insert("x-remedy".to_owned(), remedy.into());
        Self { keywords }
    }

    /// The same rule with its own words, completing "must be …".
    #[must_use]
    pub fn in_words(mut self, words: &str) -> Self {
        self.keywords.insert("x-rule".to_owned(), words.into());
        self
    }
}

impl Transform for Rule {
    /// The first rule of a schema stands in its own keywords, in place of the bounds of the type; further ones, which
    /// are asked in their order, under `allOf`.
    fn transform(&mut self, schema: &mut Schema) {
        let place = schema.ensure_object();
        if place.contains_key("x-remedy") {
            let further = place.entry("allOf").or_insert_with(|| json!([]));
            if let Value::Array(further) = further {
                further.push(Value::Object(self.keywords.clone()));
            }
        } else {
            place.extend(self.keywords.clone());
        }
    }
}

/// Positive and finite.
#[must_use]
pub fn positive(remedy: &str) -> Rule {
    above(0.0, remedy).in_words("positive and finite")
}

/// Finite and greater than a bound.
#[must_use]
pub fn above(bound: f64, remedy: &str) -> Rule {
    Rule::new([("exclusiveMinimum", number(bound)), ("x-finite", true.into())], remedy)
}

/// Finite and not negative.
#[must_use]
pub fn not_negative(remedy: &str) -> Rule {
    Rule::new([("minimum", 0.into()), ("x-finite", true.into())], remedy)
}

/// Rule for values of at least a bound; the upper bound depends on other fields.
#[must_use]
pub fn at_least(bound: f64, remedy: &str) -> Rule {
    Rule::new([("minimum", number(bound))], remedy)
}

/// Rule for values in `[lower, upper]`.
#[must_use]
pub fn between(lower: f64, upper: f64, remedy: &str) -> Rule {
    Rule::new([("minimum", number(lower)), ("maximum", number(upper))], remedy)
}

/// Rule for values in `(0, upper]`.
#[must_use]
pub fn up_to(upper: f64, remedy: &str) -> Rule {
    Rule::new([("exclusiveMinimum", 0.into()), ("maximum", number(upper))], remedy)
}

/// Rule for values in `(lower, upper)`.
#[must_use]
pub fn inside(lower: f64, upper: f64, remedy: &str) -> Rule {
    Rule::new([("exclusiveMinimum", number(lower)), ("exclusiveMaximum", number(upper))], remedy)
}

/// A list with at least one value; `words` completes "must be …", as "at least one slope".
#[must_use]
pub fn filled(words: &str, remedy: &str) -> Rule {
    Rule::new([("minItems", 1.into())], remedy).in_words(words)
}

/// A bound as JSON: a whole one without a fraction.
fn number(bound: f64) -> Value {
    if bound.fract() == 0.0 && bound.abs() < 1e15 { json!(bound as i64) } else { json!(bound) }
}
