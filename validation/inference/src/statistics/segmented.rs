//! Continuous pieces of straight lines, and parabolas, by least squares.

use nalgebra::{DMatrix, DVector};

/// y in pieces of straight lines that meet at the break points.
#[derive(Debug, Clone, PartialEq)]
pub struct Segmented {
    /// Abscissas at which the slope changes, rising, unit of x; one fewer than there are pieces.
    pub breaks: Vec<f64>,
    /// Slope of every piece, unit of y over unit of x.
    pub slopes: Vec<f64>,
    /// Root mean square of the residuals, unit of y.
    pub residual: f64,
}

/// Points that a piece must hold.
const LEAST_POINTS: usize = 3;

/// Places between two neighbouring points at which a break is tried.
const PLACES: usize = 2;

/// Passes over all breaks, and halvings of the step in each, by which their places are refined.
const SWEEPS: usize = 3;
const HALVINGS: usize = 6;

/// The best continuous fit with a number of pieces to points (x, y) of rising x; none without three points a piece.
pub fn segmented_regression(points: &[(f64, f64)], pieces: usize) -> Option<Segmented> {
    let needed = LEAST_POINTS * pieces;
    if pieces == 0 || points.len() < needed.max(pieces + 2) {
        return None;
    }
    let mut best = None;
    let mut breaks = vec![0.0; pieces - 1];
    search(points, 0, LEAST_POINTS, &mut breaks, &mut best);
    best.map(|(_, fit)| refined(points, fit))
}

/// The fit with each break moved between the places that were tried beside it.
fn refined(points: &[(f64, f64)], fit: Segmented) -> Segmented {
    let mut best = fit;
    for _ in 0..SWEEPS {
        for which in 0..best.breaks.len() {
            let upper = points.partition_point(|point| point.0 < best.breaks[which]).clamp(1, points.len() - 1);
            let mut step = (points[upper].0 - points[upper - 1].0) / PLACES as f64;
            for _ in 0..HALVINGS {
                step *= 0.5;
                for side in [-step, step] {
                    let mut breaks = best.breaks.clone();
                    breaks[which] += side;
                    let Some((sum, slopes)) = hinges(points, &breaks) else { continue };
                    let residual = (sum / points.len() as f64).sqrt();
                    if residual < best.residual {
                        best = Segmented { breaks, slopes, residual };
                        break;
                    }
                }
            }
        }
    }
    best
}

/// Tries every place of the break number `which`, and of those after it.
fn search(
    points: &[(f64, f64)],
    which: usize,
    first: usize,
    breaks: &mut Vec<f64>,
    best: &mut Option<(f64, Segmented)>,
) {
    if which == breaks.len() {
        let Some((sum, slopes)) = hinges(points, breaks) else { return };
        if best.as_ref().is_none_or(|(least, _)| sum < *least) {
            let residual = (sum / points.len() as f64).sqrt();
            *best = Some((sum, Segmented { breaks: breaks.clone(), slopes, residual }));
        }
        return;
    }
    let after = LEAST_POINTS * (breaks.len() - which);
    for next in first..=points.len() - after {
        let (lower, upper) = (points[next - 1].0, points[next].0);
        for place in 0..PLACES {
            breaks[which] = lower + (upper - lower) * (place as f64 + 0.5) / PLACES as f64;
            search(points, which + 1, next + LEAST_POINTS, breaks, best);
        }
    }
}

/// Sum of squares and slopes of the fit 1, x, (x − b)₊ ….
fn hinges(points: &[(f64, f64)], breaks: &[f64]) -> Option<(f64, Vec<f64>)> {
    let (sum, coefficients) = least_squares(points, breaks.len() + 2, |x, column| match column {
        0 => 1.0,
        1 => x,
        _ => (x - breaks[column - 2]).max(0.0),
    })?;
    let mut slope = 0.0;
    let slopes = coefficients.iter().skip(1).map(|change| {
        slope += change;
        slope
    });
    Some((sum, slopes.collect()))
}

/// Number of pieces, up to `most`, whose fit has the least Bayesian information criterion n ln(RSS/n) + k ln n; every
/// break counts for its place and its change of slope.
pub fn number_of_pieces(points: &[(f64, f64)], most: usize) -> usize {
    let count = points.len() as f64;
    let criterion = |pieces: usize| {
        let fit = segmented_regression(points, pieces)?;
        let scale = points.iter().fold(0.0_f64, |most, point| most.max(point.1.abs())).max(f64::MIN_POSITIVE);
        // a fit better than rounding is none the better
        let residual = (fit.residual / scale).max(1e-12);
        Some(2.0 * count * libm::log(residual) + 2.0 * pieces as f64 * libm::log(count))
    };
    (1..=most)
        .filter_map(|pieces| criterion(pieces).map(|value| (value, pieces)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(0, |(_, pieces)| pieces)
}

/// Second derivative of the parabola through points (x, y), unit of y over that of x²; none for fewer than four.
pub fn curvature(points: &[(f64, f64)]) -> Option<f64> {
    if points.len() < 4 {
        return None;
    }
    let middle = points.iter().map(|point| point.0).sum::<f64>() / points.len() as f64;
    let (_, coefficients) = least_squares(points, 3, |x, column| match column {
        0 => 1.0,
        1 => x - middle,
        _ => (x - middle) * (x - middle),
    })?;
    Some(2.0 * coefficients[2])
}

/// Sum of squares that is left, and the coefficients of the columns.
fn least_squares(
    points: &[(f64, f64)],
    columns: usize,
    value: impl Fn(f64, usize) -> f64,
) -> Option<(f64, DVector<f64>)> {
    let matrix = DMatrix::from_fn(points.len(), columns, |row, column| value(points[row].0, column));
    let right = DVector::from_iterator(points.len(), points.iter().map(|point| point.1));
    let factors = matrix.clone().qr();
    let projected = factors.q().transpose() * &right;
    let coefficients = factors.r().solve_upper_triangular(&projected)?;
    let left = (matrix * &coefficients - right).norm_squared();
    left.is_finite().then_some((left, coefficients))
}
