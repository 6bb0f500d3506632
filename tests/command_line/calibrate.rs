//! Calibrations: with one's own CSV, killed and resumed, refused.

use crate::command_line::killed::{Finished, assert_same_files, kill_and_resume, written};
use crate::command_line::program::Place;
use std::path::{Path, PathBuf};

/// The viscosity of a film from three velocities that someone has measured, with 3 % of uncertainty each. Displaced particles would make the
/// velocity scatter by 1 % with the last bits of the viscosity.
const PLAN: &str = r#"
title = "viscosity of a film"
evaluations = 14
trajectories = 2

[[parameters]]
path = "material.viscosity"
unit = "Pa·s"
lower = 0.2
upper = 2.0
scale = "log"

[[fit]]
case = "film"
with = { resolution = 10, jitter = 0.0, columns = 4 }
data = [{ table = "profile-fluid-newtonian-particles-jittered-resolution-10", x = "y [m]", y = "u [m/s]", file = "mine.csv" }]

[[hold_out]]
case = "film"
conditions = ["slope_angle"]
with = { resolution = 10, jitter = 0.0, columns = 4, slope_angle = 12.0 }
data = [{ metric = "particles_lost", value = 0.0, unit = "-", uncertainty = 1.0, source = "own" }]
"#;

const MINE: &str = "\
# quantity: velocity of a film
# unit: m/s
# kind: measured
# confidence: medium
# uncertainty: 3 %, column
# source: own experiment
# licence: own data
y [m],u [m/s],uncertainty [m/s]
0.003,0.086,0.003
0.005,0.126,0.004
0.008,0.161,0.005
";

fn place() -> (Place, String) {
    let place = Place::new();
    place.file("mine.csv", MINE);
    let plan = place.file("plan.toml", PLAN);
    (place, plan)
}

/// Times at which the evaluations were written.
fn evaluations(folder: &Path) -> Finished {
    let entries = std::fs::read_dir(folder.join("evaluations")).into_iter().flatten().flatten();
    let files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|file| file.extension().is_some_and(|kind| kind == "postcard"))
        .collect();
    let name = |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    written(files.iter().map(|file| (name(file), file.as_path())))
}

/// Bulk modulus of a slow film over ρ0 g h `[-]`.
const STIFFNESS: f64 = 50.0;

/// Weighted least squares by hand: the exact film, η du/dy = τ, is linear in 1/η. The viscosity `[Pa·s]` and its standard
/// deviation `[Pa·s]`.
fn viscosity_of_the_exact_film() -> (f64, f64) {
    let (depth, slope, density, gravity) = (0.01_f64, 10.0_f64.to_radians(), 1000.0, 9.81);
    let data = [[0.003, 0.086, 0.003], [0.005, 0.126, 0.004], [0.008, 0.161, 0.005]];
    let (mut up, mut down) = (0.0, 0.0);
    for [y, velocity, uncertainty] in data {
        // the film bears its own weight: ρ = ρ0 (1 + cosα (h − y)/(S h)), and so τ = ρ0 g sinα ((h − y) + cosα (h − y)²/(2 S h))
        let left = |power: i32| depth.powi(power) - (depth - y).powi(power);
        let integral = left(2) / 2.0 + slope.cos() * left(3) / (6.0 * STIFFNESS * depth);
        let of_one = density * gravity * slope.sin() * integral / uncertainty;
        up += of_one * velocity / uncertainty;
        down += of_one * of_one;
    }
    let fluidity: f64 = up / down;
    (1.0 / fluidity, 1.0 / (down.sqrt() * fluidity * fluidity))
}

/// χ², p and the intervals of a result belong to the best point, which was evaluated, and so were the ends.
fn assert_one_point(result: &serde_json::Value) {
    let evaluations = result["evaluations"].as_array().expect("a list");
    let least =
        evaluations.iter().filter_map(|evaluation| evaluation["chi_squared"].as_f64()).fold(f64::INFINITY, f64::min);
    assert_eq!(result["chi_squared"].as_f64(), Some(least));
    let parameters = result["parameters"].as_array().expect("a list");
    let data = result["fit"].as_array().expect("a list").len();
    let reduced = result["reduced_chi_squared"].as_f64().expect("more data than parameters");
    assert!((reduced * (data - parameters.len()) as f64 / least - 1.0).abs() < 1e-12, "{reduced} of {least}");
    let p = bagnold_inference::inference::chi_squared_tail(least, data - parameters.len());
    assert_eq!(result["p_value"].as_f64(), Some(p));
    for (k, parameter) in parameters.iter().enumerate() {
        for end in 0..2 {
            let value = parameter["interval"][end].as_f64().expect("a number");
            let there = evaluations.iter().find(|evaluation| {
                evaluation["values"][k].as_f64().is_some_and(|other| (other / value - 1.0).abs() < 1e-12)
            });
            let rise = there.and_then(|there| there["chi_squared"].as_f64()).expect("evaluated") - least;
            assert!((rise / 3.841_459 - 1.0).abs() < 0.1, "{rise} at the end {value}");
        }
    }
}

