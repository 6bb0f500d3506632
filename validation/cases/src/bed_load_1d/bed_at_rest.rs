//! The water over a moving bed beside that over the same bed at rest: two layers that differ in nothing but that grains may move.

use super::BedLoad1dRecord;
use super::quantities::{LAYER_SLOPE_RATIO, VELOCITY_DEFICIT};
use super::records::{SolvedLayer, on_slope};
use super::run::{BedLoad1dRun, LayerPurpose};
use crate::case::Run;
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Confidence, Limit, Metric};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::shared::percent;

/// The slope on which the paper shows the water with and without moving grains `[-]`.
const SHOWN_WITH_AND_WITHOUT: f64 = 0.03;

/// Heights between which the slope next to the bed is fitted `[m]`.
const NEAR_BED: (f64, f64) = (0.5e-3, 3e-3);

/// The water over the moving bed beside that over the same bed at rest; judged on the slope that the paper shows both of.
pub(super) fn metrics(run: &BedLoad1dRun, state: &LayerState, rest: &LayerState) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let variant = run.variant();
    let is_shown = run.stream.slope == SHOWN_WITH_AND_WITHOUT;
    let deficit =
        |height| (state.at(height).fluid_velocity - rest.at(height).fluid_velocity) / run.stream.shear_velocity();
    let statements = [
        (
            2.5e-3,
            None,
            "near the bed slower than without moving grains",
            Limit::AtMost(-0.1),
            "slower by a tenth of u_*, so that equal velocities do not show it",
        ),
        (
            0.025,
            Some(0.0),
            "above as fast as without moving grains",
            Limit::Within(-0.25, 0.25),
            "a quarter of u_*, as clear water itself is judged: 2 % of the depth mean",
        ),
    ];
    for (height, expected, statement, limit, reason) in statements {
        let source = format!("statement of the bed-load paper at 3 %: {statement}");
        metrics.push(
            VELOCITY_DEFICIT
                .of(&variant.clone().and("height", 1e3 * height), deficit(height))
                .against(expected, &source, Confidence::Medium)
                .gated_by(is_shown.then_some(limit), reason)
                .with_snapshot_tolerance(0.01, 0.01),
        );
    }
    let slope = |of: &LayerState| of.logarithmic_slope(NEAR_BED.0, NEAR_BED.1, run.closures.karman);
    if let Some((own, without)) = slope(state).zip(slope(rest)) {
        metrics.push(
            LAYER_SLOPE_RATIO
                .of(&variant, own / without)
                .against(None, "statement of the bed-load paper at 3 %: gentler where grains move", Confidence::Medium)
                .gated_by(is_shown.then_some(Limit::AtMost(0.95)), "gentler by 5 %, above any error of the cells")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    metrics
}

/// The water over the moving bed and over the same bed at rest, a panel for each slope.
pub(super) fn figure(records: &[BedLoad1dRecord], layers: &[SolvedLayer<'_>]) -> Figure {
    let mut compared = Vec::new();
    let panel = |&(run, state): &SolvedLayer<'_>| {
        let mut panel = Panel::new(
            &percent(run.stream.slope),
            Axis::logarithmic("z/d [-]").between(0.02, 12.0),
            Axis::linear("u_f/u_* [-]"),
        );
        let curve = |state: &LayerState| {
            let above = (0..state.height.len()).filter(|&k| state.height[k] > 0.0);
            let scale = run.stream.shear_velocity();
            let of = |k: usize| (state.height[k] / run.stream.grain_diameter, state.fluid_velocity[k] / scale);
            above.map(of).collect::<Vec<_>>()
        };
        panel.line("moving grains", 0, curve(state));
        for (_, rest) in on_slope(records, run, |purpose| *purpose == LayerPurpose::BedAtRest) {
            panel.reference("the same bed at rest", curve(rest));
            let differences = curve(state).into_iter().zip(curve(rest)).map(|((z, own), (_, rest))| (z, own - rest));
            let found = against_rest(&differences.collect::<Vec<_>>());
            compared.push(format!("At {} the water over moving grains is {found}.", percent(run.stream.slope)));
        }
        panel
    };
    let panels = layers.iter().map(panel).collect();
    let caption = format!(
        "Velocity of the water over moving grains and over the same bed at rest in half-logarithmic axes. Figures 7 and 8 of the bed-load \
         paper (3 %) and its figure 9 (5 %) are drawn so; their measured points are lost. The paper prints τ* = 0.173 and 0.288, which \
         follow from the set-up. In the paper the water is slower near the bed and equal above (3 %). {} The closures are the literature's; \
         the paper's yield stress of 1220 Pa and viscosity of 0.26 Pa·s are not used.",
        compared.join(" ")
    );
    Figure::new("with-and-without-motion", &caption, panels).in_columns(3)
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
