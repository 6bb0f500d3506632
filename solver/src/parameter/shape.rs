//! Shape of a value in a schema, as far as parameters need it.

use serde_json::{Map, Value};

/// One choice of an enum.
#[derive(Debug, Clone, Copy)]
pub struct Variant<'a> {
    /// Name in files.
    pub name: &'a str,
    /// The schema of what it holds: of the value below its name, or of the whole table where a tag chooses; none for a
    /// bare name.
    pub content: Option<&'a Value>,
}

/// The kind of value that a schema describes.
#[derive(Debug, Clone)]
pub enum Shape<'a> {
    /// A struct.
    Fields {
        /// Schemas by name.
        properties: &'a Map<String, Value>,
        /// Names that must be there.
        required: Vec<&'a str>,
    },
    /// An enum by name: `"settled"`, or a table whose only key is the name.
    Choice(Vec<Variant<'a>>),
    /// An enum of tables, chosen by one of their keys: `law = "mu-i"`.
    Tagged {
        /// The key.
        tag: &'a str,
        /// The choices.
        variants: Vec<Variant<'a>>,
        /// Whether there may be names that the schema does not know, such as a law of the user's own (`x-open`).
        open: bool,
    },
    /// A list of values of one schema.
    List(&'a Value),
    /// Values of their own schemas.
    Tuple(&'a [Value]),
    /// A number.
    Number,
    /// A whole number, perhaps not negative.
    Integer {
        /// Whether it may be below zero.
        signed: bool,
    },
    /// A string.
    Text,
    /// True or false.
    Flag,
    /// Anything.
    Any,
}

impl<'a> Shape<'a> {
    /// The shape of a schema.
    #[must_use]
    pub fn of(schema: &'a Value) -> Self {
        let alternatives = schema.get("oneOf").or_else(|| schema.get("anyOf")).and_then(Value::as_array);
        if let Some(alternatives) = alternatives {
            let filled: Vec<&Value> = alternatives.iter().filter(|alternative| !is_null(alternative)).collect();
            // An optional value of a type with a schema of its own.
            return match filled.as_slice() {
                [only] if filled.len() < alternatives.len() => Self::of(only),
                _ => Self::of_alternatives(&filled, schema.get("x-open").is_some_and(|open| open == true)),
            };
        }
        if let Some(names) = names(schema) {
            return Self::Choice(names);
        }
        match kind(schema) {
            "object" => match schema.get("properties").and_then(Value::as_object) {
                Some(properties) => Self::Fields { properties, required: required(schema) },
                None => Self::Any,
            },
            "array" => match (schema.get("prefixItems").and_then(Value::as_array), schema.get("items")) {
                (Some(items), _) => Self::Tuple(items),
                (None, Some(items)) => Self::List(items),
                (None, None) => Self::Any,
            },
            "number" => Self::Number,
            "integer" => {
                let unsigned = schema.get("format").and_then(Value::as_str).is_some_and(|name| name.starts_with('u'));
                Self::Integer { signed: !unsigned }
            }
            "string" => Self::Text,
            "boolean" => Self::Flag,
            _ => Self::Any,
        }
    }

    fn of_alternatives(alternatives: &[&'a Value], open: bool) -> Self {
        if let Some(tag) = alternatives.first().and_then(|first| tag(first)) {
            let variants: Option<Vec<Variant<'a>>> = alternatives
                .iter()
                .map(|alternative| {
                    let name = alternative.get("properties")?.get(tag)?.get("const")?.as_str()?;
                    Some(Variant { name, content: Some(alternative) })
                })
                .collect();
            return variants.map_or(Self::Any, |variants| Self::Tagged { tag, variants, open });
        }
        let mut variants = Vec::new();
        for &alternative in alternatives {
            if let Some(names) = names(alternative) {
                variants.extend(names);
            } else if let (Some(properties), [name]) =
                (alternative.get("properties").and_then(Value::as_object), required(alternative).as_slice())
            {
                variants.push(Variant { name, content: properties.get(*name) });
            } else {
                return Self::Any;
            }
        }
        Self::Choice(variants)
    }

    /// The choice of an enum that a value makes, if it is one.
    #[must_use]
    pub fn chosen(&self, value: &toml::Value) -> Option<Variant<'a>> {
        let (variants, name) = match self {
            Self::Choice(variants) => match value {
                toml::Value::String(name) => (variants, name.as_str()),
                toml::Value::Table(table) if table.len() == 1 => (variants, table.keys().next()?.as_str()),
                _ => return None,
            },
            Self::Tagged { tag, variants, .. } => (variants, value.get(tag)?.as_str()?),
            _ => return None,
        };
        variants.iter().copied().find(|variant| variant.name == name)
    }
}

/// The type that a schema asks for, or may be absent.
fn kind(schema: &Value) -> &str {
    match schema.get("type") {
        Some(Value::String(kind)) => kind,
        Some(Value::Array(kinds)) => {
            kinds.iter().filter_map(Value::as_str).find(|&kind| kind != "null").unwrap_or_default()
        }
        _ => "",
    }
}

fn is_null(schema: &Value) -> bool {
    schema.get("type").is_some_and(|kind| kind == "null")
}

fn required(schema: &Value) -> Vec<&str> {
    let names = schema.get("required").and_then(Value::as_array);
    names.map(|names| names.iter().filter_map(Value::as_str).collect()).unwrap_or_default()
}

/// The bare names that a schema lists.
fn names(schema: &Value) -> Option<Vec<Variant<'_>>> {
    let listed = match (schema.get("const"), schema.get("enum")) {
        (Some(name), _) => std::slice::from_ref(name),
        (None, Some(Value::Array(names))) => names,
        _ => return None,
    };
    let names = listed.iter().filter(|name| !name.is_null());
    names.map(|name| name.as_str().map(|name| Variant { name, content: None })).collect()
}

/// The property that has one fixed value.
fn tag(schema: &Value) -> Option<&str> {
    let properties = schema.get("properties")?.as_object()?;
    properties.iter().find(|(_, property)| property.get("const").is_some()).map(|(name, _)| name.as_str())
}

/// A schema's description on one line.
#[must_use]
pub fn description(schema: &Value) -> Option<String> {
    let text = schema.get("description")?.as_str()?;
    Some(text.split_whitespace().collect::<Vec<_>>().join(" "))
}