/// Before anything is simulated: a corner that takes days is announced, and limited.
#[test]
fn dear_corners_of_a_box_are_announced() {
    let (place, _) = place();
    let wide = PLAN.replace("lower = 0.2", "lower = 1e-6").replace("upper = 2.0", "upper = 1e6");
    let plan = place.file("wide.toml", &wide.replace("profile-fluid", "no-such-profile"));
    let refused = place.bagnold(&["calibrate", &plan, "--out", "out"]).assert().code(2);
    let told = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(told.contains("core time of an evaluation: about ") && told.contains(" at viscosity = 1×10⁻⁶"), "{told}");
    assert!(told.contains("; simulations above 30 minutes count as failed (--most-hours)"), "{told}");
}

#[test]
fn own_data_give_parameters_a_page_a_case_to_run_and_the_same_after_kills() {
    let (place, plan) = place();
    let done = place.bagnold(&["-q", "calibrate", &plan, "--out", "whole"]).assert().code(0);
    let printed = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    assert!(printed.starts_with("viscosity = 0.5"), "{printed}");
    assert!(printed.contains("\nevaluations: ") && printed.contains(" for intervals; simulations: "), "{printed}");
    assert!(printed.contains("fit error: ") && printed.contains("held-out error: 0 σ over 1 data"), "{printed}");
    let text = std::fs::read_to_string(place.path("whole/result.json")).expect("written");
    let result: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let best = result["parameters"][0]["best"].as_f64().expect("a number");
    let [low, high] = [0, 1].map(|k| result["parameters"][0]["interval"][k].as_f64().expect("a number"));
    let (exact, deviation) = viscosity_of_the_exact_film();
    assert!((best / exact - 1.0).abs() < 0.01, "{best} Pa·s, but the exact film has {exact} Pa·s");
    let width = (high - low) / (2.0 * 1.96 * deviation);
    assert!(
        low < best && best < high && (0.9..1.1).contains(&width),
        "{low} {best} {high}, {width} of the exact width"
    );
    assert_one_point(&result);
    for name in ["index.html", "data.csv", "evaluations.csv", "figures/profiles.svg", "figures/fit.png"] {
        assert!(place.path("whole").join(name).is_file(), "{name}");
    }
    place.bagnold(&["-q", "run", "whole/calibrated.toml", "--out", "again"]).assert().code(0);
    // nothing of a killed one is done again
    assert_eq!(kill_and_resume(&place, "calibrate", &plan, evaluations), 0);
    let points = |folder: &str| evaluations(&place.path(folder)).into_keys().collect::<Vec<_>>();
    assert_eq!(points("whole"), points("killed"), "other points were asked for");
    let names = ["result.json", "data.csv", "evaluations.csv", "calibrated.toml", "index.html"];
    assert_same_files(&place, "whole", &names);
}

/// Message of `bagnold calibrate` for a plan or data that it refuses, with exit code 2.
fn refusal(change: impl Fn(&str) -> String, data: impl Fn(&str) -> String) -> String {
    let place = Place::new();
    place.file("mine.csv", &data(MINE));
    place.file("plan.toml", &change(PLAN));
    let refused = place.bagnold(&["-q", "calibrate", "plan.toml", "--out", "out"]).assert().code(2);
    assert!(!place.path("out/result.json").exists());
    String::from_utf8_lossy(&refused.get_output().stderr).trim_end().to_owned()
}

