//! Random changes of a case's parameters, made from its schema.

use bagnold_harness::case::{AnyCase, Tier};
use bagnold_validation::REGISTRY;
use proptest::prelude::*;
use proptest::sample::Index;
use serde_json::Value;

/// Field that may be changed: a dotted path, with values that fit its type and values that do not.
#[derive(Debug, Clone)]
pub(crate) struct Leaf {
    pub(crate) path: String,
    values: Vec<String>,
}

/// A case with some of its parameters changed.
#[derive(Debug, Clone)]
pub(crate) struct Input {
    pub(crate) case: &'static str,
    pub(crate) settings: Vec<String>,
}

/// Numbers that somebody may type by mistake.
const NUMBERS: [&str; 27] = [
    "nan", "inf", "-inf", "0", "-0.0", "-1.0", "1", "1e308", "-1e308", "1e-308", "5e-324", "9.2e18", "1e15", "1e10",
    "1e6", "1e5", "1e4", "1e3", "100.0", "10.0", "0.5", "0.1", "0.01", "1e-3", "1e-6", "1e-9", "1e-12",
];

const COUNTS: [&str; 14] =
    ["-1", "0", "1", "2", "3", "4", "5", "17", "1000", "1001", "100000", "1000000", "9223372036854775807", "1.5"];

/// Values of other types than numbers.
const OTHERS: [&str; 7] = ["\"\"", "\"word\"", "true", "[]", "{}", "2024-01-01", "[[[]]]"];

/// The list of `bagnold-dev verify`: with its settings a case takes a moment.
const SHORT_RUNS: &str = include_str!("../../validation/dev/short_runs.toml");

/// The settings that cut a case short.
fn short(case: &str) -> Vec<String> {
    let list: toml::Table = toml::from_str(SHORT_RUNS).expect("TOML");
    let runs = list["runs"].as_array().expect("runs");
    let run = runs.iter().find(|run| run["case"].as_str() == Some(case)).expect("every case has a short run");
    let texts = run["settings"].as_array().expect("settings").iter();
    texts.map(|text| text.as_str().expect("a text").to_owned()).collect()
}

/// Inputs of all cases cut short, one to three changes each.
pub(crate) fn inputs() -> impl Strategy<Value = Input> {
    let cases: Vec<(&'static str, Vec<Leaf>)> = REGISTRY.cases().map(|case| (case.name(), leaves(case))).collect();
    let changes = prop::collection::vec((any::<Index>(), any::<Index>()), 1..=3);
    (any::<Index>(), changes).prop_map(move |(case, changes)| {
        let (case, leaves) = &cases[case.index(cases.len())];
        let setting = |(leaf, value): &(Index, Index)| {
            let leaf = &leaves[leaf.index(leaves.len())];
            format!("{}={}", leaf.path, leaf.values[value.index(leaf.values.len())])
        };
        let mut settings = short(case);
        for setting in changes.iter().map(setting) {
            // a field may be given once
            let path = |setting: &str| setting.split('=').next().unwrap_or_default().to_owned();
            settings.retain(|other| path(other) != path(&setting));
            settings.push(setting);
        }
        Input { case, settings }
    })
}

fn leaves(case: &dyn AnyCase) -> Vec<Leaf> {
    let mut found = Vec::new();
    collect(&case.schema(Tier::Quick), "", &mut found);
    found.retain(|leaf| !["case", "tier"].contains(&leaf.path.as_str()));
    found
}

fn collect(schema: &Value, path: &str, found: &mut Vec<Leaf>) {
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        collect(field, &path, found);
        let mut values = values_of(field);
        values.extend(OTHERS.map(str::to_owned));
        found.push(Leaf { path, values });
    }
    for choice in ["anyOf", "oneOf"].iter().flat_map(|key| schema[key].as_array().into_iter().flatten()) {
        collect(choice, path, found);
    }
}

/// Values of about a schema's type, as TOML.
fn values_of(schema: &Value) -> Vec<String> {
    let is = |kind: &str| {
        schema["type"] == kind || schema["type"].as_array().is_some_and(|kinds| kinds.contains(&kind.into()))
    };
    let mut values: Vec<String> = Vec::new();
    if is("number") {
        values.extend(NUMBERS.map(str::to_owned));
        values.extend(near(schema));
    } else if is("integer") {
        values.extend(COUNTS.map(str::to_owned));
    } else if is("array") {
        let inner = match schema["prefixItems"].as_array() {
            Some(entries) => {
                let entries: Vec<Vec<String>> = entries.iter().map(values_of).collect();
                return (0..30).map(|index| tuple(&entries, index)).collect();
            }
            None => values_of(&schema["items"]),
        };
        values.extend(inner.iter().map(|value| format!("[{value}]")));
        values.extend(inner.iter().map(|value| format!("[{value}, {value}]")));
        values.extend(inner.windows(2).map(|pair| format!("[{}, {}]", pair[0], pair[1])));
    }
    let names = [&schema["enum"], &schema["const"]].into_iter().flat_map(|names| match names {
        Value::Array(names) => names.clone(),
        Value::Null => Vec::new(),
        name => vec![name.clone()],
    });
    values.extend(names.filter(|name| !name.is_null()).map(|name| name.to_string()));
    for choice in ["anyOf", "oneOf"].iter().flat_map(|key| schema[key].as_array().into_iter().flatten()) {
        values.extend(values_of(choice));
    }
    values
}

fn tuple(entries: &[Vec<String>], index: usize) -> String {
    let pick = |(place, values): (usize, &Vec<String>)| {
        values.get((index * (7 * place + 1)) % values.len().max(1)).cloned().unwrap_or_default()
    };
    format!("[{}]", entries.iter().enumerate().map(pick).collect::<Vec<_>>().join(", "))
}

/// Numbers about the default, most of which are taken.
fn near(schema: &Value) -> Vec<String> {
    let Some(default) = schema["default"].as_f64() else { return Vec::new() };
    [0.5, 0.9, 1.1, 2.0, -1.0].map(|factor| format!("{:?}", factor * default)).to_vec()
}
