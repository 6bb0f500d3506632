//! Discrete differential operators and their corrections.

pub mod correction;
pub(crate) mod geometry;
