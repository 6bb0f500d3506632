//! How grains move: how many rows of them at once, whether the water among them follows a power of the height, and what streams of
//! about the same Shields number carried in flumes.

use super::super::flow::BedLoad1dFlow;
use super::super::quantities::{
    LOWEST_LAYER_EXPONENT, POWER_LAW_MISFIT, POWER_LAW_MISFIT_RATIO, ROWS_IN_MOTION, TRANSPORT_OVER_MEASURED,
};
use super::super::records::lowest_layer;
use crate::case::Flow;
use crate::metric::{Confidence, Limit, Metric, Origin};
use crate::reference::bed_load::{
    MEASURED_TRANSPORT, SHEET_FLOW_LOWEST_VELOCITY, TransportFormula, measured_rates_about,
};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::reference::points::{MeasuredBand, MeasuredPoints};
use crate::statistics::{linear_fit, power_law};

/// Fewest cells that a power is fitted to.
const FEWEST: usize = 6;

/// Rows of packed grains that the moving ones make `[-]`: ∫ φ dz over φ_max d, where they are faster than `speed` `[m/s]`.
fn rows_in_motion(run: &BedLoad1dFlow, state: &LayerState, speed: f64) -> f64 {
    let moving = state.solid_fraction.iter().zip(&state.grain_velocity).filter(|(_, velocity)| **velocity > speed);
    let volume: f64 = moving.map(|(fraction, _)| fraction * state.cell_height).sum();
    volume / (run.closures.largest_fraction * run.grain_diameter)
}

/// How well a power c zⁿ describes a velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PowerMisfit {
    /// Root mean square misfit over the largest velocity `[-]`.
    relative: f64,
    /// The same misfit over that of a + b ln z, both of two constants by least squares of the velocity; the power's exponent is taken
    /// from the logarithms `[-]`.
    over_logarithm: f64,
}

impl PowerMisfit {
    /// None without a fit.
    fn of(points: &[(f64, f64)]) -> Option<Self> {
        let law = power_law(points)?;
        let mean = |squares: f64| (squares / points.len() as f64).sqrt();
        // the power has no constant of its own, so that its exponent is its second one
        let power = |z: f64| libm::pow(z, law.value);
        let scale = points.iter().map(|&(z, u)| u * power(z)).sum::<f64>()
            / points.iter().map(|&(z, _)| power(z) * power(z)).sum::<f64>();
        let of_power = mean(points.iter().map(|&(z, u)| (u - scale * power(z)).powi(2)).sum());
        let logarithms: Vec<(f64, f64)> = points.iter().map(|&(z, u)| (libm::log(z), u)).collect();
        let line = linear_fit(&logarithms)?;
        let of_line = mean(logarithms.iter().map(|(x, u)| (u - line.intercept - line.slope * x).powi(2)).sum());
        let fastest = points.iter().map(|point| point.1).fold(0.0, f64::max);
        Some(Self { relative: of_power / fastest, over_logarithm: of_power / of_line })
    }
}

/// What a layer of the case's own closures says of the regime of transport.
pub(super) fn metrics(run: &BedLoad1dFlow, state: &LayerState, speed: f64) -> Vec<Metric> {
    let variant = run.variant();
    let single = "statements of the bed-load paper: up to 3 % grains saltate, one by one, and under stronger shear upper layers of them slide \
                  over lower ones, which takes more than a row";
    let power = "statement of the bed-load paper after Sumer et al.: in the lowest layer the profile is a power law and bends in \
                 half-logarithmic axes, where a logarithm is straight";
    let rows = ROWS_IN_MOTION.of(&variant, rows_in_motion(run, state, speed)).against(None, single, Confidence::Medium);
    let mut metrics = vec![rows.with_snapshot_tolerance(1e-3, 0.0)];
    let points = lowest_layer(run, state, speed);
    let (measured, law) = (&*SHEET_FLOW_LOWEST_VELOCITY, power_law(&points).filter(|_| points.len() >= FEWEST));
    if let (Some(law), Some(misfit)) = (law, PowerMisfit::of(&points)) {
        let misfits = [
            POWER_LAW_MISFIT.of(&variant, 100.0 * misfit.relative),
            POWER_LAW_MISFIT_RATIO.of(&variant, misfit.over_logarithm),
        ];
        let theirs = "standard error of the fit to their points";
        let exponent = LOWEST_LAYER_EXPONENT
            .of(&variant, law.value)
            .against(Some(measured.law.value), &measured.source, measured.confidence)
            .known_to(Origin::Digitisation, Some(measured.law.standard_error), theirs)
            .known_to(Origin::Numerical, Some(law.standard_error), "standard error of the fit to the cells");
        let misfits = misfits.map(|misfit| misfit.against(None, power, Confidence::Medium));
        metrics.extend(misfits.into_iter().chain([exponent]).map(|own| own.with_snapshot_tolerance(0.01, 0.0)));
    }
    metrics
}

/// Transport against the runs of flumes at about the same Shields number; none where there are too few.
pub(super) fn beside_measured(run: &BedLoad1dFlow, state: &LayerState) -> Option<Metric> {
    let shields = run.stream().shields_number();
    let MeasuredBand { median, bounds, deviation, number } = measured_rates_about(shields)?;
    let MeasuredPoints { source, confidence, .. } = &*MEASURED_TRANSPORT;
    let expected = median * TransportFormula::WongParker.transport(shields);
    let scatter = "half of the width of the middle two thirds of the runs within a factor of 1.3 in the Shields number, each over Wong & \
                   Parker's formula";
    let reason = "limits enclose 90 % of rates measured within a factor of 1.3 in Shields number";
    let metric = TRANSPORT_OVER_MEASURED
        .of(&run.variant(), state.transport() / expected)
        .against(Some(1.0), &format!("median of {number} runs, {source}"), *confidence)
        .known_to(Origin::Experiment, Some(deviation / median), scatter)
        .gated(Limit::Within(bounds.0 / median, bounds.1 / median), reason)
        .with_snapshot_tolerance(1e-3, 0.0);
    Some(metric)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_told_from_a_logarithm() {
        let heights: Vec<f64> = (1..=20).map(|k| 0.1 * f64::from(k)).collect();
        let of = |velocity: fn(f64) -> f64| heights.iter().map(|&z| (z, velocity(z))).collect::<Vec<_>>();
        let power = PowerMisfit::of(&of(|z| 3.0 * libm::pow(z, 0.75))).expect("points");
        assert!(power.over_logarithm < 1e-9 && power.relative < 1e-9, "{power:?}");
        let logarithm = PowerMisfit::of(&of(|z| 6.0 + 2.0 * libm::log(z))).expect("points");
        assert!(logarithm.over_logarithm > 10.0 && logarithm.relative > 0.01, "{logarithm:?}");
        // what bends in both axes is no power either
        let bent = PowerMisfit::of(&of(|z| 0.3 + 3.0 * z * z)).expect("points");
        assert!(bent.relative > 0.05, "{bent:?}");
    }
}
