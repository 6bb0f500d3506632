//! Tells the packages that build on this one how it was optimised: a profile chooses that package by package.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::metadata=opt_level={}", std::env::var("OPT_LEVEL").unwrap_or_default());
}
