//! How grains move: how many rows of them at once, whether the water among them follows a power of the height, and what streams of
//! about the same Shields number carried in flumes.

use super::quantities::{
    LOWEST_LAYER_EXPONENT, POWER_LAW_MISFIT, POWER_LAW_MISFIT_RATIO, ROWS_IN_MOTION, TRANSPORT_OVER_MEASURED,
};
use super::records::SolvedLayer;
use super::run::BedLoad1dRun;
use crate::case::Run;
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Confidence, Limit, Metric, Origin};
use crate::reference::bed_load::{
    LOWEST_LAYER_TOP, MeasuredRates, SHEET_FLOW_LOWEST_VELOCITY, TransportFormula, measured_rates_about,
};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::shared::percent;
use crate::statistics::{Exponent, linear_fit, power_law};

/// Fewest cells that a power is fitted to.
const FEWEST: usize = 6;

/// Rows of packed grains that the moving ones make `[-]`: ∫ φ dz over φ_max d, where they are faster than `speed` `[m/s]`.
fn rows_in_motion(run: &BedLoad1dRun, state: &LayerState, speed: f64) -> f64 {
    let moving = state.solid_fraction.iter().zip(&state.grain_velocity).filter(|(_, velocity)| **velocity > speed);
    let volume: f64 = moving.map(|(fraction, _)| fraction * state.cell_height).sum();
    volume / (run.closures.largest_fraction * run.stream.grain_diameter)
}

/// (height above where grains begin to move, over d; u_f/u_*) of the cells among moving grains.
fn lowest_layer(run: &BedLoad1dRun, state: &LayerState, speed: f64) -> Vec<(f64, f64)> {
    let Some(bottom) = state.moves_above(speed) else { return Vec::new() };
    let top = state.top_of_grains();
    let stream = &run.stream;
    let cells = state.height.iter().zip(&state.fluid_velocity).filter(|(z, u)| **z > bottom && **z < top && **u > 0.0);
    cells.map(|(z, u)| ((z - bottom) / stream.grain_diameter, u / stream.shear_velocity())).collect()
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
pub(super) fn metrics(run: &BedLoad1dRun, state: &LayerState, speed: f64) -> Vec<Metric> {
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
        let exponent = LOWEST_LAYER_EXPONENT
            .of(&variant, law.value)
            .against(Some(measured.law.value), &measured.source, measured.confidence)
            .known_to(
                Origin::Digitisation,
                Some(measured.law.standard_error),
                "standard error of the fit to their points",
            )
            .known_to(Origin::Numerical, Some(law.standard_error), "standard error of the fit to the cells");
        let misfits = misfits.map(|misfit| misfit.against(None, power, Confidence::Medium));
        metrics.extend(misfits.into_iter().chain([exponent]).map(|own| own.with_snapshot_tolerance(0.01, 0.0)));
    }
    metrics
}

/// Transport against the runs of flumes at about the same Shields number, with the uncertainty of the ratio to the formula by the
/// closures; none where there are too few.
pub(super) fn beside_measured(run: &BedLoad1dRun, state: &LayerState, input: f64, words: &str) -> Option<Metric> {
    let shields = run.stream.shields_number();
    let MeasuredRates { median, bounds, deviation, number, source, confidence } = measured_rates_about(shields)?;
    let expected = median * TransportFormula::WongParker.transport(shields);
    let metric = TRANSPORT_OVER_MEASURED
        .of(&run.variant(), state.transport() / expected)
        .against(Some(1.0), &format!("median of {number} runs, {source}"), confidence)
        .known_to(
            Origin::Experiment,
            Some(deviation / median),
            "half of the width of the middle two thirds of the runs within a factor of 1.3 in the Shields number, each over Wong & \
             Parker's formula",
        )
        .known_to(Origin::Input, Some(input / median), words)
        .gated(
            Limit::Within(bounds.0 / median, bounds.1 / median),
            "nine tenths of the measured runs within a factor of 1.3 in the Shields number lie there, each over Wong & Parker's formula",
        )
        .with_snapshot_tolerance(1e-3, 0.0);
    Some(metric)
}

/// The water among moving grains beside the measured sheet flow.
pub(super) fn figure(layers: &[SolvedLayer<'_>], speed: f64) -> Option<Figure> {
    let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
    let mut panel = Panel::new(
        "",
        Axis::logarithmic("height above the grains at rest, over d [-]"),
        Axis::logarithmic("u_f/u_* [-]"),
    );
    panel.points("Sumer et al. 1996, τ* = 1.4", 0, measured.points.iter().copied());
    let fit = |name: &str, law: Exponent, range: (f64, f64)| {
        let point = |z: f64| (z, law.coefficient * libm::pow(z, law.value));
        let label = format!("{name}: exponent {:.2} ± {:.2}", law.value, law.standard_error);
        (label, [point(range.0), point(range.1)])
    };
    let range = |points: &[(f64, f64)]| Some((points.first()?.0, points.last()?.0));
    let lowest: Vec<(f64, f64)> = measured.points.iter().copied().filter(|point| point.0 <= LOWEST_LAYER_TOP).collect();
    let (entry, line) = fit("lowest layer of Sumer et al.", measured.law, range(&lowest)?);
    panel.reference(&entry, line);
    let mut bends = Vec::new();
    for (slot, (run, state)) in layers.iter().enumerate() {
        let points = lowest_layer(run, state, speed);
        let (Some(law), Some(ends)) = (power_law(&points), range(&points)) else { continue };
        let (entry, line) = fit(&percent(run.stream.slope), law, ends);
        let local = points.windows(2).filter_map(power_law).map(|law| law.value);
        let (least, most) = local.fold((f64::INFINITY, 0.0_f64), |(least, most), n| (least.min(n), most.max(n)));
        bends.push(format!("{least:.2} to {most:.2} at {}", percent(run.stream.slope)));
        panel.line(&entry, slot + 1, points);
        panel.reference("", line);
    }
    let caption = format!(
        "Velocity of the water among moving grains over the height above the grains at rest, where a power law is straight. Dashed are the \
         fits, each over its range, with the standard error of the exponent from the scatter about the fit. The layers bend: their local \
         exponents are {}. Points are the sheet flow that Sumer et al. (1996) measured at a much greater Shields number, whose columns are \
         inferred. Its lowest layer are the points up to {LOWEST_LAYER_TOP} d.",
        bends.join(", ")
    );
    Some(Figure::new("lowest-layer", &caption, vec![panel]))
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
