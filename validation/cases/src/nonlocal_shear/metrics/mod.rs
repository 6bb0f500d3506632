//! How the runs are judged.

mod heap;

use super::Record;
use super::exact::ExactShear;
use super::flow::{Drive, NonlocalShearFlow};
use super::probe::ShearObservation;
use crate::case::Flow;
use crate::metric::{Limit, Metric, Variant, quantities};
use crate::reference::one_dimension::ShearStress;
use crate::setup::energy_ledger::{self, EnergyScale};
use crate::statistics::{LinearFit, linear_fit, mean, relative_l2};

quantities! {
    [energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PARTICLES_LOST: accounted("particles_lost", "-", "particles that ended behind a wall"),
    PRESSURE_UNEVENNESS: verified(
        "pressure_unevenness", "%", "largest deviation of the pressure of a row from the momentum balance, over the mean"
    ),
    VELOCITY_L2: verified("velocity_l2", "%", "relative L2 error of the velocity profile, √(Σ(u − u_ref)²/Σu_ref²)"),
    WALL_LAYER: verified(
        "wall_layer", "diameters", "e-folding distance from the wall of the velocity relative to the middle"
    ),
    FRICTION_ERROR: verified(
        "friction_error", "%", "wall friction that gives the model the same velocity in the middle, over the imposed friction, minus 1"
    ),
    TRACTION_ERROR: verified("traction_error", "%", "mean shear stress over the exact stress at the velocity of the plate, minus 1"),
    FLOWING_DEPTH: verified(
        "flowing_depth", "diameters", "depth at which the velocity of a heap is a hundredth of that of its surface"
    ),
    OBSERVED_ORDER: verified(
        "observed_order", "-", "order of convergence of velocity_l2 under the local law from one resolution to the next"
    ),
    DECAY_LENGTH: verified(
        "decay_length", "diameters", "e-folding length of the velocity below the depth at which the local law is at rest"
    ),
    TAIL_STRAIGHTNESS: verified(
        "tail_straightness", "-", "R² of a straight line through the logarithm of the velocity over that depth"
    ),
}

const EXACT: &str = "steady 1-D solution of the nonlocal law (2000 finite volumes) at the run's pressure";
/// Depths below that at which the local law is at rest, between which the tail is measured, in diameters: the whole of it, and its
/// deeper half.
const TAIL: (f64, f64) = (0.0, 5.0);
const DEEP_TAIL: (f64, f64) = (2.5, 6.0);
/// Factor of limits that are given for two particles per diameter `[-]`.
fn coarseness(run: &NonlocalShearFlow) -> f64 {
    2.0 / run.particles_per_diameter as f64
}

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    records.iter().flat_map(of_run).chain(heap::orders(records)).collect()
}

fn of_run((run, record): &Record) -> Vec<Metric> {
    let (variant, seen) = (run.variant(), &record.data);
    let lost = PARTICLES_LOST
        .of(&variant, seen.particles_lost as f64)
        .exactly(0.0, "no particle passes a wall")
        .gated(Limit::AtMost(0.0), "0: a particle behind a wall is lost mass");
    let energy = match run.drive {
        Drive::Chute | Drive::Heap => energy_ledger::metrics(&variant, &seen.energy, EnergyScale::Steady),
        // the plate feeds energy in, and its work is none of an error
        Drive::DraggedBed if seen.energy.total.is_empty() => Vec::new(),
        Drive::DraggedBed => vec![energy_ledger::residual(&variant, &seen.energy, EnergyScale::Steady)],
    };
    let Some(exact) = run.exact(seen) else { return [lost].into_iter().chain(energy).collect() };
    let own = match run.drive {
        Drive::Chute => chute(run, seen, &exact),
        Drive::DraggedBed => dragged_bed(run, seen, &exact),
        Drive::Heap => heap::metrics(run, seen, &exact),
    };
    let not_steady = seen.unsteadiness(run.window());
    let own = own.into_iter().map(|metric| metric.unless(not_steady.as_ref()));
    [lost, unevenness(run, seen, &variant)].into_iter().chain(energy).chain(own).collect()
}

