//! Inputs that are refused: each a file `tests/bad/NAME.args` with an argument a line, beside it the exact message,
//! `NAME.message`. What the arguments name (`NAME.toml`, `NAME.csv`, `NAME.pvd`) lies there too.

use crate::command_line::program::Place;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("bad")
}

/// The files of the folder by name.
fn files() -> BTreeMap<String, String> {
    let entries = std::fs::read_dir(folder()).expect("tests/bad").flatten();
    let file = |entry: std::fs::DirEntry| {
        let text = std::fs::read_to_string(entry.path()).expect("text");
        (entry.file_name().to_string_lossy().into_owned(), text)
    };
    entries.map(file).collect()
}

#[test]
fn every_bad_input_is_refused_with_its_message_and_nothing_is_written() {
    let files = files();
    let place = Place::new();
    for (name, text) in
        files.iter().filter(|(name, _)| [".toml", ".csv", ".pvd"].iter().any(|ending| name.ends_with(ending)))
    {
        place.file(name, text);
    }
    let inputs: Vec<&str> = files.keys().filter_map(|name| name.strip_suffix(".args")).collect();
    assert!(inputs.len() >= 60, "{} inputs", inputs.len());
    let before = place.names();
    let mut wrong = Vec::new();
    for name in inputs {
        let arguments: Vec<&str> = files[&format!("{name}.args")].lines().collect();
        let message = files.get(&format!("{name}.message")).map_or("", String::as_str);
        // the same on every machine
        let output = place.bagnold(&arguments).env("BAGNOLD_MOST_MEMORY", "16").output().expect("started");
        let (said, printed) = (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
        if output.status.code() != Some(2) || said != format!("error: {message}") || !printed.is_empty() {
            wrong.push(format!("{name}: exit {:?}, {printed}{said}  not: {message}", output.status.code()));
        }
        assert_eq!(place.names(), before, "{name}: something was written");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_file_of_bad_inputs_belongs_to_one() {
    let files = files();
    let texts: String =
        files.iter().filter(|(name, _)| name.ends_with(".args")).map(|(_, text)| text.as_str()).collect();
    for name in files.keys() {
        let stem = name.split('.').next().unwrap_or_default();
        let belongs = files.contains_key(&format!("{stem}.args")) || texts.lines().any(|line| line == name);
        assert!(belongs || files.values().any(|text| text.contains(name.as_str())), "{name} belongs to no input");
    }
}

/// Files that are no files, or too large to lie in the repository.
#[cfg(unix)]
#[test]
fn pipes_devices_and_files_of_megabytes_are_refused_at_once() {
    let place = Place::new();
    place.file("plan.toml", &format!("case = \"{}\"\n", "x".repeat(2 << 20)));
    place.file("fields.toml", &(0..200_000).map(|index| format!("field{index} = 1\n")).collect::<String>());
    std::fs::File::create(place.path("case.toml")).and_then(|file| file.set_len(129 << 20)).expect("a long file");
    let pipe = place.path("pipe.toml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    std::os::unix::fs::symlink("/dev/zero", place.path("zero.toml")).expect("a link");
    let begun = std::time::Instant::now();
    let (case, plans) = (&["run"][..], &["sweep", "calibrate"][..]);
    for (commands, file, reason) in [
        (case, "case.toml", "is larger than 128 MiB"),
        (plans, "plan.toml", "is larger than 1 MiB"),
        (plans, "fields.toml", "is larger than 1 MiB"),
        (&["run", "sweep", "calibrate"], "pipe.toml", "is a named pipe, not a regular file"),
        (&["run", "sweep", "calibrate"], "zero.toml", "is a device, not a regular file"),
    ] {
        let is_long = reason.contains("MiB");
        let remedy = if is_long { "shorten it, or move it elsewhere" } else { "check the path and its permissions" };
        for command in commands {
            place
                .bagnold(&[command, file])
                .assert()
                .code(2)
                .stdout("")
                .stderr(format!("error: {file}: cannot be read ({reason}); {remedy}\n"));
        }
    }
    assert!(begun.elapsed() < std::time::Duration::from_secs(60), "{:?}", begun.elapsed());
}
