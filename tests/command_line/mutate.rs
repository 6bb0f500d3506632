//! A program that is used holds no mutation; a checkout has them in a file.

use crate::program::{Place, path};

#[test]
fn without_sources_there_is_nothing_to_change() {
    let place = Place::new();
    for arguments in [
        &["dev", "mutate"][..],
        &["dev", "mutate", "list"],
        &["dev", "mutate", "trial", "von-karman", "film"],
        &["dev", "mutate", "drawn"],
    ] {
        let finished = place.bagnold(arguments).assert().code(2).stdout("");
        let message = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(message.contains("work in a checkout of bagnold"), "{message}");
    }
    assert!(!place.path("reports").exists(), "nothing was written");
}

#[test]
fn a_checkout_lists_its_mutations() {
    let mut command = assert_cmd::Command::new(path());
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).args(["dev", "mutate", "list"]);
    let listed = command.assert().code(0);
    let text = String::from_utf8_lossy(&listed.get_output().stdout).into_owned();
    assert!(text.lines().count() >= 60, "{text}");
    assert!(text.contains("von-karman") && text.contains("κ = 0.45 instead of 0.41; clear-water, bed-load"), "{text}");
    let mut command = assert_cmd::Command::new(path());
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).args(["dev", "mutate", "--errors", "von-karmann"]);
    let refused = command.assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("`von-karmann` is not among the mutations"), "{message}");
}

#[test]
fn the_program_holds_no_mutation() {
    let program = std::fs::read(path()).expect("the program can be read");
    let holds = |text: &str| program.windows(text.len()).any(|window| window == text.as_bytes());
    for name in
        ["normalisation * 1.02 / smoothing_length", "0.998_980_632_008_155", "0.5 * *right / time_step + missing"]
    {
        assert!(!holds(name), "the program names `{name}`");
    }
    assert!(holds("mutations.toml"), "where they stand is found, so that what is not found is not there");
}

#[test]
fn a_draw_takes_a_count_and_a_seed() {
    let place = Place::new();
    for (option, value, rule) in [
        ("--count", "0", "0 is not in 1..=10000"),
        ("--seed", "0xfog", "must be an integer from 0 to 2^64 - 1, such as 1 or 0x22b011ce"),
    ] {
        let refused = place.bagnold(&["dev", "mutate", "drawn", option, value]).assert().code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(rule), "{message}");
    }
}
