//! The case's figures.

use super::Record;
use super::exact::ExactShear;
use super::flow::{Drive, NonlocalShearFlow};
use super::metrics::plug_velocity;
use crate::figure::{Axis, Figure, Panel};

/// Least velocity that a logarithmic axis shows, over its largest `[-]`: three decades of a tail.
const LEAST: f64 = 1e-3;
/// Least velocity whose relative error is drawn, over that of the plate `[-]`: rows that are nearly at rest keep the unevenness of the start.
const LEAST_OF_ERRORS: f64 = 1e-2;

const NONLOCAL: &str = "nonlocal law, 1-D solution";
const LOCAL: &str = "local law under the same stresses";

fn label(run: &NonlocalShearFlow) -> String {
    match run.particles_per_diameter {
        1 => "1 particle per diameter".to_owned(),
        count => format!("{count} particles per diameter"),
    }
}

/// Points that an axis from a least value on can show.
fn shown(points: impl IntoIterator<Item = (f64, f64)>, least: f64) -> Vec<(f64, f64)> {
    points.into_iter().filter(|(_, value)| *value >= least).collect()
}

/// One row per diameter, which leaves the curve behind them to be seen.
fn thinned(run: &NonlocalShearFlow, rows: Vec<(f64, f64)>) -> impl Iterator<Item = (f64, f64)> {
    rows.into_iter().skip(run.particles_per_diameter / 2).step_by(run.particles_per_diameter)
}

/// √(g D) `[m/s]`.
fn speed(run: &NonlocalShearFlow) -> f64 {
    (run.gravity * run.diameter()).sqrt()
}

/// The solution without particles over its distance from where it flows fastest, in units of diameters and √(g D).
fn solution<'a>(run: &NonlocalShearFlow, exact: &'a ExactShear) -> impl Iterator<Item = (f64, f64)> + use<'a> {
    let (diameter, scale) = (run.diameter(), speed(run));
    exact.profile.distances.iter().zip(&exact.profile.velocities).map(move |(y, u)| (y / diameter, u / scale))
}

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let of_drive = |drive: Drive, draw: fn(&[&Record]) -> Figure| {
        let own: Vec<&Record> = records.iter().filter(|(run, _)| run.drive == drive).collect();
        (!own.is_empty()).then(|| draw(&own))
    };
    let drawn = [of_drive(Drive::DraggedBed, dragged_bed), of_drive(Drive::Chute, chute), of_drive(Drive::Heap, heap)];
    drawn.into_iter().flatten().collect()
}

/// Velocity over the depth on a logarithmic axis, and its error where it is fast enough.
struct OverDepth {
    velocity: Panel,
    error: Panel,
    /// Largest velocity over √(g D) `[-]`.
    largest: f64,
}

impl OverDepth {
    fn new(below: &str, largest: f64) -> Self {
        let depth = || Axis::linear(&format!("depth below the {below}/D [-]"));
        let velocity = Axis::logarithmic("u/√(g D) [-]").between(LEAST * largest, 2.0 * largest);
        Self {
            velocity: Panel::new("", depth(), velocity),
            error: Panel::new("", depth(), Axis::linear("u/u exact − 1 [%]")),
            largest,
        }
    }

    /// The points that the logarithmic axis can show.
    fn shown(&self, points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
        shown(points, LEAST * self.largest)
    }

    /// Draws the rows of a run.
    fn draw(&mut self, (run, record): &Record, exact: &ExactShear, slot: usize, name: &str) {
        let (diameter, scale) = (run.diameter(), speed(run));
        let depth = |y: f64| run.distance(y) / diameter;
        let rows = record.data.velocities();
        let few = self.shown(thinned(run, rows.clone()).map(|(y, u)| (depth(y), u / scale)));
        self.velocity.points(name, slot, few);
        let least = LEAST_OF_ERRORS * self.largest;
        let inside = rows.iter().filter(|(y, u)| (*u).min(exact.velocity(*y)) / scale >= least);
        self.error.line_points("", slot, inside.map(|&(y, u)| (depth(y), 100.0 * (u / exact.velocity(y) - 1.0))));
    }
}

