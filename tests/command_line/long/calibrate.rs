//! Recovery of parameters by the command line; `cargo test` recovers them from exact profiles in `tests/calibration`.

use crate::command_line::calibrate::recovers_the_truth_from_profiles;

/// The shipped example with eight rows of particles in place of twelve.
#[test]
#[ignore = "long: bash tests/long.sh"]
fn friction_and_inertia_are_found_again_from_coarse_profiles() {
    recovers_the_truth_from_profiles(8);
}
