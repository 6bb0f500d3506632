//! Tells the crate, and those that build on it, how it was optimised: Cargo lets a profile choose that package by package.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let level = std::env::var("OPT_LEVEL").unwrap_or_default();
    println!("cargo::rustc-env=BAGNOLD_SOLVER_OPT_LEVEL={level}");
    println!("cargo::metadata=opt_level={level}");
}
