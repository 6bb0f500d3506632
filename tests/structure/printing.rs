//! The program prints in one place, which knows what to do where nobody takes it: the macros panic there.

use crate::structure::source::{is_word, sources};

const MACROS: [&str; 5] = ["println!", "print!", "eprintln!", "eprint!", "dbg!"];

#[test]
fn nothing_prints_by_a_macro_that_panics() {
    let packages =
        ["harness", "report", "reference", "cases", "scenes", "tools", "dev", "figure", "inference", "number"];
    let packages = packages.map(|package| format!("validation/{package}/src"));
    let folders = ["solver/src", "validation/src", "python/src"].into_iter().chain(packages.iter().map(String::as_str));
    for source in folders.flat_map(sources) {
        for name in MACROS {
            for (position, _) in source.code.match_indices(name) {
                let is_whole = position == 0 || !is_word(source.code.as_bytes()[position - 1]);
                let line = source.line(position);
                assert!(!is_whole, "{}:{line}: {name} panics where nobody reads; use cli::terminal", source.path);
            }
        }
    }
}
