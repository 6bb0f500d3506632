//! Short ways to make the parts of a figure.

use super::{Axis, Mark, Panel, Scale, Series};

impl Axis {
    /// A linear axis that fits its data.
    #[must_use]
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Linear, limits: None }
    }

    /// A logarithmic axis that fits its data.
    #[must_use]
    pub fn logarithmic(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Logarithmic, limits: None }
    }
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.to_owned(), x, y, bands: Vec::new(), series: Vec::new(), field: None, opposite: None }
    }
}

impl Series {
    /// A series without error bars.
    #[must_use]
    pub fn new(label: &str, mark: Mark, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.to_owned(), mark, colour, points, error: Vec::new() }
    }
}
