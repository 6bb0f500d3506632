//! Short ways to make the parts of a figure.

use super::{Axis, AxisRatio, Band, Field, Figure, Mark, Panel, Scale, Series};

impl Axis {
    /// A linear axis that fits its data.
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Linear, limits: None, ratio: None }
    }

    /// A logarithmic axis that fits its data.
    pub fn logarithmic(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Logarithmic, limits: None, ratio: None }
    }

    /// The same axis between fixed limits.
    pub fn between(self, lower: f64, upper: f64) -> Self {
        Self { limits: Some((lower, upper)), ..self }
    }

    /// The same axis as the ratio of a quantity to a scale in a unit, if there is one scale: of several that differ, or none, it
    /// stays without.
    pub fn over(self, name: &str, unit: &str, scales: impl IntoIterator<Item = f64>) -> Self {
        let mut scales = scales.into_iter();
        let scale =
            scales.next().filter(|first| first.is_finite() && *first > 0.0 && scales.all(|other| other == *first));
        let ratio = scale.map(|scale| AxisRatio { name: name.to_owned(), unit: unit.to_owned(), scale });
        Self { ratio, ..self }
    }
}

impl Panel {
    /// An empty panel.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.to_owned(), x, y, bands: Vec::new(), series: Vec::new(), field: None, opposite: None }
    }

    /// Adds a simulation that is continuous, in the colour of a slot; an empty label has no legend entry.
    pub fn line(&mut self, label: &str, slot: usize, points: impl IntoIterator<Item = (f64, f64)>) -> &mut Series {
        self.draw(label, Mark::Line, slot, points)
    }

    /// Adds points in the colour of a slot.
    pub fn points(&mut self, label: &str, slot: usize, points: impl IntoIterator<Item = (f64, f64)>) -> &mut Series {
        self.draw(label, Mark::Points, slot, points)
    }

    /// Adds points with a line through them in the colour of a slot.
    pub fn line_points(
        &mut self,
        label: &str,
        slot: usize,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> &mut Series {
        self.draw(label, Mark::LinePoints, slot, points)
    }

    /// Adds what the others are compared with, dashed and black.
    pub fn reference(&mut self, label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> &mut Series {
        self.draw(label, Mark::Reference, 0, points)
    }

    /// Adds the guide of an order of convergence through the first, coarsest of the points (resolution, error).
    pub fn order(&mut self, order: i32, label: &str, errors: &[(f64, f64)]) {
        let Some(&(first, error)) = errors.first() else { return };
        self.reference(label, errors.iter().map(|(n, _)| (*n, error * (first / n).powi(order))));
    }

    /// Adds a series of any mark, whose error bars can then be set.
    pub fn draw(
        &mut self,
        label: &str,
        mark: Mark,
        slot: usize,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> &mut Series {
        let place = self.series.len();
        self.series.push(Series::new(label, mark, slot, points.into_iter().collect()));
        &mut self.series[place]
    }

    /// Adds a shaded band of (x, lower, upper).
    pub fn band(&mut self, label: &str, points: impl IntoIterator<Item = (f64, f64, f64)>) {
        self.bands.push(Band { label: label.to_owned(), points: points.into_iter().collect() });
    }
}

impl Field {
    /// Particles of a diameter in axis units, coloured between two limits.
    pub fn new(
        label: &str,
        diameter: f64,
        limits: (f64, f64),
        points: impl IntoIterator<Item = (f64, f64)>,
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        Self {
            points: points.into_iter().collect(),
            values: values.into_iter().collect(),
            label: label.to_owned(),
            diameter,
            limits: Some(limits),
        }
    }
}

impl Series {
    /// A series without error bars.
    pub fn new(label: &str, mark: Mark, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.to_owned(), mark, colour, points, error: Vec::new() }
    }
}

impl Figure {
    /// Panels, two per row.
    pub fn new(name: &str, caption: &str, panels: Vec<Panel>) -> Self {
        let columns = panels.len().clamp(1, 2);
        Self { name: name.to_owned(), caption: caption.to_owned(), panels, columns }
    }

    /// Places the panels in this number of columns.
    pub fn in_columns(self, columns: usize) -> Self {
        Self { columns, ..self }
    }
}
