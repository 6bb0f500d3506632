//! Generated inputs: whatever a file or `--set` holds, the program refuses it by the name of its field or takes it, within
//! five seconds and without a panic; and what it takes and computes never passes a gate without a number.
//!
//! `cargo test` tries some hundred; `tests/inputs/study.sh` tries thousands.

mod bounds;
mod changes;
mod damage;
mod files;
mod judge;
mod stored;
mod submission;
