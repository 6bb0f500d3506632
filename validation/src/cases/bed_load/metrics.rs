//! How the runs are judged.

use super::Record;
use super::fit::{self, held_out};
use super::observation::BedLoadObservation;
use super::parameters::{JUDGED_PAIR_LAW, Stage};
use super::profiles::{self, LAYERS};
use super::runs::{BedLoadRun, Formulation};
use crate::case::Run;
use crate::cases::channel;
use crate::metric::{Confidence, Kind, Limit, Metric};
use crate::observe::Recorded;
use crate::reference::{HONEST_BAND, TransportFormula};
use crate::statistics::{Estimate, Segmented, block_average, linear_fit};
use bagnold_solver::incompressible::PairLaw;

/// Standard errors that a value may move before a change is reported `[-]`.
const SNAPSHOT_ERRORS: f64 = 2.0;

/// Averaging time from which on a flow is taken to be settled enough to be judged `[s]`.
const JUDGED_FROM: f64 = 1.5;

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records {
        match &run.formulation {
            Formulation::Paper(_) => printed(&mut metrics, run, record),
            Formulation::Stabilised(_) => stabilised(&mut metrics, run, record),
            Formulation::Fit(_) => metrics.push(transport(run, record)),
            Formulation::Continuum { stage, pair_law, .. } => continuum(&mut metrics, run, record, *stage, *pair_law),
        }
    }
    growth(&mut metrics, records);
    for held in held_out(records) {
        let variant = fit::variant(&held);
        metrics.push(
            Metric::observed("held_out_transport_ratio", &variant, held.ratio, "-")
                .against(Some(1.0), TransportFormula::WongParker.name(), Confidence::High)
                .of_kind(Kind::Validation)
                .gated(
                    Limit::Within(HONEST_BAND.0, HONEST_BAND.1),
                    "yield stress and viscosity are those that fit the two other slopes",
                )
                .with_snapshot_tolerance(0.05, 0.0),
        );
        let values = [
            ("fitted_yield_stress", held.yield_stress, "Pa"),
            ("fitted_viscosity", held.viscosity, "Pa·s"),
            ("fit_misfit", held.misfit, "-"),
            ("fit_at_border", f64::from(u8::from(held.at_border)), "-"),
        ];
        for (name, value, unit) in values {
            metrics.push(Metric::observed(name, &variant, value, unit).with_snapshot_tolerance(0.1, 0.05));
        }
    }
    metrics
}

fn observed(name: &str, variant: &str, estimate: Estimate, factor: f64, unit: &str) -> Metric {
    Metric::observed(name, variant, factor * estimate.value, unit)
        .with_snapshot_tolerance(1e-3, (SNAPSHOT_ERRORS * factor * estimate.standard_error).abs())
}

/// Mean of a series over the window, with its statistical error.
fn average(data: &BedLoadObservation, array: &[f64]) -> Estimate {
    block_average(&data.channel.series.within(array, data.channel.window))
        .unwrap_or(Estimate { value: f64::NAN, standard_error: 0.0 })
}

fn transport(run: &BedLoadRun, record: &Recorded<BedLoadObservation>) -> Metric {
    let formula = TransportFormula::WongParker;
    observed("transport", &run.variant(), average(&record.data, &record.data.transport), 1.0, "-")
        .against(Some(formula.transport(run.stream().shields_number())), formula.name(), Confidence::High)
        .of_kind(Kind::Validation)
}

/// What every run reports.
fn common(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let data = &record.data;
    let mean = run.clear_water().mean_velocity();
    metrics.push(transport(run, record));
    metrics.push(observed("stream_velocity", &variant, average(data, &data.stream_velocity), 1.0 / mean, "-").against(
        Some(1.0),
        "clear water over a fixed bed",
        Confidence::Exact,
    ));
    metrics.push(
        Metric::observed("velocity_drift", &variant, 100.0 * drift(run, data), "%")
            .against(
                Some(0.0),
                "change of the stream's velocity over U/(2 g i), by a line through the window",
                Confidence::Exact,
            )
            .with_snapshot_tolerance(0.2, 0.1),
    );
}

/// Relative change of the stream's velocity over U/(2 g i) `[-]`.
fn drift(run: &BedLoadRun, data: &BedLoadObservation) -> f64 {
    let series = &data.channel.series;
    let time = series.within(&series.time, data.channel.window);
    let velocity = series.within(&data.stream_velocity, data.channel.window);
    let mean = velocity.iter().sum::<f64>() / velocity.len() as f64;
    let points: Vec<(f64, f64)> = time.into_iter().zip(velocity).collect();
    let adjustment = mean / (2.0 * run.materials.gravity * run.slope);
    linear_fit(&points).map_or(f64::NAN, |fit| fit.slope * adjustment / mean)
}

