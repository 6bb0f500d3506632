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
    let mut compared = Vec::new();
    let panel = |&(run, state): &SolvedLayer<'_>| {
        let stream = run.stream();
        let mut panel = Panel::new(
            &percent(stream.slope),
            Axis::logarithmic("z/d [-]").between(0.02, 12.0),
            Axis::linear("u_f/u_* [-]"),
        );
        let curve = |state: &LayerState| {
            let above = (0..state.height.len()).filter(|&k| state.height[k] > 0.0);
            let scale = stream.shear_velocity();
            let of = |k: usize| (state.height[k] / stream.grain_diameter, state.fluid_velocity[k] / scale);
            above.map(of).collect::<Vec<_>>()
        };
        panel.line("moving grains", 0, curve(state));
        for (_, rest) in on_slope(records, run, |other| other.is_on_slope(BedMotion::AtRest)) {
            panel.reference("the same bed at rest", curve(rest));
            let differences = curve(state).into_iter().zip(curve(rest)).map(|((z, own), (_, rest))| (z, own - rest));
            let found = against_rest(&differences.collect::<Vec<_>>());
            compared.push(format!("At {} the water over moving grains is {found}.", percent(stream.slope)));
        }
        panel
    };
    let mut panels: Vec<Panel> = layers.iter().map(panel).collect();
    panels.extend(layers.iter().filter_map(|layer| open_panel(records, layer)));
    let caption = format!(
        "Velocity of the water over moving grains and over the same bed at rest in half-logarithmic axes. Figures 7 and 8 of the bed-load \
         paper (3 %) and its figure 9 (5 %) are drawn so; their measured points are lost. The paper prints τ* = 0.173 and 0.288, which \
         follow from the set-up. In the paper the water is slower near the bed and equal above (3 %). {} The closures are the literature's; \
         the paper's yield stress of 1220 Pa and viscosity of 0.26 Pa·s are not used. Below: what the closures leave open of the \
         difference, by 64 draws of five drag laws, the length over which the bed's roughness fades, friction, dilation and κ; dashed \
         with the drag law of the paper, Morsi & Alexander's.",
        compared.join(" ")
    );
    Figure::new("with-and-without-motion", &caption, panels).in_columns(3)
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
    let mut panel = Panel::new(
        &format!("{}, moving less at rest", percent(stream.slope)),
        Axis::logarithmic("z/d [-]").between(0.02, 12.0),
        Axis::linear("difference of u_f, over u_* [-]"),
    );
    let band = heights.iter().filter_map(|&k| {
        let mut values: Vec<f64> = record.data.draws.drawn.iter().flatten().map(|layer| difference(layer, k)).collect();
        values.sort_by(f64::total_cmp);
        let (low, high) = (!values.is_empty()).then(|| nine_tenths(&values))?;
        Some((place(k), low, high))
    });
    panel.band("nine tenths of the draws", band);
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

/// Ranges of height in which a velocity is above and below another one, from (z/d, difference/u_*) upwards, in words.
fn against_rest(differences: &[(f64, f64)]) -> String {
    let word = |difference: f64| if difference < 0.0 { "slower" } else { "faster" };
    let changes = differences.windows(2).filter(|pair| word(pair[0].1) != word(pair[1].1));
    let mut parts: Vec<String> = changes.map(|pair| format!("{} up to {:.2} d", word(pair[0].1), pair[1].0)).collect();
    let Some(&(_, at_surface)) = differences.last() else { return "not computed".to_owned() };
    let place = if parts.is_empty() { "at every height" } else { "above" };
    parts.push(format!("{} {place}, by {:.2} u_* at the surface", word(at_surface), at_surface.abs()));
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::against_rest;

    #[test]
    fn ranges_of_faster_and_slower_water_are_named() {
        assert_eq!(against_rest(&[(0.1, 0.2), (9.0, 1.5)]), "faster at every height, by 1.50 u_* at the surface");
        let crossed = against_rest(&[(0.1, 0.2), (0.2, -0.1), (1.0, -0.2), (2.0, 0.3)]);
        assert_eq!(crossed, "faster up to 0.20 d, slower up to 2.00 d, faster above, by 0.30 u_* at the surface");
    }
}
