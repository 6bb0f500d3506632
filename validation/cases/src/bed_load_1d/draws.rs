//! Input uncertainty by the closures: layers whose closures are drawn from their ranges, each beside its bed at rest.

use super::flow::{BedLoad1dFlow, BedMotion};
use crate::case::ParameterError;
use crate::checkpoint::is_interrupted;
use crate::metric::{Metric, MetricKind, Origin};
use crate::reference::one_dimension::bed_load::{Closures, InitialVelocity, LayerState};
use crate::sampling::design::sobol;
use bagnold_solver::material::drag::DragLaw;
use serde::{Deserialize, Serialize};

/// Drag laws of equal weight; Gidaspow's jumps at a fraction of 0.2 and gives no steady state.
const DRAGS: [DragLaw; 5] =
    [DragLaw::DiFelice, DragLaw::Ergun, DragLaw::MorsiAlexander, DragLaw::WenYu, DragLaw::SchillerNaumann];

/// The drag that the bed-load paper takes.
const PAPER_DRAG: DragLaw = DragLaw::MorsiAlexander;

/// Least and largest value of a closure over its usual one `[-]`: μ_s, μ_2, I_0, φ_max and B as in
/// `reference-data/bed-load-1d/uncertainty.toml`, whose sources stand there. κ 0.38 to 0.42 is assumed about measured values; the origin 0.15
/// to 0.3 d below the tops of resting grains is that of `closures.csv` (Nezu & Nakagawa 1993).
const RANGES: [(f64, f64); 7] = [
    (0.3 / 0.35, 0.4 / 0.35),
    (0.64 / 0.97, 1.2 / 0.97),
    (0.3 / 0.69, 1.0 / 0.69),
    (0.55 / 0.6, 0.64 / 0.6),
    (0.15 / 0.31, 0.62 / 0.31),
    (0.38 / 0.41, 0.42 / 0.41),
    (0.75, 1.5),
];

/// Least and largest length over which the bed's roughness fades, over the usual 0.03 d `[-]`: 0.01 to 0.3 d, of even logarithm.
const FADE: (f64, f64) = (1.0 / 3.0, 10.0);

/// A layer of other closures, moving and at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DrawnLayer {
    /// Closures of the draw.
    pub closures: Closures,
    /// Steady layer with these closures.
    pub state: LayerState,
    /// Layer over the same bed at rest.
    pub rest: LayerState,
}

/// Layers of drawn closures.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Draws {
    /// The default with the paper's drag.
    pub paper: Option<DrawnLayer>,
    /// The draws, by their number; none without a steady state. A number has the same closures on every slope.
    pub drawn: Vec<Option<DrawnLayer>>,
}

/// Number of draws of the closures.
pub(super) fn drawn_closures(own: &Closures, number: usize) -> Vec<Closures> {
    sobol(number, RANGES.len() + 2, 1).iter().map(|point| closures(own, point)).collect()
}

/// Closures of a point of the unit cube.
fn closures(own: &Closures, point: &[f64]) -> Closures {
    let between = |(low, high): (f64, f64), share: f64| low + (high - low) * share;
    let factor = |place: usize| between(RANGES[place], point[place + 2]);
    let mut drawn = *own;
    drawn.drag = DRAGS[((DRAGS.len() as f64 * point[0]) as usize).min(DRAGS.len() - 1)];
    drawn.grain_roughness.bed_roughness_fade_length *= FADE.0 * libm::pow(FADE.1 / FADE.0, point[1]);
    drawn.static_friction *= factor(0);
    drawn.limiting_friction *= factor(1);
    drawn.reference_inertia *= factor(2);
    drawn.largest_fraction *= factor(3);
    drawn.dilation *= factor(4);
    drawn.karman *= factor(5);
    drawn.grain_roughness.origin_depth *= factor(6);
    drawn
}

/// The steady layer from rest; none where it does not become steady or where the closures break a rule.
pub(super) fn steady(flow: &BedLoad1dFlow) -> Result<Option<LayerState>, ParameterError> {
    if flow.closures.problem().is_some() {
        return Ok(None);
    }
    let approach = flow.layer().and_then(|layer| layer.approach_unless(InitialVelocity::Rest, &is_interrupted));
    if is_interrupted() {
        return Err(ParameterError::Interrupted);
    }
    Ok(approach.ok().filter(|approach| approach.unsteady.is_none()).map(|approach| approach.state))
}

/// The layer of a flow with other closures and the bed at rest beside it; none without a steady state or where the closures break a rule.
fn layer(flow: &BedLoad1dFlow, closures: Closures) -> Result<Option<DrawnLayer>, ParameterError> {
    let steady = |motion| steady(&BedLoad1dFlow { closures, motion, ..flow.clone() });
    let states = (steady(BedMotion::Dilating)?, steady(BedMotion::AtRest)?);
    Ok(states.0.zip(states.1).map(|(state, rest)| DrawnLayer { closures, state, rest }))
}

