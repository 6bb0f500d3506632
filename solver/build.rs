//! Tells the packages that build on this one how it was optimised, and chooses the instruction sets that loops are compiled for.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::metadata=opt_level={}", std::env::var("OPT_LEVEL").unwrap_or_default());
    println!("cargo::rustc-check-cfg=cfg(with_avx2, with_portable)");
    for set in sets() {
        println!("cargo::rustc-cfg=with_{set}");
    }
}

/// Instruction sets by their names in the code. Results do not depend on them, but each takes a minute of CPU to compile. A release build has
/// all of its processor family, any other build one: that of the machine that builds.
fn sets() -> &'static [&'static str] {
    let is = |name: &str, value: &str| std::env::var(name).is_ok_and(|own| own == value);
    match (is("CARGO_CFG_TARGET_ARCH", "x86_64"), is("PROFILE", "release")) {
        (true, true) => &["portable", "avx2"],
        (true, false) if builder_has_avx2() => &["avx2"],
        _ => &["portable"],
    }
}

#[cfg(target_arch = "x86_64")]
fn builder_has_avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("popcnt")
}

#[cfg(not(target_arch = "x86_64"))]
fn builder_has_avx2() -> bool {
    true
}
