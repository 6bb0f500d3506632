//! Kills of all commands that simulate; `cargo test` kills a run of model A in 2-D alone.

use crate::command_line::restart::{CALIBRATE, REPORT, RUN_IN_SPACE, RUN_TWO_PHASES, SWEEP, killed};

#[test]
#[ignore = "long: bash tests/long.sh"]
fn killed_runs_of_both_models_resume_to_the_same_state() {
    for work in [RUN_IN_SPACE, RUN_TWO_PHASES] {
        killed(&work);
    }
}

#[test]
#[ignore = "long: bash tests/long.sh"]
fn killed_reports_sweeps_and_calibrations_resume_to_the_same_states() {
    for work in [REPORT, SWEEP, CALIBRATE] {
        killed(&work);
    }
}
