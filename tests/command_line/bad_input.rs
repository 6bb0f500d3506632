//! Each bad input: its exact message, exit code 2, nothing printed and nothing written.

use crate::command_line::program::Place;

/// Runs, and expects this message and no result.
pub(crate) fn refused(place: &Place, arguments: &[&str], message: &str) {
    place.run(arguments).code(2).stdout("").stderr(format!("error: {message}\n"));
    assert!(!place.path("out").exists(), "nothing is written");
    assert!(!place.path("store").exists(), "nothing is simulated");
}

#[test]
fn an_unreadable_file() {
    let place = Place::new();
    refused(
        &place,
        &["no-such.toml"],
        "no-such.toml: cannot be read (no such file or directory); check the path and its permissions",
    );
    std::fs::create_dir(place.path("folder.toml")).expect("writable");
    refused(
        &place,
        &["folder.toml"],
        "folder.toml: cannot be read (is a directory); check the path and its permissions",
    );
    std::fs::write(place.path("binary.toml"), [0xff, 0xfe, 0x00]).expect("writable");
    refused(
        &place,
        &["binary.toml"],
        "binary.toml: cannot be read (text in UTF-16, not in UTF-8); save it as plain text in UTF-8",
    );
}

#[test]
fn an_output_folder_with_somebody_elses_files() {
    let place = Place::new();
    let out = place.path("thesis");
    std::fs::create_dir(&out).expect("writable");
    std::fs::write(out.join("chapter.tex"), "years of work").expect("writable");
    for command in [&["run", "film"][..], &["report", "--cases", "film"]] {
        place.bagnold(&[command, &["--out", "thesis"]].concat()).assert().code(2).stdout("").stderr(
            "error: output folder thesis: not empty and not written by bagnold, so nothing was changed; name an empty or new folder with --out\n",
        );
        assert_eq!(std::fs::read_to_string(out.join("chapter.tex")).expect("still there"), "years of work");
        assert_eq!(std::fs::read_dir(&out).expect("readable").count(), 1);
    }
    assert!(!place.path("store").exists(), "nothing is simulated");
}

#[test]
fn invalid_command_lines() {
    let place = Place::new();
    for arguments in [&["run"][..], &["run", "film", "--tier", "papre"], &["run", "film", "--threads", "0"], &["fly"]] {
        place.bagnold(arguments).assert().code(2).stdout("");
    }
    // far more threads than processors would take two hundred times as long
    let refused = place.bagnold(&["run", "film"]).env("RAYON_NUM_THREADS", "100000").assert().code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(text.contains("`--threads 100000`") && text.contains("eight times the processors"), "{text}");
}
