//! Missing permission. It binds everybody but root, so under root the program runs as nobody.

#![cfg(unix)]

use crate::command_line::program::{CHEAP, Place, path};
use std::fs::{Permissions, set_permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// User and group that own nothing.
const NOBODY: u32 = 65534;

fn restrict(path: &Path, mode: u32) {
    set_permissions(path, Permissions::from_mode(mode)).expect("one may change one's own files");
}

/// A copy of the program that everybody may start. A process of its own makes it: a file that this process has open for
/// writing is open in whatever another test forks meanwhile, and Linux starts no program that is open for writing.
fn copied(place: &Place, name: &str) -> PathBuf {
    let program = place.path(name);
    let status = Command::new("cp").arg("--").args([&path(), &program]).status().expect("cp is everywhere");
    assert!(status.success(), "cp: {status}");
    restrict(&program, 0o755);
    program
}

/// The program with the rights of an ordinary user.
fn ordinary(place: &Place) -> assert_cmd::Command {
    let folder = place.path("");
    let is_root = folder.metadata().expect("the folder is there").uid() == 0;
    let mut program = path();
    if is_root {
        // the build folder may be closed to others
        program = copied(place, "program");
        restrict(&folder, 0o755);
    }
    let mut command = Command::new(program);
    if is_root {
        command.uid(NOBODY).gid(NOBODY);
    }
    command.current_dir(&folder).env("BAGNOLD_STORE", place.path("store"));
    assert_cmd::Command::from_std(command)
}

#[test]
fn a_file_that_may_not_be_read() {
    let place = Place::new();
    let file = place.file("secret.toml", "case = \"film\"\n");
    restrict(Path::new(&file), 0o000);
    ordinary(&place)
        .args(["run", "secret.toml"])
        .assert()
        .code(2)
        .stdout("")
        .stderr("error: secret.toml: cannot be read (permission denied); check the path and its permissions\n");
}

#[test]
fn a_folder_that_may_not_be_written() {
    let place = Place::new();
    let closed = place.path("closed");
    std::fs::create_dir(&closed).expect("writable");
    restrict(&closed, 0o555);
    for out in ["closed/out", "closed"] {
        ordinary(&place).args([&["run", "--out", out], CHEAP].concat()).assert().code(2).stdout("").stderr(format!(
            "error: {out}: cannot be written (permission denied); choose a folder that you may write to with --out\n"
        ));
        assert_eq!(std::fs::read_dir(&closed).expect("readable").count(), 0);
    }
    restrict(&closed, 0o755);
}

#[test]
fn a_folder_that_nobody_can_make() {
    let place = Place::new();
    place.file("file", "");
    place.bagnold(&[&["run", "--out", "file/out"], CHEAP].concat()).assert().code(2).stdout("").stderr(
        "error: file/out: cannot be written (not a directory); choose a folder that you may write to with --out\n",
    );
}

#[test]
fn a_shared_folder_that_may_not_be_written() {
    let place = Place::new();
    place.file(
        "plan.toml",
        "design = \"grid\"\n[[cases]]\ncase = \"film\"\n[[vary]]\npath = \"slope_angle\"\nvalues = [20.0]\n",
    );
    let shared = place.path("shared");
    std::fs::create_dir(&shared).expect("writable");
    restrict(&shared, 0o555);
    ordinary(&place).args(["sweep", "plan.toml", "--out", "shared/sweep"]).assert().code(2).stdout("").stderr(
        "error: shared/sweep: cannot be written (permission denied); choose a folder that you may write to with --out\n",
    );
}

#[test]
fn a_copied_program_starts_whatever_is_started_meanwhile() {
    let place = Place::new();
    let done = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while !done.load(std::sync::atomic::Ordering::Relaxed) {
                    Command::new("true").status().expect("started");
                }
            });
        }
        let started = (0..4).map(|copy| {
            let program = copied(&place, &format!("program-{copy}"));
            Command::new(program).arg("--version").output()
        });
        let started: Vec<_> = started.collect();
        // before the test can fail: the other threads would go on
        done.store(true, std::sync::atomic::Ordering::Relaxed);
        assert!(started.into_iter().all(|output| output.expect("started").status.success()));
    });
}
