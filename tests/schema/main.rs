//! Every case's JSON Schema: it accepts what `bagnold show` prints and refuses what the program refuses.
//!
//! Needs a program: `BAGNOLD=target/debug/bagnold cargo test --manifest-path tests/schema/Cargo.toml`. It stands apart from the
//! other tests, which do without the library that checks schemas; `.ci/run` runs it.

use jsonschema::Validator;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::{Command, Output};

const TIERS: [&str; 3] = ["quick", "paper", "fine"];

fn bagnold(arguments: &[&str]) -> Output {
    let checkout = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let program = std::env::var_os("BAGNOLD").map_or("target/debug/bagnold".into(), PathBuf::from);
    let output = Command::new(checkout.join(&program)).args(arguments).current_dir(&checkout).output();
    output.unwrap_or_else(|error| panic!("{}: {error}; set BAGNOLD to the program's path", program.display()))
}

fn printed(arguments: &[&str]) -> String {
    let output = bagnold(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// Cases and canonical studies.
fn all() -> Vec<String> {
    printed(&["list"]).lines().filter_map(|line| line.split_whitespace().next().map(str::to_owned)).collect()
}

/// Cases alone: the file of a study holds no parameters of a type.
fn cases() -> Vec<String> {
    let cases: Vec<String> = all().into_iter().filter(|name| shown(name, "quick").get("study").is_none()).collect();
    assert!(cases.len() >= 16, "{cases:?}");
    cases
}

fn schema(case: &str, tier: &str) -> Value {
    serde_json::from_str(&printed(&["schema", case, "--tier", tier])).expect("JSON")
}

/// The shown file as JSON.
fn shown(case: &str, tier: &str) -> Value {
    toml::from_str(&printed(&["show", case, "--tier", tier])).expect("TOML")
}

fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::new(schema).expect("a JSON Schema")
}

/// A number's path, with a value just outside its bounds.
struct Outside {
    path: Vec<String>,
    value: Value,
}

/// Every number in tables of fields that has a lower or an upper bound.
fn bounded(schema: &Value, path: &[String], found: &mut Vec<Outside>) {
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        let path = [path, std::slice::from_ref(name)].concat();
        let bound = |key: &str| field[key].as_f64();
        let below = bound("minimum").map(|least| least - 1.0).or(bound("exclusiveMinimum"));
        let above = bound("maximum").map(|most| most + 1.0).or(bound("exclusiveMaximum"));
        let whole = field["type"] == "integer";
        for value in [below, above].into_iter().flatten() {
            found.push(Outside { path: path.clone(), value: if whole { json!(value as i64) } else { json!(value) } });
        }
        bounded(field, &path, found);
    }
}

/// Every list of tables with a form of its entries each.
fn lists(schema: &Value, path: &str, found: &mut Vec<(String, Value)>) {
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}{name}");
        let entry = &field["items"];
        let forms = if entry["properties"].is_null() { entry["oneOf"].as_array() } else { None };
        let forms = forms.cloned().unwrap_or_else(|| vec![entry.clone()]);
        found.extend(forms.into_iter().filter(|form| form["properties"].is_object()).map(|form| (path.clone(), form)));
        for inner in [field, entry].into_iter().chain(field["oneOf"].as_array().into_iter().flatten()) {
            lists(inner, &format!("{path}."), found);
        }
    }
}

/// The fields of a table and of the tables in it, but not those of lists of tables.
fn fields(table: &Value, path: &str) -> Vec<(String, Value)> {
    let below = |(name, field): (&String, &Value)| match field["properties"].is_object() {
        true => fields(field, &format!("{path}{name}.")),
        false => vec![(format!("{path}{name}"), field.clone())],
    };
    let all = table["properties"].as_object().into_iter().flatten().flat_map(below);
    all.filter(|(_, field)| !field["items"]["properties"].is_object()).collect()
}

fn with(mut file: Value, path: &[String], value: Value) -> Value {
    file[path[0].as_str()] = match path.len() {
        1 => value,
        _ => with(file[path[0].as_str()].take(), &path[1..], value),
    };
    file
}

#[test]
fn a_schema_accepts_what_show_prints() {
    for case in all() {
        for tier in TIERS {
            let schema = schema(&case, tier);
            jsonschema::draft202012::meta::validate(&schema).expect("valid against the metaschema");
            let errors: Vec<String> = validator(&schema)
                .iter_errors(&shown(&case, tier))
                .map(|error| format!("{}: {error}", error.instance_path()))
                .collect();
            assert!(errors.is_empty(), "{case} {tier}: {errors:?}");
        }
    }
}

