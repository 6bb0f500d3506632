//! How the runs are judged.

use super::NonlocalShearRecord;
use super::flow::{ExactShear, ShearFlow};
use super::heap;
use super::probe::ShearObservation;
use super::profile::{length_metric, tail, velocity_l2};
use super::quantities::*;
use super::run::ShearRun;
use crate::case::Run;
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::reference::one_dimension::ShearStress;
use crate::setup::energy_ledger::{self, EnergyScale};
use crate::statistics::Regression;

pub(super) fn all(records: &[NonlocalShearRecord]) -> Vec<Metric> {
    records.iter().flat_map(of_run).chain(heap::orders(records)).collect()
}

fn of_run((run, record): &NonlocalShearRecord) -> Vec<Metric> {
    let (variant, seen) = (run.variant(), &record.data);
    let lost = PARTICLES_LOST
        .of(&variant, seen.particles_lost as f64)
        .exactly(0.0, "no particle passes a wall")
        .gated(Limit::AtMost(0.0), "a particle behind a wall is lost mass");
    let energy = match run.flow {
        ShearFlow::Chute { .. } | ShearFlow::Heap { .. } => {
            energy_ledger::metrics(&variant, &seen.energy, EnergyScale::Steady)
        }
        // the plate feeds energy in, and its work is none of an error
        ShearFlow::DraggedBed { .. } if seen.energy.total.is_empty() => Vec::new(),
        ShearFlow::DraggedBed { .. } => vec![energy_ledger::residual(&variant, &seen.energy, EnergyScale::Steady)],
    };
    let Some(exact) = run.exact(seen) else { return [lost].into_iter().chain(energy).collect() };
    let own = match run.flow {
        ShearFlow::Chute { half_width, .. } => chute(run, seen, &exact, half_width),
        ShearFlow::DraggedBed { .. } => dragged_bed(run, seen, &exact),
        ShearFlow::Heap { cooperation, .. } => heap::metrics(run, seen, &exact, cooperation),
    };
    let not_steady = seen.unsteadiness(run.window());
    let own = own.into_iter().map(|metric| metric.unless(not_steady.as_ref()));
    let overfilling = OVERFILLING
        .of(&variant, 100.0 * (seen.filling - 1.0))
        .exactly(0.0, "particles that fill the channel as a lattice does")
        .with_snapshot_tolerance(0.1, 1e-2);
    [lost, overfilling, unevenness(run, seen, &variant)].into_iter().chain(energy).chain(own).collect()
}

fn unevenness(run: &ShearRun, seen: &ShearObservation, variant: &Variant) -> Metric {
    let (grains, flow) = run.found(seen);
    let deviation = |(y, pressure): (&f64, &f64)| (pressure - flow.pressure(&grains, *y)).abs();
    let largest = seen.height.iter().zip(&seen.pressure).map(deviation).fold(0.0, f64::max);
    PRESSURE_UNEVENNESS
        .of(variant, 100.0 * largest / seen.mean_pressure())
        .exactly(0.0, "a pressure that is uniform in a chute and that of the weight in a bed")
        .gated(
            Limit::AtMost(1.0),
            "1 %: an error of a row's pressure is one of its friction, which a mean over the rows of a sheared layer makes small",
        )
        .with_snapshot_tolerance(0.1, 1e-2)
}

/// Velocities of both halves of a chute over the distance from its middle.
fn folded(seen: &ShearObservation) -> Vec<(f64, f64)> {
    let rows = seen.velocities();
    let half = rows.len() / 2;
    let pairs = rows[rows.len() - half..].iter().zip(rows[..half].iter().rev());
    pairs.map(|(right, left)| (0.5 * (right.0 - left.0), 0.5 * (right.1 + left.1))).collect()
}

/// Velocity in the middle of a chute `[m/s]`.
pub(super) fn plug_velocity(seen: &ShearObservation) -> f64 {
    folded(seen).first().map_or(f64::NAN, |point| point.1)
}