fn dragged_bed(records: &[&Record]) -> Figure {
    let largest = records.iter().map(|(run, _)| run.plate_velocity).fold(0.0, f64::max);
    let mut drawn = OverDepth::new("plate", largest);
    for (slot, record) in records.iter().enumerate() {
        let (run, diameter) = (&record.0, record.0.diameter());
        let Some(exact) = run.exact(&record.1.data) else { continue };
        if slot == 0 {
            let local = exact.local().into_iter().map(|(y, u)| (y / diameter, u / speed(run)));
            let (nonlocal, local) = (drawn.shown(solution(run, &exact)), drawn.shown(local));
            drawn.velocity.reference(NONLOCAL, nonlocal);
            drawn.velocity.line(LOCAL, records.len(), local);
            drawn.error.reference("", [(0.0, 0.0), (exact.yield_distance() / diameter + 4.0, 0.0)]);
        }
        drawn.draw(record, &exact, slot, &label(run));
    }
    Figure::new(
        "dragged-bed",
        "Velocity over the depth below a dragged plate (logarithmic axis) with a finite-volume solution at the same \
         pressure, and their relative difference where the velocity exceeds 1 % of the plate's velocity.",
        vec![drawn.velocity, drawn.error],
    )
}

/// Velocities over the depth below the surface, of grains that flow together and of those that do not.
fn heap(records: &[&Record]) -> Figure {
    let exact: Vec<Option<ExactShear>> = records.iter().map(|(run, record)| run.exact(&record.data)).collect();
    let fastest =
        records.iter().zip(&exact).filter_map(|((run, _), exact)| Some(exact.as_ref()?.profile.fastest / speed(run)));
    let mut drawn = OverDepth::new("surface", fastest.fold(0.0, f64::max));
    let mut curves: Vec<bool> = Vec::new();
    for (slot, (record, exact)) in records.iter().zip(&exact).enumerate() {
        let run = &record.0;
        let Some(exact) = exact else { continue };
        if !curves.contains(&run.is_local()) {
            curves.push(run.is_local());
            let points = drawn.shown(solution(run, exact));
            if run.is_local() {
                drawn.velocity.line("local law, 1-D solution", records.len(), points);
            } else {
                drawn.velocity.reference(NONLOCAL, points);
            }
        }
        let law = if run.is_local() { "local law" } else { "nonlocal law" };
        drawn.draw(record, exact, slot, &format!("{law}, {}", label(run)));
    }
    Figure::new(
        "heap",
        "Velocity over the depth of a heap between side walls (logarithmic axis), nonlocal and local law, with \
         finite-volume solutions, and their relative difference where the velocity exceeds 1 % of the largest.",
        vec![drawn.velocity, drawn.error],
    )
}

fn chute(records: &[&Record]) -> Figure {
    let distance = || Axis::linear("distance from the wall/D [-]");
    let mut velocity = Panel::new("", distance(), Axis::linear("u/√(g D) [-]"));
    let lags = Axis::logarithmic("1 − u/u in the middle [-]").between(LEAST, 1.0);
    let mut lag = Panel::new("", distance(), lags);
    for (slot, (run, record)) in records.iter().enumerate() {
        let Some(exact) = run.exact(&record.data) else { continue };
        let (diameter, scale, half_width) = (run.diameter(), speed(run), exact.shear.thickness);
        let place = |distance: f64| (half_width - distance) / diameter;
        if slot == 0 {
            let profile = &exact.profile;
            let points = || profile.distances.iter().zip(&profile.velocities);
            velocity.reference(NONLOCAL, points().map(|(y, u)| (place(*y), u / scale)));
            lag.reference("", shown(points().map(|(y, u)| (place(*y), 1.0 - u / profile.fastest)), LEAST));
            let plug = exact.local().first().map_or(f64::NAN, |point| point.1);
            velocity.line(LOCAL, records.len(), exact.local().into_iter().map(|(y, u)| (place(y), u / scale)));
            let lags = exact.local().into_iter().map(|(y, u)| (place(y), 1.0 - u / plug));
            lag.line("", records.len(), shown(lags, LEAST));
        }
        let rows: Vec<(f64, f64)> = thinned(run, record.data.velocities()).collect();
        let plug = plug_velocity(&record.data);
        let from_wall = |y: f64| place(run.distance(y));
        velocity.points(&label(run), slot, rows.iter().map(|&(y, u)| (from_wall(y), u / scale)));
        lag.points("", slot, shown(rows.iter().map(|&(y, u)| (from_wall(y), 1.0 - u / plug)), LEAST));
    }
    Figure::new(
        "chute",
        "Velocity in a vertical chute from the wall to the middle, and its difference from the velocity in the \
         middle on a logarithmic axis. With the local law a plug begins where μ falls to μ_s.",
        vec![velocity, lag],
    )
}
