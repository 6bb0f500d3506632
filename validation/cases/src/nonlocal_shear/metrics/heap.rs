//! How heaps between side walls are judged.

use super::*;

/// Velocity at the depth that a heap counts as flowing down to, over that of its surface `[-]`.
const STILL: f64 = 0.01;
const EXACT_LOCAL: &str = "μ(I) inverted under the stresses that gravity and both side walls give, integrated from the depth at which τ/p is μ_s";

/// Metrics of a heap.
pub(super) fn metrics(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    if run.is_local() { depth(run, seen, exact) } else { creep(run, seen, exact) }
}

/// Decay and velocity of grains that flow together.
fn creep(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    decay(run, seen, exact).into_iter().chain([creeping_velocity(run, seen, exact)]).collect()
}

/// Depth down to which rows, from below, flow `[m]`.
fn flowing_depth(run: &NonlocalShearFlow, rows: &[(f64, f64)]) -> f64 {
    let Some(surface) = rows.last().map(|row| row.1) else { return f64::NAN };
    let crossed = rows.windows(2).rev().find(|pair| pair[0].1 < STILL * surface);
    crossed.map_or(f64::NAN, |pair| {
        let ((lower, slower), (upper, faster)) = (pair[0], pair[1]);
        run.distance(lower + (upper - lower) * (STILL * surface - slower) / (faster - slower))
    })
}

/// Profile and depth of a flow of the local law.
fn depth(run: &NonlocalShearFlow, seen: &ShearObservation, exact: &ExactShear) -> Vec<Metric> {
    let (diameter, row) = (run.diameter(), 1.0 / run.particles_per_diameter as f64);
    let rows = seen.velocities();
    let expected: Vec<(f64, f64)> = rows.iter().map(|&(y, _)| (y, exact.velocity(y))).collect();
    let [found, expected] = [&rows, &expected].map(|rows| flowing_depth(run, rows) / diameter);
    vec![
        FLOWING_DEPTH
            .of(&run.variant(), found)
            .exactly(expected, EXACT_LOCAL)
            .gated(
                Limit::Within(expected - row, expected + row),
                "one particle row: velocity gradients average over neighbours on both sides of the depth where flow ends",
            )
            .with_snapshot_tolerance(5e-3, 0.0),
        velocity_l2(run, seen, exact).exactly(0.0, EXACT_LOCAL).gated(
            Limit::AtMost(3.0 * coarseness(run)),
            "3 % with two particles per grain: shifting the flow's lower edge by 0.1 rows gives 1 %",
        ),
    ]
}

/// Orders of convergence under the local law, from each resolution to the next.
pub(super) fn orders(records: &[Record]) -> Vec<Metric> {
    let mut errors: Vec<(usize, f64)> = records
        .iter()
        .filter(|(run, _)| run.is_local())
        .filter_map(|(run, record)| {
            let exact = run.exact(&record.data)?;
            Some((run.particles_per_diameter, velocity_misfit(&record.data, &exact)))
        })
        .collect();
    errors.sort_by_key(|error| error.0);
    let order = |pair: &[(usize, f64)]| {
        let ((few, coarse), (many, fine)) = (pair[0], pair[1]);
        let variant = Variant::of("flow", "local-heap").and("from", few).and("to", many);
        OBSERVED_ORDER
            .of(&variant, libm::log(coarse / fine) / libm::log(many as f64 / few as f64))
            .exactly(2.0, "sums over neighbours are of second order where the shear rate is smooth")
            .gated(
                Limit::AtLeast(1.0),
                "first order: particles are perturbed, and the shear rate has a kink where flow ends",
            )
            .with_snapshot_tolerance(0.1, 0.1)
    };
    errors.windows(2).map(order).collect()
}
