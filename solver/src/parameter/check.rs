//! The one checker: a tree of values along a schema. TOML's values keep NaN and infinity, JSON's do not.

use super::{ParameterProblem, Shape, Variant, description, shortened};
use serde_json::Value as Schema;
use toml::{Table, Value};

/// Fault of one field; paths are dotted, with the index in a list: `slopes[1]`.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// There is no such field.
    Unknown {
        /// Path.
        path: String,
        /// The paths of the fields beside it.
        known: Vec<String>,
    },
    /// The field is absent.
    Missing {
        /// Path.
        path: String,
        /// Names and descriptions of all fields that are absent beside it, itself first.
        absent: Vec<(String, String)>,
    },
    /// The value is not of the field's type.
    Kind {
        /// Path.
        path: String,
        /// The value as written; none if it takes more than a line.
        value: Option<String>,
        /// Rule that the value breaks, completing "must be …".
        rule: String,
        /// The name that is none of an enum's, and the enum's names.
        choice: Option<(String, Vec<String>)>,
    },
    /// The value is of the right type, but outside its range.
    Range(ParameterProblem),
}

impl Fault {
    /// The dotted path of the field.
    #[must_use]
    pub fn path(&self) -> &str {
        match self {
            Self::Unknown { path, .. } | Self::Missing { path, .. } | Self::Kind { path, .. } => path,
            Self::Range(problem) => &problem.field,
        }
    }
}

/// The first fault of a value, in the order in which the fields are declared.
#[must_use]
pub fn first_fault(schema: &Schema, value: &Value) -> Option<Fault> {
    Place { path: String::new() }.fault(schema, value)
}

/// Path of the value that the checker visits.
struct Place {
    path: String,
}

impl Place {
    fn below(&self, name: &str) -> Self {
        Self { path: if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) } }
    }

    fn at(&self, index: usize) -> Self {
        Self { path: format!("{}[{index}]", self.path) }
    }

    fn fault(self, schema: &Schema, value: &Value) -> Option<Fault> {
        let fault = match (Shape::of(schema), value) {
            (Shape::Any, _)
            | (Shape::Number, Value::Float(_) | Value::Integer(_))
            | (Shape::Integer { signed: true }, Value::Integer(_))
            | (Shape::Text, Value::String(_))
            | (Shape::Flag, Value::Boolean(_)) => None,
            (Shape::Integer { signed: false }, Value::Integer(value)) if *value >= 0 => None,
            (Shape::Fields { properties, required }, Value::Table(table)) => {
                self.fault_of_fields(properties, &required, table)
            }
            (Shape::List(items), Value::Array(values)) => {
                values.iter().enumerate().find_map(|(index, value)| self.at(index).fault(items, value))
            }
            (Shape::Tuple(items), Value::Array(values)) if items.len() == values.len() => {
                let mut pairs = items.iter().zip(values).enumerate();
                pairs.find_map(|(index, (schema, value))| self.at(index).fault(schema, value))
            }
            (shape @ (Shape::Choice(_) | Shape::Tagged { .. }), _) => self.fault_of_choice(&shape, value),
            (shape, _) => Some(self.wrong(value, kind_in_words(&shape))),
        };
        fault.or_else(|| self.out_of_range(schema, value))
    }

    fn fault_of_fields(
        &self,
        properties: &serde_json::Map<String, Schema>,
        required: &[&str],
        table: &Table,
    ) -> Option<Fault> {
        let unknown = table.keys().find(|key| !properties.contains_key(*key)).map(|key| Fault::Unknown {
            path: self.below(key).path,
            known: properties.keys().map(|name| self.below(name).path).collect(),
        });
        // what is given and wrong comes before what is not given
        let wrong = || {
            let given = properties.iter().filter_map(|(name, schema)| Some((name, schema, table.get(name)?)));
            given.map(|(name, schema, value)| self.below(name).fault(schema, value)).find_map(|fault| fault)
        };
        let missing = || {
            let is_absent = |name: &String| required.contains(&name.as_str()) && !table.contains_key(name);
            let absent = properties.iter().filter(|(name, _)| is_absent(name));
            let absent: Vec<(String, String)> =
                absent.map(|(name, schema)| (name.clone(), description(schema).unwrap_or_default())).collect();
            absent.first().map(|(name, _)| self.below(name).path).map(|path| Fault::Missing { path, absent })
        };
        unknown.or_else(wrong).or_else(missing)
    }

    fn fault_of_choice(&self, shape: &Shape<'_>, value: &Value) -> Option<Fault> {
        if let Some(variant) = shape.chosen(value) {
            return match (shape, variant.content, value) {
                (Shape::Tagged { .. }, Some(content), _) => Self { path: self.path.clone() }.fault(content, value),
                (_, Some(content), Value::Table(table)) => {
                    table.iter().find_map(|(name, value)| self.below(name).fault(content, value))
                }
                (_, None, Value::String(_)) => None,
                (_, Some(_), _) => Some(self.wrong(value, "a table of fields".to_owned())),
                (_, None, _) => Some(self.wrong(value, format!("the name \"{}\" alone", variant.name))),
            };
        }
        match shape {
            Shape::Choice(variants) => match value {
                Value::Table(table) if table.len() == 1 => {
                    table.iter().map(|(name, value)| self.below(name).no_choice(variants, name, value)).next()
                }
                Value::String(name) => Some(self.no_choice(variants, name, value)),
                _ => Some(self.wrong(value, one_of(variants))),
            },
            Shape::Tagged { tag, variants, open } => match value.get(tag) {
                Some(Value::String(_)) if *open => None,
                Some(Value::String(name)) => Some(self.below(tag).no_choice(variants, name, &value[*tag])),
                Some(other) => Some(self.below(tag).wrong(other, one_of(variants))),
                None if value.is_table() => Some(Fault::Missing { path: self.below(tag).path, absent: Vec::new() }),
                None => Some(self.wrong(value, "a table of fields".to_owned())),
            },
            _ => None,
        }
    }

    fn no_choice(&self, variants: &[Variant<'_>], name: &str, value: &Value) -> Fault {
        let names = variants.iter().map(|variant| variant.name.to_owned()).collect();
        Fault::Kind {
            path: self.path.clone(),
            value: shown(value),
            rule: one_of(variants),
            choice: Some((name.to_owned(), names)),
        }
    }

    fn wrong(&self, value: &Value, rule: String) -> Fault {
        Fault::Kind { path: self.path.clone(), value: shown(value), rule, choice: None }
    }

    /// The first rule that the value breaks: the schema's own, then those under `allOf`.
    fn out_of_range(&self, schema: &Schema, value: &Value) -> Option<Fault> {
        let further = schema.get("allOf").and_then(Schema::as_array).into_iter().flatten();
        std::iter::once(schema).chain(further).find_map(|rule| {
            let (path, shown, words) = match value {
                Value::Float(number) => (self.path.clone(), number.to_string(), broken_bound(rule, *number)?),
                Value::Integer(number) => (self.path.clone(), number.to_string(), broken_bound(rule, *number as f64)?),
                Value::Array(values) => (self.path.clone(), value.to_string(), broken_list(rule, values.len())?),
                _ => return None,
            };
            let word = |key: &str| rule.get(key).and_then(Schema::as_str);
            let remedy = word("x-remedy").unwrap_or("see the default with `bagnold show`");
            let words = word("x-rule").map_or(words, str::to_owned);
            Some(Fault::Range(ParameterProblem::new(&path, shown, &words, remedy)))
        })
    }
}

