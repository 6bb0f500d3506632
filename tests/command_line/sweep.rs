//! Sweeps: killed and resumed, refused, and what they leave.

use crate::command_line::killed::{Finished, assert_same_files, kill_and_resume, written};
use crate::command_line::program::Place;
use bagnold_harness::case::Limits;
use bagnold_tools::sweep::SweepPlan;
use bagnold_validation::REGISTRY;
use std::path::{Path, PathBuf};

const PLAN: &str = r#"
design = "grid"

[[cases]]
case = "film"
with = { resolution = 10 }

[[vary]]
path = "material.viscosity"
values = [0.5, 0.7, 1.0, 1.4]

[[vary]]
path = "slope_angle"
values = [20.0, 25.0, 95.0]
"#;

/// Times at which the records were written.
fn records(folder: &Path) -> Finished {
    let runs: Vec<PathBuf> =
        std::fs::read_dir(folder.join("runs")).into_iter().flatten().flatten().map(|run| run.path()).collect();
    let files: Vec<PathBuf> = runs.iter().map(|run| run.join("record.postcard")).collect();
    let name = |run: &Path| run.file_name().unwrap_or_default().to_string_lossy().into_owned();
    written(runs.iter().map(|run| name(run)).zip(files.iter().map(PathBuf::as_path)))
}

/// The shipped plan: layers over Shields number and grain size, none of which its case refuses.
#[test]
fn the_shipped_plan_has_four_hundred_layers() {
    let plan = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/sweeps/bed-load-1d-map.toml");
    let manifest = SweepPlan::read(&plan).and_then(|plan| plan.manifest(*REGISTRY, Limits::default())).expect("a plan");
    assert_eq!(manifest.entries.len(), 400);
    for entry in &manifest.entries {
        assert_eq!(entry.refusal, None, "{}", entry.folder);
    }
}

#[test]
fn a_sweep_that_was_killed_gives_the_same_table_and_repeats_nothing() {
    let place = Place::new();
    let plan = place.file("plan.toml", PLAN);
    let whole = place.bagnold(&["-q", "sweep", &plan, "--out", "whole"]).assert().code(3);
    let printed = String::from_utf8_lossy(&whole.get_output().stdout).into_owned();
    assert!(printed.starts_with("8 of 12 runs done, 4 failed (reasons in failures.csv)\n"), "{printed}");

    assert_eq!(kill_and_resume(&place, "sweep", &plan, records), 3);
    assert_same_files(&place, "whole", &["results.csv", "failures.csv", "manifest.json"]);
}

#[test]
fn a_sweep_may_mean_some_runs_only() {
    let place = Place::new();
    let chosen = PLAN.replace("resolution = 10 }", "resolution = 10, variants = [{ name = \"own\" }, { name = \"bingham\", set = { material = { law = \"bingham\", yield_stress = 5.1, plastic_viscosity = 0.5, regularisation_rate = 0.3 } } }] }").replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]");
    let chosen = chosen.replace("[20.0, 25.0, 95.0]", "[20.0]");
    let plan =
        place.file("plan.toml", &chosen.replace("case = \"film\"", "case = \"film\"\nonly = [\"fluid=newtonian\"]"));
    place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().success();
    let results = std::fs::read_to_string(place.path("out/results.csv")).expect("written");
    assert!(results.contains("fluid=newtonian") && !results.contains("fluid=bingham"), "{results}");
    let other = refusal(&chosen.replace("case = \"film\"", "case = \"film\"\nonly = [\"fluid=oil\"]"), &[]);
    assert!(
        other.starts_with("error: plan.toml: `cases[0].only` is \"fluid=oil\", but must be keys and values of a run"),
        "{other}"
    );
}

