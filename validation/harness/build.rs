//! Gives the package the texts that an installed program carries: tables of `reference-data`, what is stated of references,
//! sensitivities to inputs, comparisons of the baseline, and judgements of calibrations.

#[path = "build/embed.rs"]
mod embed;

use embed::{embed, texts};
use std::path::PathBuf;

fn main() {
    let package = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    embed("reference_data", &texts(&package, &["reference-data"], &["csv"]));
    embed("stated_uncertainties", &texts(&package, &["reference-data"], &["toml"]));
    embed("sensitivities", &texts(&package, &["sensitivities"], &["csv"]));
    embed("comparisons", &texts(&package, &["snapshots/comparisons"], &["csv"]));
    embed("held_out_judgements", &texts(&package, &["snapshots/calibrations"], &["json"]));
    embed("controls", &texts(&package, &["controls"], &["toml", "csv"]));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
}
