//! Transport over the value of each input.

use super::super::BedLoad1dRecord;
use super::super::flow::BedLoad1dFlow;
use super::super::records::{SolvedLayer, on_slope};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::shared::percent;
use bagnold_solver::material::drag::DragLaw;

/// Inputs in the order of the panels, with their labels.
const LABELS: [(&str, &str); 9] = [
    ("bed_roughness_fade_length", "fade length of the bed's roughness/d [-]"),
    ("limiting_friction", "μ_2 [-]"),
    ("static_friction", "μ_s [-]"),
    ("reference_inertia", "I_0 [-]"),
    ("largest_fraction", "φ_max [-]"),
    ("dilation", "B [-]"),
    ("cell_height", "height of a cell [mm]"),
    ("drag", "drag law, numbered"),
    ("mixing_length", "mixing length, numbered"),
];

/// An input of a layer, laws by their number.
fn value(name: &str, run: &BedLoad1dFlow) -> f64 {
    match name {
        "cell_height" => 1e3 * run.cell_height(),
        "drag" => DragLaw::ALL.iter().position(|law| *law == run.closures.drag).map_or(0.0, |place| place as f64 + 1.0),
        "mixing_length" => f64::from(run.closures.mixing_length as u8),
        _ => {
            let input = run.inputs().into_iter().find(|(own, _)| *own == name);
            input.and_then(|(_, value)| value.number()).unwrap_or(f64::NAN)
        }
    }
}

/// Transport over the value of each closure.
pub(super) fn figure(records: &[BedLoad1dRecord], layers: &[SolvedLayer<'_>]) -> Option<Figure> {
    let mut panels: Vec<Panel> = Vec::new();
    let mut caption = "Transport over that of Wong & Parker's formula when one closure is replaced and the others are kept. Dashed is the \
                       value with which the case is judged."
        .to_owned();
    for (name, label) in LABELS {
        let mut panel = Panel::new("", Axis::linear(label), Axis::linear("q*/q* of Wong & Parker [-]"));
        // one entry of each kind, in the first panel
        let entry = |text: String| if panels.is_empty() { text } else { String::new() };
        let mut own_place = 0.0;
        for (slot, &(run, state)) in layers.iter().enumerate() {
            let expected = TransportFormula::WongParker.transport(run.stream().shields_number());
            let others = on_slope(records, run, BedLoad1dFlow::is_sensitivity);
            let others = others.filter(|(other, _)| value(name, other) != value(name, run));
            let others = others.map(|(other, state)| (value(name, other), state.transport() / expected));
            let mut points: Vec<(f64, f64)> = others.collect();
            if points.is_empty() || expected <= 0.0 {
                continue;
            }
            // one value for all slopes
            own_place = value(name, run);
            points.push((own_place, state.transport() / expected));
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mark = if matches!(name, "drag" | "mixing_length") { Mark::Points } else { Mark::LinePoints };
            panel.series.push(Series::new(&entry(percent(run.stream().slope)), mark, slot, points));
        }
        let places = panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
        let ends = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), x| (from.min(x), to.max(x)));
        if panel.series.is_empty() {
            continue;
        }
        let gate = <[f64; 2]>::from(ends).map(|place| (place, MEASURED_BAND.0, MEASURED_BAND.1));
        panel.band(&entry("gate of the transport".to_owned()), gate);
        let dashed = [MEASURED_BAND.0, MEASURED_BAND.1].map(|ratio| (own_place, ratio));
        panel.reference(&entry("value of the case".to_owned()), dashed);
        caption.push_str(match name {
            "bed_roughness_fade_length" => " No literature gives the length over which the roughness of the bed fades.",
            "drag" => {
                " Drag laws are 1 Morsi–Alexander, 2 Schiller–Naumann, 3 Wen–Yu, 4 Ergun, 5 Gidaspow, 6 Di Felice."
            }
            "mixing_length" => {
                " Mixing lengths are 1 integral over the room between the grains, 2 κ z √(1 − z/h), 3 κ z."
            }
            _ => "",
        });
        panels.push(panel);
    }
    (!panels.is_empty()).then(|| Figure::new("sensitivities", &caption, panels))
}