/// Points of a study, whose parameters a file of its own holds, are simulated one by one.
#[test]
fn a_study_is_swept_by_its_parameters() {
    let place = Place::new();
    let plan = "design = \"grid\"\nmetrics = [\"pore_pressure_middle\"]\n[[cases]]\ncase = \"consolidation\"\n[[vary]]\n\
                path = \"material.liquid_viscosity\"\nvalues = [5e-4, 1e-3, 2e-3]\n";
    let plan = place.file("plan.toml", plan);
    place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().success();
    let results = std::fs::read_to_string(place.path("out/results.csv")).expect("written");
    let mut lines = results.lines();
    let column = lines.next().and_then(|heads| heads.split(',').position(|head| head == "value")).expect("a column");
    let rows = lines
        .filter(|line| line.contains("pore_pressure_middle"))
        .map(|line| line.split(',').nth(column).expect("a value").parse().expect("a number"));
    let pressures: Vec<f64> = rows.collect();
    assert!(pressures.len() == 3 && pressures.is_sorted_by(|a, b| 1.05 * a < *b), "{pressures:?}");
}

#[test]
fn failures_keep_their_reason() {
    let place = Place::new();
    let plan = place.file("plan.toml", &PLAN.replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]"));
    place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().code(3);
    let failures = std::fs::read_to_string(place.path("out/failures.csv")).expect("written");
    assert_eq!(
        failures,
        "run,case,tier,viscosity,slope_angle,reason\n\
         3,film,quick,0.5,95.0,\"plan.toml: `slope_angle` is 95, but must be above −90° and below 90°; give the angle between \
         the slope and the horizontal in degrees\"\n"
            .replace("plan.toml: ", "")
    );
}

/// Message of `bagnold sweep` for a plan that it refuses, with exit code 2 and without a folder.
fn refusal(plan: &str, arguments: &[&str]) -> String {
    let place = Place::new();
    place.file("plan.toml", plan);
    let command = [&["-q", "sweep", "plan.toml", "--out", "out"], arguments].concat();
    let refused = place.bagnold(&command).assert().code(2);
    assert!(records(&place.path("out")).is_empty());
    String::from_utf8_lossy(&refused.get_output().stderr).trim_end().to_owned()
}

#[test]
fn wrong_plans_are_refused_by_name() {
    let path = refusal(&PLAN.replace("material.viscosity", "material.viscoscity"), &[]);
    assert_eq!(
        path,
        "error: plan.toml: `material.viscoscity`: unknown field; did you mean \
         `material.viscosity`? `bagnold show film` prints all fields"
    );
    let reversed = PLAN.replace("values = [0.5, 0.7, 1.0, 1.4]", "lower = 2.0\nupper = 1.0\nlevels = 3");
    assert_eq!(
        refusal(&reversed, &[]),
        "error: plan.toml: `vary[0].lower` is 2, but must be below `upper`, which is 1; exchange the two bounds"
    );
    let case = refusal(&PLAN.replace("case = \"film\"", "case = \"flim\""), &[]);
    assert_eq!(case, "error: plan.toml: `flim`: unknown case; did you mean `film`? `bagnold list` prints all cases");
    let syntax = refusal(&PLAN.replace("[[vary]]", "[[parameter]]"), &[]);
    assert!(syntax.starts_with("error: plan.toml: `line 8, column 3`: unknown field `parameter`"), "{syntax}");
    let design = refusal(&PLAN.replace("design = \"grid\"", "design = \"sobol\""), &[]);
    assert_eq!(
        design,
        "error: plan.toml: `line 2, column 10`: expected design = \"grid\", or a table [design.latin_hypercube] or \
         [design.sobol] with `points` and `seed`; `bagnold sweep --help` shows a plan"
    );
}

#[test]
fn a_metric_that_no_run_has_is_named() {
    let place = Place::new();
    let plan =
        PLAN.replace("design = \"grid\"", "design = \"grid\"\nmetrics = [\"particles_lost\", \"particles_list\"]");
    let plan = place.file("plan.toml", &plan.replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]"));
    let done = place.bagnold(&["sweep", &plan, "--out", "out"]).assert().code(3);
    let said = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    assert!(said.contains("no run has the metric `particles_list`") && !said.contains("`particles_lost`"), "{said}");
}

