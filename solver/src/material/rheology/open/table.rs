//! A law as files have it: its name under `law`, and its parameters beside it.

use super::OpenLawError;
use crate::material::rheology::{BUILT_IN_NAMES, BuiltIn, Rheology};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::value::MapDeserializer;
use serde::de::{DeserializeOwned, Error as _, IntoDeserializer, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// The parameters of a law of a user's own crate: numbers in SI units, sorted by their names.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parameters(Vec<(String, f64)>);

impl Parameters {
    pub(super) fn new(mut values: Vec<(String, f64)>) -> Self {
        values.sort_by(|a, b| a.0.cmp(&b.0));
        Self(values)
    }

    /// Names and values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// Reads them into a struct with a field of type f64 for each; `deny_unknown_fields` refuses a misspelt one.
    ///
    /// # Errors
    /// A parameter that is missing or unknown.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, OpenLawError> {
        T::deserialize(MapDeserializer::<_, serde::de::value::Error>::new(self.iter()))
            .map_err(|problem| OpenLawError::Parameter(problem.to_string()))
    }
}

/// Name and parameters of a user-defined law, as they are written.
pub(in crate::material::rheology) struct Written {
    pub(super) name: &'static str,
    pub(super) parameters: &'static Parameters,
}

impl Serialize for Rheology {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.written() {
            Ok(built_in) => built_in.serialize(serializer),
            Err(Written { name, parameters }) => {
                let mut map = serializer.serialize_map(Some(1 + parameters.0.len()))?;
                map.serialize_entry("law", name)?;
                for (name, value) in parameters.iter() {
                    map.serialize_entry(name, &value)?;
                }
                map.end()
            }
        }
    }
}

impl JsonSchema for Rheology {
    fn schema_name() -> Cow<'static, str> {
        "Rheology".into()
    }

    /// The laws of this crate; `x-open` says that there may be others, which judge their parameters themselves.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = BuiltIn::json_schema(generator);
        schema.insert("x-open".to_owned(), true.into());
        schema
    }
}

impl<'de> Deserialize<'de> for Rheology {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Table)
    }
}

/// A value of a law's table.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Entry {
    Number(f64),
    Text(String),
}

impl<'de> IntoDeserializer<'de> for Entry {
    type Deserializer = Entry;

    fn into_deserializer(self) -> Entry {
        self
    }
}

impl<'de> Deserializer<'de> for Entry {
    type Error = serde::de::value::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        match self {
            Self::Number(value) => visitor.visit_f64(value),
            Self::Text(value) => visitor.visit_string(value),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

struct Table;

impl<'de> Visitor<'de> for Table {
    type Value = Rheology;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a law by its name under `law`, with its parameters")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Rheology, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry::<String, Entry>()? {
            entries.push(entry);
        }
        let name = entries.iter().find(|(key, _)| key == "law").ok_or_else(|| A::Error::missing_field("law"))?;
        let Entry::Text(name) = name.1.clone() else { return Err(A::Error::custom("`law` must be the name of a law")) };
        if BUILT_IN_NAMES.contains(&name.as_str()) {
            let built_in = BuiltIn::deserialize(MapDeserializer::new(entries.into_iter()));
            return built_in.map(Rheology::from).map_err(A::Error::custom);
        }
        let mut parameters = Vec::new();
        for (key, value) in entries {
            match value {
                Entry::Number(value) => parameters.push((key, value)),
                Entry::Text(_) if key == "law" => {}
                Entry::Text(text) => {
                    let message = format!("invalid type: string \"{text}\", expected a number for `{key}`");
                    return Err(A::Error::custom(message));
                }
            }
        }
        Rheology::open_with(&name, Parameters::new(parameters)).map_err(A::Error::custom)
    }
}
