//! Series of gauges: what they count, and how they are written and drawn.

use crate::figure::{Axis, Figure, Panel};
use crate::output::Table;
use bagnold_solver::parameter::{between, filled};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parts that a particle's volume is spread in over a spacing to either side.
const PARTS: i32 = 8;

/// A measured series that a gauge is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Name of the gauge, whose first column it is.
    pub gauge: String,
    /// Where the numbers come from.
    pub source: String,
    /// Times `[s]` and values in the gauge's unit, positive.
    #[schemars(transform = filled("at least one row", "give time and value of every point"))]
    pub points: Vec<(f64, f64)>,
    /// Largest root mean square of the relative error `[%]`; 0 where it is only observed.
    #[serde(default)]
    #[schemars(transform = between(0.0, 100.0, "10 is a tenth"))]
    pub limit: f64,
}

/// One column of a series.
pub(in crate::cases) struct Column {
    /// Name and unit.
    pub(in crate::cases) heading: String,
    /// Label of its axis.
    pub(in crate::cases) axis: &'static str,
}

/// Volumes `[m^D]` of the particles by bins, of which `bin` names that of a place; in the order of the scene.
pub(in crate::cases) fn volumes<const D: usize>(
    simulation: &Simulation<D>,
    bin: impl Fn(Vector<D>) -> Option<usize>,
) -> Vec<f64> {
    let particles = simulation.particles();
    let mut sums: Vec<f64> = Vec::new();
    for index in particles.by_identity() {
        if let Some(bin) = bin(particles.position[index]) {
            if sums.len() <= bin {
                sums.resize(bin + 1, 0.0);
            }
            sums[bin] += particles.mass[index] / particles.density[index];
        }
    }
    sums
}

/// The first place along a line, from its start and where material stands on, with a section of less than `[m^(D-1)]`
/// among what `counts`: volumes are spread over a spacing to either side.
pub(in crate::cases) fn reached<const D: usize>(
    simulation: &Simulation<D>,
    from: &Vector<D>,
    to: &Vector<D>,
    section: f64,
    counts: impl Fn(&Vector<D>) -> bool,
) -> f64 {
    let spacing = simulation.spacing();
    let (bin, length) = (0.25 * spacing, (to - from).norm());
    let along = (to - from) / length;
    let bins = (length / bin).ceil() as usize;
    let mut area = vec![0.0; bins];
    for part in 0..PARTS {
        let shift = (f64::from(part) - 0.5 * f64::from(PARTS - 1)) * 2.0 / f64::from(PARTS) * spacing;
        let shares = volumes(simulation, |place| {
            if !counts(&place) {
                return None;
            }
            let place = (place - from).dot(&along) + shift;
            (place >= 0.0 && place < length).then_some((place / bin) as usize)
        });
        for (sum, share) in area.iter_mut().zip(shares) {
            *sum += share / f64::from(PARTS);
        }
    }
    let stands = |area: &f64| *area >= section * bin;
    let Some(first) = area.iter().position(stands) else { return 0.0 };
    let gap = area[first..].iter().position(|area| !stands(area));
    gap.map_or(length, |gap| (first + gap) as f64 * bin)
}

/// The series of a run as a table: time, mass, and a column a gauge's column.
pub(in crate::cases) fn table<'a>(
    name: String,
    mass: &str,
    gauges: impl Iterator<Item = (&'a str, Vec<Column>)>,
    (time, masses, series): (&[f64], &[f64], &[Vec<f64>]),
) -> Table {
    let headings = gauges
        .flat_map(|(gauge, columns)| columns.into_iter().map(move |column| format!("{gauge}: {}", column.heading)));
    let headings: Vec<String> = headings.collect();
    let mut columns = vec![("t [s]", time), (mass, masses)];
    columns.extend(headings.iter().map(String::as_str).zip(series.iter().map(Vec::as_slice)));
    Table::of_columns(name, &columns)
}

/// One panel a gauge with a line a column that shares its axis.
pub(in crate::cases) fn figure<'a>(
    gauges: impl Iterator<Item = (&'a str, Vec<Column>)>,
    measured: &[Measured],
    time: &[f64],
    series: &[Vec<f64>],
) -> Option<Figure> {
    let mut next = 0;
    let mut panels = Vec::new();
    for (name, columns) in gauges {
        let axis = columns.first().map_or("", |column| column.axis);
        let mut panel = Panel::new(name, Axis::linear("t [s]"), Axis::linear(axis));
        for measured in measured.iter().filter(|measured| measured.gauge == name) {
            panel.reference("measured", measured.points.iter().copied());
        }
        for (slot, column) in columns.iter().enumerate().filter(|(_, column)| column.axis == axis) {
            let values = series.get(next + slot).map_or(&[][..], Vec::as_slice);
            let label =
                if slot == 0 && columns.get(1).is_none_or(|other| other.axis != axis) { "" } else { &column.heading };
            panel.line(label, slot, time.iter().copied().zip(values.iter().copied()));
        }
        next += columns.len();
        panels.push(panel);
    }
    (!panels.is_empty()).then(|| Figure::new("gauges", "What the gauges of the scene measured.", panels).in_columns(2))
}
