//! The pages of a report's folder.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The report to look at: `$BAGNOLD_REPORT`, else the one that README's first command writes.
pub(crate) fn folder() -> PathBuf {
    let usual = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports"));
    let folder = std::env::var_os("BAGNOLD_REPORT").map_or_else(usual, PathBuf::from);
    folder.canonicalize().expect("a report; `cargo run -- report` writes one")
}

/// Addresses of its pages: the overview, those of the whole report that are there, then the cases.
pub(crate) fn addresses() -> Vec<String> {
    let folder = folder();
    let mut pages: Vec<PathBuf> = vec![folder.join("index.html")];
    let whole = ["gates.html", "papers.html", "comparisons.html", "validated.html"].map(|name| folder.join(name));
    pages.extend(whole.into_iter().filter(|page| page.exists()));
    let cases = std::fs::read_dir(folder.join("cases")).expect("the cases of the report");
    let cases: BTreeSet<PathBuf> = cases.flatten().map(|case| case.path().join("index.html")).collect();
    pages.extend(cases);
    pages.iter().map(|page| address(page)).collect()
}

/// The address of a file.
pub(crate) fn address(file: &Path) -> String {
    url::Url::from_file_path(file).expect("an absolute path").to_string()
}
