//! A panel for every pair of parameters: values that agree with the data, on every branch, within the box of the search.

use super::super::result::CalibrationResult;
use super::axis;
use crate::figure::{Figure, Panel};

/// The figure; none for fewer than two parameters or without a region.
pub(super) fn figure(outcome: &CalibrationResult) -> Option<Figure> {
    let count = outcome.parameters.len();
    if count < 2 || outcome.region.is_empty() {
        return None;
    }
    let pairs = (0..count).flat_map(|first| (first + 1..count).map(move |second| (first, second)));
    let panels: Vec<Panel> = pairs.map(|(first, second)| pair(outcome, first, second)).collect();
    let caption = "Pairs of parameters along the likelihood profiles, on every branch that agrees with the data at \
                   95 %. Rectangle: bounds of the search.";
    let columns = panels.len().min(3);
    Some(Figure::new("pairs", caption, panels).in_columns(columns))
}

fn pair(outcome: &CalibrationResult, first: usize, second: usize) -> Panel {
    let (x, y) = (&outcome.parameters[first], &outcome.parameters[second]);
    let mut panel = Panel::new("", axis(x), axis(y));
    let of = |values: &Vec<f64>| (values[first], values[second]);
    let ((left, right), (low, high)) = (x.bounds, y.bounds);
    panel.reference("bounds", [(left, low), (right, low), (right, high), (left, high), (left, low)]);
    panel.points("agrees at 95 %", 0, outcome.region.iter().map(of));
    panel.points("minimum", 3, outcome.minima.iter().skip(1).map(|minimum| of(&minimum.values)));
    panel.points("best", 1, [(x.best, y.best)]);
    if let Some(truth) = x.truth.zip(y.truth) {
        panel.points("truth", 2, [truth]);
    }
    panel
}
