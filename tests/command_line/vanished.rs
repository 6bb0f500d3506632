//! Folders that somebody removes while a command works in them.

use crate::command_line::restart::{RUN_IN_PLANE, SWEEP, Work, checkpoints, has_gone_on, output_of_the_program, place};
use std::path::Path;
use std::process::ExitStatus;

/// Removes the folder, whatever is being written into it meanwhile.
fn remove(folder: &Path) {
    while folder.exists() {
        let _ = std::fs::remove_dir_all(folder);
    }
}

/// Exit status and message of a command whose folder of this name is removed after its first checkpoint.
fn without(work: &Work, place: &crate::command_line::program::Place, removed: &str) -> (ExitStatus, String) {
    let mut child = work.start(place, "out", "1");
    assert!(has_gone_on(&mut child, place, "out-store"), "{}: over before anything could be removed", work.name);
    remove(&place.path(removed));
    output_of_the_program(child)
}

#[test]
fn an_output_folder_that_vanishes_is_named_and_the_result_is_in_the_store() {
    let place = place();
    let (expected, _) = RUN_IN_PLANE.undisturbed(&place);
    let (status, said) = without(&RUN_IN_PLANE, &place, "out");
    assert_eq!(status.code(), Some(2), "{said}");
    let message =
        "error: out: cannot be written (no such file or directory); choose a folder that you may write to with --out";
    assert!(said.contains(message), "{said}");
    assert!(checkpoints(&place, "out-store").is_empty(), "the run was finished and stored");
    let (status, said) = output_of_the_program(RUN_IN_PLANE.start(&place, "out", "1"));
    assert!(status.code().is_some_and(|code| code <= 1), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "out"), expected);
}

#[test]
fn a_sweep_whose_folder_vanishes_says_so_and_begins_anew() {
    let place = place();
    let (expected, _) = SWEEP.undisturbed(&place);
    let (status, said) = without(&SWEEP, &place, "out");
    assert_eq!(status.code(), Some(2), "{said}");
    assert!(said.contains("cannot be written (no such file or directory)"), "{said}");
    let (status, said) = output_of_the_program(SWEEP.start(&place, "out", "1"));
    assert_eq!(status.code(), Some(0), "{said}");
    assert_eq!(SWEEP.states(&place, "out"), expected);
}

#[test]
fn a_store_that_vanishes_costs_no_result() {
    let place = place();
    let (expected, _) = RUN_IN_PLANE.undisturbed(&place);
    let (status, said) = without(&RUN_IN_PLANE, &place, "out-store");
    assert!(status.code().is_some_and(|code| code <= 1), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "out"), expected);
    let (status, said) = output_of_the_program(RUN_IN_PLANE.start(&place, "out", "1"));
    assert!(status.code().is_some_and(|code| code <= 1), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "out"), expected);
}
