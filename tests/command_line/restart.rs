//! Commands that are killed with -9 in the middle of a run, and go on: the final states are those of a command that was left
//! alone. `BAGNOLD_KILLS` sets how often each is killed (`tests/restart.sh`).

use crate::command_line::program::{self, Place};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A command, without its folder and store.
pub(crate) struct Work {
    pub(crate) name: &'static str,
    pub(crate) arguments: &'static [&'static str],
    /// File with the final states, in the folder of the command.
    states: &'static str,
    /// Text that marks the compared lines of the file; none where all are compared.
    only: Option<&'static str>,
}

pub(crate) const RUN_IN_PLANE: Work = Work {
    name: "run, model A, plane",
    arguments: &["run", "film", "--vary", "resolution=36", "--set", "relaxation_times=1.5"],
    states: "metrics.json",
    only: Some("\"state_hash\""),
};

pub(crate) const RUN_IN_SPACE: Work = Work {
    name: "run, model A, space",
    arguments: &["run", "column-round", "--vary", "aspect_ratio=0.7", "--set", "resolution=6"],
    states: "metrics.json",
    only: Some("\"state_hash\""),
};

pub(crate) const RUN_TWO_PHASES: Work = Work {
    name: "run, model B, grains as pairs and in columns",
    arguments: &[
        "run",
        "bed-load",
        "--set",
        "duration=0.1",
        "--set",
        "averaging_time=0.05",
        "--set",
        r#"variants=[{name="stabilised"},{name="at-rest",set={formulation="at-rest"}},{name="from-another-start",set={particles={start=0.45}}},{name="dilating",set={formulation="dilating"}}]"#,
    ],
    states: "metrics.json",
    only: Some("\"state_hash\""),
};

pub(crate) const REPORT: Work = Work {
    name: "report, model B",
    arguments: &["report", "--cases", "water-film"],
    states: "cases/water-film/metrics.json",
    only: Some("\"state_hash\""),
};

pub(crate) const SWEEP: Work =
    Work { name: "sweep", arguments: &["sweep", "sweep.toml"], states: "results.csv", only: None };

pub(crate) const CALIBRATE: Work =
    Work { name: "calibrate", arguments: &["calibrate", "calibrate.toml"], states: "evaluations.csv", only: None };

const SWEEP_PLAN: &str = r#"
design = "grid"

[[cases]]
case = "film"
with = { resolution = 30, relaxation_times = 1.5 }

[[vary]]
path = "material.viscosity"
values = [0.5, 1.0]
"#;

const CALIBRATION_PLAN: &str = r#"
title = "viscosity of a film"
evaluations = 3
trajectories = 0
region_evaluations = 0

[[parameters]]
path = "material.viscosity"
unit = "Pa·s"
lower = 0.2
upper = 2.0
scale = "log"

[[fit]]
case = "film"
with = { resolution = 30, relaxation_times = 1.5 }
data = [{ metric = "wall_work", value = -1.0, unit = "%", uncertainty = 1.0, source = "own" }]
"#;

/// Number of times that each command is killed.
fn kills() -> usize {
    std::env::var("BAGNOLD_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(2)
}

impl Work {
    /// The command, into a folder of a place, with a store of the same name.
    pub(crate) fn start(&self, place: &Place, folder: &str, threads: &str) -> Child {
        let mut process = Command::new(program::path());
        process.current_dir(place.path("")).args(self.arguments).stdout(Stdio::null()).stderr(Stdio::piped());
        process.args(["--out", folder, "--store", &format!("{folder}-store"), "--threads", threads]);
        process.args(["--checkpoint-interval", "0.05"]);
        process.spawn().expect("started")
    }

    /// Final states of the command, as lines of a file in its folder.
    pub(crate) fn states(&self, place: &Place, folder: &str) -> String {
        let path = place.path(folder).join(self.states);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let lines = text.lines().filter(|line| self.only.is_none_or(|only| line.contains(only)));
        lines.collect::<Vec<_>>().join("\n")
    }

    /// The states of the command left alone, and its exit code.
    pub(crate) fn undisturbed(&self, place: &Place) -> (String, ExitStatus) {
        let status = self.start(place, "whole", "1").wait().expect("ended");
        assert!(status.code().is_some_and(|code| code <= 1), "{}: {status}", self.name);
        (self.states(place, "whole"), status)
    }
}

pub(crate) fn place() -> Place {
    let place = Place::new();
    place.file("sweep.toml", SWEEP_PLAN);
    place.file("calibrate.toml", CALIBRATION_PLAN);
    place
}

/// Checkpoints in a store, and half written ones.
pub(crate) fn checkpoints(place: &Place, store: &str) -> Vec<PathBuf> {
    let inside = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
    };
    let versions = inside(&place.path(store));
    versions.iter().flat_map(|version| inside(&version.join("unfinished"))).flat_map(|run| inside(&run)).collect()
}

/// Waits until the command has written checkpoints that were not there before, or has ended; whether it still works.
pub(crate) fn has_gone_on(child: &mut Child, place: &Place, store: &str) -> bool {
    let before = checkpoints(place, store);
    let patience = Instant::now() + Duration::from_secs(300);
    while child.try_wait().expect("a child").is_none() {
        if checkpoints(place, store).iter().any(|file| !before.contains(file)) {
            return true;
        }
        assert!(Instant::now() < patience, "no checkpoint in five minutes");
        std::thread::sleep(Duration::from_millis(3));
    }
    false
}

pub(crate) fn output_of_the_program(child: Child) -> (ExitStatus, String) {
    let output = child.wait_with_output().expect("ended");
    (output.status, String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Kills the command with -9 at moments that differ, and lets it go on by itself each time.
pub(crate) fn killed(work: &Work) {
    let place = place();
    let (expected, status) = work.undisturbed(&place);
    let mut hits = 0;
    for kill in 0..kills() {
        let threads = if kill % 2 == 0 { "1" } else { "2" };
        let mut child = work.start(&place, "killed", threads);
        if has_gone_on(&mut child, &place, "killed-store") {
            // anywhere between two checkpoints, and within one
            std::thread::sleep(Duration::from_millis((kill as u64 * 37) % 90));
            child.kill().expect("kill -9");
            hits += 1;
        }
        child.wait().expect("ended");
    }
    assert!(hits > 0, "{}: over before it could be killed", work.name);
    let (ended, said) = output_of_the_program(work.start(&place, "killed", "2"));
    assert_eq!(ended.code(), status.code(), "{}: {said}", work.name);
    assert!(!said.contains("WARN"), "{}: {said}", work.name);
    assert_eq!(work.states(&place, "killed"), expected, "{} after {hits} kills", work.name);
    assert!(checkpoints(&place, "killed-store").is_empty(), "{}: checkpoints stay", work.name);
    println!("{}: {hits} kills, final states equal", work.name);
}

#[test]
fn a_killed_run_resumes_to_the_same_state() {
    killed(&RUN_IN_PLANE);
}
