//! Measurements as points with error bars.

use super::Measurements;
use super::place::MatchingPanel;
use crate::figure::{Figure, Mark, Series};

/// Largest number of bars along the horizontal axis, each a separate line: more would fill the figure.
const MOST_BARS: usize = 400;

/// Draws them into their panel, in a colour of their own.
pub(super) fn draw(measurements: &Measurements, place: &MatchingPanel, figures: &mut [Figure]) {
    let panel = &mut figures[place.figure].panels[place.panel];
    let colour = panel.series.iter().map(|series| series.colour + 1).max().unwrap_or(0);
    let (to_x, to_y) = place.factors;
    let given = measurements.abscissa.values.iter().zip(&measurements.measured.values);
    let given: Vec<(f64, f64)> = given.map(|(x, y)| (x * to_x, y * to_y)).collect();
    let uncertainty: Vec<f64> = measurements.uncertainty.iter().map(|value| value * to_y).collect();
    let points = given.iter().map(|point| place.turned(*point)).collect();
    let mut cloud = Series::new(&measurements.legend(), Mark::Points, colour, points);
    if place.is_across {
        for ((x, y), half) in given.iter().zip(&uncertainty).take(MOST_BARS) {
            let ends = [(*x, y - half), (*x, y + half)].map(|point| place.turned(point));
            panel.series.push(Series::new("", Mark::Line, colour, ends.to_vec()));
        }
    } else {
        cloud.error = uncertainty;
    }
    panel.series.push(cloud);
}
