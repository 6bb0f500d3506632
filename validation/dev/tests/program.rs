//! The program that developers run, which `cargo test` builds with it.

use assert_cmd::Command;
use std::path::Path;

/// The program in a folder, and what it writes to standard output or, if it refuses, to standard error.
fn run(folder: &Path, arguments: &[&str], code: i32) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bagnold-dev"));
    let finished = command.current_dir(folder).args(arguments).assert().code(code);
    let output = finished.get_output();
    if code == 2 {
        assert!(output.stdout.is_empty());
    }
    String::from_utf8_lossy(if code == 2 { &output.stderr } else { &output.stdout }).into_owned()
}

#[test]
fn without_sources_there_is_nothing_to_change() {
    let place = tempfile::tempdir().expect("a temporary folder");
    for arguments in [
        &["mutate"][..],
        &["mutate", "list"],
        &["mutate", "trial", "von-karman", "film"],
        &["mutate", "drawn"],
        &["controls"],
    ] {
        let message = run(place.path(), arguments, 2);
        assert!(message.contains("work in a checkout of bagnold"), "{message}");
    }
    assert!(!place.path().join("reports").exists(), "nothing was written");
}

#[test]
fn a_checkout_lists_its_mutations() {
    let checkout = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = run(checkout, &["mutate", "list"], 0);
    assert!(text.lines().count() >= 60, "{text}");
    assert!(text.contains("von-karman") && text.contains("κ = 0.45 instead of 0.41; clear-water, bed-load"), "{text}");
    let message = run(checkout, &["mutate", "--errors", "von-karmann"], 2);
    assert!(message.contains("`von-karmann` is not among the mutations"), "{message}");
}

#[test]
fn a_draw_takes_a_count_and_a_seed() {
    let place = tempfile::tempdir().expect("a temporary folder");
    for (option, value, rule) in [
        ("--count", "0", "0 is not in 1..=10000"),
        ("--seed", "0xfog", "must be an integer from 0 to 2^64 - 1, such as 1 or 0x22b011ce"),
    ] {
        let message = run(place.path(), &["mutate", "drawn", option, value], 2);
        assert!(message.contains(rule), "{message}");
    }
}
