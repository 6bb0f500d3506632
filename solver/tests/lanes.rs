//! The lanes and what they stand on, without the passes: compiled in seconds with every instruction set, also for valgrind.
#![expect(dead_code, unused_imports, unreachable_pub, reason = "passes use the rest")]

#[path = "../src/lanes/mod.rs"]
mod lanes;
#[path = "../src/parallel/mod.rs"]
mod parallel;
#[path = "../src/vector.rs"]
mod vector;