fn chute(run: &ShearRun, seen: &ShearObservation, exact: &ExactShear, half_width: f64) -> Vec<Metric> {
    let (variant, diameter) = (run.variant(), run.grains.law.grain_diameter);
    let folded = folded(seen);
    let plug = plug_velocity(seen);
    let lagging = plug * (1.0 - libm::exp(-1.0));
    let crossed = folded.windows(2).find(|rows| rows[1].1 < lagging);
    let layer = crossed.map_or(f64::NAN, |rows| {
        let ((near, faster), (far, slower)) = (rows[0], rows[1]);
        half_width - far + (far - near) * (lagging - slower) / (faster - slower)
    });
    let expected = exact.profile.wall_layer().unwrap_or(f64::NAN);
    let (grains, flow) = run.found(seen);
    let found = match flow {
        ShearFlow::Chute { wall_friction, .. } => wall_friction,
        ShearFlow::DraggedBed { .. } | ShearFlow::Heap { .. } => f64::NAN,
    };
    let coarseness = COARSE / run.particles_per_diameter as f64;
    let implied = flow.friction_of(&grains, plug).ok().flatten().unwrap_or(f64::NAN);
    vec![
        length_metric(WALL_LAYER.of(&variant, layer / diameter), expected / diameter, run),
        velocity_l2(run, seen, exact).gated(
            Limit::AtMost(5.0 * coarseness),
            "5 % where two particles are as long as a grain and half of it with twice as many: so near the least friction at which this chute flows \
             its velocity goes with the friction to the power of 14, so that 5 % are less than 0.4 % of the friction",
        ),
        FRICTION_ERROR
            .of(&variant, 100.0 * (implied / found - 1.0))
            .exactly(0.0, EXACT)
            .gated(
                Limit::Within(-0.4 * coarseness, 0.4 * coarseness),
                "0.4 % where two particles are as long as a grain and half of it with twice as many: what 5 % of the velocity are so near that least friction",
            )
            .with_snapshot_tolerance(0.1, 1e-2),
        PLUG_VELOCITY_ERROR
            .of(&variant, 100.0 * (plug / exact.profile.fastest - 1.0))
            .exactly(0.0, EXACT)
            .with_snapshot_tolerance(0.1, 1e-1),
    ]
}

fn dragged_bed(run: &ShearRun, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    let (variant, diameter) = (run.variant(), run.grains.law.grain_diameter);
    let rows = seen.velocities();
    let lines = |depths| {
        let exact_rows = rows.iter().map(|&(y, _)| (y, exact.velocity(y)));
        (tail(run, exact, depths, rows.iter().copied()), tail(run, exact, depths, exact_rows))
    };
    let length = |line: Option<Regression>| line.map_or(f64::NAN, |line| -1.0 / (line.slope * diameter));
    let straightness = |line: Option<Regression>| line.map_or(f64::NAN, |line| line.r_squared);
    let mut metrics = Vec::new();
    for depths in [TAIL, DEEP_TAIL] {
        let (found, expected) = lines(depths);
        let variant = Variant::of("from", depths.0).and("to", depths.1).followed_by(&variant);
        metrics.push(length_metric(DECAY_LENGTH.of(&variant, length(found)), length(expected), run));
    }
    let (found, expected) = lines(TAIL);
    metrics.push(
        TAIL_STRAIGHTNESS
            .of(&variant, straightness(found))
            .exactly(straightness(expected), EXACT)
            .gated(Limit::AtLeast(STRAIGHT.0), STRAIGHT.1)
            .with_snapshot_tolerance(1e-3, 0.0),
    );
    let (found, _) = lines(DEEP_TAIL);
    metrics.push(
        DEEP_DECAY_LENGTH
            .of(&variant, length(found))
            .against(
                None,
                "about one diameter below flows on heaps, whatever the flow, is what experiments are known for; their numbers are not at hand",
                Confidence::Unverified,
            )
            .with_snapshot_tolerance(1e-2, 0.0),
    );
    let traction = match exact.shear.stress {
        ShearStress::UnderGravity { traction, .. } => traction,
        _ => f64::NAN,
    };
    metrics.push(
        TRACTION_ERROR
            .of(&variant, 100.0 * (seen.mean_shear_stress() / traction - 1.0))
            .exactly(0.0, EXACT)
            .gated(
                Limit::Within(-0.5, 0.5),
                "half a per cent: the traction hardly depends on the velocity, and so on its error",
            )
            .with_snapshot_tolerance(0.1, 1e-2),
    );
    let allowed = 2.0 * COARSE / run.particles_per_diameter as f64;
    metrics.push(velocity_l2(run, seen, exact).gated(
        Limit::AtMost(allowed),
        "2 % where two particles are as long as a grain and half of it with twice as many: first order, of a layer six diameters thick below \
         a plate at which the first row is a quarter of a diameter away",
    ));
    metrics
}
