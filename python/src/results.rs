//! Tables, pictures of particles and figures as Python sees them. The numbers of particles move into NumPy's arrays, without
//! a copy; they are read-only.

use crate::waiting::Refused;
use bagnold_figure::{Figure, FigureFormat, render};
use bagnold_harness::observation::Frame;
use bagnold_harness::output::Table;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A table's columns by their headings.
pub(crate) fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    for (place, heading) in table.columns.iter().enumerate() {
        let values: Vec<f64> = table.rows.iter().map(|row| row[place]).collect();
        columns.set_item(heading, PyArray1::from_vec(py, values))?;
    }
    Ok(columns)
}

/// A time with its particles: `(time, {name: (unit, array)})`.
pub(crate) fn particles(py: Python<'_>, frame: Frame) -> PyResult<(f64, Bound<'_, PyDict>)> {
    let arrays = PyDict::new(py);
    arrays.set_item("position", ("m", vectors(py, frame.position)?))?;
    for (name, unit, values) in frame.vectors {
        arrays.set_item(name, (unit, vectors(py, values)?))?;
    }
    for (name, unit, values) in frame.scalars {
        arrays.set_item(name, (unit, locked(PyArray1::from_vec(py, values).into_any())?))?;
    }
    Ok((frame.time, arrays))
}

/// A row per particle.
fn vectors(py: Python<'_>, values: Vec<[f64; 3]>) -> PyResult<Bound<'_, PyAny>> {
    let rows = values.len();
    locked(PyArray1::from_vec(py, values.into_flattened()).reshape([rows, 3])?.into_any())
}

/// The same array, to be read only: every caller gets the same one.
fn locked(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}

/// A case's figures, drawn when they are asked for.
#[pyclass(frozen, module = "bagnold._native")]
pub(crate) struct Figures(pub(crate) Vec<Figure>);

#[pymethods]
impl Figures {
    /// Their names.
    fn names(&self) -> Vec<&str> {
        self.0.iter().map(|figure| figure.name.as_str()).collect()
    }

    /// One of them as SVG; `None` if there is none of that name.
    fn svg(&self, name: &str) -> PyResult<Option<String>> {
        let found = self.0.iter().find(|figure| figure.name == name);
        found
            .map(|figure| {
                render::svg(figure, FigureFormat::SCREEN)
                    .map_err(|error| Refused::new_err(format!("failed to {error}")))
            })
            .transpose()
    }
}
