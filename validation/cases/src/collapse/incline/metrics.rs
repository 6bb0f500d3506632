//! How a collapse on a slope is judged.

use super::Record;
use super::inside::Inside;
use crate::case::Flow;
use crate::collapse::heap::with_resolution;
use crate::collapse::interior::{Station, linear_misfit_ratio};
use crate::collapse::metrics::other_codes::Beside;
use crate::collapse::metrics::quantities::*;
use crate::collapse::metrics::{at_rest, conservation};
use crate::collapse::{BIN_WIDTH, Collapse, SlopeCollapse, SlopeFlow};
use crate::metric::{Confidence, Limit, Metric, Quantity, Variant, quantities};
use crate::observation::{Frame, Recorded};
use crate::reference::collapse::{SLOPE_EXPERIMENT, slope_run_out};
use crate::setup::energy_ledger::{self, EnergyScale};
use crate::shared::range;
use crate::statistics::mean;

quantities! {
    [PARTICLES_LOST, MOMENTUM_RESIDUAL, REST_TIME, DEPOSIT_SLOPE_ANGLE, energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK, FRONT_DISPLACEMENT, FRONT, KINETIC_ENERGY, LINEAR_MISFIT_RATIO]
    LARGEST_THICKNESS: stated("largest_thickness", "cm", "largest thickness of the flow at a station"),
    FASTEST_DEPTH: stated("fastest_depth", "-", "mean depth of the fastest twentieth of the grains along the slope, over the local thickness, at a time"),
    VISCOSITY_AND_DEPTH: stated("viscosity_and_depth", "-", "rank correlation of the apparent viscosity and the depth below the surface, at a time"),
    VISCOSITY_LIKE_PRESSURE: stated("viscosity_like_pressure", "-", "rank correlation of the apparent viscosity with the pressure less that with the shear rate, both as sizes, at a time"),
    SURFACE_VISCOSITY: stated("surface_viscosity", "Pa·s", "median apparent viscosity of the uppermost fifth of the thickness, at a time"),
    BED_VISCOSITY: stated("bed_viscosity", "Pa·s", "median apparent viscosity of the lowest fifth of the thickness, at a time"),
    SHEARED_DEPTH: stated("sheared_depth", "-", "mean depth of the twentieth of the grains that is sheared fastest, over the local thickness, at a time"),
    INERTIA_CONTRAST: stated("inertia_contrast", "-", "range between the quartiles of the inertial number among the faster half of the grains over that among the slower, at a time"),
    UNIFORMITY: stated("uniformity", "-", "least over largest depth mean of the velocity at three places behind the front, at a time"),
    FRONT_VISCOSITY: stated("front_viscosity", "Pa·s", "median apparent viscosity of the last tenth of the reservoir's length behind the front, at a time"),
}

/// Times of the paper's figures 4 and 5 at which fields are measured `[s]`; they begin at 0.11 s.
const FIELD_TIMES: [f64; 3] = [0.12, 0.2, 0.4];
/// Slope of those figures `[°]`.
const FIELD_SLOPE: f64 = 22.0;
/// Earliest time that the paper speaks of `[s]`.
const EARLIEST_STATED: f64 = 0.11;
/// "Near the surface", of the local thickness `[-]`: the upper third.
const NEAR_SURFACE: f64 = 1.0 / 3.0;

/// Margin of the gate beyond the band of the law's two quotations `[-]`.
pub(super) const MARGIN: f64 = 0.15;
/// Time at which the flow is compared with other codes, over √(h_0/g) `[-]`: the latest that they tell.
const WELL_DOWN_THE_SLOPE: f64 = 4.0;
/// Times at which the front is reported `[s]`.
const FRONT_TIMES: [f64; 2] = [0.3, 0.4];

pub(super) fn of_run((run, record): &Record) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data.collapse);
    let observed = |quantity: Quantity, variant: &Variant, value: f64| {
        quantity.of(variant, value).with_snapshot_tolerance(1e-3, 1e-3)
    };
    let mut metrics = conservation(&variant, data, &run.numerics, EnergyScale::Fall);
    let (angle, friction) = (run.slope_angle.to_radians(), run.material.contact_friction());
    let law = |k: f64| slope_run_out(run.initial_height, angle, friction, k);
    let (lower, upper) = SLOPE_EXPERIMENT.run_out_coefficients;
    if !run.is_regularised()
        && let (Some(short), Some(long)) = (law(lower), law(upper))
    {
        // on a horizontal bed the fit was not made for the paper's case
        let is_judged = run.slope_angle > 0.0 && run.is_resolved() && run.material.is_plastic();
        let limit = Limit::Within((1.0 - MARGIN) * short, (1.0 + MARGIN) * long);
        let source =
            format!("h_0 2k/(tanδ − tanθ), k = {lower} to {upper}, tanδ = μ_s: Mangeney et al. 2010 as quoted");
        let run_out = observed(FRONT_DISPLACEMENT, &variant, data.run_out() * run.reservoir_length);
        let row = data.front_uncertainty().map(|uncertainty| uncertainty * run.reservoir_length);
        metrics.extend([
            with_resolution(run_out, None, row)
                .against(Some(0.5 * (short + long)), &source, SLOPE_EXPERIMENT.confidence)
                .gated_by(
                    is_judged.then_some(limit),
                    "limits are the published fit with k = 0.4 to 0.5, widened by 15 %",
                ),
            at_rest(&variant, data, &run.material, run.duration),
            observed(DEPOSIT_SLOPE_ANGLE, &variant, data.slope_angle()).exactly(
                libm::atan(friction).to_degrees() - run.slope_angle,
                "arctan μ_s − θ, the steepest surface that can rest, from the bed; line over 20–80 % of the front",
            ),
        ]);
    }
    metrics.extend(FRONT_TIMES.into_iter().filter_map(|time| {
        let variant = Variant::of("time", time).followed_by(&variant);
        Some(observed(FRONT, &variant, front_at(data, time)?))
    }));
    if let Some(beside) = Beside::of_slope(run, data) {
        metrics.extend(beside.metrics(&variant, WELL_DOWN_THE_SLOPE));
    }
    // the paper's figures 4 and 5, with the law itself
    if run.slope_angle == FIELD_SLOPE && !run.is_regularised() {
        metrics.extend(FIELD_TIMES.iter().filter_map(|&time| of_fields(time, run, record)).flatten());
    }
    metrics
}

