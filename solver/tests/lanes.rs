//! The lanes, what they stand on, and the laws and sums that are written in them, without the passes: compiled in seconds with every
//! instruction set, also for valgrind.
#![expect(dead_code, unused_imports, unreachable_pub, reason = "passes use the rest")]

#[path = "../src/cell_order.rs"]
mod cell_order;
#[path = "../src/domain.rs"]
mod domain;
#[path = "../src/lanes/mod.rs"]
mod lanes;
#[path = "../src/linear/mod.rs"]
mod linear;
#[path = "../src/material/mod.rs"]
mod material;
#[path = "../src/parallel/mod.rs"]
mod parallel;
#[path = "../src/parameter/mod.rs"]
mod parameter;
#[path = "../src/vector.rs"]
mod vector;
