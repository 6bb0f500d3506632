//! The tables that a file may add, for `bagnold show`: entries of lists in every form that they have, and optional tables.

use super::notes::note_of;
use bagnold_solver::parameter::{Shape, description, rule_in_words};
use serde_json::Value as Schema;

/// TOML in comments: the tables of schemas, each below a dotted path, with meaning, unit and rule of all their fields. Empty, if
/// there are none.
pub fn tables_to_add(schemas: &[(&str, &Schema)]) -> String {
    let tables: String = schemas.iter().map(|(path, schema)| tables_below(path, schema)).collect();
    let heading = "\n# Tables that this file may add, in place of an empty list.\n\
        # Fields with a default and optional ones may be left out; other values are examples.\n";
    if tables.is_empty() { tables } else { format!("{heading}{tables}") }
}

fn tables_below(path: &str, schema: &Schema) -> String {
    let mut text = String::new();
    for form in forms(schema) {
        let Shape::Fields { properties, required } = Shape::of(form) else { continue };
        for (name, field) in properties {
            let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
            text += &match Shape::of(field) {
                Shape::List(entry) => table(&format!("[[{path}]]"), &path, entry),
                Shape::Fields { .. } if !required.contains(&name.as_str()) => table(&format!("[{path}]"), &path, field),
                _ => tables_below(&path, field),
            };
        }
    }
    text
}

/// The forms of a table: one, or those that its tag chooses from; none for what is not a table.
fn forms(schema: &Schema) -> Vec<&Schema> {
    match Shape::of(schema) {
        Shape::Fields { .. } => vec![schema],
        Shape::Tagged { variants, .. } => variants.iter().filter_map(|variant| variant.content).collect(),
        _ => Vec::new(),
    }
}

/// A table in each of its forms, with the tables below.
fn table(head: &str, path: &str, schema: &Schema) -> String {
    let about = description(schema).unwrap_or_default();
    let form = |form| format!("\n# {head}  # {about}\n{}{}", fields("", form), tables_below(path, form));
    forms(schema).into_iter().map(form).collect()
}

/// The fields of a table; lists of tables and optional tables have tables of their own.
fn fields(path: &str, schema: &Schema) -> String {
    let Shape::Fields { properties, required } = Shape::of(schema) else { return String::new() };
    let line = |(name, field): (&String, &Schema)| {
        let is_required = required.contains(&name.as_str());
        match Shape::of(field) {
            Shape::Fields { .. } if is_required => return fields(&format!("{path}{name}."), field),
            Shape::Fields { .. } => return String::new(),
            Shape::List(entry) if !forms(entry).is_empty() => return String::new(),
            _ => {}
        }
        let left_out = if default(field).is_some() { "default" } else { "optional" };
        let left_out = (!is_required).then(|| left_out.to_owned());
        let notes = [Some(note_of(field)).filter(|note| !note.is_empty()), rule_in_words(field), left_out];
        let notes: Vec<String> = notes.into_iter().flatten().collect();
        format!("# {path}{name} = {}  # {}\n", example(field), notes.join("; "))
    };
    properties.iter().map(line).collect()
}

/// The default; TOML has no null.
fn default(schema: &Schema) -> Option<toml::Value> {
    toml::Value::try_from(schema.get("default")?).ok()
}

/// A value as TOML: the default, or an example of the type.
fn example(schema: &Schema) -> String {
    if let Some(default) = default(schema) {
        return default.to_string();
    }
    match Shape::of(schema) {
        Shape::Choice(variants) => format!("\"{}\"", variants[0].name),
        Shape::List(entry) => format!("[{}]", example(entry)),
        Shape::Tuple(entries) => format!("[{}]", entries.iter().map(example).collect::<Vec<_>>().join(", ")),
        Shape::Number => "1.0".to_owned(),
        Shape::Integer { .. } => "1".to_owned(),
        Shape::Flag => "false".to_owned(),
        Shape::Text => "\"…\"".to_owned(),
        Shape::Fields { .. } | Shape::Tagged { .. } | Shape::Any => {
            schema.get("anyOf").map_or_else(|| "{}".to_owned(), |choices| example(&choices[0]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::parameter::{positive, schema_of};
    use schemars::JsonSchema;

    /// A probe.
    #[derive(JsonSchema)]
    #[schemars(tag = "kind", rename_all = "kebab-case")]
    #[expect(dead_code, reason = "only its schema is used")]
    enum Probe {
        /// Speed at a place.
        Speed {
            /// Place x, y `[m]`. It may move.
            at: (f64, f64),
            #[schemars(transform = positive("give it in metres"))]
            /// Width `[m]`.
            width: Option<f64>,
        },
        /// Rows that are counted.
        Count { rows: Vec<Row> },
    }

    /// A row.
    #[derive(JsonSchema)]
    #[expect(dead_code, reason = "only its schema is used")]
    struct Row {
        /// Number of particles.
        #[schemars(default)]
        number: u32,
    }

    #[derive(JsonSchema)]
    #[expect(dead_code, reason = "only its schema is used")]
    struct Scene {
        spacing: f64,
        probes: Vec<Probe>,
        /// The last row.
        last: Option<Row>,
    }

    #[test]
    fn every_field_of_an_entry_has_its_note_rule_and_default() {
        let expected = r#"
# Tables that this file may add, in place of an empty list.
# Fields with a default and optional ones may be left out; other values are examples.

# [[scene.probes]]  # A probe.
# kind = "speed"  # speed at a place
# at = [1.0, 1.0]  # place x, y [m]
# width = 1.0  # width [m]; positive and finite; optional

# [[scene.probes]]  # A probe.
# kind = "count"  # rows that are counted

# [[scene.probes.rows]]  # A row.
# number = 0  # number of particles; at least 0; default

# [scene.last]  # The last row.
# number = 0  # number of particles; at least 0; default
"#;
        assert_eq!(tables_to_add(&[("scene", schema_of::<Scene>())]), expected);
        assert_eq!(tables_to_add(&[("", schema_of::<f64>())]), "");
    }
}