fn unevenness(run: &NonlocalShearFlow, seen: &ShearObservation, variant: &Variant) -> Metric {
    let (grains, flow) = run.found(seen);
    let deviation = |(y, pressure): (&f64, &f64)| (pressure - flow.pressure(&grains, *y)).abs();
    let largest = seen.height.iter().zip(&seen.pressure).map(deviation).fold(0.0, f64::max);
    PRESSURE_UNEVENNESS
        .of(variant, 100.0 * largest / seen.mean_pressure())
        .exactly(0.0, "a pressure that is uniform in a chute and that of the weight in a bed")
        .gated(Limit::AtMost(1.0), "1 %: pressure errors change the friction of a row, but average out over rows")
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

fn chute(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    let (variant, diameter, half_width) = (run.variant(), run.diameter(), exact.shear.thickness);
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
    let coarseness = coarseness(run);
    let implied = flow.friction_of(&grains, plug).ok().flatten().unwrap_or(f64::NAN);
    vec![
        length_metric(WALL_LAYER.of(&variant, layer / diameter), expected / diameter, run),
        velocity_l2(run, seen, exact).gated(
            Limit::AtMost(5.0 * coarseness),
            "5 % with two particles per grain: a friction error of 0.4 % gives 5 % (velocity ∝ friction^14)",
        ),
        FRICTION_ERROR
            .of(&variant, 100.0 * (implied / flow.wall_friction - 1.0))
            .exactly(0.0, EXACT)
            .gated(
                Limit::Within(-0.4 * coarseness, 0.4 * coarseness),
                "0.4 % with two particles per grain: a friction error that changes velocity by 5 %",
            )
            .with_snapshot_tolerance(0.1, 1e-2),
    ]
}

fn dragged_bed(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    let variant = run.variant();
    let mut metrics = decay(run, seen, exact);
    let traction = match exact.shear.stress {
        ShearStress::UnderGravity { traction, .. } => traction,
        _ => f64::NAN,
    };
    metrics.push(
        TRACTION_ERROR
            .of(&variant, 100.0 * (mean(&seen.shear_stress) / traction - 1.0))
            .exactly(0.0, EXACT)
            .gated(Limit::Within(-0.5, 0.5), "0.5 %: a narrow limit, as velocity errors hardly change the traction")
            .with_snapshot_tolerance(0.1, 1e-2),
    );
    metrics.push(creeping_velocity(run, seen, exact));
    metrics
}

/// Error of the velocity where grains creep below others that flow.
fn creeping_velocity(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Metric {
    let reason = "limit 2 % with two particles per grain, 1 % with four: first-order error expected";
    velocity_l2(run, seen, exact).gated(Limit::AtMost(2.0 * coarseness(run)), reason)
}

/// The line through the logarithm of velocities between two depths below that at which the local law is at rest, in diameters.
fn tail(
    run: &NonlocalShearFlow,
    exact: &ExactShear,
    (upper, lower): (f64, f64),
    velocities: &[(f64, f64)],
) -> Option<LinearFit> {
    let diameter = run.diameter();
    let depths = velocities.iter().map(|&(y, velocity)| (run.distance(y), velocity));
    let inside = depths.filter(|(depth, _)| {
        let below = (depth - exact.yield_distance()) / diameter;
        below >= upper && below <= lower
    });
    linear_fit(&inside.map(|(depth, velocity)| (depth, libm::log(velocity))).collect::<Vec<_>>())
}

/// Length `[diameters]` over which a velocity decays along a line through its logarithm.
fn decay_length(run: &NonlocalShearFlow, line: Option<LinearFit>) -> f64 {
    line.map_or(f64::NAN, |line| -1.0 / (line.slope * run.diameter()))
}

/// How the velocity decays below the depth at which the local law is at rest.
fn decay(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    let (variant, rows) = (run.variant(), seen.velocities());
    let expected: Vec<(f64, f64)> = rows.iter().map(|&(y, _)| (y, exact.velocity(y))).collect();
    let lines = |depths| [&rows, &expected].map(|rows| tail(run, exact, depths, rows));
    let length = |depths: (f64, f64)| {
        let variant = Variant::of("from", depths.0).and("to", depths.1).followed_by(&variant);
        let [found, expected] = lines(depths).map(|line| decay_length(run, line));
        length_metric(DECAY_LENGTH.of(&variant, found), expected, run)
    };
    let [found, expected] = lines(TAIL).map(|line| line.map_or(f64::NAN, |line| line.r_squared));
    let straight = TAIL_STRAIGHTNESS
        .of(&variant, found)
        .exactly(expected, EXACT)
        .gated(Limit::AtLeast(0.98), "0.98: a line fits the logarithm of near-exponential decay, not of a sharp edge")
        .with_snapshot_tolerance(1e-3, 0.0);
    vec![length(TAIL), length(DEEP_TAIL), straight]
}

/// A length of the decay or of the layer at a wall `[diameters]`.
fn length_metric(metric: Metric, expected: f64, run: &NonlocalShearFlow) -> Metric {
    let allowed = 0.05 * coarseness(run);
    metric
        .exactly(expected, EXACT)
        .gated(
            Limit::Within((1.0 - allowed) * expected, (1.0 + allowed) * expected),
            "limit 5 % with two particles per grain, the fewest that resolve 1.2 diameters; 2.5 % with four",
        )
        .with_snapshot_tolerance(5e-3, 0.0)
}

fn velocity_l2(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Metric {
    let misfit = velocity_misfit(seen, exact);
    VELOCITY_L2.of(&run.variant(), 100.0 * misfit).exactly(0.0, EXACT).with_snapshot_tolerance(5e-2, 1e-2)
}

/// Relative L2 of the velocity profile `[-]`.
fn velocity_misfit(seen: &ShearObservation, exact: &ExactShear) -> f64 {
    relative_l2(seen.velocities().into_iter().map(|(y, velocity)| (velocity, exact.velocity(y))))
}