/// The printed set-up: no gate, what it does is the result.
fn printed(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let data = &record.data;
    metrics.push(Metric::observed("end_time", &variant, record.simulated_time, "s").with_snapshot_tolerance(0.05, 0.0));
    let highest = data.channel.series.highest.iter().copied().fold(0.0, f64::max);
    metrics.push(
        Metric::observed("highest_particle", &variant, highest, "h")
            .against(Some(1.0), "the depth of the water", Confidence::Exact)
            .with_snapshot_tolerance(0.1, 0.0),
    );
    let last = data.transport.last().copied().unwrap_or(f64::NAN);
    let formula = TransportFormula::WongParker;
    metrics.push(
        Metric::observed("last_transport", &variant, last, "-")
            .against(Some(formula.transport(run.stream().shields_number())), formula.name(), Confidence::High)
            .of_kind(Kind::Validation)
            .with_snapshot_tolerance(0.2, 1e-3),
    );
}

fn stabilised(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let data = &record.data;
    let outer = record.clone().map(|data| data.channel);
    metrics.push(channel::particles_lost(&variant, &outer));
    metrics.push(channel::momentum_residual(&variant, &outer));
    common(metrics, run, record);
    let judged = run.averaging_time >= JUDGED_FROM && run.slope == 0.03;
    let gated = |metric: Metric, limit, reason: &str| if judged { metric.gated(limit, reason) } else { metric };
    let profile = &data.channel.profile;
    let mut slopes = Vec::new();
    for (name, lower, upper) in LAYERS {
        let estimate = profile.estimate(|points| profiles::semi_log_slope(run, points, lower, upper));
        slopes.push(estimate.value);
        metrics.push(observed("semi_log_slope", &format!("{variant},height={name}"), estimate, 1.0, "-").against(
            Some(1.0),
            "u_*/κ, fitted to u over ln z",
            Confidence::Exact,
        ));
    }
    let ratio = Metric::observed("layer_slope_ratio", &variant, slopes[0] / slopes[3], "-")
        .against(None, "statement of the paper: two layers at 3 %, the lower one less steep", Confidence::Medium)
        .with_snapshot_tolerance(0.1, 0.0);
    metrics.push(gated(
        ratio,
        Limit::AtMost(0.8),
        "two layers: the lower semi-logarithmic slope is smaller by a fifth",
    ));
    layers(metrics, run, record);
    let near = profile.estimate(|points| profiles::deficit(run, points, 2.5e-3));
    let deficit = observed("near_bed_deficit", &variant, near, 1.0, "u_*").against(
        None,
        "statement of the paper: near the bed slower than clear water",
        Confidence::Medium,
    );
    metrics.push(gated(deficit, Limit::AtMost(-0.1), "slower than clear water by a tenth of u_*"));
    let above = profile.estimate(|points| profiles::sheared_borders(run, points).1);
    metrics.push(observed("sheared_up_to", &variant, above, 1e3, "mm"));
    let below = profile.estimate(|points| profiles::sheared_borders(run, points).0);
    metrics.push(observed("sheared_from", &variant, below, 1e3, "mm"));
    grains(metrics, run, data);
}

/// The layers that a segmented regression finds, with the errors of their slopes and borders; observed.
fn layers(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let profile = &record.data.channel.profile;
    let count = profiles::number_of_layers(run, &profile.points());
    // of 2 % the paper says nothing
    let published = match run.slope {
        0.03 => Some(2.0),
        0.05 => Some(3.0),
        _ => None,
    };
    metrics.push(
        Metric::observed("number_of_layers", &variant, count as f64, "-")
            .against(published, "statement of the paper: two layers at 3 %, three at 5 %", Confidence::Medium)
            .of_kind(Kind::Validation)
            // a break more or less is no drift of the flow
            .with_snapshot_tolerance(0.0, 1.0),
    );
    let scale = run.clear_water().semi_logarithmic_slope() / run.clear_water().friction_velocity();
    for layer in 0..count {
        let of = |read: &dyn Fn(&Segmented) -> f64| {
            profile.estimate(|points| profiles::layers(run, points, count).map_or(f64::NAN, |fit| read(&fit)))
        };
        let named = format!("{variant},layer={}", layer + 1);
        let slope = of(&|fit| fit.slopes[layer] / scale);
        metrics.push(observed("layer_slope", &named, slope, 1.0, "-").against(Some(1.0), "u_*/κ", Confidence::Exact));
        if layer + 1 < count {
            let border = of(&|fit| libm::exp(fit.breaks[layer]));
            metrics.push(observed("layer_border", &named, border, 1.0, "d"));
        }
    }
}