/// A field's own rule, completing "must be …"; the bounds of its unit are left out.
#[must_use]
pub fn rule_in_words(schema: &Schema) -> Option<String> {
    let words = schema.get("x-rule").and_then(Schema::as_str).map(str::to_owned);
    let of_list = || schema.get("items").and_then(|_| broken_list(schema, 0));
    let of_entries = || Some(format!("each {}", rule_in_words(schema.get("items")?)?));
    // NaN breaks every bound, an empty list every least length
    words.or_else(|| broken_bound(schema, f64::NAN)).or_else(of_list).or_else(of_entries)
}

/// The bounds that a number breaks, in words.
fn broken_bound(rule: &Schema, value: f64) -> Option<String> {
    let bound = |key: &str| rule.get(key).and_then(Schema::as_f64);
    let (least, above) = (bound("minimum"), bound("exclusiveMinimum"));
    let (most, below) = (bound("maximum"), bound("exclusiveMaximum"));
    let finite = rule.get("x-finite").is_some_and(|finite| finite == true);
    // Written so that NaN lies in no range.
    let holds = least.is_none_or(|bound| value >= bound)
        && above.is_none_or(|bound| value > bound)
        && most.is_none_or(|bound| value <= bound)
        && below.is_none_or(|bound| value < bound)
        && (!finite || value.is_finite())
        && bound("x-smallest").is_none_or(|smallest| value == 0.0 || value.abs() >= smallest);
    (!holds).then(|| match (least, above, most, below) {
        (Some(least), _, Some(most), _) => format!("between {} and {}", number(least), number(most)),
        (_, Some(above), Some(most), _) => format!("above {} and at most {}", number(above), number(most)),
        (_, Some(above), _, Some(below)) => format!("above {} and below {}", number(above), number(below)),
        (_, Some(above), ..) => format!("finite and greater than {}", number(above)),
        (Some(0.0), ..) if finite => "finite and not negative".to_owned(),
        (Some(least), ..) => format!("at least {}", number(least)),
        (.., Some(most), _) => format!("at most {}", number(most)),
        (.., Some(below)) => format!("below {}", number(below)),
        (None, None, None, None) => "finite".to_owned(),
    })
}

/// The least length that a list falls short of, in words.
fn broken_list(rule: &Schema, length: usize) -> Option<String> {
    let least = rule.get("minItems").and_then(Schema::as_u64)?;
    ((length as u64) < least).then(|| format!("a list of at least {least}"))
}

/// Name of a value of a shape, without the words of Rust's type system.
fn kind_in_words(shape: &Shape<'_>) -> String {
    match shape {
        Shape::Fields { .. } | Shape::Tagged { .. } => "a table of fields",
        Shape::Choice(variants) => return one_of(variants),
        Shape::List(_) => "an array in brackets, such as [1.0, 2.0] or [\"newtonian\"]",
        Shape::Tuple(items) => return format!("an array of {} values", items.len()),
        Shape::Number => "a number",
        Shape::Integer { signed: false } => "a whole number without sign, decimal point or exponent",
        Shape::Integer { signed: true } => "a whole number",
        Shape::Text => "a text in quotes",
        Shape::Flag => "true or false",
        Shape::Any => "a value",
    }
    .to_owned()
}

fn one_of(variants: &[Variant<'_>]) -> String {
    let quoted: Vec<String> = variants.iter().map(|variant| format!("`{}`", variant.name)).collect();
    match quoted.as_slice() {
        [only] => only.clone(),
        _ => format!("one of {}", quoted.join(", ")),
    }
}

/// A bound with the fewest digits: 1e-9, 0.5, 1000000.
fn number(bound: f64) -> String {
    let text = format!("{bound:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A value as TOML writes it, if that takes one line.
fn shown(value: &Value) -> Option<String> {
    Some(value.to_string()).filter(|text| !text.contains('\n')).map(shortened)
}
