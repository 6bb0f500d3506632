//! Metrics as colours over two parameters, if exactly two were varied.

use crate::figure::{Axis, Field, Figure, Panel};

/// Ratio of the largest to the least positive value from which on a quantity is drawn by its logarithm.
const WIDE: f64 = 5.0;

/// Values of a parameter or of a metric, as they are drawn.
struct Scaled {
    values: Vec<f64>,
    label: String,
}

impl Scaled {
    fn of(values: &[f64], label: &str) -> Self {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if least > 0.0 && most > WIDE * least {
            let values = values.iter().map(|value| libm::log10(*value)).collect();
            Self { values, label: format!("log10 {label}") }
        } else {
            Self { values: values.to_vec(), label: label.to_owned() }
        }
    }

    fn span(&self) -> f64 {
        let most = self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// A metric over two parameters: its name with unit, and of each run both parameters and its value.
pub(super) struct MetricMap {
    pub(super) metric: String,
    pub(super) points: Vec<(f64, f64, f64)>,
}

/// A panel per metric; none without one that has values.
pub(super) fn figure(case: &str, parameters: [&str; 2], surfaces: &[MetricMap]) -> Option<Figure> {
    let panels: Vec<Panel> =
        surfaces.iter().filter(|surface| surface.points.len() > 1).map(|surface| panel(parameters, surface)).collect();
    let name = format!("map-{}", case.replace([' ', '/'], "-"));
    let caption = format!("Metrics of every run, shown as colours, over {} and {}.", parameters[0], parameters[1]);
    (!panels.is_empty()).then(|| Figure::new(&name, &caption, panels))
}

fn panel(parameters: [&str; 2], surface: &MetricMap) -> Panel {
    let column = |pick: fn(&(f64, f64, f64)) -> f64| surface.points.iter().map(pick).collect::<Vec<f64>>();
    let x = Scaled::of(&column(|point| point.0), parameters[0]);
    let y = Scaled::of(&column(|point| point.1), parameters[1]);
    let colour = Scaled::of(&column(|point| point.2), &surface.metric);
    // axes of a field share their scale: a dot is as wide as the points lie apart
    let diameter = (x.span().max(1e-3) * y.span().max(1e-3) / surface.points.len() as f64).sqrt();
    let mut panel = Panel::new("", Axis::linear(&x.label), Axis::linear(&y.label));
    panel.field = Some(Field {
        points: x.values.iter().copied().zip(y.values.iter().copied()).collect(),
        values: colour.values,
        label: colour.label,
        diameter,
        limits: None,
    });
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_ranges_are_drawn_by_their_logarithm() {
        let points = vec![(0.01, 1.0, 2.0), (0.1, 2.0, 3.0), (1.0, 3.0, 4.0)];
        let surface = MetricMap { metric: "q [-]".to_owned(), points };
        let figure = figure("a case", ["tau", "d"], &[surface]).expect("three points");
        assert_eq!(figure.name, "map-a-case");
        let panel = &figure.panels[0];
        assert_eq!((panel.x.label.as_str(), panel.y.label.as_str()), ("log10 tau", "d"));
        let field = panel.field.as_ref().expect("a field");
        assert_eq!(field.points[0], (-2.0, 1.0));
        assert_eq!((field.label.as_str(), field.values[2]), ("q [-]", 4.0));
    }

    #[test]
    fn a_single_point_is_no_map() {
        let surface = MetricMap { metric: "q [-]".to_owned(), points: vec![(1.0, 1.0, 1.0)] };
        assert!(figure("film", ["a", "b"], &[surface]).is_none());
    }
}
