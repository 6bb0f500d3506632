//! Signals to all commands that simulate; `cargo test` sends one to a run.

use crate::command_line::interrupted::{hangup, interrupted};
use crate::command_line::restart::{CALIBRATE, REPORT, SWEEP};

#[test]
#[ignore = "long: bash tests/long.sh"]
fn signals_keep_finished_runs_of_reports_sweeps_and_calibrations() {
    interrupted(&[(&REPORT, ("INT", 130)), (&SWEEP, hangup()), (&CALIBRATE, ("TERM", 143))]);
}
