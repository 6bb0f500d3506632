//! A law as files have it: its name under `law`, and its parameters beside it.

use super::OpenLawError;
use crate::material::rheology::{BUILT_IN_NAMES, BuiltIn, Rheology};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::value::MapDeserializer;
use serde::de::{DeserializeOwned, Error as _};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use toml::{Table, Value};

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
        let mut table = Table::deserialize(deserializer)?;
        let Value::String(name) = table.get("law").ok_or_else(|| D::Error::missing_field("law"))?.clone() else {
            return Err(D::Error::custom("`law` must be the name of a law"));
        };
        if BUILT_IN_NAMES.contains(&name.as_str()) {
            let built_in = table.try_into::<BuiltIn>();
            return built_in.map(Self::from).map_err(|problem| D::Error::custom(problem.message()));
        }
        table.remove("law");
        let number = |(key, value): (String, Value)| match value {
            Value::Float(value) => Ok((key, value)),
            Value::Integer(value) => Ok((key, value as f64)),
            other => {
                let kind = other.type_str();
                Err(D::Error::custom(format!("invalid type: {kind} {other}, expected a number for `{key}`")))
            }
        };
        let parameters = table.into_iter().map(number).collect::<Result<_, _>>()?;
        Self::open_with(&name, Parameters::new(parameters)).map_err(D::Error::custom)
    }
}
