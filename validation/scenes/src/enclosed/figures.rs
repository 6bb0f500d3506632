//! Figures of scenes: pictures of the material between its walls, and the series of the gauges.

use super::filling::SiteFate;
use super::parameters::Dimension;
use super::series;
use super::surfaces::Surfaces;
use super::{SceneObservation, SceneParameters, SceneRecord};
use crate::figure::{Axis, Figure, Panel};

pub(crate) fn all<S: Dimension<D>, const D: usize>(
    parameters: &SceneParameters<S, D>,
    records: &[SceneRecord<S, D>],
) -> Vec<Figure> {
    let of_run = |(_, record): &SceneRecord<S, D>| {
        // another code's front comes without pictures
        let pictures = (!record.frames.is_empty()).then(|| S::pictures(parameters, &record.frames));
        [pictures, gauges(parameters, &record.data)]
    };
    records.iter().flat_map(of_run).flatten().collect()
}

/// Where particles start, and what walls take of the bodies.
pub(crate) fn setup<S: Dimension<D>, const D: usize>(parameters: &SceneParameters<S, D>) -> Figure {
    let sites = parameters.survey(&Surfaces::of(&parameters.enclosure(), parameters.depth_of_walls()));
    let count = |fate: SiteFate| sites.iter().filter(|(_, other)| *other == fate).count();
    let caption = format!(
        "Of {} sites that the bodies hold, {} get particles (0), {} are too near to a wall (½), {} are behind one (1).",
        sites.len(),
        count(SiteFate::Particle),
        count(SiteFate::AtAWall),
        count(SiteFate::Behind),
    );
    let value = |fate: SiteFate| match fate {
        SiteFate::Particle => 0.0,
        SiteFate::AtAWall => 0.5,
        SiteFate::Behind => 1.0,
    };
    let sites: Vec<_> = sites.iter().map(|&(place, fate)| (place, value(fate))).collect();
    Figure::new("setup", &caption, S::setup(parameters, &sites))
}

/// One panel a gauge with a line a column that shares its axis.
fn gauges<S: Dimension<D>, const D: usize>(
    parameters: &SceneParameters<S, D>,
    data: &SceneObservation<D>,
) -> Option<Figure> {
    let panel = |series: series::GaugeSeries<'_, D>| {
        let columns = &series.columns;
        let axis = columns.first().map_or("", |column| &column.axis);
        let mut panel = Panel::new(series.gauge, Axis::linear("t [s]"), Axis::linear(axis));
        for measured in series.measured {
            panel.reference("measured", measured.points.iter().copied());
        }
        for (slot, column) in columns.iter().enumerate().filter(|(_, column)| column.axis == axis) {
            let values = series.values.get(slot).map_or(&[][..], Vec::as_slice);
            let label =
                if slot == 0 && columns.get(1).is_none_or(|other| other.axis != axis) { "" } else { &column.heading };
            panel.line(label, slot, data.time.iter().copied().zip(values.iter().copied()));
        }
        panel
    };
    let panels: Vec<Panel> = series::of_run(parameters, data).into_iter().map(panel).collect();
    (!panels.is_empty()).then(|| Figure::new("gauges", "What the gauges of the scene measured.", panels).in_columns(2))
}
