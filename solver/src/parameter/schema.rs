//! The schema of a type, made once.

use super::{Fault, ParameterProblem, first_fault, magnitude};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Value;
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The schema of a type's serialised form, everything inlined: no `$ref`; numbers have the bounds of their units besides
/// those of their fields. Made at the first call, then kept for good.
pub fn schema_of<T: JsonSchema + 'static>() -> &'static Value {
    static MADE: Mutex<BTreeMap<TypeId, &'static Value>> = Mutex::new(BTreeMap::new());
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    made.entry(TypeId::of::<T>()).or_insert_with(|| {
        let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
        let mut schema = Value::from(settings.into_generator().into_root_schema_for::<T>());
        close(&mut schema);
        magnitude::bound(&mut schema);
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

/// Says of every table of fields that it has no others, and gives its tag the description of the table.
fn close(schema: &mut Value) {
    match schema {
        Value::Object(keywords) => {
            let about = keywords.get("description").cloned();
            if let Some(fields) = keywords.get_mut("properties").and_then(Value::as_object_mut) {
                let tags = fields.values_mut().filter(|field| field.get("const").is_some());
                tags.zip(about).for_each(|(tag, about)| tag["description"] = about);
                keywords.insert("additionalProperties".to_owned(), false.into());
            }
            keywords.values_mut().for_each(close);
        }
        Value::Array(schemas) => schemas.iter_mut().for_each(close),
        _ => {}
    }
}
