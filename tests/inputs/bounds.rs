//! No number of a case's parameters is without bounds. That schema and program agree on them is for `tests/schema`.

use bagnold_harness::case::Tier;
use bagnold_solver::parameter::{positive, schema_of};
use bagnold_validation::REGISTRY;
use schemars::JsonSchema;
use serde_json::Value;

/// Numbers of all cases that only their unit bounds; only fewer are allowed.
const BOUNDED_BY_UNIT: usize = 263;

#[test]
fn every_number_of_every_case_is_bounded_on_both_sides() {
    for case in REGISTRY.cases() {
        let loose = unbounded(&flow(case.schema(Tier::Quick)));
        assert!(loose.is_empty(), "{}: give a unit in the doc comment, or a rule: {loose:?}", case.name());
    }
}

/// Of the numbers of a bed, the one without unit and rule.
#[test]
fn a_number_without_rule_and_unit_is_found() {
    #[derive(JsonSchema)]
    #[expect(dead_code, reason = "only its schema is read")]
    struct Bed {
        /// Depth `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        depth: f64,
        /// Angles `[°]`.
        angles: Vec<f64>,
        /// Pairs: thickness `[m]`, angle `[°]`.
        stops: Vec<(f64, f64)>,
        columns: usize,
        nameless: f64,
    }

    assert_eq!(unbounded(schema_of::<Bed>()), [".nameless"]);
}

#[test]
fn no_number_loses_its_own_rule() {
    let mut found = Vec::new();
    for case in REGISTRY.cases() {
        without_rule(&flow(case.schema(Tier::Quick)), case.name(), &mut found);
    }
    let (number, list) = (found.len(), found.join("\n"));
    assert!(number <= BOUNDED_BY_UNIT, "{number} numbers without a rule of their own, {BOUNDED_BY_UNIT} may:\n{list}");
}

/// The dotted paths of numbers that no unit bounds and no rule bounds on both sides.
fn unbounded(schema: &Value) -> Vec<String> {
    let mut found = Vec::new();
    collect_unbounded(schema, "", &mut found);
    found
}

fn collect_unbounded(schema: &Value, path: &str, found: &mut Vec<String>) {
    let kinds = match schema.get("type") {
        Some(Value::Array(kinds)) => kinds.iter().filter_map(Value::as_str).collect(),
        Some(Value::String(kind)) => vec![kind.as_str()],
        _ => Vec::new(),
    };
    let further = schema.get("allOf").and_then(Value::as_array);
    let rules: Vec<&Value> = std::iter::once(schema).chain(further.into_iter().flatten()).collect();
    let has = |keys: [&str; 2]| rules.iter().any(|rule| keys.iter().any(|key| rule.get(key).is_some()));
    let both = has(["minimum", "exclusiveMinimum"]) && has(["maximum", "exclusiveMaximum"]);
    if kinds.contains(&"number") && !both {
        found.push(path.to_owned());
    }
    for (name, field) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
        collect_unbounded(field, &format!("{path}.{name}"), found);
    }
    if let Some(items) = schema.get("items") {
        collect_unbounded(items, &format!("{path}[]"), found);
    }
    for key in ["anyOf", "oneOf", "prefixItems"] {
        for choice in schema.get(key).and_then(Value::as_array).into_iter().flatten() {
            collect_unbounded(choice, path, found);
        }
    }
}

/// A schema without its list of runs, whose values obey the rules of the fields that they are given to.
fn flow(mut schema: Value) -> Value {
    if let Some(fields) = schema["properties"].as_object_mut() {
        fields.retain(|name, _| !["variants", "vary"].contains(&name.as_str()));
    }
    schema
}

/// Paths of numbers that have no rule but that of their unit.
fn without_rule(schema: &Value, path: &str, found: &mut Vec<String>) {
    let is_number = schema["type"] == "number"
        || schema["type"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind == "number"));
    if is_number && schema["x-remedy"].is_null() {
        found.push(path.to_owned());
    }
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        without_rule(field, &format!("{path}.{name}"), found);
    }
    let choices = ["anyOf", "oneOf", "prefixItems"].into_iter().filter_map(|key| schema[key].as_array()).flatten();
    for inner in choices.chain([&schema["items"]]).filter(|inner| inner.is_object()) {
        without_rule(inner, path, found);
    }
}
