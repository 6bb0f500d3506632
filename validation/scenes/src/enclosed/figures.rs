//! Figures of scenes: pictures of the material between its walls, and the series of the gauges.

use super::filling::SiteFate;
use super::flow::Dimension;
use super::setting::SceneInlet;
use super::surfaces::Surfaces;
use super::{Measurand, SceneFlow, SceneObservation, SceneRecord, series, shapes};
use crate::figure::{Axis, Field, Figure, Mark, Panel, Series};
use crate::measured::HALF_A_ROW;
use bagnold_solver::vector::Vector;

/// Margin of pictures around the material, over the size of its box in the direction of the axis `[-]`.
const MARGIN: f64 = 0.1;

/// Labels of the axes of space.
const AXES: [&str; 3] = ["x [m]", "y [m]", "z [m]"];

pub(crate) fn all<S: Dimension<D>, const D: usize>(records: &[SceneRecord<S, D>]) -> Vec<Figure> {
    let of_run = |(parameters, record): &SceneRecord<S, D>| {
        // another code's front comes without pictures
        let pictures = (!record.frames.is_empty()).then(|| (S::PICTURES)(parameters, &record.frames));
        pictures.into_iter().chain(gauges(parameters, &record.data))
    };
    records.iter().flat_map(of_run).collect()
}

/// Axes of pictures: the material of all of them and the inlets with a margin, but nothing beyond the scene.
pub(crate) fn picture_axes<'a, S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    material: impl IntoIterator<Item = &'a [f64; 3]>,
) -> [Axis; D] {
    let (extent, rim) = (parameters.extent(), 2.0 * parameters.spacing);
    let scene = (extent.0.add_scalar(-rim), extent.1.add_scalar(rim));
    let places = material.into_iter().map(|place| Vector::<D>::from_fn(|k, _| place[k]));
    let seen = places.filter(|place| shapes::box_holds(&scene.0, &scene.1, place));
    let (lower, upper) = shapes::around(seen.chain(parameters.inlets.iter().flat_map(SceneInlet::corners)));
    let margin = ((upper - lower) * MARGIN).add_scalar(rim);
    let limits = |k: usize| ((lower[k] - margin[k]).max(scene.0[k]), (upper[k] + margin[k]).min(scene.1[k]));
    std::array::from_fn(|k| Axis { limits: Some(limits(k)), ..Axis::linear(AXES[k]) })
}

/// Panel of the start along two axes: sites in the colours of their values.
pub(crate) fn start_panel<'s, S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    title: &str,
    [right, up]: [usize; 2],
    sites: impl IntoIterator<Item = &'s (Vector<D>, f64)>,
) -> Panel {
    let (lower, upper) = parameters.extent();
    let margin = 4.0 * parameters.spacing;
    let axis = |k: usize| Axis::linear(AXES[k]).between(lower[k] - margin, upper[k] + margin);
    let mut panel = Panel::new(title, axis(right), axis(up));
    let (points, values): (Vec<_>, Vec<_>) =
        sites.into_iter().map(|(place, value)| ((place[right], place[up]), *value)).unzip();
    if !points.is_empty() {
        panel.field = Some(Field::new("behind [-]", parameters.spacing, (0.0, 1.0), points, values));
    }
    panel
}

/// Draws the inlets along two axes, in colours behind those of the walls.
pub(crate) fn add_inlets<S: Dimension<D>, const D: usize>(
    panel: &mut Panel,
    parameters: &SceneFlow<S, D>,
    [right, up]: [usize; 2],
) {
    for (k, inlet) in parameters.inlets.iter().enumerate() {
        let corners = inlet.corners();
        let closing = corners.first().filter(|_| D > 2);
        let points = corners.iter().chain(closing).map(|place| (place[right], place[up])).collect();
        panel.series.push(Series::new(inlet.name(), Mark::LinePoints, parameters.walls.len() + k, points));
    }
}

/// Figure of the initial particles, and of the parts of bodies that walls remove, scene by scene.
pub(crate) fn setup<S: Dimension<D>, const D: usize>(scenes: &[SceneFlow<S, D>]) -> Figure {
    let (captions, panels): (Vec<String>, Vec<Vec<Panel>>) = scenes.iter().map(start).unzip();
    Figure::new("setup", &captions.join(" "), panels.concat())
}

