//! The case's figures: pictures of the material between its walls, and the series of the gauges.

use super::{Record, SceneParameters};
use crate::figure::{Axis, Field, Figure, Mark, Panel, Series};
use bagnold_solver::vector::Vector;

pub(super) fn all(parameters: &SceneParameters, records: &[Record]) -> Vec<Figure> {
    records
        .iter()
        .flat_map(|record| [Some(pictures(parameters, record)), series(parameters, record)])
        .flatten()
        .collect()
}

/// One panel a picture, the particles in the colours of their speed and the walls where they stand.
fn pictures(parameters: &SceneParameters, (_, record): &Record) -> Figure {
    let fastest = record.frames.iter().flat_map(|frame| frame.speeds()).fold(0.0, f64::max);
    let (lower, upper) = parameters.extent();
    let margin = 2.0 * parameters.spacing;
    let axis = |label: &str, k: usize| Axis::linear(label).between(lower[k] - margin, upper[k] + margin);
    let panels = record.frames.iter().map(|frame| {
        let mut panel = Panel::new(&format!("t = {:.3} s", frame.time), axis("x [m]", 0), axis("y [m]", 1));
        let points: Vec<(f64, f64)> = frame.position.iter().map(|place| (place[0], place[1])).collect();
        panel.field = Some(Field::new("|v| [m/s]", parameters.spacing, (0.0, fastest), points, frame.speeds()));
        for wall in &parameters.walls {
            let shell = wall.shell();
            let moved = shell.motion.displacement(frame.time);
            let place = |point: &Vector<2>| (point[0] + moved[0], point[1] + moved[1]);
            let ends = shell.facets.first().map(|facet| place(&facet.corners[0]));
            let points = ends.into_iter().chain(shell.facets.iter().map(|facet| place(&facet.corners[1]))).collect();
            panel.series.push(Series::new("", Mark::Reference, 0, points));
        }
        panel
    });
    Figure::new("pictures", "The material in the colours of its speed, and its walls, dashed.", panels.collect())
}

/// One panel a gauge with a line a column that shares its axis.
fn series(parameters: &SceneParameters, (_, record): &Record) -> Option<Figure> {
    let data = &record.data;
    let mut next = 0;
    let mut panels = Vec::new();
    for gauge in &parameters.gauges {
        let columns = gauge.columns();
        let axis = columns.first().map_or("", |column| column.axis);
        let mut panel = Panel::new(gauge.name(), Axis::linear("t [s]"), Axis::linear(axis));
        for measured in parameters.measured.iter().filter(|measured| measured.gauge == gauge.name()) {
            panel.reference("measured", measured.points.iter().copied());
        }
        for (slot, column) in columns.iter().enumerate().filter(|(_, column)| column.axis == axis) {
            let values = data.gauges.get(next + slot).map_or(&[][..], Vec::as_slice);
            let label =
                if slot == 0 && columns.get(1).is_none_or(|other| other.axis != axis) { "" } else { &column.heading };
            panel.line(label, slot, data.time.iter().copied().zip(values.iter().copied()));
        }
        next += columns.len();
        panels.push(panel);
    }
    (!panels.is_empty()).then(|| Figure::new("gauges", "What the gauges of the scene measured.", panels).in_columns(2))
}