#[test]
fn a_sweep_without_slurm_says_what_is_missing() {
    let place = Place::new();
    let plan = place.file("plan.toml", PLAN);
    let refused = place
        .bagnold(&["-q", "sweep", &plan, "--out", "out", "--engine", "slurm"])
        .env("PATH", place.path("empty"))
        .assert()
        .code(2);
    assert_eq!(
        String::from_utf8_lossy(&refused.get_output().stderr),
        "error: slurm: `sbatch` is not installed on this machine; log in to the cluster, or use --engine local\n"
    );
}

/// Commands of Slurm that keep their arguments, a line each, and answer as Slurm does.
#[test]
fn requested_options_reach_slurm_as_one_argument_each_and_are_kept() {
    let place = Place::new();
    let plan = place.file("plan.toml", &PLAN.replace("[20.0, 25.0, 95.0]", "[20.0]"));
    std::fs::create_dir(place.path("bin")).expect("writable");
    for (name, answer) in [("sbatch", "echo '17;cluster'"), ("squeue", "echo '17 2'; echo '18 3'")] {
        let script = format!("#!/bin/sh\nfor each; do echo \"$each\"; done >{name}-said\n{answer}\n");
        let file = place.file(&format!("bin/{name}"), &script);
        assert!(std::process::Command::new("chmod").args(["+x", &file]).status().expect("chmod").success());
    }
    let said = |name: &str| std::fs::read_to_string(place.path(name)).expect("called");
    let path = format!("{}:{}", place.path("bin").display(), std::env::var("PATH").unwrap_or_default());
    let slurm =
        ["--engine", "slurm", "--time", "1:00 --wrap=id", "--partition", "a b", "--throttle", "2", "--store", "s"];
    let arguments = [&["sweep", &plan, "--out", "out $x"][..], &slurm].concat();
    let submitted = place.bagnold(&arguments).env("PATH", &path).assert().code(0);
    let text = String::from_utf8_lossy(&submitted.get_output().stdout).into_owned();
    assert!(text.starts_with("submitted 4 runs as Slurm job 17\n"), "{text}");
    let options = said("sbatch-said");
    for line in ["--time=1:00 --wrap=id", "--partition=a b", "--array=1,2,3,4%2", "sweep", "task", "--store", "s"] {
        assert!(options.lines().any(|other| other == line), "{line} in {options}");
    }
    assert!(options.lines().any(|line| line.ends_with("/out $x")), "{options}");
    // without options those of the last submission count, and what is queued is not submitted again
    let again = ["sweep", "collect", "out $x", "--resubmit", "--time", "2:00"];
    place.bagnold(&again).env("PATH", &path).assert().code(1);
    let options = said("sbatch-said");
    for line in ["--time=2:00", "--partition=a b", "--array=1,3,4%2", "s"] {
        assert!(options.lines().any(|other| other == line), "{line} in {options}");
    }
}

#[test]
fn a_folder_that_cannot_be_written_or_holds_a_sweep_is_refused() {
    let place = Place::new();
    let plan = place.file("plan.toml", &PLAN.replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]"));
    let file = place.file("file", "");
    let below = format!("{file}/out");
    let unwritable = place.bagnold(&["-q", "sweep", &plan, "--out", &below]).assert().code(2);
    assert_eq!(
        String::from_utf8_lossy(&unwritable.get_output().stderr),
        format!(
            "error: {below}: cannot be written (not a directory); choose a folder that you may write to with --out\n"
        )
    );
    place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().code(3);
    let other = place.file("other.toml", &PLAN.replace("[0.5, 0.7, 1.0, 1.4]", "[0.6]"));
    let mixed = place.bagnold(&["-q", "sweep", &other, "--out", "out"]).assert().code(2);
    assert_eq!(
        String::from_utf8_lossy(&mixed.get_output().stderr),
        "error: out: contains a sweep of another plan; name another folder with --out\n"
    );
    let none = place.bagnold(&["sweep", "collect", "store"]).assert().code(2);
    let message = String::from_utf8_lossy(&none.get_output().stderr).into_owned();
    assert!(message.contains("no sweep in this folder (no manifest.json)"), "{message}");
}