/// Caption and panels of a scene at the start.
fn start<S: Dimension<D>, const D: usize>(parameters: &SceneFlow<S, D>) -> (String, Vec<Panel>) {
    let sites = parameters.survey(&Surfaces::of(&parameters.enclosure(), parameters.depth_of_walls(), S::SIDE));
    let count = |fate: SiteFate| sites.iter().filter(|(_, other)| *other == fate).count();
    let caption = format!(
        "Of {} lattice sites inside the bodies, {} get particles (0), {} are too close to a wall (½), {} are behind a wall (1).",
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
    (caption, (S::SETUP)(parameters, &sites))
}

/// Panels of a figure of gauges, and such figures of a scene at most: a sheet of 5000 panels takes 10 GB.
const PANELS: usize = 12;
const SHEETS: usize = 10;

/// A panel for each axis of a gauge, with a line for each column that has it, by twelve on a sheet.
fn gauges<S: Dimension<D>, const D: usize>(parameters: &SceneFlow<S, D>, data: &SceneObservation<D>) -> Vec<Figure> {
    let panel = |series: &series::GaugeSeries<'_, D>, axis: &str| {
        let mut panel = Panel::new(series.gauge, Axis::linear("t [s]"), Axis::linear(axis));
        for measured in series.measured.iter().filter(|_| series.columns[0].axis == axis) {
            panel.reference("measured", measured.points.iter().copied());
        }
        if let (Measurand::Front(_), [_, least, most, ..]) = (&series.measure, series.values) {
            let points =
                data.time.iter().zip(least.iter().zip(most)).map(|(&time, (&least, &most))| (time, least, most));
            panel.band(HALF_A_ROW, points);
        }
        for (slot, column) in series.columns.iter().enumerate().filter(|(_, column)| column.axis == axis) {
            let values = series.values.get(slot).map_or(&[][..], Vec::as_slice);
            panel.line(&column.heading, slot, data.time.iter().copied().zip(values.iter().copied()));
        }
        panel
    };
    let panels = |series: series::GaugeSeries<'_, D>| {
        let mut axes: Vec<&str> = series.columns.iter().map(|column| column.axis.as_str()).collect();
        axes.dedup();
        // the interval of a front is a band in its panel
        axes.truncate(if matches!(series.measure, Measurand::Front(_)) { 1 } else { D });
        axes.into_iter().map(|axis| panel(&series, axis)).collect::<Vec<_>>()
    };
    let panels: Vec<Panel> = series::of_run(parameters, data).into_iter().flat_map(panels).collect();
    let all = panels.len();
    let sheet = |(index, panels): (usize, &[Panel])| {
        let name = if index == 0 { "gauges".to_owned() } else { format!("gauges-{}", index + 1) };
        let mut caption = "Time series of the scene's gauges: one panel for each gauge and quantity.".to_owned();
        if all > PANELS {
            let (first, last) = (index * PANELS + 1, index * PANELS + panels.len());
            caption += &format!(" Panels {first} to {last} of {all}; the tables contain all.");
        }
        Figure::new(&name, &caption, panels.to_vec()).in_columns(2)
    };
    panels.chunks(PANELS).take(SHEETS).enumerate().map(sheet).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::quick;
    use crate::scene::Plane;

    #[test]
    fn pictures_show_the_material_and_no_more_of_the_scene() {
        let parameters = SceneFlow { spacing: 0.01, inlets: Vec::new(), ..quick::<Plane, 2>() };
        let (lower, upper) = parameters.extent();
        // the last grain has left the scene
        let heights = [(lower[0], 0.05), (upper[0], 0.06), (upper[0] + 1.0, 0.0)];
        let material = heights.map(|(x, height)| [x, lower[1] + height, 0.0]);
        let [x, y] = picture_axes(&parameters, &material).map(|axis| axis.limits.expect("fixed"));
        assert_eq!(x, (lower[0] - 0.02, upper[0] + 0.02));
        assert!((y.0 - lower[1] - 0.029).abs() < 1e-12 && (y.1 - lower[1] - 0.081).abs() < 1e-12, "{y:?}");
    }
}
