//! A program that is used has no errors to plant, and no trace of them.

use crate::program::{Place, path};

#[test]
fn a_program_without_errors_says_how_to_build_one() {
    let place = Place::new();
    for arguments in [&["mutate"][..], &["mutate", "list"], &["mutate", "trial", "von-karman", "film"]] {
        let finished = place.bagnold(arguments).assert().code(2).stdout("");
        let message = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(message.contains("--features planted-errors"), "{message}");
    }
    assert!(!place.path("reports").exists(), "nothing was written");
}

#[test]
fn the_program_holds_no_error() {
    let program = std::fs::read(path()).expect("the program can be read");
    let holds = |text: &str| program.windows(text.len()).any(|window| window == text.as_bytes());
    // what such a program would have to hold to name them; the help has `von-karman`
    for name in ["kernel-normalisation", "mirror-tensor-sign", "z_0 = k_s/33 instead of k_s/30"] {
        assert!(!holds(name), "the program names `{name}`");
    }
    assert!(holds("planted-errors"), "what the help says is found, so that what is not found is not there");
}
