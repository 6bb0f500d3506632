//! Dependencies of all workspaces, by the rules of `deny.toml`: licences, crates, their versions and sources. Licences are
//! those of this platform's crates; `.ci/run` fetches the crates of all platforms and runs the test that asks for theirs.

use crate::structure::source::workspace;
use std::process::Command;

/// Manifests of what users run.
const SHIPPED: [&str; 2] = ["Cargo.toml", "python/Cargo.toml"];
/// Manifests of tests that need what a program of the project may not have.
const OTHERS: [&str; 2] = ["tests/browser/Cargo.toml", "tests/schema/Cargo.toml"];

/// What a command of Cargo prints about a workspace, from what is fetched already.
fn cargo(manifest: &str, command: &str, arguments: &[&str]) -> String {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(program)
        .args([command, "--locked", "--offline", "--manifest-path", manifest])
        .args(arguments)
        .current_dir(workspace())
        .output()
        .expect("cargo");
    assert!(output.status.success(), "{manifest}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Packages that are built, whose licence is not allowed.
fn offences(manifest: &str, of: &[&str], allowed: &[String]) -> Vec<String> {
    let format = ["--prefix", "none", "--no-dedupe", "--format", "{p}|{l}"];
    let text = cargo(manifest, "tree", &[&format, of].concat());
    let mut found: Vec<(&str, &str)> = text.lines().filter_map(|line| line.rsplit_once('|')).collect();
    found.sort_unstable();
    found.dedup();
    assert!(found.len() > 100, "{manifest}: {found:?}");
    // older crates write a stroke for OR
    let is_allowed = |licence: &str| is_allowed(&licence.replace('/', " OR ").replace("  ", " "), allowed);
    found.retain(|(_, licence)| !is_allowed(licence));
    found.iter().map(|(package, licence)| format!("{manifest}: {package}: licence {licence}")).collect()
}

/// Name and source of every package that is locked, for any platform.
fn locked(manifest: &str) -> Vec<(String, Option<String>)> {
    let file = workspace().join(manifest).with_extension("lock");
    let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let lock: toml::Table = toml::from_str(&text).expect("TOML");
    let packages = lock["package"].as_array().expect("packages");
    let text = |package: &toml::Value, key: &str| package.get(key).and_then(toml::Value::as_str).map(str::to_owned);
    packages.iter().map(|package| (text(package, "name").expect("a name"), text(package, "source"))).collect()
}

/// Dependencies of a workspace's own packages that take any version of a crate.
fn of_any_version(manifest: &str) -> Vec<String> {
    let metadata: serde_json::Value =
        serde_json::from_str(&cargo(manifest, "metadata", &["--no-deps", "--format-version", "1"])).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    let dependencies = packages.iter().flat_map(|package| package["dependencies"].as_array().expect("a list"));
    let wild = dependencies.filter(|dependency| dependency["req"] == "*" && dependency["path"].is_null());
    wild.map(|dependency| format!("{manifest}: {} of any version", dependency["name"])).collect()
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
    let (banned, registries) = (texts(&rules, "bans", "deny"), texts(&rules, "sources", "allow-registry"));
    let allowed = texts(&rules, "licenses", "allow");
    let mut offences = offences("Cargo.toml", &["--edges", "normal,build,dev"], &allowed);
    for manifest in [SHIPPED, OTHERS].concat() {
        for (name, source) in locked(manifest) {
            if banned.contains(&name) && SHIPPED.contains(&manifest) {
                offences.push(format!("{manifest}: {name}: banned"));
            }
            if let Some(source) = source
                && !registries.iter().any(|registry| source == format!("registry+{registry}"))
            {
                offences.push(format!("{manifest}: {name}: from {source}"));
            }
        }
        offences.extend(of_any_version(manifest));
    }
    assert!(offences.is_empty(), "{}", offences.join("\n"));
}

#[test]
#[ignore = "needs the crates of all platforms: .ci/run"]
fn every_crate_of_every_platform_has_a_licence_that_the_project_allows() {
    let allowed = texts(&rules(), "licenses", "allow");
    let of = ["--edges", "normal,build", "--target", "all"];
    let offences = SHIPPED.map(|manifest| offences(manifest, &of, &allowed)).concat();
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
