//! Pairs of runs that start from one kept state, slower and faster than it flows, judged at the flow between them that would not
//! change: from the rates at which both approach it.

use super::continuum::beside_layer;
use super::*;
use crate::metric::MetricKind;
use crate::reference::one_dimension::bed_load::LayerState;
use crate::statistics::{BlockProfile, FittedValue};

/// Half a grain above the bed `[m]`.
const NEAR: f64 = 2.5e-3;
/// Difference of a deficit from the layers' `[u_*]`.
const DEFICIT: f64 = 0.6;

/// What is seen of the flow at a share of the way from a slower run to a faster one `[-]`.
fn between(slow: &BedLoadObservation, fast: &BedLoadObservation, share: f64) -> BedLoadObservation {
    let mut mixed = slow.clone();
    let mix = |own: &mut f64, other: f64| *own += share * (other - *own);
    let mix_profile = |own: &mut BlockProfile, other: &BlockProfile| {
        let sums = own.sums.iter_mut().flatten().zip(other.sums.iter().flatten());
        for (own, other) in sums.filter(|(_, other)| other.samples > 0.0) {
            mix(&mut own.velocity, other.velocity / other.samples * own.samples);
        }
    };
    mix_profile(&mut mixed.channel.profile, &fast.channel.profile);
    mix_profile(&mut mixed.sediment, &fast.sediment);
    for (own, other) in mixed.carried.iter_mut().flatten().zip(fast.carried.iter().flatten()) {
        mix(&mut own.volume, other.volume);
        mix(&mut own.force, other.force);
    }
    for (own, other) in mixed.transport.iter_mut().zip(&fast.transport) {
        // in formulas of transport q*^(2/3) is linear in the excess of the stress
        *own = libm::cbrt(*own).powi(2);
        mix(own, libm::cbrt(*other).powi(2));
        *own = libm::pow(own.max(0.0), 1.5);
    }
    let (own, other) = (&mut mixed.channel.momentum, &fast.channel.momentum);
    mix(&mut own.before, other.before);
    mix(&mut own.after, other.after);
    mix(&mut own.held, other.held);
    mixed
}

/// The flow between a pair of runs that would not change, by the faster run of the pair.
pub(in super::super) struct SteadyFlow {
    /// Starts of both runs and of the flow between them `[-]`.
    starts: [f64; 3],
    pub(in super::super) data: BedLoadObservation,
}

impl SteadyFlow {
    /// Gives nothing for a run that is not the faster one of a pair.
    pub(in super::super) fn of(records: &[BedLoadRecord], (run, fast): &BedLoadRecord) -> Option<Self> {
        let is_slower = |other: &BedLoadFlow| run.has_another_start_than(other) && other.start() < run.start();
        let (slow_run, slow) = records.iter().find(|(other, _)| run.is_kept() && is_slower(other))?;
        let [slower, faster] = [slow, fast].map(|record| record.data.channel.trend(&record.data.stream_velocity));
        let share = slower / (slower - faster);
        let start = slow_run.start() + share * (run.start() - slow_run.start());
        Some(Self { starts: [slow_run.start(), run.start(), start], data: between(&slow.data, &fast.data, share) })
    }
}

/// Metrics of the pair that a run is the faster one of.
pub(super) fn of_pair(records: &[BedLoadRecord], record: &BedLoadRecord) -> Vec<Metric> {
    let Some(SteadyFlow { starts: [slow, fast, start], data }) = SteadyFlow::of(records, record) else {
        return Vec::new();
    };
    let run = &record.0;
    let starts = Value::list([slow, fast]);
    let variant = Variant::of("formulation", run.formulation.name()).and("slope", run.slope);
    let variant = variant.and("start", starts).and("spacing", run.spacing());
    let mut metrics = vec![
        STEADY_START
            .of(&variant, start)
            .exactly(1.0, "the kept state is steady")
            .with_snapshot_tolerance(0.0, 2e-3)
            .gated(Limit::Within(0.98, 1.02), "2 %: kept state and runs may each err by 0.1 u_*, 1 % of mean velocity"),
    ];
    metrics.extend(beside_layer(run, &data, &variant, (true, true)));
    let rest = records.iter().find(|(other, _)| other.rests() && other.slope == run.slope).map(|(_, rest)| &rest.data);
    let layers = data.layer.as_ref().zip(rest.and_then(|rest| rest.layer.as_ref()));
    let (Some(rest), Some(layers)) = (rest, layers) else { return metrics };
    metrics.extend([(NEAR_BED_DEFICIT, NEAR), (OUTER_DEFICIT, 0.5 * run.depth)].map(|(quantity, height)| {
        let at = |data: &BedLoadObservation| {
            data.channel.profile.estimate(|points| profiles::velocity_at(run, points, height))
        };
        let [own, held] = [at(&data), at(rest)];
        let standard_error = own.standard_error.hypot(held.standard_error);
        let estimate = FittedValue { value: own.value - held.value, standard_error };
        let of_layer = |layer: &LayerState| layer.at(height).fluid_velocity / run.clear_water().friction_velocity();
        let expected = of_layer(layers.0) - of_layer(layers.1);
        channel::observed(quantity, &variant, estimate, 1.0)
            .of_kind(MetricKind::Verification)
            .exactly(expected, "the 1-D layers over a moving bed and over one at rest")
            .gated(
                Limit::Within(expected - DEFICIT, expected + DEFICIT),
                "0.6 u_*: expected error of bed levels uncertain by 0.2 mm, where velocity grows by 2.9 u_*/mm",
            )
    }));
    metrics
}
