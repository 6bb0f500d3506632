//! No number of a case's parameters is without bounds. That schema and program agree on them is for `tests/schema`.

use bagnold_harness::case::Tier;
use bagnold_validation::REGISTRY;
use serde_json::Value;

/// Numbers of all cases that only their unit bounds; only fewer are allowed.
const BOUNDED_BY_UNIT: usize = 263;

#[test]
fn every_number_of_every_case_is_bounded_on_both_sides() {
    for case in REGISTRY.cases() {
        let loose = bagnold_solver::parameter::unbounded(&flow(case.schema(Tier::Quick)));
        assert!(loose.is_empty(), "{}: give a unit in the doc comment, or a rule: {loose:?}", case.name());
    }
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
