//! Pairs of runs that start from one kept state, slower and faster than it flows, judged at the flow between them that would not
//! change: from the rates at which both approach it.

use super::continuum::{Compared, beside_layer, momentum_residual};
use super::*;
use crate::channel::ProfilePoint;
use crate::metric::MetricKind;
use crate::reference::one_dimension::bed_load::LayerState;
use crate::statistics::{BlockProfile, Extrapolation, interpolated};

/// Half a grain above the bed `[m]`.
const NEAR: f64 = 2.5e-3;

/// Difference of a deficit from the layers' `[u_*]`.
const DEFICIT: f64 = 0.6;

/// A slower and a faster run from one state.
struct Pair<'r> {
    slow: &'r BedLoadRecord,
    fast: &'r BedLoadRecord,
    /// Share of the way from the slower run to the faster one at which the stream would not change `[-]`.
    share: f64,
}

impl<'r> Pair<'r> {
    /// The pair of a faster run.
    fn of(records: &'r [BedLoadRecord], fast: &'r BedLoadRecord) -> Option<Self> {
        let is_slow = |(run, _): &&BedLoadRecord| fast.0.has_another_start_than(run) && run.start() < fast.0.start();
        let slow = records.iter().find(is_slow).filter(|_| fast.0.continuum.start_state == StartState::Kept)?;
        let [slower, faster] = [slow, fast].map(|(_, run)| run.data.channel.trend(&run.data.stream_velocity));
        Some(Self { slow, fast, share: slower / (slower - faster) })
    }

    /// The value between those of both runs.
    fn between(&self, of: impl Fn(&'r BedLoadRecord) -> f64) -> f64 {
        let [slow, fast] = [self.slow, self.fast].map(of);
        slow + self.share * (fast - slow)
    }

    /// A statistic of the profile between those of both runs, with their errors.
    fn estimate(
        &self,
        of: impl Fn(&'r BedLoadObservation) -> &'r BlockProfile,
        statistic: impl Fn(&[ProfilePoint]) -> f64,
    ) -> FittedValue {
        let [slow, fast] = [self.slow, self.fast].map(|(_, record)| of(&record.data));
        let none = (Extrapolation::Nothing, Extrapolation::Nothing);
        let between = |slow: &[ProfilePoint], fast: &[ProfilePoint]| {
            let fast: Vec<(f64, f64)> = fast.iter().map(|point| (point.height, point.velocity)).collect();
            let point = |point: &ProfilePoint| {
                let faster = interpolated(&fast, point.height, none)?;
                Some(ProfilePoint { velocity: point.velocity + self.share * (faster - point.velocity), ..*point })
            };
            statistic(&slow.iter().filter_map(point).collect::<Vec<_>>())
        };
        let slow_error = slow.estimate(|points| between(points, &fast.points()));
        let fast_error = fast.estimate(|points| between(&slow.points(), points)).standard_error;
        FittedValue { standard_error: slow_error.standard_error.hypot(fast_error), ..slow_error }
    }

    /// q*, interpolated as q*^(2/3), which is linear in the excess of the stress in formulas of transport.
    fn transport(&self) -> FittedValue {
        let [slow, fast] = [self.slow, self.fast].map(|(_, record)| record.data.mean_transport());
        let linear = self.between(|(_, record)| libm::cbrt(record.data.mean_transport().value).powi(2));
        let standard_error = (0.5 * slow.standard_error).hypot(0.5 * fast.standard_error);
        FittedValue { value: libm::pow(linear, 1.5), standard_error }
    }
}

/// Metrics of the pair that a run is the faster one of.
pub(super) fn of_pair(records: &[BedLoadRecord], fast: &BedLoadRecord) -> Vec<Metric> {
    let (Some(pair), Some(layer)) = (Pair::of(records, fast), &fast.1.data.layer) else { return Vec::new() };
    let run = &fast.0;
    let starts = Value::list([pair.slow.0.start(), run.start()]);
    let variant = Variant::of("formulation", run.formulation.name()).and("slope", run.slope).and("start", starts);
    let water = |statistic: &dyn Fn(&[ProfilePoint]) -> f64| pair.estimate(|data| &data.channel.profile, statistic);
    let grains = |statistic: &dyn Fn(&[ProfilePoint]) -> f64| pair.estimate(|data| &data.sediment, statistic);
    let mut metrics = vec![
        STEADY_START
            .of(&variant, pair.between(|(run, _)| run.start()))
            .exactly(1.0, "the state is steady")
            .with_snapshot_tolerance(0.0, 2e-3)
            .gated(Limit::Within(0.98, 1.02), "2 %: profiles of state and runs, each shifted by 0.1 u_* of 10 u_*"),
    ];
    let residual = pair.between(|(_, record)| record.data.channel.momentum.residual());
    metrics.push(momentum_residual(&variant, residual));
    let compared = Compared {
        water_rms: water(&|points| profiles::fluid_rms(run, points, layer)),
        water_mean: water(&|points| profiles::fluid_mean(run, points, layer)),
        grain_rms: grains(&|points| profiles::grain_rms(run, points, layer)),
        drag: pair.between(|(_, record)| profiles::drag_ratio(&record.data.drag_profile(), layer)),
        transport: pair.transport(),
    };
    metrics.extend(beside_layer(run, &variant, layer, compared, (true, true)));
    metrics.extend(curvatures(&variant, true, |above| grains(&|points| profiles::grain_curvature(run, points, above))));
    let is_rest = |(other, _): &&BedLoadRecord| other.rests() && other.slope == run.slope;
    let Some((_, Recorded { data: rest, .. })) = records.iter().find(is_rest) else { return metrics };
    let Some(rest_layer) = &rest.layer else { return metrics };
    let heights = [(NEAR_BED_DEFICIT, NEAR), (OUTER_DEFICIT, 0.5 * run.depth)];
    metrics.extend(heights.map(|(quantity, height)| {
        let at = |points: &[ProfilePoint]| profiles::velocity_at(run, points, height);
        let [own, rest] = [water(&at), rest.channel.profile.estimate(at)];
        let standard_error = own.standard_error.hypot(rest.standard_error);
        let estimate = FittedValue { value: own.value - rest.value, standard_error };
        let of_layer = |layer: &LayerState| layer.at(height).fluid_velocity / run.clear_water().friction_velocity();
        let expected = of_layer(layer) - of_layer(rest_layer);
        channel::observed(quantity, &variant, estimate, 1.0)
            .of_kind(MetricKind::Verification)
            .exactly(expected, "the 1-D layers over a moving bed and over one at rest")
            .gated(
                Limit::Within(expected - DEFICIT, expected + DEFICIT),
                "0.6 u_*: over held grains a shift by a fifth of a 1 mm spacing at 2.9 u_* per mm",
            )
    }));
    metrics
}
