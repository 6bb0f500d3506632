//! Collapses as external codes give them: columns and slopes, measured by the same surveyor.

pub(crate) mod column;
mod heap;
pub(crate) mod slope;
