//! Parameters that are varied, and designs of points to vary them over.

pub mod design;
mod parameter;
mod random;

pub use parameter::{Bounds, BoundsError, Spacing};
pub use random::Random;
