//! Numbers in the two models: constants of physics are parameters of laws, numerical choices stand in `Numerics`; what is
//! left is listed in `literals.toml`, each with its reason.

use crate::structure::source::{Source, is_word, sources, workspace};
use serde::Deserialize;
use std::collections::BTreeSet;

/// Numbers that need no reason.
const FREE: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 3.0, 4.0, std::f64::consts::PI];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    literal: Vec<Entry>,
}

/// Literals of a file that share a reason.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// Path below `solver/src`.
    file: String,
    /// As they are written.
    literals: Vec<String>,
    reason: String,
}

/// A number as it is written, and its line.
fn literals(source: &Source) -> Vec<(String, usize)> {
    let code = without_ranges(without_numerics_defaults(source));
    let bytes = code.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        if !is_word(bytes[at]) {
            at += 1;
            continue;
        }
        let start = at;
        let is_number = bytes[at].is_ascii_digit();
        while at < bytes.len() && is_word(bytes[at]) {
            at += 1;
        }
        if !is_number {
            continue;
        }
        let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        // `pair.0` is a field, and so is each part of `pair.0.1`
        let is_field = start > 0 && bytes[start - 1] == b'.' && !(start > 1 && bytes[start - 2] == b'.');
        if !is_field && bytes.get(at) == Some(&b'.') && bytes.get(at + 1) != Some(&b'.') {
            at += usize::from(digit(at + 1) || !bytes.get(at + 1).is_some_and(|byte| is_word(*byte)));
            while at < bytes.len() && is_word(bytes[at]) {
                at += 1;
            }
        }
        if code[start..at].ends_with('e') && matches!(bytes.get(at), Some(b'-' | b'+')) && digit(at + 1) {
            at += 1;
            while at < bytes.len() && is_word(bytes[at]) {
                at += 1;
            }
        }
        let text = &code[start..at];
        if !is_field && !value(text).is_some_and(|value| FREE.contains(&value)) {
            found.push((text.to_owned(), source.line(start)));
        }
    }
    found
}

/// The value of a literal without its type; none for what is no number, such as one in another base.
fn value(text: &str) -> Option<f64> {
    let plain = text.replace('_', "");
    let types = ["f64", "f32", "usize", "isize", "u64", "u32", "u16", "u8", "i64", "i32", "i16", "i8"];
    let bare = types.iter().find_map(|kind| plain.strip_suffix(kind)).unwrap_or(&plain);
    bare.parse().ok()
}

/// The code with the declared ranges of parameters blanked: `#[schemars(…)]`.
fn without_ranges(mut code: String) -> String {
    let starts: Vec<usize> = code.match_indices("#[schemars(").map(|hit| hit.0).collect();
    for start in starts {
        let end = code[start..].find("))]").map_or(code.len(), |length| start + length);
        let blank: String = code[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        code.replace_range(start..end, &blank);
    }
    code
}

/// The code with the tables of default numerics blanked: `impl Default for …` and the constructors of `numerics.rs`.
fn without_numerics_defaults(source: &Source) -> String {
    let mut code = source.code.clone();
    if !source.path.ends_with("numerics.rs") {
        return code;
    }
    let starts: Vec<usize> =
        ["impl Default for", "-> Self {"].iter().flat_map(|mark| code.match_indices(mark).map(|hit| hit.0)).collect();
    for start in starts {
        let Some(open) = code[start..].find('{').map(|open| start + open) else { continue };
        let mut depth = 0i32;
        let close = code[open..].bytes().position(|byte| {
            depth += i32::from(byte == b'{') - i32::from(byte == b'}');
            depth == 0
        });
        let end = close.map_or(code.len(), |close| open + close);
        let blank: String = code[open..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        code.replace_range(open..end, &blank);
    }
    code
}

#[test]
fn every_number_of_the_models_has_a_reason() {
    let path = workspace().join("tests/structure/literals.toml");
    let text = std::fs::read_to_string(&path).expect("the list of literals");
    let list: List = toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut unused: BTreeSet<(String, String)> = BTreeSet::new();
    for entry in &list.literal {
        assert!(!entry.reason.trim().is_empty(), "{} needs a reason", entry.file);
        unused.extend(entry.literals.iter().map(|literal| (entry.file.clone(), literal.clone())));
    }
    let listed = unused.clone();
    let mut complaints = Vec::new();
    for source in sources("solver/src") {
        let file = source.path.trim_start_matches("tests/../").trim_start_matches("solver/src/").to_owned();
        if !["weakly_compressible/", "incompressible/"].iter().any(|model| file.starts_with(model)) {
            continue;
        }
        for (literal, line) in literals(&source) {
            let key = (file.clone(), literal.clone());
            unused.remove(&key);
            if !listed.contains(&key) {
                complaints.push(format!(
                    "{}:{line} has the number {literal}, which literals.toml does not explain",
                    source.path
                ));
            }
        }
    }
    complaints.extend(
        unused.iter().map(|(file, literal)| format!("literals.toml explains {literal} in {file}, where it is not")),
    );
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn numbers_are_told_from_fields_and_names() {
    let code = "let a = x.0 + pair.0.1 + 5.0; let b = 1e-3f64; let c = f32x4(7, 0.5); for i in 0..8 {} y = 2.5.min(z); w = 6.;";
    let source = Source { path: "a.rs".to_owned(), module: Vec::new(), code: code.to_owned() };
    let found: Vec<String> = literals(&source).into_iter().map(|found| found.0).collect();
    assert_eq!(found, ["5.0", "1e-3f64", "7", "8", "2.5", "6."]);
}
