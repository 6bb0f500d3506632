//! How a collapse on a slope is judged.

use super::Record;
use crate::case::Run;
use crate::cases::collapse::metrics::{at_rest, conservation};
use crate::cases::collapse::quantities::{DEPOSIT_SLOPE_ANGLE, MOMENTUM_RESIDUAL, PARTICLES_LOST, REST_TIME};
use crate::cases::energy_ledger;
use crate::metric::{Limit, Metric, Quantity, Variant, quantities};
use crate::reference::{SLOPE_EXPERIMENT, slope_run_out};

quantities! {
    [PARTICLES_LOST, MOMENTUM_RESIDUAL, REST_TIME, DEPOSIT_SLOPE_ANGLE, energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    FRONT_DISPLACEMENT: validated("front_displacement", "m", "the front's way from the gate to the end of the deposit"),
    FRONT: validated("front", "-", "place of the front at a time, over r_0"),
}

/// What the gate allows beyond the band of the law's two quotations `[-]`.
const MARGIN: f64 = 0.15;
/// Times at which the front is told `[s]`.
const FRONT_TIMES: [f64; 2] = [0.3, 0.4];

pub(super) fn of_run((run, record): &Record) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data.collapse);
    let observed = |quantity: Quantity, variant: &Variant, value: f64| {
        quantity.of(variant, value).with_snapshot_tolerance(1e-3, 1e-3)
    };
    let mut metrics = conservation(&variant, data, &run.reservoir.numerics);
    let (angle, friction) = (run.slope_angle.to_radians(), run.static_friction());
    let law = |k: f64| slope_run_out(run.reservoir.initial_height, angle, friction, k);
    let (lower, upper) = SLOPE_EXPERIMENT.run_out_coefficients;
    if run.regularisation_rate.is_none()
        && let (Some(short), Some(long)) = (law(lower), law(upper))
    {
        // on a horizontal bed the fit was not made for the paper's case
        let is_judged = run.slope_angle > 0.0 && run.is_resolved() && run.law.is_plastic();
        let limit = Limit::Within((1.0 - MARGIN) * short, (1.0 + MARGIN) * long);
        let source =
            format!("h_0 2k/(tanδ − tanθ), k = {lower} to {upper}, tanδ = μ_s: Mangeney et al. 2010 as quoted");
        metrics.extend([
            observed(FRONT_DISPLACEMENT, &variant, data.run_out() * run.reservoir.reservoir_length)
                .against(Some(0.5 * (short + long)), &source, SLOPE_EXPERIMENT.confidence)
                .gated_by(
                    is_judged.then_some(limit),
                    "the band of k = 0.4 to 0.5, 15 % to either side; at 20 rows and more",
                ),
            at_rest(&variant, data, &run.law, run.reservoir.duration),
            observed(DEPOSIT_SLOPE_ANGLE, &variant, data.slope_angle()).exactly(
                libm::atan(friction).to_degrees() - run.slope_angle,
                "arctan μ_s − θ, the steepest surface that can rest, from the bed; line over 20–80 % of the front",
            ),
        ]);
    }
    for time in FRONT_TIMES {
        if let Some(index) = data.time.iter().position(|&t| t >= time) {
            let variant = Variant::of("time", time).followed_by(&variant);
            metrics.push(observed(FRONT, &variant, data.front[index]));
        }
    }
    metrics
}
