//! The extension module behind the Python package `bagnold`: plain values in and out. What users see is in `bagnold/`.

mod command;
mod results;
mod run;
mod waiting;

use bagnold_validation::REGISTRY;
use pyo3::prelude::*;

/// Calls into Bagnold's library.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::cases;
    #[pymodule_export]
    use super::command::command;
    #[pymodule_export]
    use super::results::Figures;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::waiting::Refused;
}

/// Names of all cases, each with a line about it.
#[pyfunction]
fn cases() -> Vec<(&'static str, &'static str)> {
    REGISTRY.iter().map(|case| (case.name(), case.summary())).collect()
}
