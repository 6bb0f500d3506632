//! The water over a moving bed beside that over the same bed at rest.

use super::super::BedLoad1dRecord;
use super::super::draws::{DrawnLayer, nine_tenths};
use super::super::flow::BedMotion;
use super::super::records::{SolvedLayer, on_slope};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::shared::percent;

/// The water over the moving bed and over the same bed at rest, a panel for each slope.
pub(super) fn figure(records: &[BedLoad1dRecord], layers: &[SolvedLayer<'_>]) -> Figure {
    let panel = |&(run, state): &SolvedLayer<'_>| {
        let stream = run.stream();
        let height = Axis::logarithmic("z/d [-]").between(0.02, 12.0);
        let mut panel = Panel::new(&percent(stream.slope), height, Axis::linear("u_f/u_* [-]"));
        let curve = |state: &LayerState| {
            let above = (0..state.height.len()).filter(|&k| state.height[k] > 0.0);
            let scale = stream.shear_velocity();
            let of = |k: usize| (state.height[k] / stream.grain_diameter, state.fluid_velocity[k] / scale);
            above.map(of).collect::<Vec<_>>()
        };
        panel.line("moving grains", 0, curve(state));
        for (_, rest) in on_slope(records, run, |other| other.is_on_slope(BedMotion::AtRest)) {
            panel.reference("the same bed at rest", curve(rest));
        }
        panel
    };
    let mut panels: Vec<Panel> = layers.iter().map(panel).collect();
    panels.extend(layers.iter().filter_map(|layer| open_panel(records, layer)));
    let caption = "Water velocity above moving grains and above a bed at rest, as in figures 7 to 9 of the bed-load \
                   paper (missing in the scan). Below: their difference, with 64 draws of the closures from published \
                   ranges.";
    Figure::new("with-and-without-motion", caption, panels).in_columns(3)
}

/// The difference of the water over moving and over resting grains, with what the closures leave open; none without draws.
fn open_panel(records: &[BedLoad1dRecord], &(run, state): &SolvedLayer<'_>) -> Option<Panel> {
    let of_slope =
        |(other, _): &&BedLoad1dRecord| other.closure_draws > 0 && other.stream().slope == run.stream().slope;
    let (flow, record) = records.iter().find(of_slope)?;
    let stream = flow.stream();
    let difference = |layer: &DrawnLayer, k: usize| {
        (layer.state.fluid_velocity[k] - layer.rest.fluid_velocity[k]) / stream.shear_velocity()
    };
    let heights: Vec<usize> =
        (0..record.data.state.height.len()).filter(|&k| record.data.state.height[k] > 0.0).collect();
    let place = |k: usize| record.data.state.height[k] / stream.grain_diameter;
    let height = Axis::logarithmic("z/d [-]").between(0.02, 12.0);
    let title = format!("{}, moving minus at rest", percent(stream.slope));
    let mut panel = Panel::new(&title, height, Axis::linear("difference of u_f, over u_* [-]"));
    let band = heights.iter().filter_map(|&k| {
        let mut values: Vec<f64> = record.data.draws.drawn.iter().flatten().map(|layer| difference(layer, k)).collect();
        values.sort_by(f64::total_cmp);
        let (low, high) = (!values.is_empty()).then(|| nine_tenths(&values))?;
        Some((place(k), low, high))
    });
    panel.band("90 % of the draws", band);
    let paper = record.data.draws.paper.as_ref()?;
    for (_, rest) in on_slope(records, run, |other| other.is_on_slope(BedMotion::AtRest)) {
        let above = (0..state.height.len()).filter(|&k| state.height[k] > 0.0);
        let own = |k: usize| (state.fluid_velocity[k] - rest.fluid_velocity[k]) / stream.shear_velocity();
        panel.line("usual closures", 0, above.map(|k| (state.height[k] / stream.grain_diameter, own(k))));
    }
    panel.reference("the paper's drag law", heights.iter().map(|&k| (place(k), difference(paper, k))));
    panel.line("as fast", 1, [(0.02, 0.0), (12.0, 0.0)]);
    Some(panel)
}
