//! The program where no checkout is: an empty folder, a home of its own, and what it carries.

use crate::command_line::program::{CHEAP, Place, path};
use assert_cmd::Command;
use bagnold_harness::case::Tier;
use bagnold_report::Baseline;
use bagnold_validation::REGISTRY;
use std::path::PathBuf;

/// The folder in which one works, beside the home and the copied program.
const WORK: &str = "work";

const SUBMISSION: &str = "case = \"water-film\"\n[code]\nname = \"by hand\"\n[[run]]\nvariant = \"particles=lattice\"\n\
    numbers = { velocity_l2 = 0.2 }\n";

/// A copy of the program as a user has it whose only file of Bagnold is the program.
fn installed(place: &Place) -> PathBuf {
    let program = place.path(&format!("bagnold{}", std::env::consts::EXE_SUFFIX));
    if !program.exists() {
        std::fs::create_dir(place.path(WORK)).expect("writable");
        std::fs::copy(path(), &program).expect("copied");
    }
    program
}

fn bagnold(place: &Place, arguments: &[&str]) -> Command {
    let mut command = Command::new(installed(place));
    command.current_dir(place.path(WORK)).args(arguments);
    command.env_remove("BAGNOLD_STORE").env_remove("XDG_CACHE_HOME").env("HOME", place.path("home"));
    command
}

fn read(place: &Place, file: &str) -> String {
    let file = place.path(WORK).join(file);
    std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// Names in a folder, sorted.
fn names(folder: PathBuf) -> Vec<String> {
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_report_in_an_empty_folder_compares_with_the_values_that_the_program_carries() {
    let place = Place::new();
    bagnold(&place, &["report", "--cases", "water-film", "--deny", "moved", "--quiet"]).assert().code(0);
    assert_eq!(names(place.path(WORK)), ["reports"], "nothing else was written there");
    let page = read(&place, "reports/cases/water-film/index.html");
    assert!(page.contains("velocity_l2"), "{page}");
    // beside the values stand those that the program carries
    let carried = Baseline::shipped("water-film", Tier::Quick).expect("carried").content("water-film");
    assert!(carried.contains("velocity_l2 | "), "{carried}");

    bagnold(&place, &["report", "--cases", "water-film", "--accept", "--quiet"]).assert().code(0);
    assert_eq!(names(place.path(WORK)), ["reports", "snapshots"], "a baseline of one's own stands here");
    let file = "snapshots/quick/water-film.snap";
    let own = read(&place, file);
    let moved =
        |line: &str| if line.starts_with("velocity_l2 | ") { line.replace("| 0.", "| 7.") } else { line.to_owned() };
    let other: String = own.lines().map(|line| moved(line) + "\n").collect();
    assert_ne!(own, other);
    std::fs::write(place.path(WORK).join(file), other).expect("writable");
    let finished = bagnold(&place, &["report", "--cases", "water-film", "--deny", "moved", "--quiet"]).assert().code(1);
    let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
    assert!(text.contains("moved: "), "{text}");
}

#[test]
fn every_command_works_and_keeps_its_runs_in_the_users_cache() {
    let place = Place::new();
    let listed = bagnold(&place, &["list"]).assert().code(0);
    let listed = String::from_utf8_lossy(&listed.get_output().stdout).into_owned();
    assert_eq!(listed.lines().count(), REGISTRY.iter().count());
    bagnold(&place, &["show", "film"]).assert().code(0);
    bagnold(&place, &[&["run"], CHEAP, &["--quiet"]].concat()).assert().code(0);
    assert!(read(&place, "reports/runs/film-quick/index.html").contains("velocity_l2"));
    assert_eq!(names(place.path("home")), [".cache"]);
    let stored = names(place.path("home/.cache/bagnold"));
    assert!(
        matches!(stored.as_slice(), [runs, speeds] if runs.starts_with("sources-") && speeds == "speeds.json"),
        "{stored:?}"
    );

    bagnold(&place, &["export", "water-film", "--out", "exported", "--quiet"]).assert().code(0);
    assert!(read(&place, "exported/definitions.md").contains("velocity_l2"));
    std::fs::write(place.path(WORK).join("mine.toml"), SUBMISSION).expect("writable");
    bagnold(&place, &["judge", "mine.toml", "--out", "judged", "--quiet"]).assert().code(0);
    assert!(read(&place, "judged/metrics.json").contains("by hand"));
    let template = bagnold(&place, &["judge", "--template", "water-film"]).assert().code(0);
    assert!(String::from_utf8_lossy(&template.get_output().stdout).contains("case = \"water-film\""));

    bagnold(&place, &["examples"]).assert().code(0);
    assert_eq!(
        names(place.path(WORK).join("examples")),
        [".bagnold-output", "calibrations", "grains", "scenes", "studies", "sweeps"]
    );
    let shipped = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../validation/calibrations"));
    assert_eq!(names(place.path(WORK).join("examples/calibrations")), names(shipped));
    let refused = bagnold(&place, &["calibrate", "examples/calibrations/no.toml"]).assert().code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("cannot be read"));
    let mut entries = names(place.path(WORK));
    entries.retain(|name| !["exported", "examples", "judged", "mine.toml", "reports"].contains(&name.as_str()));
    assert!(entries.is_empty(), "{entries:?}");
}
