//! Texts that a package carries, written as code that `include!` takes.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Files of some of the package's folders with such endings, by their names: in a single folder, or with the folder where
/// there are several. In the workspace some folders are links to common ones; in a package they are copies.
pub(crate) fn texts(package: &Path, folders: &[&str], endings: &[&str]) -> Vec<(String, PathBuf)> {
    let mut texts = Vec::new();
    for name in folders {
        let folder = package.join(name);
        let folder = folder.canonicalize().unwrap_or(folder);
        println!("cargo::rerun-if-changed={}", folder.display());
        let own = Path::new(name).file_name().unwrap_or_default().to_string_lossy();
        let above = if folders.len() == 1 { String::new() } else { format!("{own}/") };
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
pub(crate) fn embed(name: &str, texts: &[(String, PathBuf)]) {
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
pub(crate) fn sorted_files(folder: &Path) -> Vec<PathBuf> {
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
