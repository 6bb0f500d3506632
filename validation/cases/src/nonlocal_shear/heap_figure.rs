//! Heaps between side walls, drawn.

use super::NonlocalShearRecord;
use super::flow::{ExactShear, RheologyChoice, ShearFlow};
use super::marks::{LEAST, LEAST_OF_ERRORS, NONLOCAL, label, shown, thinned};
use super::run::ShearRun;
use crate::figure::{Axis, Figure, Panel};

/// Velocities over the depth below the surface, of grains that flow together and of those that do not.
pub(super) fn drawn(records: &[&NonlocalShearRecord]) -> Figure {
    let exact: Vec<Option<ExactShear>> = records.iter().map(|(run, record)| run.exact(&record.data)).collect();
    let speed = |run: &ShearRun| (run.gravity * run.grains.law.grain_diameter).sqrt();
    let fastest = |(record, exact): (&&NonlocalShearRecord, &Option<ExactShear>)| {
        exact.as_ref().map_or(0.0, |exact| exact.profile.fastest / speed(&record.0))
    };
    let largest = records.iter().zip(&exact).map(fastest).fold(0.0, f64::max);
    let least = LEAST * largest;
    let depths = || Axis::linear("depth below the surface/D [-]");
    let mut velocity = Panel::new("", depths(), Axis::logarithmic("u/√(g D) [-]").between(least, 2.0 * largest));
    let mut error = Panel::new("", depths(), Axis::linear("u/u exact − 1 [%]"));
    let mut curves: Vec<RheologyChoice> = Vec::new();
    for (slot, ((run, record), exact)) in records.iter().zip(&exact).enumerate() {
        let (Some(exact), ShearFlow::Heap { cooperation, .. }) = (exact, run.flow) else { continue };
        let (diameter, scale) = (run.grains.law.grain_diameter, speed(run));
        let (name, law) = match cooperation {
            RheologyChoice::Nonlocal => (NONLOCAL, "nonlocal law"),
            RheologyChoice::Local => ("local law, without particles", "local law"),
        };
        if !curves.contains(&cooperation) {
            curves.push(cooperation);
            let profile = &exact.profile;
            let points = profile.distances.iter().zip(&profile.velocities).map(|(y, u)| (y / diameter, u / scale));
            match cooperation {
                RheologyChoice::Nonlocal => velocity.reference(name, shown(points, least)),
                RheologyChoice::Local => velocity.line(name, records.len(), shown(points, least)),
            };
        }
        let depth = |y: f64| run.flow.distance(y) / diameter;
        let rows = record.data.velocities();
        let few = thinned(run, rows.clone());
        let name = format!("{law}, {}", label(run));
        velocity.points(&name, slot, shown(few.map(|(y, u)| (depth(y), u / scale)), least));
        let inside = rows.iter().filter(|(y, u)| (*u).min(exact.velocity(*y)) / scale >= LEAST_OF_ERRORS * largest);
        error.line_points("", slot, inside.map(|&(y, u)| (depth(y), 100.0 * (u / exact.velocity(y) - 1.0))));
    }
    Figure::new(
        "heap",
        "Velocity over the depth below the surface of a heap between side walls, on a logarithmic axis, of grains that flow together (nonlocal law) and \
         of grains that do not (local law). The friction of the side walls grows as the weight, so that τ/p falls with the depth; where it is μ_s the \
         local law ends at rest, and below it the nonlocal law creeps. Particles against the solutions without them, and the difference where the velocity \
         is a hundredth of the fastest at least.",
        vec![velocity, error],
    )
}
