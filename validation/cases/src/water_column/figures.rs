//! The case's figures.

use super::Record;
use crate::case::Flow;
use crate::figure::{Axis, Figure, Panel};
use crate::reference::water::{HEIGHT_READING, OTHER_WATER_FRONTS, WATER_FRONT, WATER_HEIGHTS, spread_of_water_fronts};
use crate::shared::distinct;

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let time = || Axis::linear("t/√(a/(2g)) [-]").over("t", "s", records.iter().map(|(run, _)| run.time_scale()));
    let widths = records.iter().map(|(run, _)| run.width);
    let mut front = Panel::new("", time(), Axis::linear("front x/a [-]").over("front", "m", widths));
    let mut energy = Panel::new("", time(), Axis::linear("energy change/work of gravity [%]"));
    for measured in distinct(records.iter().map(|(run, _)| run.measured())) {
        front.reference(measured.name, measured.points.iter().copied());
    }
    for (slot, (run, record)) in records.iter().enumerate() {
        let data = &record.data;
        let points = || data.time.iter().copied();
        front.line(&run.variant().to_string(), slot, points().zip(data.front.iter().copied()));
        // another code's front comes without energies
        if data.energy.total.is_empty() {
            continue;
        }
        let start = data.energy.total.first().copied().unwrap_or(f64::NAN);
        let share = |total: &f64| 100.0 * (total - start) / data.energy.gravity;
        energy.line("", slot, points().zip(data.energy.total.iter().map(share)));
    }
    vec![
        fronts_and_heights(records),
        Figure::new(
            "front-and-energy",
            "Front position (depth of 1/50 of the column's width) with measurements, for release by a lift gate and \
             at once, and change of total energy, which must not rise.",
            vec![front, energy],
        ),
    ]
}

/// Fronts and heights at the wall of the columns that are released at once, beside what experiments found.
fn fronts_and_heights(records: &[Record]) -> Figure {
    let time = || Axis::linear("t/√(a/(2g)) [-]");
    let mut front = Panel::new("front", time(), Axis::linear("x/a [-]"));
    let mut height = Panel::new("height at the wall", time(), Axis::linear("height/initial height [-]"));
    let end = records.iter().flat_map(|(_, record)| record.data.time.last()).fold(0.0_f64, |end, time| end.max(*time));
    let until = |points: &[(f64, f64)]| points.iter().copied().filter(|point| point.0 <= end).collect::<Vec<_>>();
    let spread = spread_of_water_fronts();
    let own = until(&WATER_FRONT.points);
    let bars = own.iter().map(|(_, x)| 2.0 * spread * x).collect();
    front.points("Martin & Moyce 1952, n² = 2, twice the spread", 0, own).error = bars;
    for (slot, (name, points)) in OTHER_WATER_FRONTS.iter().enumerate() {
        front.points(name, slot + 1, until(points));
    }
    for (slot, measured) in WATER_HEIGHTS.iter().enumerate() {
        let points = until(&measured.points);
        let bars = vec![2.0 * HEIGHT_READING; points.len()];
        height.points(&format!("Martin & Moyce 1952, n² = {}", measured.aspect_ratio), slot, points).error = bars;
    }
    let mut drawn = false;
    for (slot, (run, record)) in records.iter().enumerate() {
        let data = &record.data;
        let points = |values: &[f64]| data.time.iter().copied().zip(values.iter().copied()).collect::<Vec<_>>();
        if !run.is_gated() {
            front.line("", slot + 5, points(&data.front));
        }
        let label = if run.is_gated() {
            format!("n² = {}, lift gate", run.aspect_ratio)
        } else if drawn {
            String::new()
        } else {
            format!("n² = {}, released at once", run.aspect_ratio)
        };
        drawn |= !run.is_gated();
        height.line(&label, slot + 5, points(&data.height));
    }
    Figure::new(
        "front-and-height",
        "Water columns with several experiments: front of columns twice as high as wide, and height at the wall. \
         Error bars: twice the rms difference of measured fronts; for heights, the last digit.",
        vec![front, height],
    )
}
