//! The case's figures.

use super::metrics::{froude_number, relative_thickness};
use super::{FlowThicknessFlow, LayerFate, Record, StartStop, flows, searches};
use crate::figure::{Axis, Figure, Mark, Panel};
use crate::statistics::grouped;

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let drawn = [
        searches(records).next().map(|(flow, _)| stopping(flow, records)),
        flows(records, false).next().map(|(flow, _)| flow_rule(flow, records)),
        flows(records, true).next().map(|(flow, _)| froude(flow, records)),
    ];
    drawn.into_iter().flatten().collect()
}

/// Colour slot of each law, which has a mark of its own shape.
const LAWS: [usize; 3] = [0, 3, 4];
/// Thinnest and thickest layer of a curve `[m]`.
const DRAWN: (f64, f64) = (2.5e-3, 40e-3);

/// Which layers stop: the local law and the experiments.
fn stopping(first: &FlowThicknessFlow, records: &[Record]) -> Figure {
    let incline = first.incline();
    let mut panel = Panel::new("", Axis::linear("θ [°]"), Axis::logarithmic("layer thickness [mm]"));
    let experiment = thicknesses().map(|h| (incline.stopping_angle(h).to_degrees(), 1e3 * h)).collect::<Vec<_>>();
    let local = libm::atan(incline.static_friction).to_degrees();
    panel.line("fit to experiments: h_stop(θ)", 2, experiment);
    panel.reference("local law, exact: tanθ = μ_s", [(local, 1e3 * DRAWN.0), (local, 1e3 * DRAWN.1)]);
    draw_searches(&mut panel, searches(records));
    let tried = searches(records).map(|(run, _)| (law_name(run), format!("{:.0}", 1e3 * run.layer.layer_height)));
    let tried: Vec<String> =
        grouped(tried).iter().map(|(law, thicknesses)| format!("{law} at {} mm", thicknesses.join(" and "))).collect();
    // for the legend alone
    panel.points("kept flowing", 6, []);
    panel.draw("stopped", Mark::OpenPoints, 6, []);
    let caption = format!(
        "Layers that stopped (open) or flowed (filled) over slope and thickness: {}. Curves: exact h_stop of each \
         law, and the fit to experiments, whose uncertainty is not stated.",
        tried.join("; ")
    );
    Figure::new("start-stop", &caption, vec![panel])
}

/// Thicknesses of curves `[m]`.
fn thicknesses() -> impl Iterator<Item = f64> {
    (0..=60).map(|step| DRAWN.0 * libm::pow(DRAWN.1 / DRAWN.0, f64::from(step) / 60.0))
}

/// Name of the law of a search.
fn law_name(flow: &FlowThicknessFlow) -> String {
    flow.surface_name().map_or("local law".to_owned(), |surface| format!("nonlocal law, {surface}"))
}

/// Marks of each law, filled where a layer kept flowing and open where it stopped, and the curve of its own h_stop.
fn draw_searches<'a>(panel: &mut Panel, searches: impl Iterator<Item = (&'a FlowThicknessFlow, &'a StartStop)>) {
    let mut laws: Vec<String> = Vec::new();
    for (run, found) in searches {
        let law = law_name(run);
        let place = laws.iter().position(|known| *known == law).unwrap_or(laws.len());
        let slot = LAWS[place % LAWS.len()];
        let runs = format!("{law}: runs");
        let ends = [
            (runs.as_str(), LayerFate::Flows, Mark::Points, slot),
            (runs.as_str(), LayerFate::Stops, Mark::OpenPoints, slot),
            ("undecided", LayerFate::Undecided, Mark::Points, 1),
        ];
        for (label, fate, mark, slot) in ends {
            let ended = found.trials.iter().filter(|trial| trial.fate == fate).map(|trial| trial.slope_angle);
            let points: Vec<_> = ended.map(|angle| (angle, 1e3 * run.layer.layer_height)).collect();
            // most searches leave nothing open, and then the legend need not speak of it
            if !points.is_empty() {
                panel.draw(label, mark, slot, points);
            }
        }
        if place == laws.len() {
            let angle = |h: f64| {
                let mut flow = run.clone();
                flow.layer.layer_height = h;
                flow.exact(0.0).map(|layer| (layer.stopping_angle().to_degrees(), 1e3 * h))
            };
            let curve: Vec<_> = thicknesses().filter_map(angle).collect();
            let entry = if curve.is_empty() { String::new() } else { format!("{law}: exact") };
            panel.line(&entry, slot, curve);
            laws.push(law);
        }
    }
}

/// (h/h_stop, Froude number) of the steady flows of the local or the nonlocal law.
fn froude_numbers(records: &[Record], nonlocal: bool) -> Vec<(f64, f64)> {
    let numbers = |(flow, data)| Some((relative_thickness(flow)?, froude_number(flow, data)));
    flows(records, nonlocal).filter_map(numbers).collect()
}

