//! Names that a crate with a law or a case can have.

use super::super::arguments::NewCrate;
use crate::REGISTRY;
use crate::input::FieldError;
use bagnold_solver::material::rheology::open::built_in;

/// More letters than this make no name of a law.
const LONGEST: usize = 64;

/// Words of the language, which no crate may be called by.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Names of crates that the new one uses, and those that Cargo or the compiler keep for themselves.
const TAKEN: &[&str] = &[
    "alloc",
    "bagnold",
    "bagnold-solver",
    "bagnold-validation",
    "build",
    "core",
    "deps",
    "examples",
    "incremental",
    "proc-macro",
    "schemars",
    "serde",
    "std",
    "test",
];

/// Whether a name is valid for a crate and for its law or case.
pub(super) fn check(name: &str, what: &NewCrate) -> Result<(), FieldError> {
    let refused = |rule: &str, remedy: &str| Err(FieldError::new("NAME", format!("{name:?}"), rule, remedy));
    let is_plain = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "-_".contains(letter);
    let begins = name.starts_with(|first: char| first.is_ascii_lowercase());
    if !begins || !name.chars().all(is_plain) || name.ends_with(['-', '_']) || name.len() > LONGEST {
        return refused(
            "a crate's name of at most 64 lower-case letters, digits and hyphens that begins with a letter",
            "choose a name such as my-law",
        );
    }
    let kebab = name.replace('_', "-");
    if KEYWORDS.contains(&name) || TAKEN.contains(&kebab.as_str()) {
        return refused("neither a Rust keyword nor the name of a crate it uses", "add a word, such as my-law");
    }
    match what {
        NewCrate::Law(_) if built_in().contains(&name) => {
            refused("different from existing laws", "give yours another name: both can then be compared")
        }
        NewCrate::Case(_) if REGISTRY.iter().any(|case| case.name() == name) => {
            refused("different from existing cases", "give yours another name; `bagnold list` prints the existing ones")
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::arguments::Named;
    use super::*;

    fn refusal(name: &str, what: fn(Named) -> NewCrate) -> Option<String> {
        let asked = Named { name: name.to_owned(), out: None };
        check(name, &what(asked)).err().map(|error| error.to_string())
    }

    #[test]
    fn names_are_those_of_crates_and_of_nothing_that_is_there() {
        for name in ["my-law", "power_law_2", "x"] {
            assert_eq!(refusal(name, NewCrate::Law), None);
            assert_eq!(refusal(name, NewCrate::Case), None);
        }
        let long = "x".repeat(65);
        for name in ["", "My-law", "2law", "-law", "law-", "my law", "../law", "löß", "a/b", "a\"b", &long] {
            let refusal = refusal(name, NewCrate::Law).unwrap_or_default();
            assert!(refusal.contains("but must be a crate's name"), "{name}: {refusal}");
        }
        for name in ["fn", "self", "serde", "bagnold_solver", "test", "build"] {
            let refusal = refusal(name, NewCrate::Case).unwrap_or_default();
            assert!(refusal.contains("neither a Rust keyword"), "{name}: {refusal}");
        }
        assert!(refusal("mu-i", NewCrate::Law).is_some_and(|text| text.contains("different from existing laws")));
        assert!(refusal("film", NewCrate::Case).is_some_and(|text| text.contains("different from existing cases")));
        assert_eq!(refusal("film", NewCrate::Law), None);
    }
}
