//! Whole calibrations whose runs scatter: displaced particles move a film's profile and the front of a column.
//!
//! Data are made by the model itself at the truth, and noise of every experiment is its own. With `repeats` every evaluation is
//! the mean over seeds, whose variance enters χ² and the intervals.

use super::findings::{VISCOSITY, outcome};
use std::collections::BTreeMap;

/// A film of displaced particles, nine velocities along its profile.
const FILM: &str = r#"
[[fit]]
case = "film"
with = { resolution = 10 }
data = [{ table = "profile-fluid-newtonian-particles-jittered-resolution-10", x = "y [m]", y = "u [m/s]", noise = 0.03, bins = 9 }]
"#;

/// Run-outs of three columns of sand, eight particles over the half width.
const COLUMNS: &str = r#"
[[parameters]]
path = "material.static_friction"
name = "mu_s"
unit = "-"
lower = 0.4
upper = 0.8
start = 0.52
truth = 0.58

[[fit]]
case = "column-planar"
data = [
  { metric = "run_out", variant = "material=sand,aspect_ratio=0.9,resolution=8", noise = 0.1 },
  { metric = "run_out", variant = "material=sand,aspect_ratio=1.5,resolution=8", noise = 0.1 },
  { metric = "run_out", variant = "material=sand,aspect_ratio=3,resolution=8", noise = 0.1 },
]

[fit.with]
resolution = 8
vary = [{ path = "aspect_ratio", values = [0.9, 1.5, 3.0] }]
"#;

/// Outcomes of the experiments of a problem.
#[derive(Debug, Default)]
struct Tally {
    experiments: usize,
    joint: usize,
    single: usize,
    settled: usize,
    raised: usize,
    evaluations: Vec<usize>,
    /// Number of occurrences of each finding, by its first words.
    findings: BTreeMap<String, usize>,
}

/// Repeats the calibration of one parameter with noise of many seeds.
fn study(name: &str, seeds: std::ops::RangeInclusive<usize>, repeats: usize, problem: &str) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let folder = tempfile::tempdir().expect("a folder");
        let text = format!("title = \"{name}\"\nseed = {seed}\nrepeats = {repeats}\n{problem}");
        let outcome = outcome(folder.path(), &text);
        let found = &outcome.parameters[0];
        let (low, high) = found.interval.expect("points enough");
        tally.experiments += 1;
        tally.joint += usize::from(outcome.truth_inside == Some(true));
        tally.single += usize::from(found.truth.is_some_and(|truth| (low..=high).contains(&truth)));
        tally.settled += usize::from(found.settled == (true, true));
        tally.raised += usize::from(!outcome.findings.is_empty());
        tally.evaluations.push(outcome.evaluations.len());
        for finding in &outcome.findings {
            let words: Vec<&str> = finding.split_whitespace().take(6).collect();
            *tally.findings.entry(words.join(" ")).or_default() += 1;
        }
    }
    tally.evaluations.sort_unstable();
    println!("{name}, means of {repeats}: {tally:?}");
    tally
}

fn assert_sound(tally: &Tally) {
    let most = |share: f64| (share * tally.experiments as f64).ceil() as usize;
    assert!(tally.joint >= most(0.85) && tally.single >= most(0.85), "{tally:?}");
    assert!(tally.raised <= tally.experiments - most(0.9), "{tally:?}");
}

/// The full study in short; the interval of a single search over scattering runs is tested in `bagnold_inference`.
mod long {
    use super::*;

    #[test]
    #[ignore = "long: bash tests/long.sh"]
    fn a_film_of_perturbed_particles_is_judged_by_means_over_seeds() {
        let tally = study("a film of displaced particles", 1..=1, 3, &format!("{VISCOSITY}{FILM}"));
        assert!(tally.joint == 1 && tally.settled == 1, "{tally:?}");
    }
}

#[test]
#[ignore = "the full study: a quarter of an hour"]
fn regions_of_films_of_displaced_particles_hold_the_viscosity() {
    assert_sound(&study("a film of displaced particles", 1..=80, 3, &format!("{VISCOSITY}{FILM}")));
}

#[test]
#[ignore = "the full study: columns are simulated for an hour"]
fn regions_of_columns_by_means_over_seeds_hold_the_friction() {
    assert_sound(&study("run-out of columns", 1..=40, 3, COLUMNS));
}
