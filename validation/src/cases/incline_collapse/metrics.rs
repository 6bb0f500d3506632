//! How a collapse on a slope is judged.

use super::Record;
use crate::case::Run;
use crate::cases::collapse::metrics::{momentum_residual, nothing_lost};
use crate::metric::{Confidence, Kind, Limit, Metric, Variant};
use crate::reference::{SLOPE_EXPERIMENT, slope_run_out};

/// What the gate allows beyond the band of the law's two quotations `[-]`.
const MARGIN: f64 = 0.15;
/// Times at which the front is told `[s]`.
const FRONT_TIMES: [f64; 2] = [0.3, 0.4];

pub(super) fn of_run((run, record): &Record) -> Vec<Metric> {
    let variant = run.variant();
    let data = &record.data.collapse;
    let mut metrics = nothing_lost(&variant, data).to_vec();
    // an implicit step keeps no account of what the walls gave
    if run.regularisation_rate.is_none() {
        metrics.push(momentum_residual(&variant, data));
    }
    let observed = |name: &str, variant: &Variant, value: f64, unit: &str| {
        Metric::observed(name, variant, value, unit).of_kind(Kind::Validation).with_snapshot_tolerance(1e-3, 1e-3)
    };
    let angle = run.slope_angle.to_radians();
    // the front's way from the gate
    let way = (data.run_out()) * run.reservoir_length;
    let law = |k: f64| slope_run_out(run.initial_height, angle, run.static_friction(), k);
    let (lower, upper) = SLOPE_EXPERIMENT.run_out_coefficients;
    if run.regularisation_rate.is_none()
        && let (Some(short), Some(long)) = (law(lower), law(upper))
    {
        let front = observed("front_displacement", &variant, way, "m").against(
            Some(0.5 * (short + long)),
            &format!("h_0 2k/(tanδ − tanθ), k = {lower} to {upper}, tanδ = μ_s: Mangeney et al. 2010 as quoted"),
            SLOPE_EXPERIMENT.confidence,
        );
        // on a horizontal bed the fit was not made for the paper's case
        metrics.push(if run.slope_angle > 0.0 && run.is_resolved() {
            let limit = Limit::Within((1.0 - MARGIN) * short, (1.0 + MARGIN) * long);
            front.gated(limit, "specification 2: the band of k = 0.4 to 0.5, 15 % to either side; at 20 rows and more")
        } else {
            front
        });
        metrics.push(
            Metric::observed("kinetic_energy_share", &variant, data.agitation(), "-")
                .against(Some(0.0), "a static deposit", Confidence::Exact)
                .gated(Limit::AtMost(1e-6), "specification 2: at most 1e-6 of the potential energy that was released")
                .with_snapshot_tolerance(0.0, 1e-6),
        );
        let friction_angle = libm::atan(run.static_friction()).to_degrees() - run.slope_angle;
        metrics.push(observed("deposit_slope_angle", &variant, data.slope_angle(), "°").against(
            Some(friction_angle),
            "arctan μ_s − θ, the steepest surface that can rest, from the bed; line over 20–80 % of the front",
            Confidence::Exact,
        ));
    }
    for time in FRONT_TIMES {
        if let Some(index) = data.time.iter().position(|&t| t >= time) {
            let variant = Variant::of("time", time).followed_by(&variant);
            metrics.push(observed("front", &variant, data.front[index], "-"));
        }
    }
    metrics
}
