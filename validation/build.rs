//! Gives the crate a hash of everything that a stored result depends on, the commit that it is built from, and the texts that
//! an installed program carries: tables of `reference-data`, accepted values, shipped calibrations, scenes, studies and sweeps.

#[path = "build/commit.rs"]
mod commit;

use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders of code that results depend on.
const CODE: [&str; 6] = [
    "solver/src",
    "validation/number/src",
    "validation/figure/src",
    "validation/inference/src",
    "validation/layer/src",
    "validation/src",
];

/// What else they depend on.
const REST: [&str; 3] = ["reference-data", "Cargo.lock", "Cargo.toml"];

fn main() {
    let package = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let workspace = package.parent().map(Path::to_path_buf).unwrap_or_default();
    let mut hash = Sha256::new();

    for name in CODE {
        let folder = workspace.join(name);
        println!("cargo::rerun-if-changed={}", folder.display());
        for file in sorted_files(&folder) {
            add_file(&mut hash, &workspace, &file);
        }
    }
    let tables = texts(&package, &["reference-data"], &["csv"]);
    for (name, file) in &tables {
        add(&mut hash, &format!("reference-data/{name}"), &std::fs::read(file).unwrap_or_default());
    }
    embed("reference_data", &tables);
    // what follows says how far results and references are known, or is compared with results or makes new ones, but no result depends on it
    embed("stated_uncertainties", &texts(&package, &["reference-data"], &["toml"]));
    embed("sensitivities", &texts(&package, &["sensitivities"], &["csv"]));
    embed("accepted_comparisons", &texts(&package, &["snapshots"], &["csv"]));
    embed("accepted_values", &texts(&package, &["snapshots"], &["snap", "toml"]));
    embed("plans", &texts(&package, &["calibrations", "scenes", "studies", "sweeps"], &["toml", "csv", "stl"]));
    for name in ["Cargo.lock", "Cargo.toml"] {
        let file = workspace.join(name);
        println!("cargo::rerun-if-changed={}", file.display());
        add_file(&mut hash, &workspace, &file);
    }
    // Another compiler, profile or instruction set is another program, even if its results ought to be the same.
    add(&mut hash, "rustc", &compiler());
    let variables =
        ["PROFILE", "OPT_LEVEL", SOLVER_OPT_LEVEL, "TARGET", "CARGO_CFG_TARGET_FEATURE", "CARGO_ENCODED_RUSTFLAGS"];
    for variable in variables {
        add(&mut hash, variable, self::variable(variable).as_bytes());
    }

    let text = hash.finalize().iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    });
    println!("cargo::rustc-env=BAGNOLD_SOURCE_HASH={text}");
    let commit = commit::commit(&workspace, &[&CODE[..], &REST[..]].concat());
    println!("cargo::rustc-env=BAGNOLD_COMMIT={}", commit.as_deref().unwrap_or("unknown"));
    println!("cargo::rustc-env=BAGNOLD_PROFILE={}", profile());
    println!("cargo::rustc-env=BAGNOLD_SOLVER_OPT_LEVEL={}", variable(SOLVER_OPT_LEVEL));
    println!("cargo::rustc-env=BAGNOLD_TARGET_FEATURES={}", variable("CARGO_CFG_TARGET_FEATURE"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
}

/// What the solver's build script tells of its package.
const SOLVER_OPT_LEVEL: &str = "DEP_BAGNOLD_SOLVER_OPT_LEVEL";

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

/// Files of some of the package's folders with such endings, by their names: in a single folder, or with the folder where
/// there are several. In the workspace some folders are links to common ones; in a package they are copies.
fn texts(package: &Path, folders: &[&str], endings: &[&str]) -> Vec<(String, PathBuf)> {
    let mut texts = Vec::new();
    for name in folders {
        let folder = package.join(name);
        let folder = folder.canonicalize().unwrap_or(folder);
        println!("cargo::rerun-if-changed={}", folder.display());
        let above = if folders.len() == 1 { String::new() } else { format!("{name}/") };
        for file in sorted_files(&folder) {
            let ending = file.extension().unwrap_or_default().to_string_lossy();
            if endings.contains(&ending.as_ref()) {
                let below = file.strip_prefix(&folder).unwrap_or(&file).to_string_lossy().replace('\\', "/");
                texts.push((above.clone() + &below, file));
            }
        }
    }
    texts
}

/// Writes texts as an array of names and contents into a file for `include!`.
fn embed(name: &str, texts: &[(String, PathBuf)]) {
    let rows = texts.iter().fold(String::new(), |mut rows, (name, file)| {
        // Writing to a string cannot fail.
        let _ = writeln!(rows, "    ({name:?}, include_str!({file:?})),");
        rows
    });
    let code = format!("static FILES: [(&str, &str); {}] = [\n{rows}];\n", texts.len());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join(format!("{name}.rs"));
    if let Err(error) = std::fs::write(&out, code) {
        println!("cargo::error=failed to write {}: {error}", out.display());
    }
}

/// All files below a folder by path. What cannot be read is left out: the compiler will complain about it.
fn sorted_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    files
}

fn add_file(hash: &mut Sha256, workspace: &Path, file: &Path) {
    let name = file.strip_prefix(workspace).unwrap_or(file).to_string_lossy().replace('\\', "/");
    add(hash, &name, &std::fs::read(file).unwrap_or_default());
}

/// Names and contents with their lengths, so that nothing can move from one to the other unnoticed.
fn add(hash: &mut Sha256, name: &str, contents: &[u8]) {
    for bytes in [name.as_bytes(), contents] {
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    }
}