/// The flow rule (42).
fn flow_rule(first: &FlowThicknessFlow, records: &[Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("h/h_stop(θ) [-]"), Axis::linear("Ū/√(gh) [-]"));
    let points = froude_numbers(records, false);
    let far = points.iter().fold(1.0_f64, |most, point| most.max(point.0));
    let line = vec![(0.0, 0.0), (1.05 * far, 1.05 * far * first.flow_coefficient)];
    panel.reference("β of Table 1", line);
    panel.points("steady flows", 0, points);
    Figure::new(
        "flow-rule",
        "Depth-averaged velocity of steady flows over √(gh) against thickness over h_stop(θ), with equation (42) of \
         the collapse paper. The law implies this line by (41), so the figure verifies the solver.",
        vec![panel],
    )
}

/// Cells of a steady profile in a curve, whose error is then below the width of its line.
const CURVE_CELLS: usize = 1000;
/// Points of a curve.
const CURVE_POINTS: i32 = 200;
/// What half a degree of the slope makes of h_stop, which no document at hand states the scatter of `[°]`.
const SLOPE_ERROR: f64 = 0.5;

/// The Froude number of both laws beside the flow rule.
fn froude(first: &FlowThicknessFlow, records: &[Record]) -> Figure {
    let axis = Axis::logarithmic;
    let mut panel = Panel::new("", axis("h/h_stop(θ) of the experiments [-]"), axis("Ū/√(gh) [-]"));
    let [local, nonlocal] = [false, true].map(|nonlocal| froude_numbers(records, nonlocal));
    let farthest = local.iter().chain(&nonlocal).fold(1.0_f64, |most, point| most.max(point.0));
    let (angle, coefficient, incline) = (first.slope_angle, first.flow_coefficient, first.incline());
    let thickness = |angle: f64| incline.deposit_thickness(angle.to_radians());
    let relative = |step: i32| libm::pow(1.3 * farthest, f64::from(step) / f64::from(CURVE_POINTS));
    let steps = || (0..=CURVE_POINTS).map(relative);
    let mut steepness = String::new();
    if let (Some(thick), Some(own), Some(thin)) =
        (thickness(angle - SLOPE_ERROR), thickness(angle), thickness(angle + SLOPE_ERROR))
    {
        let along = |thickness: f64| move |times: f64| coefficient * times * own / thickness;
        let (lower, upper) = (along(thick), along(thin));
        panel.band("flow rule at a slope half a degree gentler or steeper", steps().map(|x| (x, lower(x), upper(x))));
        let curve = steps().filter_map(|times| {
            let mut flow = first.clone();
            flow.layer.layer_height = times * own;
            let velocity = flow.exact(angle)?.steady(CURVE_CELLS).ok()?.depth_mean();
            // below its own h_stop it is at rest
            (velocity > 0.0).then(|| (times, velocity / flow.speed()))
        });
        let curve: Vec<(f64, f64)> = curve.collect();
        if let [.., (x, y), (far, end)] = curve[..] {
            let slope = libm::log(end / y) / libm::log(far / x);
            steepness = format!(" The nonlocal curve ends with the power {slope:.1}.");
        }
        panel.line("nonlocal law, 1-D solution", 1, curve);
    }
    panel.reference("flow rule of the experiments, β h/h_stop", steps().map(|times| (times, coefficient * times)));
    panel.points("local law, particles", 0, local);
    panel.points("nonlocal law, particles", 1, nonlocal);
    let caption = format!(
        "Depth-averaged velocity over √(gh) against thickness over the experimental h_stop(θ), for both \
         laws.{steepness} Band: ± half a degree of slope. The published points are not available."
    );
    Figure::new("froude-number", &caption, vec![panel])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};
    use crate::layer::flow_thickness::SlopeTrial;

    #[test]
    fn laws_have_a_mark_each_that_is_open_where_a_layer_stopped() {
        let trial = |(slope_angle, fate)| SlopeTrial { slope_angle, fate, time: 1.0, mean_velocity: 0.0, lost: 0 };
        let found = StartStop { trials: [(20.0, LayerFate::Stops), (24.0, LayerFate::Flows)].map(trial).to_vec() };
        let list = RunList::<FlowThicknessFlow>::of_tier(Tier::Paper);
        let mut panel = Panel::new("", Axis::linear("θ [°]"), Axis::logarithmic("h [mm]"));
        let searches = list.flows().iter().filter(|flow| flow.is_sought());
        draw_searches(&mut panel, searches.map(|flow| (flow, &found)));
        let laws = ["local law: runs", "nonlocal law, vanishing: runs", "nonlocal law, no-flux: runs"];
        for (law, slot) in laws.into_iter().zip(LAWS) {
            for (mark, angle) in [(Mark::Points, 24.0), (Mark::OpenPoints, 20.0)] {
                let own = panel.series.iter().find(|series| series.label == law && series.mark == mark).expect(law);
                assert_eq!((own.colour, own.points[0].0), (slot, angle));
            }
        }
    }
}
