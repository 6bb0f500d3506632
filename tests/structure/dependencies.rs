//! Dependencies of the workspace, by the rules of `deny.toml`: licences, crates and their sources. Licences are those
//! of this platform's crates; `.ci/run` asks cargo-deny for all.

use crate::structure::source::workspace;
use std::process::Command;

/// Name and licence of everything that the two commands of README build on this platform: a machine that has run them has
/// fetched nothing else, so that Cargo cannot be asked for more without a network.
fn built() -> Vec<(String, String)> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--locked", "--offline", "--edges", "normal,build,dev", "--prefix", "none"])
        .args(["--no-dedupe", "--format", "{p}|{l}"])
        .current_dir(workspace())
        .output()
        .expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut found: Vec<(String, String)> = text
        .lines()
        .filter_map(|line| line.rsplit_once('|'))
        .map(|(package, licence)| (package.split(' ').next().unwrap_or_default().to_owned(), licence.to_owned()))
        .collect();
    found.sort();
    found.dedup();
    assert!(found.len() > 100, "{found:?}");
    found
}

/// Name and source of every package that is locked, for any platform.
fn locked() -> Vec<(String, Option<String>)> {
    let text = std::fs::read_to_string(workspace().join("Cargo.lock")).expect("Cargo.lock");
    let lock: toml::Table = toml::from_str(&text).expect("TOML");
    let packages = lock["package"].as_array().expect("packages");
    let text = |package: &toml::Value, key: &str| package.get(key).and_then(toml::Value::as_str).map(str::to_owned);
    packages.iter().map(|package| (text(package, "name").expect("a name"), text(package, "source"))).collect()
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
    for (name, licence) in built() {
        // older crates write a stroke for OR
        if !is_allowed(&licence.replace('/', " OR ").replace("  ", " "), &allowed) {
            offences.push(format!("{name}: licence {licence}"));
        }
    }
    for (name, source) in locked() {
        if banned.contains(&name) {
            offences.push(format!("{name}: banned"));
        }
        if let Some(source) = source
            && !registries.iter().any(|registry| source == format!("registry+{registry}"))
        {
            offences.push(format!("{name}: from {source}"));
        }
    }
    assert!(offences.is_empty(), "{}", offences.join("\n"));
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
