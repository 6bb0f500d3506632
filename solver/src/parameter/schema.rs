//! The schema of a type, made once.

use super::{Fault, ParameterProblem, first_fault};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Value;
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The schema of a type's serialised form, everything inlined: no `$ref`. Made at the first call, then kept for good.
pub fn schema_of<T: JsonSchema + 'static>() -> &'static Value {
    static MADE: Mutex<BTreeMap<TypeId, &'static Value>> = Mutex::new(BTreeMap::new());
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    made.entry(TypeId::of::<T>()).or_insert_with(|| {
        let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
        let mut schema = Value::from(settings.into_generator().into_root_schema_for::<T>());
        close(&mut schema);
        Box::leak(Box::new(schema))
    })
}

/// The first field of a value that is outside its declared range, if any.
pub fn range_problem<T: Serialize + JsonSchema + 'static>(value: &T) -> Option<ParameterProblem> {
    let tree = toml::Value::try_from(value).ok()?;
    match first_fault(schema_of::<T>(), &tree) {
        Some(Fault::Range(problem)) => Some(problem),
        // A typed value has the fields and the types of its own schema.
        Some(Fault::Unknown { .. } | Fault::Missing { .. } | Fault::Kind { .. }) | None => None,
    }
}

/// A schema's description on one line.
#[must_use]
pub fn description(schema: &Value) -> Option<String> {
    let text = schema.get("description")?.as_str()?;
    Some(text.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// Says of every table of fields that it has no others.
fn close(schema: &mut Value) {
    match schema {
        Value::Object(keywords) => {
            if keywords.get("properties").is_some_and(Value::is_object) {
                keywords.insert("additionalProperties".to_owned(), false.into());
            }
            keywords.values_mut().for_each(close);
        }
        Value::Array(schemas) => schemas.iter_mut().for_each(close),
        _ => {}
    }
}