#[test]
fn wrong_plans_are_refused_by_name() {
    let plan = |from: &'static str, to: &'static str| refusal(move |text| text.replace(from, to), str::to_owned);
    assert_eq!(
        plan("material.viscosity", "material.viscoscity"),
        "error: plan.toml: `material.viscoscity`: unknown field; did you mean \
         `material.viscosity`? `bagnold show film` prints all fields"
    );
    assert_eq!(
        plan("lower = 0.2", "lower = 5.0"),
        "error: plan.toml: `parameters[0].lower` is 5, but must be below `upper`, which is 2; exchange the two bounds"
    );
    assert_eq!(
        plan(", slope_angle = 12.0", ""),
        "error: plan.toml: the run `film fluid=newtonian,particles=jittered,resolution=10` is in both `fit[0]` and \
         `hold_out[0]`; remove it from one: held-out data must not be fitted"
    );
    assert_eq!(
        plan("uncertainty = 1.0, ", ""),
        "error: plan.toml: `hold_out[0].data[0].uncertainty`: missing or not positive; give a standard deviation in \
         the unit of the value, or `factor` for a logarithmic one"
    );
    assert_eq!(
        plan("x = \"y [m]\"", "x = \"y\""),
        "error: plan.toml: `fit[0].data[0].x` is y, but must be a column with its unit, as in the heading of the table; write \
         such as \"y [m]\""
    );
    assert_eq!(
        plan("evaluations = 14", "evaluations = 0"),
        "error: plan.toml: `evaluations` is 0, but must be at least 1; give 25 for three parameters"
    );
    let unit = plan("unit = \"-\", uncertainty", "unit = \"m\", uncertainty");
    assert!(unit.ends_with("the case gives `particles_lost` in [-], but the data are in [m]; convert them"), "{unit}");
}

/// Neither another cell nor a slope that differs by rounding is another experiment.
#[test]
fn validation_data_must_differ_in_physics() {
    let plan = |to: &'static str| refusal(move |text| text.replace("slope_angle = 12.0", to), str::to_owned);
    let same = |value: &str| {
        format!(
            "error: plan.toml: `hold_out[0]` has the conditions of `fit[0]` (slope_angle {value} and 10: the same within 1 \
             %); hold out data of other conditions"
        )
    };
    assert_eq!(plan("slope_angle = 10.000001"), same("10.000001"));
    assert_eq!(
        refusal(
            |text| text.replace("10, jitter = 0.0, columns = 4, slope_angle = 12.0", "12, jitter = 0.0, columns = 4"),
            str::to_owned
        ),
        same("10")
    );
    assert_eq!(
        refusal(|text| text.replace("conditions = [\"slope_angle\"]\n", ""), str::to_owned),
        "error: plan.toml: `hold_out[0].conditions` is missing, but must be given, because `fit[0]` has the same case; name the \
         parameters that differ from the fit, such as conditions = [\"slope_angle\"]"
    );
    assert_eq!(
        refusal(|text| text.replace("conditions = [\"slope_angle\"]", "conditions = [\"slope_angel\"]"), str::to_owned),
        "error: plan.toml: `slope_angel`: unknown field; did you mean `slope_angle`? `bagnold show \
         film` prints all fields"
    );
    assert_eq!(
        refusal(|text| text.replace("conditions = [\"slope_angle\"]", "conditions = [\"arrangement\"]"), str::to_owned),
        "error: plan.toml: `hold_out[0].conditions` is arrangement, but must be a number or a list of numbers of the case; name \
         a numerical parameter, such as `slope_angle`"
    );
}

#[test]
fn nothing_to_compare_with_is_refused() {
    let from = PLAN.find("data = [{ table").expect("there");
    let to = from + PLAN[from..].find("}]").expect("there") + 2;
    let empty = refusal(|text| text.replace(&PLAN[from..to], "data = []"), str::to_owned);
    assert_eq!(empty, "error: plan.toml: `fit[0].data`: no entry; add the data that the case is compared with");
}

#[test]
fn wrong_data_are_refused_by_name() {
    let data = |from: &'static str, to: &'static str| refusal(str::to_owned, move |text| text.replace(from, to));
    assert_eq!(
        data("u [m/s],uncertainty [m/s]", "u [cm],uncertainty [mm]"),
        "error: mine.csv: `u` is [cm], but must be a unit that converts to [m/s]; correct the unit in the heading"
    );
    assert_eq!(
        data(",uncertainty [m/s]\n", "\n").split(';').next(),
        Some("error: mine.csv: `line 9`: 3 columns, and the heading has 2")
    );
    assert_eq!(
        data(",uncertainty [m/s]", ",weight"),
        "error: mine.csv: `columns`: u [m/s] has no uncertainty; add a column `uncertainty [m/s]`, or repeats: \
         columns of one name, or a list of files in the place of this one"
    );
    assert_eq!(
        data("y [m],", "z [m],"),
        "error: mine.csv: `columns`: no column `y` among z [m], u [m/s], uncertainty [m/s]; rename one, \
         or give { files = […], columns = { \"y\" = \"HEADING [UNIT]\" } }"
    );
    assert_eq!(
        data("0.126", "NaN"),
        "error: mine.csv: `line 10`: \"NaN\" in column u [m/s] is not a measured value; write a finite number with a \
         decimal point, or leave the row out"
    );
}

