//! Gives the program a hash of everything that a stored result depends on, the commit that it is built from, and the shipped
//! calibrations, grains, scenes, studies and sweeps.

#[path = "build/code.rs"]
mod code;
#[path = "build/commit.rs"]
mod commit;
#[path = "build/texts/embed.rs"]
mod embed;
#[path = "build/rooms.rs"]
mod rooms;

use code::{CODE, code, is_of_tests};
use embed::{embed, sorted_files, texts};
use rooms::{LAWS, Rooms};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Other files and folders on which results depend.
const REST: [&str; 3] = ["reference-data", "Cargo.lock", "Cargo.toml"];

/// Folders of shipped plans.
const PLANS: [&str; 5] = ["calibrations", "examples/grains", "examples/scenes", "examples/studies", "sweeps"];

/// Endings of the files of decks of other codes; some have none.
const DECKS: [&str; 11] =
    ["", "sh", "py", "csv", "toml", "gfs", "column", "chute", "bingham", "herschel_bulkley", "newtonian"];

/// Whether a file of the league is a deck's, or the submission beside it.
fn is_of_deck(name: &str) -> bool {
    !name.starts_with("wrong/") && (name.contains("/deck/") || name.ends_with("/submission.toml"))
}

fn main() {
    let package = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let workspace = package.parent().map(Path::to_path_buf).unwrap_or_default();
    let (mut hash, mut of_solver, mut build) = (Sha256::new(), Sha256::new(), Sha256::new());
    let dispatch = |folder: &str| source(&workspace, &workspace.join(folder).join("mod.rs")).1;
    let mut rooms = Rooms::new(&LAWS.map(dispatch).concat());

    for name in CODE {
        let folder = workspace.join(name);
        println!("cargo::rerun-if-changed={}", folder.display());
        if workspace.join("Cargo.lock").is_file() && !folder.is_dir() {
            println!(
                "cargo::error=`{name}` is no folder, but results depend on it; correct `CODE` in validation/build.rs"
            );
        }
        let sources = sorted_files(&folder).into_iter().map(|file| source(&workspace, &file));
        for (path, contents) in sources.filter(|(path, _)| !is_of_tests(path)) {
            add(&mut hash, &path, contents.as_bytes());
            if name == CODE[0] {
                add(&mut of_solver, &path, contents.as_bytes());
            }
            rooms.sort_in(&path, &contents);
        }
    }
    for (name, file) in &texts(&package.join("harness"), &["reference-data"], &["csv"]) {
        add(&mut build, &format!("reference-data/{name}"), &std::fs::read(file).unwrap_or_default());
    }
    for (name, file) in &texts(&package.join("cases"), &["states"], &["csv"]) {
        add(&mut build, &format!("states/{name}"), &std::fs::read(file).unwrap_or_default());
    }
    // no result depends on the plans
    embed("studies", &texts(&package, &["studies"], &["toml"]));
    let league = texts(&package, &["league"], &DECKS);
    embed("decks", &league.into_iter().filter(|(name, _)| is_of_deck(name)).collect::<Vec<_>>());
    embed("plans", &texts(&package, &PLANS, &["toml", "csv", "stl", "dump", "slope"]));
    for name in ["Cargo.lock", "Cargo.toml"] {
        let file = workspace.join(name);
        println!("cargo::rerun-if-changed={}", file.display());
        add(&mut build, name, &std::fs::read(file).unwrap_or_default());
    }
    // Another compiler, profile or instruction set is another program, even if its results ought to be the same.
    add(&mut build, "rustc", &compiler());
    let variables =
        ["PROFILE", "OPT_LEVEL", SOLVER_OPT_LEVEL, "TARGET", "CARGO_CFG_TARGET_FEATURE", "CARGO_ENCODED_RUSTFLAGS"];
    for variable in variables {
        add(&mut build, variable, self::variable(variable).as_bytes());
    }

    write_hashes(&rooms, &build);
    hash.update(build.finalize());
    println!("cargo::rustc-env=BAGNOLD_SOURCE_HASH={}", digits(hash));
    println!("cargo::rustc-env=BAGNOLD_SOLVER_HASH={}", digits(of_solver));
    let commit = commit::commit(&workspace, &[&CODE[..], &REST[..]].concat());
    println!("cargo::rustc-env=BAGNOLD_COMMIT={}", commit.as_deref().unwrap_or("unknown"));
    println!("cargo::rustc-env=BAGNOLD_PROFILE={}", profile());
    println!("cargo::rustc-env=BAGNOLD_SOLVER_OPT_LEVEL={}", variable(SOLVER_OPT_LEVEL));
    println!("cargo::rustc-env=BAGNOLD_TARGET_FEATURES={}", variable("CARGO_CFG_TARGET_FEATURE"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
}

/// Variable by which the solver's build script reports the optimisation level of its package.
const SOLVER_OPT_LEVEL: &str = "DEP_BAGNOLD_SOLVER_OPT_LEVEL";

fn digits(hash: Sha256) -> String {
    hash.finalize().iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn variable(name: &str) -> String {
    std::env::var(name).unwrap_or_default()
}

/// Version, commit and host of the compiler, in its own words.
fn compiler() -> Vec<u8> {
    let output = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())).arg("-vV").output();
    output.map(|output| output.stdout).unwrap_or_default()
}

/// Name of the profile's folder: `debug`, `release` or that of a profile of one's own, for which `PROFILE` has what it inherits.
fn profile() -> String {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    // PROFILE/build/PACKAGE-HASH/out
    let name = out.ancestors().nth(3).and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    name.unwrap_or_else(|| variable("PROFILE"))
}

/// Path of a source in the workspace, and its code.
fn source(workspace: &Path, file: &Path) -> (String, String) {
    let path = file.strip_prefix(workspace).unwrap_or(file).to_string_lossy().replace('\\', "/");
    (path, code(&std::fs::read_to_string(file).unwrap_or_default()))
}

/// Writes cases, laws and what draws, each with the hash of all that it depends on beside the rest of the build, as an array for
/// `include!`.
fn write_hashes(rooms: &Rooms, build: &Sha256) {
    let hash = |sources: &[&(String, String)]| {
        let mut hash = build.clone();
        sources.iter().for_each(|(path, code)| add(&mut hash, path, code.as_bytes()));
        digits(hash)
    };
    let hashes: Vec<(String, String)> =
        rooms.dependences().into_iter().map(|(name, sources)| (name, hash(&sources))).collect();
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join("rooms.rs");
    if let Err(error) = std::fs::write(&out, format!("&{hashes:?}")) {
        println!("cargo::error=failed to write {}: {error}", out.display());
    }
}

/// Names and contents with their lengths, so that nothing can move from one to the other unnoticed.
fn add(hash: &mut Sha256, name: &str, contents: &[u8]) {
    for bytes in [name.as_bytes(), contents] {
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    }
}