/// Velocity over depth at a quarter, half and three quarters of the way from the gate to the front; none before the front has
/// come two stations' widths.
fn stations(time: f64, run: &SlopeFlow, record: &Recorded<SlopeCollapse>) -> Vec<Station> {
    let (unit, data) = (run.reservoir_length, &record.data.collapse);
    let (Some(frame), Some(front)) = (Frame::nearest(&record.frames, time), front_at(data, time)) else {
        return Vec::new();
    };
    if front - 1.0 < 2.0 * BIN_WIDTH {
        return Vec::new();
    }
    let at = |part: f64| Station::of(frame, (1.0 + part * (front - 1.0)) * unit, BIN_WIDTH * unit, run.spacing());
    [0.25, 0.5, 0.75].map(at).to_vec()
}

/// Front over r_0 at the first observation from a time on `[s]`.
fn front_at(data: &Collapse, time: f64) -> Option<f64> {
    data.time.iter().position(|&t| t >= time).map(|index| data.front[index])
}

/// Mean over the depth `[m/s]`.
fn mean_velocity(station: &Station) -> f64 {
    mean(&station.profile.iter().map(|point| point.1).collect::<Vec<f64>>())
}

/// What the paper says of velocity and viscosity inside the collapse, at a time.
fn of_fields(time: f64, run: &SlopeFlow, record: &Recorded<SlopeCollapse>) -> Option<Vec<Metric>> {
    let inside = Inside::at(time, run, record)?;
    let variant = Variant::of("time", time).followed_by(&run.variant());
    let is_judged = run.is_resolved() && run.material.is_plastic();
    let of = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-2, 1e-2);
    let gate = |limit: Limit| is_judged.then_some(limit);
    let stated = |quantity: Quantity, value: f64, statement: &str| {
        of(quantity, value).against(None, &format!("statement: {statement}"), Confidence::Medium)
    };
    let near_surface = "from 0.11 s on the largest velocity is near the surface, in a shallow region";
    let mut metrics = vec![stated(FASTEST_DEPTH, inside.fastest_depth, near_surface).gated_by(
        gate(Limit::AtMost(NEAR_SURFACE)).filter(|_| time >= EARLIEST_STATED),
        "1/3: near the surface means the upper third; a uniform velocity would give 1/2",
    )];
    metrics.extend(inside.viscosity_and_depth.map(|correlation| {
        let rises = "the viscosity grows with the distance from the free surface, mainly through the pressure";
        stated(VISCOSITY_AND_DEPTH, correlation, rises).gated_by(
            gate(Limit::AtLeast(0.5)),
            "0.5: midway between no correlation (0) and a viscosity that always rises with depth (1)",
        )
    }));
    let correlations = inside.viscosity_and_pressure.zip(inside.viscosity_and_shear_rate);
    metrics.extend(correlations.map(|(pressure, rate)| {
        let looks =
            "the field of the viscosity looks like that of the pressure and hides the effect of the strain rate";
        stated(VISCOSITY_LIKE_PRESSURE, pressure.abs() - rate.abs(), looks)
            .gated_by(gate(Limit::AtLeast(0.0)), "0: above it, viscosity follows pressure more than shear rate")
    }));
    let (surface, bed) = inside.surface_and_bed_viscosity;
    let observed = [
        (SURFACE_VISCOSITY, surface),
        (BED_VISCOSITY, bed),
        (SHEARED_DEPTH, Some(inside.sheared_depth)),
        (INERTIA_CONTRAST, inside.inertia_contrast),
    ];
    metrics.extend(observed.into_iter().filter_map(|(quantity, value)| Some(of(quantity, value?))));
    let stations = stations(time, run, record);
    if let [_, middle, _] = stations.as_slice()
        && let Some(ratio) = linear_misfit_ratio(middle, run.spacing())
    {
        metrics.push(of(LINEAR_MISFIT_RATIO, ratio));
        let (least, most) = range(stations.iter().map(mean_velocity));
        metrics.push(of(UNIFORMITY, least / most));
    }
    metrics.extend(inside.front_viscosity.map(|viscosity| {
        let falls = "statement: towards the front it falls to less than 0.7 Pa·s; the scan leaves the digit in doubt";
        of(FRONT_VISCOSITY, viscosity).against(Some(0.7), falls, Confidence::Unverified)
    }));
    Some(metrics)
}