/// Given again, it ends as it did, and says where its results are.
#[test]
fn a_sweep_that_is_done_runs_nothing_and_says_so() {
    let place = Place::new();
    for (values, code, all) in [("[20.0, 25.0]", 0, "2"), ("[20.0, 25.0, 95.0]", 3, "3")] {
        let plan = PLAN.replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]").replace("[20.0, 25.0, 95.0]", values);
        let plan = place.file(&format!("plan-{all}.toml"), &plan);
        let out = format!("out-{all}");
        let first = place.bagnold(&["sweep", &plan, "--out", &out]).assert().code(code);
        let first = String::from_utf8_lossy(&first.get_output().stdout).into_owned();
        let before =
            (records(&place.path(&out)), std::fs::read(place.path(&out).join("results.csv")).expect("written"));
        for more in [&[][..], &["--fresh"]] {
            let again =
                place.bagnold(&[&["sweep", &plan, "--out", &out], more].concat()).assert().code(code).stderr("");
            assert_eq!(
                String::from_utf8_lossy(&again.get_output().stdout),
                format!(
                    "all {all} runs are finished already; to run them again, name another folder with --out\n\
                     {first}"
                )
            );
        }
        let after = (records(&place.path(&out)), std::fs::read(place.path(&out).join("results.csv")).expect("written"));
        assert_eq!(before, after);
    }
}

#[test]
fn points_of_a_hypercube_fill_their_range_on_its_scale() {
    let place = Place::new();
    let plan = PLAN
        .replace("design = \"grid\"", "[design.latin_hypercube]\npoints = 4\nseed = 7")
        .replace("values = [0.5, 0.7, 1.0, 1.4]", "lower = 0.5\nupper = 8.0\nscale = \"log\"")
        .replace("values = [20.0, 25.0, 95.0]", "lower = 20.0\nupper = 28.0");
    let plan = place.file("plan.toml", &plan);
    place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().code(0);
    let results = std::fs::read_to_string(place.path("out/results.csv")).expect("written");
    let mut points: Vec<(f64, f64)> = results
        .lines()
        .filter(|line| line.contains(",particles_lost,"))
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            (fields[3].parse().expect("a viscosity"), fields[4].parse().expect("an angle"))
        })
        .collect();
    // one point in each quarter of either range: factors of two from 0.5 Pa·s, 2° from 20°
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let quarters: Vec<u32> = points.iter().map(|point| ((point.0 / 0.5_f64).log2()) as u32).collect();
    assert_eq!(quarters, [0, 1, 2, 3], "{points:?}");
    points.sort_by(|a, b| a.1.total_cmp(&b.1));
    let quarters: Vec<u32> = points.iter().map(|point| ((point.1 - 20.0) / 2.0) as u32).collect();
    assert_eq!(quarters, [0, 1, 2, 3], "{points:?}");
}

/// A film that has no time to become steady has no profile, and the table and the summary give the reason.
#[test]
fn a_value_that_is_not_a_number_has_its_reason() {
    let place = Place::new();
    let short = PLAN.replace("resolution = 10 }", "resolution = 10, relaxation_times = 0.2 }");
    let short = short.replace("[0.5, 0.7, 1.0, 1.4]", "[0.5]").replace("[20.0, 25.0, 95.0]", "[20.0]");
    let plan = place.file("plan.toml", &short);
    let ended = place.bagnold(&["-q", "sweep", &plan, "--out", "out"]).assert().success();
    let printed = String::from_utf8_lossy(&ended.get_output().stdout).into_owned();
    assert!(printed.contains("values are not numbers (column `reason`"), "{printed}");
    let results = std::fs::read_to_string(place.path("out/results.csv")).expect("written");
    assert!(results.lines().next().is_some_and(|head| head.ends_with("verdict,reason")), "{results}");
    for line in results.lines().skip(1) {
        let reason = line.split_once(",NaN,").map(|(_, rest)| rest.splitn(3, ',').nth(2).unwrap_or_default());
        assert!(reason.map_or(line.ends_with(','), |reason| reason.len() > 10), "{line}");
    }
    assert!(results.contains(",NaN,"), "{results}");
}
