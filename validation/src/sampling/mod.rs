//! Parameters that are varied, and designs of points to vary them over.

pub mod design;
mod parameter;
mod random;

pub use parameter::{Bounds, Paths, Spacing, float};
pub(crate) use random::Random;
