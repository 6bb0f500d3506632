//! Grains as volume fractions against the 1-D layer of the same closures.

use super::*;

/// Averaging time from which on a run beside the 1-D layer is judged whether it still changes or not `[s]`.
const JUDGED_FROM: f64 = 1.5;
/// Shortest averaging time of a flow that is judged because it no longer changes `[s]`.
const SHORTEST: f64 = 0.5;
/// Largest change of the stream's velocity over U/(2 g i) of such a flow `[-]`.
const STEADY: f64 = 0.02;

/// Spacing below which the transport of dilating grains is judged more closely `[m]`.
const FINE: f64 = 6e-4;

/// Whether a run in the layer's water is compared with the layer: it was watched for long, or it does not change.
fn is_settled(run: &BedLoadFlow, data: &BedLoadObservation) -> bool {
    run.averaging_time >= JUDGED_FROM || (run.averaging_time >= SHORTEST && drift(run, data).abs() <= STEADY)
}

/// Metrics of a run of grains as volume fractions.
pub(super) fn of(record: &BedLoadRecord, forgotten: bool) -> Vec<Metric> {
    let (run, Recorded { data, .. }) = record;
    let variant = run.variant();
    let mut metrics = vec![channel::particles_lost(&variant, &record.1.clone().map(|data| data.channel))];
    metrics.extend(common(record, forgotten));
    // a run from a kept state is one of a pair, or the bed at rest that the pair is compared with
    if run.continuum.start_state == StartState::Layer {
        let judged = run.is_judged() && (forgotten || (run.starts_as_usual() && is_settled(run, data)));
        metrics.extend(beside_layer(run, data, &variant, (judged, forgotten)));
    }
    metrics
}

/// Metrics of a flow beside the layer: whether they are judged, and also by what holds of flows that have forgotten their start.
pub(super) fn beside_layer(
    run: &BedLoadFlow,
    data: &BedLoadObservation,
    variant: &Variant,
    (judged, forgotten): (bool, bool),
) -> Vec<Metric> {
    let dilating = run.dilates();
    let Some(layer) = &data.layer else { return Vec::new() };
    let mut metrics = vec![
        channel::MOMENTUM_RESIDUAL
            .of(variant, data.channel.momentum.residual())
            .exactly(
                0.0,
                "change of momentum = gravity − what held grains and floor take; particles that cross a gradient of φ \
                 change the share of their mass that counts",
            )
            .gated(
                Limit::Within(-0.01, 0.01),
                "0.01: expected residual of particles that cross solid-fraction gradients; drag and pressure only exchange momentum",
            )
            .with_snapshot_tolerance(0.1, 1e-3),
    ];
    let source = "the 1-D layer of the same closures; the water starts at `start` times its velocity";
    let gate = |limit: Limit| judged.then_some(limit);
    let observed =
        |quantity, estimate, exact| channel::observed(quantity, variant, estimate, 1.0).exactly(exact, source);
    let profile = &data.channel.profile;
    let (most, reason) = if dilating {
        (0.1, "0.1 u_*: expected error of profiles shifted by 1/12 of a 1 mm spacing")
    } else {
        (0.25, "0.25 u_*: a profile shifted by 0.2 mm, where velocity grows by 1.4 u_*/mm")
    };
    let rms = profile.estimate(|points| profiles::fluid_rms(run, points, layer));
    let mean = profile.estimate(|points| profiles::fluid_mean(run, points, layer));
    metrics.extend([
        observed(FLUID_VELOCITY_RMS, rms, 0.0).gated_by(gate(Limit::AtMost(most)), reason),
        observed(FLUID_VELOCITY_MEAN, mean, 1.0).gated_by(
            gate(Limit::Within(0.97, 1.03)),
            "3 %: a shifted profile is expected to err by 0.25 u_*, 2.5 % of the depth average",
        ),
    ]);
    if run.formulation == BedLoadFormulation::Porous {
        return metrics;
    }
    let rms = data.sediment.estimate(|points| profiles::grain_rms(run, points, layer));
    let force = profiles::drag_ratio(&data.drag_profile(), layer);
    metrics.extend([
        observed(GRAIN_VELOCITY_RMS, rms, 0.0).gated_by(
            gate(Limit::AtMost(0.2)).filter(|_| !dilating),
            "0.2 u_*: a profile shifted by 0.3 mm, where grain velocity grows by 0.7 u_*/mm",
        ),
        DRAG_RATIO.of(variant, force).exactly(1.0, source).with_snapshot_tolerance(0.0, 0.02).gated_by(
            gate(Limit::Within(0.95, 1.05)).filter(|_| dilating),
            "5 %: expected error of bins cut by the bed's top; the water's stress fixes the total drag",
        ),
    ]);
    let rate = data.mean_transport();
    if dilating && forgotten {
        let expected = run.formula_transport();
        metrics.push(by_formula(channel::observed(PREDICTED_TRANSPORT, variant, rate, 1.0), run).gated(
            Limit::Within(MEASURED_BAND.0 * expected, MEASURED_BAND.1 * expected),
            "limits enclose 90 % of Meyer-Peter & Müller's runs with Shields numbers τ* ≥ 0.1; nothing is fitted",
        ));
    }
    let (within, reason) = match dilating {
        true if run.spacing() < FINE => (0.08, "8 %: about half of the 15 % allowed with a 1 mm spacing"),
        true => (0.15, "15 %: expected error of moving layers that are few spacings thick (one or two at 2 % slope)"),
        false => (0.1, "10 %: the grains' profile may be shifted by a third of a 1 mm spacing"),
    };
    metrics.push(
        channel::observed(TRANSPORT_RATIO, variant, rate, 1.0 / layer.transport())
            .exactly(1.0, source)
            .gated_by(gate(Limit::Within(1.0 - within, 1.0 + within)), reason),
    );
    metrics.extend(grains(variant, run, data, forgotten && dilating));
    metrics
}