#[test]
fn data_without_counterpart_say_what_there_is() {
    let place = Place::new();
    place.file("mine.csv", MINE);
    place.file("plan.toml", &PLAN.replace("profile-fluid-newtonian", "profile-newtonian"));
    let refused = place.bagnold(&["-q", "calibrate", "plan.toml", "--out", "out"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    let begin = "error: plan.toml: `fit[0]`: the case gives no table `profile-newtonian-particles-jittered-resolution-10`; it has ";
    assert!(message.starts_with(begin), "{message}");
}

const CHOICES: &str = r#"
title = "which fluid"

[[choices]]
name = "thin"
set = { film = ["material.viscosity=0.5"] }

[[choices]]
name = "thick"
set = { film = ["material.viscosity=1.0"] }

[[fit]]
case = "film"
with = { resolution = 10 }
data = [{ table = "profile-fluid-newtonian-particles-jittered-resolution-10", x = "y [m]", y = "u [m/s]", file = "mine.csv" }]

[[hold_out]]
case = "film"
conditions = ["slope_angle"]
with = { resolution = 10, slope_angle = 12.0 }
data = [{ metric = "no_such_metric", value = 0.0, unit = "-", uncertainty = 1.0, source = "own" }]
"#;

#[test]
fn choices_are_ranked_by_the_fitted_data_alone() {
    let place = Place::new();
    place.file("mine.csv", MINE);
    place.file("plan.toml", CHOICES);
    let done = place.bagnold(&["-q", "calibrate", "plan.toml", "--out", "out"]).assert().code(0);
    let printed = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    // nothing can be said of what is held out, which changes neither ranks nor weights
    assert!(printed.starts_with("thin: χ² "), "{printed}");
    let text = std::fs::read_to_string(place.path("out/result.json")).expect("written");
    let result: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(result["trials"][0]["name"], "thin");
    assert!(result["trials"][0]["weight"].as_f64().is_some_and(|weight| weight > 0.99), "{text}");
    assert!(result["trials"][1]["hold_out_failure"].as_str().is_some_and(|reason| reason.contains("no_such_metric")));
}

#[test]
fn choices_that_set_nothing_are_refused() {
    let refusal = |from: &str, to: &str| {
        let place = Place::new();
        place.file("mine.csv", MINE);
        place.file("plan.toml", &CHOICES.replacen(from, to, 1));
        let refused = place.bagnold(&["-q", "calibrate", "plan.toml", "--out", "out"]).assert().code(2);
        String::from_utf8_lossy(&refused.get_output().stderr).trim_end().to_owned()
    };
    assert_eq!(
        refusal("film = [\"material.viscosity=1.0\"]", "flim = [\"material.viscosity=1.0\"]"),
        "error: plan.toml: `choices[1].set` is flim, but must be a case with data in `fit` or `hold_out`; did you mean `film`?"
    );
    assert_eq!(
        refusal("material.viscosity=1.0", "material.viscoscity=1.0"),
        "error: plan.toml: `material.viscoscity`: unknown field; did you mean \
         `material.viscosity`? `bagnold show film` prints all fields"
    );
    assert_eq!(
        refusal("name = \"thick\"", "name = \"thin\""),
        "error: plan.toml: `choices[1].name` is thin, but must be unique; rename it"
    );
}

/// The shipped example on the real solver: all three parameters of μ(I) within 2 %, the truth inside the 95 % region.
#[test]
#[ignore = "two minutes: cargo test -- --ignored"]
fn friction_and_inertia_are_found_again_from_profiles() {
    recovers_the_truth_from_profiles(12);
}

pub(crate) fn recovers_the_truth_from_profiles(rows: usize) {
    let place = Place::new();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/calibrations/mu-i-from-profiles.toml");
    let text = std::fs::read_to_string(example)
        .expect("the example")
        .replace("trajectories = 2", "trajectories = 0")
        .replace("resolution = 12", &format!("resolution = {rows}"))
        .replace("resolution-12", &format!("resolution-{rows}"));
    let written: toml::Table = toml::from_str(&text).expect("TOML");
    let evaluations = written["evaluations"].as_integer().and_then(|count| u64::try_from(count).ok()).expect("a count");
    let plan = place.file("plan.toml", &text);
    place.bagnold(&["-q", "calibrate", &plan, "--out", "out"]).assert().code(0);
    let text = std::fs::read_to_string(place.path("out/result.json")).expect("written");
    let result: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    // the first descent, eight other starts, and descents from them
    assert!(result["searched"].as_u64().is_some_and(|count| count <= evaluations + 8 + evaluations));
    for parameter in result["parameters"].as_array().expect("a list") {
        let number = |name: &str| parameter[name].as_f64().expect("a number");
        let error = number("best") / number("truth") - 1.0;
        assert!(error.abs() < 0.02, "{parameter}");
    }
    assert_eq!(result["truth_inside"], true, "{text}");
}