/// What is reported of the grains; none of it is gated.
fn grains(metrics: &mut Vec<Metric>, run: &BedLoadRun, data: &BedLoadObservation) {
    let variant = run.variant();
    let layer = data.layer.as_ref();
    let points = data.sediment.points();
    let source = "the 1-D layer";
    let values = [
        (
            "decay_length",
            1e3 * profiles::decay_length(&points),
            "mm",
            layer.and_then(|l| l.decay_length(1e-4)).map(|l| 1e3 * l),
        ),
        (
            "moves_above",
            1e3 * profiles::moves_above(&points, 0.01),
            "mm",
            layer.and_then(|l| l.moves_above(0.01)).map(|z| 1e3 * z),
        ),
    ];
    for (name, value, unit, reference) in values {
        let metric = Metric::observed(name, &variant, value, unit).with_snapshot_tolerance(0.1, 0.5);
        metrics.push(match reference {
            Some(reference) => metric.against(Some(reference), source, Confidence::Exact),
            None => metric,
        });
    }
    for (name, above) in [("grain_curvature_above", true), ("grain_curvature_below", false)] {
        let estimate = data.sediment.estimate(|points| profiles::grain_curvature(run, points, above));
        if estimate.value.is_finite() {
            let metric = observed(name, &variant, estimate, 1.0, "u_*/d²");
            metrics.push(metric.against(
                None,
                "statement of the paper: concave above the top of the bed (−), convex below (+)",
                Confidence::Medium,
            ));
        }
    }
    let drag = data.drag_profile();
    let peak = drag
        .iter()
        .copied()
        .fold((f64::NAN, f64::NEG_INFINITY), |best, point| if point.1 > best.1 { point } else { best });
    metrics.push(Metric::observed("drag_peak_height", &variant, 1e3 * peak.0, "mm").with_snapshot_tolerance(0.1, 1.0));
}

fn continuum(
    metrics: &mut Vec<Metric>,
    run: &BedLoadRun,
    record: &Recorded<BedLoadObservation>,
    stage: Stage,
    pair_law: PairLaw,
) {
    let variant = run.variant();
    let data = &record.data;
    let Some(layer) = &data.layer else { return };
    metrics.push(channel::particles_lost(&variant, &record.clone().map(|data| data.channel)));
    common(metrics, run, record);
    let source = "the 1-D layer of the same closures";
    let judged = run.averaging_time >= JUDGED_FROM && pair_law == JUDGED_PAIR_LAW;
    let gated = |metric: Metric, holds: bool, limit, reason: &str| {
        if judged && holds { metric.gated(limit, reason) } else { metric }
    };
    let water = stage != Stage::Dilating;
    let profile = &data.channel.profile;
    let rms = profile.estimate(|points| profiles::fluid_rms(run, points, layer));
    let metric =
        observed("fluid_velocity_rms", &variant, rms, 1.0, "u_*").against(Some(0.0), source, Confidence::Exact);
    metrics.push(gated(metric, water, Limit::AtMost(0.25), "a quarter of u_* over 0.5 mm … 0.9 h"));
    let mean = profile.estimate(|points| profiles::fluid_mean(run, points, layer));
    let metric =
        observed("fluid_velocity_mean", &variant, mean, 1.0, "-").against(Some(1.0), source, Confidence::Exact);
    metrics.push(gated(metric, water, Limit::Within(0.97, 1.03), "3 % of the depth mean"));
    if stage == Stage::Porous {
        return;
    }
    let rms = data.sediment.estimate(|points| profiles::grain_rms(run, points, layer));
    let metric =
        observed("grain_velocity_rms", &variant, rms, 1.0, "u_*").against(Some(0.0), source, Confidence::Exact);
    metrics.push(gated(metric, stage == Stage::Frozen, Limit::AtMost(0.2), "a fifth of u_* where grains move"));
    let ratio = average(data, &data.transport);
    let within = match stage {
        Stage::Frozen => 0.1,
        _ if run.slope < 0.025 => 0.25,
        _ => 0.15,
    };
    let metric = observed("transport_ratio", &variant, ratio, 1.0 / layer.transport(), "-").against(
        Some(1.0),
        source,
        Confidence::Exact,
    );
    let limit = Limit::Within(1.0 - within, 1.0 + within);
    metrics.push(gated(metric, true, limit, "what discretisation may cost in transport"));
    grains(metrics, run, data);
}

/// More transport and a thicker sheared layer at 5 % than at 3 %.
fn growth(metrics: &mut Vec<Metric>, records: &[Record]) {
    let of = |slope: f64| {
        let found = |(run, _): &&Record| matches!(run.formulation, Formulation::Stabilised(_)) && run.slope == slope;
        records.iter().find(found)
    };
    let (Some((low_run, low)), Some((high_run, high))) = (of(0.03), of(0.05)) else { return };
    if low_run.averaging_time < JUDGED_FROM {
        return;
    }
    let transport = |record: &Recorded<BedLoadObservation>| average(&record.data, &record.data.transport).value;
    let thickness = |run: &BedLoadRun, record: &Recorded<BedLoadObservation>| {
        let (lower, upper) = profiles::sheared_borders(run, &record.data.channel.profile.points());
        upper - lower
    };
    let values = [
        ("transport_growth", transport(high) / transport(low)),
        ("sheared_thickness_growth", thickness(high_run, high) / thickness(low_run, low)),
    ];
    for (name, value) in values {
        metrics.push(
            Metric::observed(name, "formulation=stabilised,slope=0.03_0.05", value, "-")
                .against(None, "statement of the paper: larger at 5 % than at 3 %", Confidence::Medium)
                .gated(Limit::AtLeast(1.05), "larger by more than the scatter of repeats, 3 %")
                .with_snapshot_tolerance(0.05, 0.0),
        );
    }
}