#[test]
fn show_and_schema_document_every_field_of_list_entries() {
    for case in all() {
        let text = printed(&["show", &case]);
        let mut found = Vec::new();
        lists(&schema(&case, "quick"), "", &mut found);
        let has_lists = ["scene", "scene-space", "footing"].contains(&case.as_str());
        assert!(!has_lists || found.len() >= 10, "{case}: {found:?}");
        // [paper] has the lists of [set]
        for (path, form) in found.iter().filter(|(path, _)| !path.starts_with("paper.")) {
            let head = format!("# [[{path}]]");
            let tables: Vec<&str> = text.split("\n\n").filter(|table| table.starts_with(&head)).collect();
            let is_documented = |table: &str, (name, field): &(String, Value)| {
                let about = field["description"].as_str().unwrap_or_else(|| panic!("{case}: {path}.{name}: {field}"));
                let about = about.split_whitespace().collect::<Vec<_>>().join(" ");
                let sentence = about.split(". ").next().unwrap_or_default().trim_end_matches('.').replace("`[", "[");
                let words = [&sentence.replace("]`", "]"), field["x-rule"].as_str().unwrap_or_default()];
                let of = |table: &str, name: &str| {
                    let line = table.lines().find(|line| line.starts_with(&format!("# {name} = ")));
                    line.unwrap_or_default().to_lowercase()
                };
                // a table within the entry has a block of its own
                let line = name.rsplit_once('.').map_or_else(String::new, |(within, name)| {
                    let head = format!("# [{path}.{within}]");
                    let own = text.split("\n\n").filter(|table| table.starts_with(&head));
                    own.map(|table| of(table, name)).find(|line| !line.is_empty()).unwrap_or_default()
                });
                let line = if line.is_empty() { of(table, name) } else { line };
                words.iter().all(|words| !line.is_empty() && line.contains(&words.to_lowercase()))
            };
            let fields = fields(form, "");
            let is_whole = |table: &&str| fields.iter().all(|field| is_documented(table, field));
            assert!(!fields.is_empty() && tables.iter().any(is_whole), "{case}: {path}: {tables:#?}");
        }
    }
}

#[test]
fn a_schema_needs_nothing_but_the_case() {
    for case in cases() {
        let validator = validator(&schema(&case, "quick"));
        assert!(validator.is_valid(&json!({ "case": case })), "{case}");
        assert!(!validator.is_valid(&json!({ "case": "another" })) && !validator.is_valid(&json!({})));
        assert!(!validator.is_valid(&json!({ "case": case, "tier": "papre" })));
    }
}

#[test]
fn a_schema_refuses_unknown_fields_and_wrong_types() {
    for case in cases() {
        let (schema, file) = (schema(&case, "quick"), shown(&case, "quick"));
        let validator = validator(&schema);
        for (name, field) in schema["properties"].as_object().expect("fields") {
            assert!(!validator.is_valid(&with(file.clone(), &[format!("{name}_")], json!(1))), "{name}_");
            assert!(!validator.is_valid(&with(file.clone(), std::slice::from_ref(name), json!({ "x": 1 }))), "{name}");
            assert!(field["description"].is_string() || name == "numerics", "{case} has no description of {name}");
        }
    }
}

#[test]
fn schema_and_program_refuse_the_same_values() {
    for case in cases() {
        let (schema, file) = (schema(&case, "quick"), shown(&case, "quick"));
        let validator = validator(&schema);
        let mut outside = Vec::new();
        bounded(&schema, &[], &mut outside);
        assert!(outside.len() > 10, "{case}");
        for Outside { path, value } in outside {
            let name = path.join(".");
            let setting = format!("{name}={value}");
            assert!(!validator.is_valid(&with(file.clone(), &path, value)), "{case}: {setting}");
            // what the program wrongly took would be refused as too long
            let output = bagnold(&["run", &case, "--set", &setting, "--most-hours", "1e-9"]);
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(
                output.status.code() == Some(2) && message.contains(&format!("`{name}` is ")),
                "{case}: {setting}: {message}"
            );
        }
    }
}

#[test]
fn the_schema_of_a_study_accepts_the_shipped_one_and_refuses_slips() {
    let schema: Value = serde_json::from_str(&printed(&["schema", "study"])).expect("JSON");
    jsonschema::draft202012::meta::validate(&schema).expect("valid against the metaschema");
    let validator = validator(&schema);
    let file =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../validation/examples/studies/beads-in-a-flume.toml");
    let text = std::fs::read_to_string(file).expect("the shipped study");
    let study = |from: &str, to: &str| -> Value {
        assert!(text.contains(from), "{from}");
        toml::from_str(&text.replacen(from, to, 1)).expect("TOML")
    };
    let errors: Vec<String> =
        validator.iter_errors(&study("", "")).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:?}");
    for (from, to) in [
        ("study = ", "stduy = "),
        ("base = \"flume.toml\"", ""),
        ("base = ", "case = \"scene\"\nbase = "),
        ("values = [0.01, 0.005]", "values = 0.01"),
        ("value = \"last\"", "value = \"latest\""),
        ("value = \"last\"", ""),
        ("value = \"last\"", "value = \"last\"\nmetric = \"energy_residual\""),
        ("at_most = 2.0", "at_most = \"2\""),
        ("confidence = \"exact\"", "confidence = \"sure\""),
        ("within = [-151.6, -145.6]", "within = [-151.6]"),
    ] {
        assert!(!validator.is_valid(&study(from, to)), "{from} -> {to}");
    }
}
