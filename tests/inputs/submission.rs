//! Every part of a submission alone, and what is refused.

use bagnold_cases::collapse::{ColumnFlow, SlopeFlow};
use bagnold_harness::case::{
    Changes, ExternalColumn, ExternalData, ExternalSchema, NamedColumns, ParticleFrame, RunList, Tier,
};
use bagnold_tools::ToolError;
use bagnold_tools::judge::CaseSubmissions;
use bagnold_validation::REGISTRY;

const ROWS: u32 = 30;

/// Columns that rise from 0 to a hundredth, times to one second, shares of `size`, and a deposit of that size.
fn columns(items: &[ExternalColumn], is_planar: bool, size: f64) -> NamedColumns {
    let ramp: Vec<f64> = (0..ROWS).map(|row| f64::from(row) / 2900.0).collect();
    let shares = vec![size / f64::from(ROWS); ROWS as usize];
    let column = |name| match name {
        "area" | "volume" => shares.clone(),
        "thickness" if is_planar => vec![size / 0.01; ROWS as usize],
        "thickness" => vec![size / (std::f64::consts::FRAC_PI_4 * 1e-4); ROWS as usize],
        // a front must reach as far in time as the measurement
        "time" => ramp.iter().map(|value| 100.0 * value).collect(),
        _ => ramp.clone(),
    };
    items.iter().map(|item| (item.name.to_owned(), column(item.name))).collect()
}

/// Area or volume of what collapses in a run of a case.
fn size_of(case: &str, run: usize) -> f64 {
    fn section<const D: usize>(run: usize) -> (f64, f64) {
        let run = RunList::<ColumnFlow<D>>::of_tier(Tier::Quick).flows()[run].clone();
        (run.half_width * run.half_width * run.initial_height(), run.half_width)
    }
    let reservoir = SlopeFlow::default();
    match case {
        "column-planar" => section::<2>(run).0,
        "column-round" => section::<3>(run).0 * std::f64::consts::FRAC_PI_4 * section::<3>(run).1,
        _ => reservoir.reservoir_length * reservoir.initial_height,
    }
}

/// Each part that the case takes, alone: series, profile, one picture, two pictures.
fn parts(form: &'static ExternalSchema, is_planar: bool, size: f64) -> Vec<ExternalData> {
    let particles: Vec<ExternalColumn> =
        form.particles.iter().filter(|item| !(is_planar && item.name == "z")).copied().collect();
    let picture = |time: f64| ParticleFrame { time, columns: columns(&particles, is_planar, size) };
    let mut parts = Vec::new();
    if !form.series.is_empty() {
        parts.push(ExternalData { series: columns(form.series, is_planar, size), ..ExternalData::default() });
    }
    if !form.profile.is_empty() {
        parts.push(ExternalData { profile: columns(form.profile, is_planar, size), ..ExternalData::default() });
    }
    if !particles.is_empty() {
        parts.push(ExternalData { pictures: vec![picture(0.5)], ..ExternalData::default() });
        parts.push(ExternalData { pictures: vec![picture(0.2), picture(0.5)], ..ExternalData::default() });
    }
    parts
}

#[test]
fn every_part_alone_gives_numbers_and_none_for_what_is_missing() {
    let mut cases = 0;
    for case in REGISTRY.iter().filter(|case| *case.form() != ExternalSchema::NUMBERS) {
        cases += 1;
        let prepared = case.prepare(Tier::Quick, &Changes::default()).expect("a tier");
        let of_run = |run| parts(case.form(), case.name() != "column-round", size_of(case.name(), run));
        for part in 0..of_run(0).len() {
            let all: Vec<ExternalData> = (0..prepared.run_count()).map(|run| of_run(run).swap_remove(part)).collect();
            let result =
                prepared.judge_external(&all).map_err(|(run, error)| format!("{} run {run}: {error}", case.name()));
            let result = result.expect("complete columns");
            assert!(result.measured.iter().any(|(_, names)| !names.is_empty()), "{}: nothing measured", case.name());
            for ledger in ["energy_residual", "energy_rise", "momentum_residual"] {
                let judged = result.metrics.iter().any(|metric| metric.name == ledger && result.is_measured(metric));
                assert!(!judged, "{}: {ledger} of a code that keeps no ledger", case.name());
            }
        }
    }
    assert!(cases >= 6, "{cases} cases take files");
}

fn read(text: &str) -> Result<CaseSubmissions, ToolError> {
    let folder = tempfile::tempdir().expect("temporary folder");
    let file = folder.path().join("mine.toml");
    std::fs::write(&file, text).expect("writable");
    std::fs::write(folder.path().join("u.csv"), "y [mm],u\n0,0\n1,0.1\n2,0.2\n").expect("writable");
    CaseSubmissions::read(&[file], *REGISTRY)
}

fn message(text: &str) -> String {
    let error = read(text).err().map(|error| error.to_string()).expect("refused");
    error.rsplit_once("mine.toml: ").map_or(error.clone(), |(_, message)| message.to_owned())
}

const HEAD: &str = "case = \"bagnold\"\n[code]\nname = \"a\"\n[[run]]\n";

#[test]
fn a_profile_in_other_units_is_a_run() {
    let text = format!(
        "{HEAD}variant = \"slope_angle=24,start=rest\"\nprofile = {{ file = \"u.csv\", columns = {{ height = \"y [mm]\", velocity = \"u [m/s]\" }} }}"
    );
    let trial = read(&text).expect("a submission");
    assert_eq!((trial.prepared.run_count(), trial.entries.len()), (1, 1));
    let l2 = trial.entries[0].result.metrics.iter().find(|metric| metric.name == "velocity_l2").expect("a profile");
    assert!(l2.value.is_finite() && trial.entries[0].result.is_measured(l2));
}

#[test]
fn invalid_value_is_refused_by_field() {
    let run = "variant = \"slope_angle=24,start=rest\"\n";
    let profile = |columns: &str| format!("{HEAD}{run}profile = {{ file = \"u.csv\", columns = {{ {columns} }} }}");
    let refused = [
        (format!("{HEAD}{run}"), "`run 1`: no results; add numbers"),
        (
            format!("{HEAD}variant = \"slope_angle=3\"\nnumbers = {{ velocity_l2 = 1.0 }}"),
            "`run 1.variant` is \"slope_angle=3\", but must be keys and values of a run",
        ),
        (
            format!("{HEAD}{run}numbers = {{ velocity_l2 = nan }}"),
            "`run 1.numbers.velocity_l2` is NaN, but must be a number",
        ),
        (
            profile("height = \"y [mm]\", velocity = \"v [m/s]\""),
            "`run 1.profile.columns.velocity`: no column \"v\" in",
        ),
        (
            profile("height = \"y [mm]\", velocity = \"u [furlong/s]\""),
            "`run 1.profile.columns.velocity` is [furlong/s], but must be a unit that converts to m/s",
        ),
        (profile("height = \"u [s]\""), "`run 1.profile.columns.height` is [s], but must be a unit that converts to m"),
        (
            profile("hight = \"y [mm]\""),
            "`run 1.profile.columns.hight`: unknown name; did you mean `height`? known are height [m] (",
        ),
    ];
    for (text, start) in refused {
        let message = message(&text);
        assert!(message.contains(start), "{message}");
    }
}
