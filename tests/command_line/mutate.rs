//! The program that users run holds no mutation; a checkout has them in a file.

use crate::command_line::program::path;

#[test]
fn the_program_holds_no_mutation() {
    let program = std::fs::read(path()).expect("the program can be read");
    let program = String::from_utf8_lossy(&program);
    let holds = |text: &str| program.contains(text);
    for name in
        ["normalisation * 1.02 / smoothing_length", "0.998_980_632_008_155", "0.5 * *right / time_step + missing"]
    {
        assert!(!holds(name), "the program names `{name}`");
    }
    assert!(!holds("mutations.toml"), "the program reads mutations");
    assert!(holds("known_failures.toml"), "a text that is in the program is found");
}
