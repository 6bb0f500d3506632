//! Closures that differ from the literature's in one point.

use super::BedLoad1dRecord;
use super::records::of;
use super::replacements::Replaced;
use super::run::{BedLoad1dRun, LayerPurpose};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::reference::one_dimension::bed_load::{LayerState, MixingLengthClosure};
use crate::shared::percent;
use bagnold_solver::material::drag::DragLaw;

/// Closures in the order of the figure, with their labels.
const DRAWN: [(&str, &str); 9] = [
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

/// Place of a replacement on its axis; laws are numbered.
fn place(replaced: Replaced) -> f64 {
    match replaced {
        Replaced::Drag(law) => {
            DragLaw::ALL.iter().position(|other| *other == law).map_or(0.0, |place| place as f64 + 1.0)
        }
        Replaced::MixingLength(length) => match length {
            MixingLengthClosure::None => 0.0,
            MixingLengthClosure::Integral => 1.0,
            MixingLengthClosure::Root => 2.0,
            MixingLengthClosure::Linear => 3.0,
        },
        Replaced::CellHeight(height) => 1e3 * height,
        _ => replaced.value().unwrap_or(f64::NAN),
    }
}

/// The literature's own closure of a name.
fn own(name: &str, run: &BedLoad1dRun) -> Replaced {
    let closures = &run.closures;
    match name {
        "limiting_friction" => Replaced::LimitingFriction(closures.limiting_friction),
        "static_friction" => Replaced::StaticFriction(closures.static_friction),
        "reference_inertia" => Replaced::ReferenceInertia(closures.reference_inertia),
        "largest_fraction" => Replaced::LargestFraction(closures.largest_fraction),
        "dilation" => Replaced::Dilation(closures.dilation),
        "cell_height" => Replaced::CellHeight(run.cell_height),
        "bed_roughness_fade_length" => {
            Replaced::BedRoughnessFadeLength(closures.grain_roughness.bed_roughness_fade_length)
        }
        "drag" => Replaced::Drag(closures.drag),
        _ => Replaced::MixingLength(closures.mixing_length),
    }
}

/// Standard uncertainty of a layer's transport over the formula's from its closures, each over the values that it was replaced by, taken
/// for the ends of an even spread `[-]`, with what they are; none where none was.
pub(super) fn model_input_uncertainty(
    records: &[BedLoad1dRecord],
    run: &BedLoad1dRun,
    own: &LayerState,
) -> Option<(f64, String)> {
    let expected = TransportFormula::WongParker.transport(run.stream.shields_number());
    let mut ranges: Vec<(&str, f64, f64)> = Vec::new();
    for (other, state) in of(records, |purpose| matches!(purpose, LayerPurpose::Sensitivity(_))) {
        let LayerPurpose::Sensitivity(replaced) = other.purpose else { continue };
        // the height of a cell is no closure
        if other.stream.slope != run.stream.slope || matches!(replaced, Replaced::CellHeight(_)) {
            continue;
        }
        let ratio = state.transport() / expected;
        match ranges.iter_mut().find(|range| range.0 == replaced.closure()) {
            Some(range) => (range.1, range.2) = (range.1.min(ratio), range.2.max(ratio)),
            None => {
                let ratio_of_own = own.transport() / expected;
                ranges.push((replaced.closure(), ratio.min(ratio_of_own), ratio.max(ratio_of_own)));
            }
        }
    }
    let squares: f64 = ranges.iter().map(|(_, low, high)| (high - low).powi(2) / 12.0).sum();
    let words: Vec<String> = ranges.iter().map(|(name, low, high)| format!("{name} {low:.2} to {high:.2}")).collect();
    (!ranges.is_empty())
        .then(|| (squares.sqrt(), format!("the ratio over the plausible range of each closure: {}", words.join(", "))))
}

/// Transport over the value of each closure.
pub(super) fn figure(records: &[BedLoad1dRecord], layers: &[(&BedLoad1dRun, &LayerState)]) -> Option<Figure> {
    let mut panels = Vec::new();
    let mut caption = "Transport over that of Wong & Parker's formula when one closure is replaced and the others are kept. Dashed is the \
                       value with which the case is judged."
        .to_owned();
    for (name, label) in DRAWN {
        let mut panel = Panel::new("", Axis::linear(label), Axis::linear("q*/q* of Wong & Parker [-]"));
        let mut own_place = None;
        for (slot, (run, state)) in layers.iter().enumerate() {
            let expected = TransportFormula::WongParker.transport(run.stream.shields_number());
            let mut points: Vec<(f64, f64)> = of(records, |purpose| matches!(purpose, LayerPurpose::Sensitivity(_)))
                .filter(|(other, _)| other.stream.slope == run.stream.slope)
                .filter_map(|(other, state)| match other.purpose {
                    LayerPurpose::Sensitivity(replaced) if replaced.closure() == name => {
                        Some((place(replaced), state.transport() / expected))
                    }
                    _ => None,
                })
                .collect();
            if points.is_empty() || expected <= 0.0 {
                continue;
            }
            // one value for all slopes
            let chosen = place(own(name, run));
            own_place = Some(chosen);
            points.push((chosen, state.transport() / expected));
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let entry = if panels.is_empty() { percent(run.stream.slope) } else { String::new() };
            let mark = if matches!(name, "drag" | "mixing_length") { Mark::Points } else { Mark::LinePoints };
            panel.series.push(Series::new(&entry, mark, slot, points));
        }
        let Some(own_place) = own_place else { continue };
        let places = || panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
        let (from, to) = (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
        let entry = if panels.is_empty() { "gate of the transport" } else { "" };
        panel.band(entry, [from, to].map(|place| (place, MEASURED_BAND.0, MEASURED_BAND.1)));
        let entry = if panels.is_empty() { "value of the case" } else { "" };
        panel.reference(entry, [(own_place, MEASURED_BAND.0), (own_place, MEASURED_BAND.1)]);
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
