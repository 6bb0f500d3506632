//! The corner plot of the posterior: histograms of single parameters and samples of every pair.

use super::super::result::{CalibrationResult, ParameterEstimate};
use super::axis;
use crate::figure::{Axis, Figure, Panel};

/// Bins of a histogram.
const BINS: usize = 24;

/// The figure, if samples were asked for.
pub(super) fn figure(outcome: &CalibrationResult) -> Option<Figure> {
    if outcome.samples.is_empty() {
        return None;
    }
    let count = outcome.parameters.len();
    let mut panels: Vec<Panel> = (0..count).map(|k| histogram(&outcome.parameters[k], &column(outcome, k))).collect();
    for first in 0..count {
        for second in first + 1..count {
            panels.push(pair(outcome, first, second));
        }
    }
    let caption = "Samples of the posterior on the emulator, for each parameter and each pair of parameters. The \
                   prior is uniform over the ranges.";
    Some(Figure::new("corner", caption, panels).in_columns(count.clamp(1, 3)))
}

fn column(outcome: &CalibrationResult, k: usize) -> Vec<f64> {
    outcome.samples.iter().map(|sample| sample[k]).collect()
}

/// Share of the samples in each bin, as steps.
fn histogram(parameter: &ParameterEstimate, values: &[f64]) -> Panel {
    let scaled = |value: f64| if parameter.logarithmic { libm::log(value) } else { value };
    let (low, high) = values
        .iter()
        .map(|value| scaled(*value))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let width = (high - low).max(f64::MIN_POSITIVE) / BINS as f64;
    let mut counts = [0usize; BINS];
    for value in values {
        counts[(((scaled(*value) - low) / width) as usize).min(BINS - 1)] += 1;
    }
    let edge = |bin: usize| {
        let scaled = low + bin as f64 * width;
        if parameter.logarithmic { libm::exp(scaled) } else { scaled }
    };
    let share = |count: usize| count as f64 / values.len() as f64;
    let steps = (0..BINS).flat_map(|bin| [(edge(bin), share(counts[bin])), (edge(bin + 1), share(counts[bin]))]);
    let mut panel = Panel::new("", axis(parameter), Axis::linear("share of samples [-]"));
    panel.line("posterior", 0, steps);
    panel.points("best", 1, [(parameter.best, 0.0)]);
    panel
}

fn pair(outcome: &CalibrationResult, first: usize, second: usize) -> Panel {
    let (x, y) = (&outcome.parameters[first], &outcome.parameters[second]);
    let mut panel = Panel::new("", axis(x), axis(y));
    panel.points("posterior", 0, column(outcome, first).into_iter().zip(column(outcome, second)));
    panel.points("best", 1, [(x.best, y.best)]);
    panel
}
