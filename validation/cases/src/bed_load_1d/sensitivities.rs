//! Closures that differ from the literature's in one point.

use super::BedLoad1dRecord;
use super::quantities::{START_DIFFERENCE, TRANSPORT_SENSITIVITY};
use super::records::{InputSpread, SolvedLayer, literature, on_slope, second_variant};
use super::run::{BedLoad1dRun, LayerPurpose};
use crate::case::Run;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::Metric;
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::reference::one_dimension::bed_load::{LayerState, MixingLengthClosure};
use crate::shared::percent;
use bagnold_solver::material::drag::DragLaw;

/// A closure with its label in the figure and its value; laws are numbered.
struct Closure {
    name: &'static str,
    label: &'static str,
    value: fn(&BedLoad1dRun) -> f64,
}

const fn closure(name: &'static str, label: &'static str, value: fn(&BedLoad1dRun) -> f64) -> Closure {
    Closure { name, label, value }
}

/// Closures in the order of the figure; the height of a cell is none, and is shown with them.
const CLOSURES: [Closure; 9] = [
    closure("bed_roughness_fade_length", "fade length of the bed's roughness/d [-]", |run| {
        run.closures.grain_roughness.bed_roughness_fade_length
    }),
    closure("limiting_friction", "μ_2 [-]", |run| run.closures.limiting_friction),
    closure("static_friction", "μ_s [-]", |run| run.closures.static_friction),
    closure("reference_inertia", "I_0 [-]", |run| run.closures.reference_inertia),
    closure("largest_fraction", "φ_max [-]", |run| run.closures.largest_fraction),
    closure("dilation", "B [-]", |run| run.closures.dilation),
    closure(CELL_HEIGHT, "height of a cell [mm]", |run| 1e3 * run.cell_height),
    closure("drag", "drag law, numbered", |run| {
        DragLaw::ALL.iter().position(|law| *law == run.closures.drag).map_or(0.0, |place| place as f64 + 1.0)
    }),
    closure("mixing_length", "mixing length, numbered", |run| match run.closures.mixing_length {
        MixingLengthClosure::None => 0.0,
        MixingLengthClosure::Integral => 1.0,
        MixingLengthClosure::Root => 2.0,
        MixingLengthClosure::Linear => 3.0,
    }),
];

const CELL_HEIGHT: &str = "cell_height";

/// Layers on the slope of a run in which one input is replaced.
fn replaced<'a>(records: &'a [BedLoad1dRecord], run: &'a BedLoad1dRun) -> impl Iterator<Item = SolvedLayer<'a>> {
    on_slope(records, run, |purpose| matches!(purpose, LayerPurpose::Sensitivity(_)))
}

/// Transport with a closure replaced over that without, and of a layer with two states also from the fast start.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (own_run, own) in literature(records) {
        for (run, state) in replaced(records, own_run) {
            let ratio = TRANSPORT_SENSITIVITY.of(&run.variant(), state.transport() / own.transport());
            let ratio = ratio.exactly(1.0, "the layer with the literature's closures");
            metrics.push(ratio.with_snapshot_tolerance(1e-3, 0.0));
        }
        for (run, record) in records.iter().filter(|(run, _)| run.stream.slope == own_run.stream.slope) {
            let second = record.data.second.as_ref().filter(|_| matches!(run.purpose, LayerPurpose::Sensitivity(_)));
            let Some(second) = second else { continue };
            metrics.push(TRANSPORT_SENSITIVITY.of(&second_variant(run), second.transport() / own.transport()));
            metrics.push(START_DIFFERENCE.of(&run.variant(), record.data.start_difference));
        }
    }
    metrics
}

/// Standard uncertainty of a layer's transport over the formula's from its closures, each over the values that it was replaced by, taken
/// for the ends of an even spread `[-]`, with what they are; 0 where none was.
pub(super) fn model_input_uncertainty(
    records: &[BedLoad1dRecord],
    run: &BedLoad1dRun,
    own: &LayerState,
) -> (f64, String) {
    let expected = TransportFormula::WongParker.transport(run.stream.shields_number());
    let mut spread = InputSpread::default();
    for Closure { name, value, .. } in CLOSURES.iter().filter(|closure| closure.name != CELL_HEIGHT) {
        for (_, state) in replaced(records, run).filter(|(other, _)| value(other) != value(run)) {
            spread.add(name, own.transport() / expected, state.transport() / expected);
        }
    }
    (spread.standard(), spread.words())
}

/// Transport over the value of each closure.
pub(super) fn figure(records: &[BedLoad1dRecord], layers: &[SolvedLayer<'_>]) -> Option<Figure> {
    let mut panels: Vec<Panel> = Vec::new();
    let mut caption = "Transport over that of Wong & Parker's formula when one closure is replaced and the others are kept. Dashed is the \
                       value with which the case is judged."
        .to_owned();
    for Closure { name, label, value } in &CLOSURES {
        let mut panel = Panel::new("", Axis::linear(label), Axis::linear("q*/q* of Wong & Parker [-]"));
        // one entry of each kind, in the first panel
        let entry = |text: String| if panels.is_empty() { text } else { String::new() };
        let mut own_place = 0.0;
        for (slot, &(run, state)) in layers.iter().enumerate() {
            let expected = TransportFormula::WongParker.transport(run.stream.shields_number());
            let others = replaced(records, run).filter(|(other, _)| value(other) != value(run));
            let others = others.map(|(other, state)| (value(other), state.transport() / expected));
            let mut points: Vec<(f64, f64)> = others.collect();
            if points.is_empty() || expected <= 0.0 {
                continue;
            }
            // one value for all slopes
            own_place = value(run);
            points.push((own_place, state.transport() / expected));
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mark = if matches!(*name, "drag" | "mixing_length") { Mark::Points } else { Mark::LinePoints };
            panel.series.push(Series::new(&entry(percent(run.stream.slope)), mark, slot, points));
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
        caption.push_str(match *name {
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
