//! Metrics that cases of several families share, with their limits.

pub(crate) mod printed_laws;
