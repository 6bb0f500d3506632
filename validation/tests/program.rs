//! Makes `cargo test` build the program that the command line tests in the workspace's `tests/` start.

#[test]
fn the_program_tells_its_version() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_bagnold")).arg("--version").output().expect("started");
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), format!("bagnold {}", env!("CARGO_PKG_VERSION")));
}
