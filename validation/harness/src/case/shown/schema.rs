//! The JSON Schema of a case file, for editors.

use crate::case::{OUTPUT_FIELDS, Tier};
use bagnold_solver::parameter::{Shape, schema_of};
use serde_json::{Map, Value as Schema, json};
use toml::{Table, Value};

/// The schema of a file for `case`: every parameter may be left out and is then the tier's.
pub(in crate::case) fn of_file(case: &str, summary: &str, tier: Tier, parameters: &Schema, defaults: &Table) -> Schema {
    let mut tiers = schema_of::<Tier>().clone();
    if let Schema::Object(keywords) = &mut tiers {
        for keyword in ["$schema", "title"] {
            keywords.remove(keyword);
        }
        keywords.insert("description".to_owned(), "Tier that supplies parameters missing in the file.".into());
        keywords.insert("default".to_owned(), tier.name().into());
    }
    let mut fields = Map::new();
    fields.insert("case".to_owned(), json!({ "type": "string", "const": case, "description": summary }));
    fields.insert("tier".to_owned(), tiers);
    let overlay = "CSV files with measurements to be drawn into the case's figures; their paths begin at this file.";
    let repeats = json!({ "type": ["string", "array"], "items": { "type": "string" } });
    let named = json!({ "type": "object", "properties": { "files": repeats, "columns": { "type": "object" } }, "required": ["files", "columns"], "additionalProperties": false });
    let one = json!({ "anyOf": [repeats, named] });
    let files = json!({ "type": "array", "items": one, "default": [], "description": overlay });
    fields.insert("overlay".to_owned(), files);
    let states = json!({
        "type": "object",
        "description": "States of every run to be written on its way, for ParaView.",
        "properties": {
            "every": { "not": { "type": ["string", "boolean", "array", "object", "null"] }, "description": "Time between two states [s], positive." },
            "fields": { "type": "array", "items": { "enum": OUTPUT_FIELDS }, "description": "Quantities of the particles; all where none are named." },
        },
        "required": ["every"],
        "additionalProperties": false,
    });
    fields.insert("output".to_owned(), states);
    let mut parameters = parameters.clone();
    fill(&mut parameters, &Value::Table(defaults.clone()));
    if let Some(Schema::Object(properties)) = parameters.get_mut("properties").map(Schema::take) {
        fields.extend(properties);
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": format!("bagnold: {case}"),
        "description": summary,
        "type": "object",
        "properties": fields,
        "required": ["case"],
        "additionalProperties": false,
    })
}

/// Makes the fields of a table optional and notes their defaults. A choice other than the default's is given whole.
fn fill(schema: &mut Schema, default: &Value) {
    match Shape::of(schema) {
        Shape::Fields { .. } => fill_fields(schema, default),
        Shape::Choice(_) | Shape::Tagged { .. } => {
            fill_choice(schema, default);
            note_default(schema, default);
        }
        _ => note_default(schema, default),
    }
}

fn fill_fields(schema: &mut Schema, default: &Value) {
    let Some(keywords) = schema.as_object_mut() else { return };
    keywords.remove("required");
    if let Some(Schema::Object(properties)) = keywords.get_mut("properties") {
        for (name, property) in properties {
            if let Some(default) = default.get(name).filter(|_| property.get("const").is_none()) {
                fill(property, default);
            }
        }
    }
}

fn fill_choice(schema: &mut Schema, default: &Value) {
    let Some(name) = Shape::of(schema).chosen(default).map(|variant| variant.name.to_owned()) else { return };
    let tagged = matches!(Shape::of(schema), Shape::Tagged { .. });
    let alternatives = ["oneOf", "anyOf"].into_iter().find(|key| schema.get(key).is_some());
    let Some(alternatives) = alternatives.and_then(|key| schema.get_mut(key)).and_then(Schema::as_array_mut) else {
        return;
    };
    for alternative in alternatives {
        if tagged {
            let is_it = |property: &Schema| property.get("const").is_some_and(|tag| *tag == *name);
            let properties = alternative.get("properties").and_then(Schema::as_object);
            if properties.is_some_and(|properties| properties.values().any(is_it)) {
                fill_fields(alternative, default);
            }
        } else if let (Some(content), Some(default)) =
            (alternative.get_mut("properties").and_then(|properties| properties.get_mut(&name)), default.get(&name))
        {
            fill(content, default);
        }
    }
}

fn note_default(schema: &mut Schema, default: &Value) {
    if let (Schema::Object(keywords), Ok(default)) = (schema, serde_json::to_value(default)) {
        keywords.insert("default".to_owned(), default);
    }
}
