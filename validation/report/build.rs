//! Gives the package the baseline and expected failures that an installed program carries.

#[path = "build/embed.rs"]
mod embed;

use embed::{embed, texts};
use std::path::PathBuf;

fn main() {
    let package = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    embed("baseline", &texts(&package, &["snapshots"], &["snap", "toml"]));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
}
