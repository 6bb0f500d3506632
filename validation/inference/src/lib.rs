//! Calibration of models that cost minutes, designs of points to try, and the statistics behind both. Nothing here knows a
//! solver, a case or a file.

pub mod inference;
pub mod sampling;
pub mod statistics;
