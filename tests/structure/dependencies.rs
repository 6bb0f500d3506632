//! What the workspace depends on, by the rules of `deny.toml`: licences, crates and where they come from.

use crate::source::workspace;
use serde_json::Value;
use std::process::Command;

/// Crates that nobody maintains any longer, which others bring along; a new one is a decision.
const UNMAINTAINED: [&str; 3] = ["paste", "rustybuzz", "ttf-parser"];

fn packages() -> Vec<Value> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--locked", "--offline"])
        .current_dir(workspace())
        .output()
        .expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("packages").clone()
}

fn rules() -> toml::Table {
    let text = std::fs::read_to_string(workspace().join("deny.toml")).expect("deny.toml");
    toml::from_str(&text).expect("TOML")
}

fn texts(rules: &toml::Table, section: &str, key: &str) -> Vec<String> {
    let values = rules[section][key].as_array().expect("a list");
    let text = |value: &toml::Value| value.get("crate").unwrap_or(value).as_str().expect("a text").to_owned();
    values.iter().map(text).collect()
}

/// Whether an SPDX expression can be met with allowed licences: `or` binds weaker than `and`, and brackets are first.
fn is_allowed(expression: &str, allowed: &[String]) -> bool {
    let expression = expression.trim();
    let parts = |word: &str| split(expression, word);
    let choices = parts(" OR ");
    if choices.len() > 1 {
        return choices.into_iter().any(|choice| is_allowed(choice, allowed));
    }
    let all = parts(" AND ");
    if all.len() > 1 {
        return all.into_iter().all(|one| is_allowed(one, allowed));
    }
    match expression.strip_prefix('(').and_then(|inner| inner.strip_suffix(')')) {
        Some(inner) => is_allowed(inner, allowed),
        None => allowed.iter().any(|licence| licence == expression),
    }
}

/// The parts of a text between words that stand outside of brackets.
fn split<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0);
    for (place, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 && place >= start && text[place..].starts_with(word) {
            parts.push(&text[start..place]);
            start = place + word.len();
        }
    }
    parts.push(&text[start..]);
    parts
}

#[test]
fn every_crate_has_a_licence_and_a_source_that_the_project_allows() {
    let rules = rules();
    let allowed = texts(&rules, "licenses", "allow");
    let (banned, registries) = (texts(&rules, "bans", "deny"), texts(&rules, "sources", "allow-registry"));
    let mut offences = Vec::new();
    let mut unmaintained = Vec::new();
    for package in packages() {
        let name = package["name"].as_str().expect("a name").to_owned();
        // older crates write a stroke for OR
        let licence = package["license"].as_str().unwrap_or("none").replace('/', " OR ").replace("  ", " ");
        if !is_allowed(&licence.replace("  ", " "), &allowed) {
            offences.push(format!("{name}: licence {licence}"));
        }
        if banned.contains(&name) {
            offences.push(format!("{name}: banned"));
        }
        if let Some(source) = package["source"].as_str()
            && !registries.iter().any(|registry| source == format!("registry+{registry}"))
        {
            offences.push(format!("{name}: from {source}"));
        }
        if UNMAINTAINED.contains(&name.as_str()) {
            unmaintained.push(name);
        }
    }
    unmaintained.sort();
    assert!(offences.is_empty(), "{}", offences.join("\n"));
    assert_eq!(unmaintained, UNMAINTAINED, "take out of the list what is gone");
}

#[test]
fn expressions_of_licences_are_understood() {
    let allowed = ["MIT".to_owned(), "Unicode-3.0".to_owned(), "Apache-2.0 WITH LLVM-exception".to_owned()];
    for (expression, holds) in [
        ("MIT", true),
        ("GPL-3.0", false),
        ("MIT OR GPL-3.0", true),
        ("GPL-3.0 OR Apache-2.0 WITH LLVM-exception OR AGPL-3.0", true),
        ("(MIT OR GPL-3.0) AND Unicode-3.0", true),
        ("(GPL-3.0 OR LGPL-2.1) AND Unicode-3.0", false),
        ("MIT AND GPL-3.0", false),
        ("none", false),
    ] {
        assert_eq!(is_allowed(expression, &allowed), holds, "{expression}");
    }
}
