//! The JSON Schema of a study's file, for editors.

use super::file::StudyText;
use schemars::generate::SchemaSettings;
use serde_json::{Value as Schema, json};

/// The schema (2020-12) of a study: fields, types, and which of them exclude each other. What depends on the case, its
/// parameters and the headings of its tables, is open.
pub fn schema() -> Schema {
    let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let mut schema = Schema::from(settings.into_generator().into_root_schema_for::<StudyText>());
    drop_null(&mut schema);
    schema["title"] = "bagnold: study".into();
    schema["description"] = "A study: what is simulated, what of it is measured, what judges it.".into();
    schema["oneOf"] = one_of(&["case", "base"]);
    schema["required"] = json!(["study", "summary", "checks"]);
    let checks = &mut schema["properties"]["checks"];
    if let Some(checks) = checks.as_object_mut() {
        checks.remove("default");
    }
    checks["items"]["oneOf"] = one_of(&["metric", "value", "compare", "order_of", "difference_of"]);
    schema
}

/// Exactly one of these fields.
fn one_of(fields: &[&str]) -> Schema {
    fields.iter().map(|field| json!({ "required": [field] })).collect()
}

/// TOML has no null: a field that may be left out is left out.
fn drop_null(schema: &mut Schema) {
    let null = json!({ "type": "null" });
    if let Schema::Object(keywords) = schema {
        if let Some(Schema::Array(types)) = keywords.get_mut("type") {
            types.retain(|word| word != "null");
            if let [only] = &types[..] {
                let only = only.clone();
                keywords.insert("type".to_owned(), only);
            }
        }
        if let Some(Schema::Array(words)) = keywords.get_mut("enum") {
            words.retain(|word| !word.is_null());
        }
        if let Some(Schema::Array(choices)) = keywords.get_mut("anyOf") {
            choices.retain(|choice| *choice != null);
            // what stands beside, such as the field's own description, goes before what the choice says
            if let [Schema::Object(only)] = &choices[..] {
                let only = only.clone();
                keywords.remove("anyOf");
                for (keyword, value) in only {
                    keywords.entry(keyword).or_insert(value);
                }
            }
        }
        if keywords.get("default").is_some_and(Schema::is_null) {
            keywords.remove("default");
        }
        keywords.values_mut().for_each(drop_null);
    } else if let Schema::Array(parts) = schema {
        parts.iter_mut().for_each(drop_null);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_has_a_type_and_a_description_and_none_may_be_null() {
        let schema = schema();
        assert!(!schema.to_string().contains("null"), "{schema:#}");
        let check = schema["properties"]["checks"]["items"]["properties"].clone();
        for fields in [schema["properties"].clone(), check] {
            for (name, field) in fields.as_object().expect("fields") {
                assert!(field["description"].is_string(), "{name}: {field}");
                let is_typed = ["type", "oneOf", "anyOf", "enum"].iter().any(|key| !field[key].is_null());
                assert!(is_typed, "{name}: {field}");
            }
        }
        assert_eq!(schema["additionalProperties"], false);
    }
}
