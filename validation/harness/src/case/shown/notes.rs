//! The remarks of `bagnold show`, from the parameters' doc comments.

use bagnold_solver::parameter::{Shape, description};
use serde_json::Value as Schema;
use std::collections::BTreeMap;
use toml::{Table, Value};

/// Remarks on the parameters by dotted path, each with its unit; entries of lists are numbered, `gauges[0].width`.
pub(in crate::case) fn notes(schema: &Schema, parameters: &Table) -> BTreeMap<String, String> {
    let mut notes = BTreeMap::new();
    collect(schema, &Value::Table(parameters.clone()), "", &mut notes);
    notes
}

/// Notes a value and what is below it.
fn collect(schema: &Schema, value: &Value, path: &str, notes: &mut BTreeMap<String, String>) {
    let below = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    let shape = Shape::of(schema);
    match (&shape, value) {
        (Shape::Fields { properties, .. }, Value::Table(table)) => {
            for (name, schema) in *properties {
                if let Some(value) = table.get(name) {
                    note(schema, name, below(name), notes);
                    collect(schema, value, &below(name), notes);
                }
            }
        }
        (Shape::Choice(_), Value::Table(_)) => {
            if let Some((variant, (content, inner))) =
                shape.chosen(value).and_then(|variant| Some((variant, (variant.content?, value.get(variant.name)?))))
            {
                // The table's head has the variant's name; what the choice is about stands there.
                let head = notes.get(path).cloned();
                notes.extend(head.map(|head| (below(variant.name), head)));
                collect(content, inner, &below(variant.name), notes);
            }
        }
        (Shape::Tagged { tag, variants, .. }, Value::Table(_)) => {
            notes.insert(below(tag), names(variants.iter().map(|variant| variant.name)));
            if let Some(content) = shape.chosen(value).and_then(|variant| variant.content) {
                let tag = below(tag);
                let choices = notes.get(&tag).cloned();
                collect(content, value, path, notes);
                notes.extend(choices.map(|choices| (tag, choices)));
            }
        }
        (Shape::List(items), Value::Array(values)) => {
            for (index, value) in values.iter().enumerate().filter(|(_, value)| value.is_table()) {
                let entry = format!("{path}[{index}]");
                // the head of each entry has the list's note
                notes.extend(notes.get(path).cloned().map(|note| (entry.clone(), note)));
                collect(items, value, &entry, notes);
            }
        }
        _ => {}
    }
}

/// Meaning of a field, with its unit and the names that it is one of.
pub(in crate::case) fn note_of(schema: &Schema) -> String {
    let about = description(schema).map(|text| remark(&text)).unwrap_or_default();
    let choices = choices(schema).unwrap_or_default();
    match (about.is_empty(), choices.is_empty()) {
        (_, true) => about,
        (true, false) => choices,
        (false, false) => format!("{about}: {choices}"),
    }
}

fn note(schema: &Schema, name: &str, path: String, notes: &mut BTreeMap<String, String>) {
    let note = note_of(schema);
    if !note.is_empty() && note.replace(' ', "_") != name {
        notes.insert(path, note);
    }
}

/// The names that an enum's value, or each of a list's, is one of.
fn choices(schema: &Schema) -> Option<String> {
    match Shape::of(schema) {
        Shape::Choice(variants) if variants.len() > 1 => Some(names(variants.iter().map(|variant| variant.name))),
        Shape::List(items) => choices(items),
        _ => None,
    }
}

/// `"a", "b" or "c"`.
fn names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// The first sentence of a doc comment as a remark: units and names without their backquotes, a small letter in front.
pub(in crate::case) fn remark(description: &str) -> String {
    let is_end = |(at, _): &(usize, &str)| {
        let word = description[..*at].rsplit([' ', '(']).next().unwrap_or_default();
        !["al", "e.g", "i.e", "Eq", "Fig"].contains(&word)
    };
    let sentence = description.match_indices(". ").find(is_end).map_or(description, |(at, _)| &description[..at]);
    let text = sentence.trim_end_matches('.').replace("`[", "[").replace("]`", "]");
    let mut letters = text.chars();
    match (letters.next(), letters.clone().next()) {
        (Some(first), Some(second)) if second.is_lowercase() => first.to_lowercase().chain(letters).collect(),
        (Some('A'), Some(' ')) => format!("a{}", letters.as_str()),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_remark_is_the_first_sentence_with_its_unit() {
        assert_eq!(remark("Layer height h `[m]`."), "layer height h [m]");
        assert_eq!(remark("Rows of the study; empty for none. Each is run once."), "rows of the study; empty for none");
        assert_eq!(remark("Pile of Bui et al. (2008). Observed only."), "pile of Bui et al. (2008)");
        assert_eq!(remark("Density of the material. Grains and gaps."), "density of the material");
        assert_eq!(remark("C_s of the eddy viscosity (5) `[-]`."), "C_s of the eddy viscosity (5) [-]");
        assert_eq!(remark("σ of (27) `[-]`."), "σ of (27) [-]");
    }

    #[test]
    fn entries_of_a_list_have_notes_of_their_own() {
        let form = |kind: &str, about: &str| {
            let width = json!({ "type": "number", "description": about });
            json!({ "type": "object", "properties": { "kind": { "const": kind }, "width": width } })
        };
        let forms = [form("front", "Width of a strip `[m]`."), form("depth", "Diameter `[m]`.")];
        let gauges = json!({ "type": "array", "items": { "oneOf": forms }, "description": "Probes." });
        let schema = json!({ "type": "object", "properties": { "gauges": gauges } });
        let given = "[[gauges]]\nkind = \"front\"\nwidth = 1.0\n[[gauges]]\nkind = \"depth\"\nwidth = 2.0";
        let notes = notes(&schema, &toml::from_str(given).expect("TOML"));
        let of = ["gauges[0]", "gauges[0].width", "gauges[1]", "gauges[1].width"].map(|path| notes[path].as_str());
        assert_eq!(of, ["probes", "width of a strip [m]", "probes", "diameter [m]"]);
    }

    #[test]
    fn names_are_listed_as_in_a_sentence() {
        assert_eq!(names(["a", "b", "c"].into_iter()), "\"a\", \"b\" or \"c\"");
        assert_eq!(names(["a"].into_iter()), "\"a\"");
    }
}
