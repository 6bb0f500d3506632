//! Standard output and standard error that nobody takes, and texts that would control a terminal.

#![cfg(target_os = "linux")]

use crate::command_line::program::{CHEAP, Place, path};
use std::fs::{File, OpenOptions};
use std::process::{Command, Output, Stdio};

fn full() -> File {
    OpenOptions::new().write(true).open("/dev/full").expect("a device that is always full")
}

/// A pipe whose reader has gone.
fn broken() -> Stdio {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

fn run(place: &Place, arguments: &[&str], output: impl Into<Stdio>, error: impl Into<Stdio>) -> Output {
    let mut command = Command::new(path());
    command.current_dir(place.path("")).env("BAGNOLD_STORE", place.path("store")).args(arguments);
    let child = command.stdin(Stdio::null()).stdout(output).stderr(error).spawn().expect("started");
    child.wait_with_output().expect("ended")
}

/// Commands that print, each in its way.
fn printing() -> Vec<Vec<&'static str>> {
    let run = [&["-q", "run", "--json", "--out", "out"], CHEAP].concat();
    let words = [
        &["list"][..],
        &["show", "film"],
        &["schema", "film"],
        &["completions", "bash"],
        &["completions", "man"],
        &["judge", "--template", "film"],
        &["sweep", "template"],
        &["store", "list"],
        &["--help"],
        &["run", "--help"],
        &["help"],
        &["--version"],
    ];
    words.into_iter().map(<[&str]>::to_vec).chain([run]).collect()
}

#[test]
fn output_that_cannot_be_written_is_an_error() {
    let place = Place::new();
    for arguments in printing() {
        let ended = run(&place, &arguments, full(), Stdio::piped());
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!(ended.status.code(), Some(2), "{arguments:?}: {said}");
        assert_eq!(
            said,
            "error: standard output: cannot be written (no space left on device); free space, or redirect it; the folders of \
             results were written\n",
            "{arguments:?}"
        );
    }
    assert!(place.path("out/metrics.json").is_file(), "the work was done all the same");
}

#[test]
fn a_reader_who_has_had_enough_is_no_error() {
    let place = Place::new();
    for arguments in printing() {
        let ended = run(&place, &arguments, broken(), Stdio::piped());
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!((ended.status.code(), said.as_str()), (Some(0), ""), "{arguments:?}");
    }
}

#[test]
fn closed_standard_error_is_accepted() {
    let place = Place::new();
    let film = |more: &[&'static str]| [&["run", "--out", "out", "--fresh"], CHEAP, more].concat();
    let cases = [
        // an estimate, a profile and log lines
        (film(&["--profile", "-vv"]), 0),
        (vec!["run", "flim"], 2),
        (vec!["run"], 2),
        (vec!["--no-such-flag"], 2),
        (vec!["sweep", "none.toml"], 2),
    ];
    // a store that cannot be written is a warning
    place.file("file", "");
    let warned = film(&["--store", "file/store"]);
    for (arguments, code) in cases.into_iter().chain([(warned, 0)]) {
        for stderr in [full().into(), broken()] {
            let ended = run(&place, &arguments, Stdio::null(), stderr);
            assert_eq!(ended.status.code(), Some(code), "{arguments:?}");
        }
    }
}

#[test]
fn neither_can_be_written_and_nothing_panics() {
    let place = Place::new();
    for (arguments, code) in [(vec!["list"], 2), (vec!["--help"], 2), ([&["run", "--out", "out"], CHEAP].concat(), 2)] {
        assert_eq!(run(&place, &arguments, full(), full()).status.code(), Some(code), "{arguments:?}");
    }
}

/// Texts and names of files are shown, and not obeyed by a terminal.
#[test]
fn texts_of_files_do_not_reach_the_terminal_as_they_stand() {
    let place = Place::new();
    let controls = "\u{1b}[2J\u{7}\u{9b}\u{202e}";
    let toml = "\\u001b[2J\\u0007\\u009b\\u202e";
    place.file("field.toml", &format!("case = \"film\"\n\"slope{toml}\" = 1\n"));
    place.file("case.toml", &format!("case = \"fi{toml}lm\"\n"));
    place.file("value.toml", &format!("case = \"film\"\nresolution = \"a{toml}\"\n"));
    place.file("law.toml", &format!("case = \"column-planar\"\n[material]\nlaw = \"a{toml}\"\n"));
    place.file("plan.toml", &format!("design = \"grid\"\n[[cases]]\ncase = \"film\"\nname = \"a{toml}\"\n[[vary]]\npath = \"slope_angle\"\nvalues = [1.0]\n"));
    place.file(&format!("raw{controls}.toml"), "case = 1\n");
    place.file("raw.toml", &format!("case = \"film\"\n# {controls}\nx = {controls}\n"));
    let missing = format!("missing{controls}.toml");
    let named = format!("raw{controls}.toml");
    let setting = format!("slope_angle=a{controls}");
    for arguments in [
        &["run", "field.toml"][..],
        &["run", "case.toml"],
        &["run", "value.toml"],
        &["run", "law.toml"],
        &["run", "raw.toml"],
        &["run", &named],
        &["run", &missing],
        &["calibrate", &named],
        &["judge", &named],
        &["sweep", "plan.toml"],
        &["run", "film", "--set", &setting],
    ] {
        let ended = run(&place, arguments, Stdio::piped(), Stdio::piped());
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!(ended.status.code(), Some(2), "{arguments:?}: {said}");
        let is_plain =
            |text: &str| !text.chars().any(|letter| bagnold_harness::input::is_control(letter) && letter != '\n');
        assert!(is_plain(&said), "{arguments:?}: {said:?}");
        // what is quoted is still recognised; of a comment nothing is
        assert!(said.contains("[2J") || arguments.contains(&"raw.toml"), "{arguments:?}: {said}");
        assert!(ended.stdout.is_empty());
    }
}
