//! The case's figures.

use super::Record;
use crate::case::Run;
use crate::figure::{Axis, Figure, Panel};

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let time = || Axis::linear("t/√(a/(2g)) [-]").over("t", "s", records.iter().map(|(run, _)| run.time_scale()));
    let widths = records.iter().map(|(run, _)| run.column.width);
    let mut front = Panel::new("", time(), Axis::linear("front x/a [-]").over("front", "m", widths));
    let mut energy = Panel::new("", time(), Axis::linear("energy change/work of gravity [%]"));
    let mut drawn: Vec<&str> = Vec::new();
    for (run, _) in records {
        let measured = run.measured();
        if !drawn.contains(&measured.name) {
            front.reference(measured.name, measured.points.iter().copied());
            drawn.push(measured.name);
        }
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
    vec![Figure::new(
        "front-and-energy",
        "The front, where a fiftieth of the column's width stands on the bed, against the measured ones: behind a gate that is \
         lifted as in the experiment, and released at once, where the experiment starts later; and the change of kinetic, elastic and potential energy together, which may only fall.",
        vec![front, energy],
    )]
}
