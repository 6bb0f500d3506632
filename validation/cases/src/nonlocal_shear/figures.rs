//! The case's figures.

use super::NonlocalShearRecord;
use super::flow::ShearFlow;
use super::heap_figure as heap;
use super::marks::{LEAST, LEAST_OF_ERRORS, LOCAL, NONLOCAL, label, shown, thinned};
use super::metrics::plug_velocity;
use super::run::ShearRun;
use crate::figure::{Axis, Figure, Panel};

pub(super) fn all(records: &[NonlocalShearRecord]) -> Vec<Figure> {
    let flows = |kind: fn(&ShearFlow) -> bool| -> Vec<&NonlocalShearRecord> {
        records.iter().filter(|(run, _)| kind(&run.flow)).collect()
    };
    let chutes = flows(|flow| matches!(flow, ShearFlow::Chute { .. }));
    let beds = flows(|flow| matches!(flow, ShearFlow::DraggedBed { .. }));
    let heaps = flows(|flow| matches!(flow, ShearFlow::Heap { .. }));
    let drawn = [
        (!beds.is_empty()).then(|| dragged_bed(&beds)),
        (!chutes.is_empty()).then(|| chute(&chutes)),
        (!heaps.is_empty()).then(|| heap::drawn(&heaps)),
    ];
    drawn.into_iter().flatten().collect()
}

fn dragged_bed(records: &[&NonlocalShearRecord]) -> Figure {
    let speed = |run: &ShearRun| (run.gravity * run.grains.law.grain_diameter).sqrt();
    let largest = records.iter().map(|(run, _)| match run.flow {
        ShearFlow::DraggedBed { plate_velocity, .. } => plate_velocity / speed(run),
        ShearFlow::Chute { .. } | ShearFlow::Heap { .. } => 0.0,
    });
    let largest = largest.fold(0.0, f64::max);
    let least = LEAST * largest;
    let mut velocity = Panel::new(
        "",
        Axis::linear("depth below the plate/D [-]"),
        Axis::logarithmic("u/√(g D) [-]").between(least, 2.0 * largest),
    );
    let mut error = Panel::new("", Axis::linear("depth below the plate/D [-]"), Axis::linear("u/u exact − 1 [%]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let Some(exact) = run.exact(&record.data) else { continue };
        let (diameter, scale) = (run.grains.law.grain_diameter, speed(run));
        let depth = |y: f64| run.flow.distance(y) / diameter;
        if slot == 0 {
            let profile = &exact.profile;
            let points = profile.distances.iter().zip(&profile.velocities).map(|(y, u)| (y / diameter, u / scale));
            velocity.reference(NONLOCAL, shown(points, least));
            velocity.line(
                LOCAL,
                records.len(),
                shown(exact.local().iter().map(|(y, u)| (y / diameter, u / scale)), least),
            );
            error.reference("", [(0.0, 0.0), (exact.yield_distance() / diameter + 4.0, 0.0)]);
        }
        let rows = record.data.velocities();
        let few = thinned(run, record.data.velocities());
        velocity.points(&label(run), slot, shown(few.map(|(y, u)| (depth(y), u / scale)), least));
        let inside = rows.iter().filter(|(_, u)| u / scale >= LEAST_OF_ERRORS * largest);
        error.line_points("", slot, inside.map(|&(y, u)| (depth(y), 100.0 * (u / exact.velocity(y) - 1.0))));
    }
    Figure::new(
        "dragged-bed",
        "Velocity over the depth below a plate that drags grains under gravity, on a logarithmic axis. The local law comes to rest at the depth \
         at which τ/p falls to μ_s; under the nonlocal law the bed creeps below it, by an exponential whose length is that of the \
         fluidity. Particles against the solution without them at their own pressure, and the difference where the velocity is a hundredth of the plate's at least.",
        vec![velocity, error],
    )
}

fn chute(records: &[&NonlocalShearRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("distance from the wall/D [-]"), Axis::linear("u/√(g D) [-]"));
    let mut lag = Panel::new(
        "",
        Axis::linear("distance from the wall/D [-]"),
        Axis::logarithmic("1 − u/u in the middle [-]").between(LEAST, 1.0),
    );
    for (slot, (run, record)) in records.iter().enumerate() {
        let Some(exact) = run.exact(&record.data) else { continue };
        let ShearFlow::Chute { half_width, .. } = run.flow else { continue };
        let diameter = run.grains.law.grain_diameter;
        let scale = (run.gravity * diameter).sqrt();
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
        let from_wall = |y: f64| place(run.flow.distance(y));
        velocity.points(&label(run), slot, rows.iter().map(|&(y, u)| (from_wall(y), u / scale)));
        lag.points("", slot, shown(rows.iter().map(|&(y, u)| (from_wall(y), 1.0 - u / plug)), LEAST));
    }
    Figure::new(
        "chute",
        "Velocity in a vertical chute from its walls to its middle, both halves, and by how much it lags behind the middle on a \
         logarithmic axis. Under the local law a plug without any shear begins where μ falls to μ_s; under the nonlocal law the shear \
         decays into it.",
        vec![velocity, lag],
    )
}
