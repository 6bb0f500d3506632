//! The tests of equal bits alone, for a build that has all instruction sets: `cargo test --profile lanes -p bagnold-solver-tests`.

#[expect(dead_code, reason = "other invariants use the rest")]
mod invariants {
    mod determinism;
    mod fields;
    mod inlets;
    mod memories;
    mod patches;
    mod shells;
}

mod threads;
