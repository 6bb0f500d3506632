//! Gives the crate a hash of everything that a stored result depends on, and the tables of `reference-data`.

use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn main() {
    let package = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let workspace = package.parent().map(Path::to_path_buf).unwrap_or_default();
    let mut hash = Sha256::new();

    for name in ["solver/src", "validation/src"] {
        let folder = workspace.join(name);
        println!("cargo::rerun-if-changed={}", folder.display());
        for file in sorted_files(&folder) {
            add_file(&mut hash, &workspace, &file);
        }
    }
    let tables = reference_tables(&package.join("reference-data"));
    for (name, file) in &tables {
        add(&mut hash, &format!("reference-data/{name}"), &std::fs::read(file).unwrap_or_default());
    }
    embed(&tables);
    for name in ["Cargo.lock", "Cargo.toml"] {
        let file = workspace.join(name);
        println!("cargo::rerun-if-changed={}", file.display());
        add_file(&mut hash, &workspace, &file);
    }
    // Another profile or instruction set is another program, even if its results ought to be the same.
    for variable in ["PROFILE", "OPT_LEVEL", "TARGET", "CARGO_CFG_TARGET_FEATURE", "CARGO_ENCODED_RUSTFLAGS"] {
        let value = std::env::var(variable).unwrap_or_default();
        add(&mut hash, variable, value.as_bytes());
    }

    let text = hash.finalize().iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    });
    println!("cargo::rustc-env=BAGNOLD_SOURCE_HASH={text}");
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    println!("cargo::rustc-env=BAGNOLD_PROFILE={} (opt-level {})", variable("PROFILE"), variable("OPT_LEVEL"));
    println!("cargo::rustc-env=BAGNOLD_TARGET_FEATURES={}", variable("CARGO_CFG_TARGET_FEATURE"));
    println!("cargo::rerun-if-changed=build.rs");
}

/// The CSV files of a folder by their names in it. In the workspace the folder is a link to the common one; in a package
/// it is a copy.
fn reference_tables(folder: &Path) -> Vec<(String, PathBuf)> {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    println!("cargo::rerun-if-changed={}", folder.display());
    let is_table = |file: &PathBuf| file.extension().is_some_and(|extension| extension == "csv");
    let name = |file: &PathBuf| file.strip_prefix(&folder).unwrap_or(file).to_string_lossy().replace('\\', "/");
    sorted_files(&folder).into_iter().filter(is_table).map(|file| (name(&file), file)).collect()
}

/// Writes the tables as an array of names and texts that `reference/shipped.rs` includes.
fn embed(tables: &[(String, PathBuf)]) {
    let rows = tables.iter().fold(String::new(), |mut text, (name, file)| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "    ({name:?}, include_str!({file:?})),");
        text
    });
    let text = format!("static FILES: [(&str, &str); {}] = [\n{rows}];\n", tables.len());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join("reference_data.rs");
    if let Err(error) = std::fs::write(&out, text) {
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
