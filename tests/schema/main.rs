//! Every case's JSON Schema: it accepts what `bagnold show` prints and refuses what the program refuses.

use bagnold_validation::case::{AnyCase, Changes, Tier};
use bagnold_validation::cases::REGISTRY;
use jsonschema::Validator;
use serde_json::{Value, json};

const TIERS: [Tier; 3] = [Tier::Quick, Tier::Paper, Tier::Fine];

fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::new(schema).expect("a JSON Schema")
}

/// The shown file as JSON.
fn shown(case: &dyn AnyCase, tier: Tier) -> Value {
    toml::from_str(&case.show(tier)).expect("TOML")
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

fn with(mut file: Value, path: &[String], value: Value) -> Value {
    file[path[0].as_str()] = match path.len() {
        1 => value,
        _ => with(file[path[0].as_str()].take(), &path[1..], value),
    };
    file
}

#[test]
fn a_schema_accepts_what_show_prints() {
    for case in REGISTRY.iter() {
        for tier in TIERS {
            let schema = case.schema(tier);
            jsonschema::draft202012::meta::validate(&schema).expect("valid against the metaschema");
            let errors: Vec<String> = validator(&schema)
                .iter_errors(&shown(case, tier))
                .map(|error| format!("{}: {error}", error.instance_path()))
                .collect();
            assert!(errors.is_empty(), "{} {tier}: {errors:?}", case.name());
        }
    }
}

#[test]
fn a_schema_needs_nothing_but_the_case() {
    for case in REGISTRY.iter() {
        let validator = validator(&case.schema(Tier::Quick));
        assert!(validator.is_valid(&json!({ "case": case.name() })), "{}", case.name());
        assert!(!validator.is_valid(&json!({ "case": "another" })) && !validator.is_valid(&json!({})));
        assert!(!validator.is_valid(&json!({ "case": case.name(), "tier": "papre" })));
    }
}

#[test]
fn a_schema_refuses_unknown_fields_and_wrong_types() {
    for case in REGISTRY.iter() {
        let schema = case.schema(Tier::Quick);
        let (validator, file) = (validator(&schema), shown(case, Tier::Quick));
        for (name, field) in schema["properties"].as_object().expect("fields") {
            assert!(!validator.is_valid(&with(file.clone(), &[format!("{name}_")], json!(1))), "{name}_");
            assert!(!validator.is_valid(&with(file.clone(), std::slice::from_ref(name), json!({ "x": 1 }))), "{name}");
            assert!(field["description"].is_string() || name == "numerics", "{} says nothing of {name}", case.name());
        }
    }
}

#[test]
fn schema_and_program_refuse_the_same_values() {
    for case in REGISTRY.iter() {
        let schema = case.schema(Tier::Quick);
        let (validator, file) = (validator(&schema), shown(case, Tier::Quick));
        let mut outside = Vec::new();
        bounded(&schema, &[], &mut outside);
        assert!(outside.len() > 10, "{}", case.name());
        for Outside { path, value } in outside {
            let name = path.join(".");
            let settings = [format!("{name}={value}")];
            assert!(!validator.is_valid(&with(file.clone(), &path, value)), "{}: {}", case.name(), settings[0]);
            let refused =
                case.prepare(Tier::Quick, &Changes { file: None, settings: &settings, ..Changes::default() }).err();
            let message = refused.map(|error| error.to_string()).unwrap_or_default();
            assert!(message.contains(&format!("`{name}` is ")), "{}: {}: {message}", case.name(), settings[0]);
        }
    }
}

#[test]
fn every_number_of_every_case_is_bounded_on_both_sides() {
    for case in REGISTRY.iter() {
        let loose = bagnold_solver::parameter::unbounded(&case.schema(Tier::Quick));
        assert!(loose.is_empty(), "{}: give a unit in the doc comment, or a rule: {loose:?}", case.name());
    }
}