impl Draws {
    /// The draws that a flow asks for.
    ///
    /// # Errors
    /// A run that was interrupted.
    pub(super) fn of(flow: &BedLoad1dFlow) -> Result<Self, ParameterError> {
        if flow.closure_draws == 0 {
            return Ok(Self::default());
        }
        let drawn = drawn_closures(&flow.closures, flow.closure_draws).into_iter().map(|own| layer(flow, own));
        Ok(Self {
            paper: layer(flow, Closures { drag: PAPER_DRAG, ..flow.closures })?,
            drawn: drawn.collect::<Result<_, _>>()?,
        })
    }
}

/// Adds to what is stated or measured what the draws leave open of it: the deviation of the same metrics of each draw.
pub(super) fn known_to_closures(metrics: Vec<Metric>, draws: &[Vec<Metric>]) -> Vec<Metric> {
    let with_draws = |metric: Metric| {
        let is_model = matches!(metric.kind, MetricKind::Validation | MetricKind::Statement);
        let is_same = |other: &&Metric| other.name == metric.name && other.variant == metric.variant;
        let values = draws.iter().filter_map(|draw| draw.iter().find(is_same).map(|found| found.value));
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        if !is_model || values.len() < 3 {
            return metric;
        }
        values.sort_by(f64::total_cmp);
        let (mean, variance) = crate::statistics::mean_and_variance(values.iter().copied());
        let (low, high) = nine_tenths(&values);
        let words = format!(
            "{} draws of the closures over the ranges of the literature (five drag laws, length over which the bed's roughness fades, \
             friction, dilation, κ): mean {mean:.3}, nine tenths of them {low:.3} to {high:.3}",
            values.len()
        );
        metric.known_to(Origin::Input, Some(variance.sqrt()), &words)
    };
    metrics.into_iter().map(with_draws).collect()
}

/// Ends of the middle nine tenths of sorted values.
pub(super) fn nine_tenths(sorted: &[f64]) -> (f64, f64) {
    let at = |share: f64| sorted[(share * (sorted.len() - 1) as f64).round() as usize];
    (at(0.05), at(0.95))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_spread_over_the_ranges_and_keep_the_rules() {
        let own = Closures::default();
        let points = sobol(64, RANGES.len() + 2, 1);
        let drawn: Vec<Closures> = points.iter().map(|point| closures(&own, point)).collect();
        assert!(drawn.iter().all(|closures| closures.problem().is_none()));
        for law in DRAGS {
            let number = drawn.iter().filter(|closures| closures.drag == law).count();
            assert!((10..=16).contains(&number), "{law:?}: {number} of 64");
        }
        let fades = drawn.iter().map(|closures| closures.grain_roughness.bed_roughness_fade_length);
        let (low, high) = fades.fold((f64::INFINITY, 0.0_f64), |(low, high), own| (low.min(own), high.max(own)));
        assert!(low > 0.01 && low < 0.012 && high < 0.3 && high > 0.25, "{low} to {high}");
    }

    /// The ranges by which comparisons with measurements are propagated are the ranges that are drawn from.
    #[test]
    fn ranges_are_those_of_the_stated_uncertainty() {
        let text = include_str!("../../../../reference-data/bed-load-1d/uncertainty.toml");
        let usual = Closures::default();
        let own = [
            ("closures.static_friction", usual.static_friction, RANGES[0]),
            ("closures.limiting_friction", usual.limiting_friction, RANGES[1]),
            ("closures.reference_inertia", usual.reference_inertia, RANGES[2]),
            ("closures.largest_fraction", usual.largest_fraction, RANGES[3]),
            ("closures.dilation", usual.dilation, RANGES[4]),
            (
                "closures.grain_roughness.bed_roughness_fade_length",
                usual.grain_roughness.bed_roughness_fade_length,
                FADE,
            ),
        ];
        for (path, value, (low, high)) in own {
            let stated = |end: &str| -> f64 {
                let begin = format!("{end} = [\"{path}=");
                let rest = text.lines().find_map(|line| line.strip_prefix(&begin)).expect("a range of the file");
                rest.trim_end_matches("\"]").parse().expect("a number")
            };
            let is_near = |drawn: f64, stated: f64| (drawn / stated - 1.0).abs() < 1e-12;
            assert!(is_near(value * low, stated("low")) && is_near(value * high, stated("high")), "{path}");
        }
    }

    #[test]
    fn a_spread_is_that_of_the_same_metric_alone() {
        let of = |name: &str, value: f64| {
            crate::bed_load_1d::quantities::VELOCITY_DEFICIT.of(&crate::metric::Variant::of("height", name), value)
        };
        let draws: Vec<Vec<Metric>> =
            [1.0, 2.0, 3.0].iter().map(|&value| vec![of("a", value), of("b", 7.0 * value)]).collect();
        let known = known_to_closures(vec![of("a", 2.0), of("c", 1.0)], &draws);
        assert_eq!(known[0].uncertainty.standard(), Some(1.0));
        assert_eq!(known[1].uncertainty.standard(), None);
    }
}
