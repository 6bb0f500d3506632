//! Random numbers, bounds and designs.

mod design;
mod parameter;
mod random;
