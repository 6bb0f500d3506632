//! Friction laws from points (I, μ ± σ) of known truth: how often the intervals hold it, and what a plateau beyond the data says.

use super::coverage::normal;
use super::findings::{outcome, plan};
use bagnold_figure::FigureFormat;
use bagnold_tools::calibration::{CalibrationResult, write};
use bagnold_validation::REGISTRY;
use std::path::Path;

/// μ_s, μ_2 and I_0 of the truth, and the standard uncertainty of a friction `[-]`.
const TRUTH: [f64; 3] = [0.25, 0.75, 0.3];
const SIGMA: f64 = 0.004;

/// The law of ten points up to an inertial number, with the noise of a seed.
fn fitted(folder: &Path, most: f64, seed: u64) -> CalibrationResult {
    let mut points = "inertial_number [-],friction [-],friction uncertainty [-]\n".to_owned();
    for (k, noise) in (1..).zip(normal(seed, 10)) {
        let inertia = most * f64::from(k) / 10.0;
        let exact = TRUTH[0] + (TRUTH[1] - TRUTH[0]) * inertia / (inertia + TRUTH[2]);
        let friction = exact + SIGMA * noise;
        points += &format!("{inertia},{friction},{SIGMA}\n");
    }
    std::fs::write(folder.join("points.csv"), points).expect("written");
    let parameter = |path: &str, lower: f64, upper: f64| {
        format!("[[parameters]]\npath = \"{path}\"\nlower = {lower}\nupper = {upper}\n")
    };
    let plan = [
        "title = \"a law\"\n".to_owned(),
        parameter("static_friction", 0.1, 0.4),
        parameter("limiting_friction", 0.45, 1.5),
        parameter("reference_inertia", 0.05, 3.0),
        "[[fit]]\nlaw = \"mu-i\"\nwith = { grain_diameter = 0.002, grain_density = 2500.0 }\n".to_owned(),
        "data = [{ file = \"points.csv\" }]\n".to_owned(),
    ];
    outcome(folder, &plan.concat())
}

/// Sets of some seeds whose intervals hold the truth, parameter by parameter.
fn held(seeds: std::ops::Range<u64>) -> [usize; 3] {
    let mut held = [0; 3];
    for seed in seeds {
        let folder = tempfile::tempdir().expect("a folder");
        let outcome = fitted(folder.path(), 0.6, seed);
        assert!(seed > 0 || has_draws(&outcome, folder.path()));
        for ((held, found), truth) in held.iter_mut().zip(&outcome.parameters).zip(TRUTH) {
            let (low, high) = found.interval.expect("points enough");
            *held += usize::from((low..=high).contains(&truth));
        }
    }
    held
}

#[test]
fn intervals_of_a_law_hold_the_truth() {
    let held = held(0..6);
    assert!(held.iter().all(|held| *held >= 5), "{held:?} of 6");
}

#[test]
#[ignore = "a minute: cargo test -- --ignored"]
fn intervals_of_a_law_hold_the_truth_in_nine_of_ten_sets() {
    let held = held(0..100);
    println!("intervals of a law that hold the truth: {held:?} of 100");
    assert!(held.iter().all(|held| *held >= 90), "{held:?}");
}

/// Whether the file of the law has the best values and draws.
fn has_draws(outcome: &CalibrationResult, folder: &Path) -> bool {
    write(outcome, &plan(folder), &folder.join("out"), FigureFormat::SCREEN).expect("written");
    let fit = std::fs::read_to_string(folder.join("out/figures/fit.csv")).expect("a figure");
    assert_eq!(fit.matches("I [-],μ [-],line,model,").count(), 80, "a formula is drawn as a curve: {fit}");
    let law = std::fs::read_to_string(folder.join("out/law.toml")).expect("written");
    let law: toml::Table = toml::from_str(&law).expect("TOML");
    let draws = law["draws"].as_array().expect("draws");
    law["material"]["law"].as_str() == Some("mu-i")
        && draws.len() == 50
        && draws.iter().all(|draw| draw["reference_inertia"].is_float())
}

#[test]
fn plateau_beyond_the_data_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let findings = fitted(folder.path(), 0.1, 0).findings.concat();
    assert!(
        findings.contains("limiting_friction") && findings.contains("beyond the data, which end at I = 0.1"),
        "{findings}"
    );
}

#[test]
fn an_end_at_the_bound_of_another_parameter_and_a_point_without_shear_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    // a plateau far beyond the data: both grow together, until one meets its bound
    let outcome = fitted(folder.path(), 0.1, 0);
    let told = "the upper end of `reference_inertia` is where `limiting_friction` meets its bound";
    assert!(outcome.findings.iter().any(|finding| finding.starts_with(told)), "{:?}", outcome.findings);
    let points = std::fs::read_to_string(folder.path().join("points.csv")).expect("written");
    std::fs::write(folder.path().join("points.csv"), points.replacen("\n0.01,", "\n-0.01,", 1)).expect("written");
    let limits = bagnold_harness::case::Limits::default();
    let file = folder.path().join("plan.toml");
    let refused = bagnold_tools::calibration::CalibrationPlan::read(&file, *REGISTRY, limits);
    let message = refused.expect_err("refused").to_string();
    assert!(message.contains("`fit[0].data` is I = -0.01, but must be positive"), "{message}");
}
