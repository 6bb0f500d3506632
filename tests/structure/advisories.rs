//! `tests/advisories.sh`: checked where there is a database, said where there is none.

#![cfg(unix)]

use crate::structure::source::workspace;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

/// Exit code and what the script prints, with a folder in place of Cargo's home.
fn run(deny: &Path, home: &Path) -> (Option<i32>, String) {
    let script = workspace().join("tests/advisories.sh");
    let output = Command::new("bash").arg(script).arg(deny).env("CARGO_HOME", home).output().expect("bash");
    (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn advisories_are_checked_where_a_database_is_and_otherwise_said_to_be_unchecked() {
    let home = tempfile::tempdir().expect("temporary folder");
    let program = |name: &str, text: &str| {
        let path = home.path().join(name);
        std::fs::write(&path, text).expect("writable");
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("ours");
        path
    };
    // says what it is asked for in place of cargo-deny
    let sound = program("sound", "#!/bin/sh\necho \"$@\"\n");
    let vulnerable = program("vulnerable", "#!/bin/sh\nexit 1\n");
    let (code, text) = run(&home.path().join("none"), home.path());
    assert!(
        code == Some(0) && text.starts_with("advisories: not checked, because there is no cargo-deny at "),
        "{text}"
    );
    let (code, text) = run(&vulnerable, home.path());
    assert!(code == Some(0) && text.starts_with("advisories: not checked, because there is no database in "), "{text}");
    assert_eq!(text.lines().count(), 1);
    std::fs::create_dir_all(home.path().join("advisory-dbs/advisory-db-1")).expect("writable");
    let (code, text) = run(&sound, home.path());
    assert_eq!(code, Some(0), "{text}");
    for manifest in ["Cargo.toml", "python/Cargo.toml", "tests/browser/Cargo.toml"] {
        let asked = format!("--offline --config deny.toml --manifest-path {manifest} check advisories\n");
        assert!(text.contains(&asked) && workspace().join(manifest).is_file(), "{text}");
    }
    assert_eq!(run(&vulnerable, home.path()).0, Some(1), "a vulnerable dependency");
}
