//! Straight lines by least squares.

/// y = intercept + slope x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearFit {
    /// Slope, unit of y over unit of x.
    pub slope: f64,
    /// Intercept, unit of y.
    pub intercept: f64,
}

/// The least-squares line through points (x, y); none for fewer than two distinct x.
#[must_use]
pub fn linear_fit(points: &[(f64, f64)]) -> Option<LinearFit> {
    let n = points.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let (mut xx, mut xy) = (0.0, 0.0);
    for point in points {
        xx += (point.0 - x) * (point.0 - x);
        xy += (point.0 - x) * (point.1 - y);
    }
    let slope = xy / xx;
    slope.is_finite().then_some(LinearFit { slope, intercept: y - slope * x })
}

/// Slope of the line through (ln x, ln y); none where a value is not positive.
#[must_use]
pub fn log_log_slope(points: &[(f64, f64)]) -> Option<f64> {
    if points.iter().any(|(x, y)| !(*x > 0.0 && *y > 0.0)) {
        return None;
    }
    let logarithms: Vec<_> = points.iter().map(|(x, y)| (libm::log(*x), libm::log(*y))).collect();
    linear_fit(&logarithms).map(|fit| fit.slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_exactly() {
        let fit = linear_fit(&[(0.0, 1.0), (1.0, 3.0), (4.0, 9.0)]).unwrap();
        assert!((fit.slope - 2.0).abs() < 1e-14 && (fit.intercept - 1.0).abs() < 1e-14);
        assert_eq!(linear_fit(&[(1.0, 1.0), (1.0, 2.0)]), None);
        assert_eq!(linear_fit(&[]), None);
    }

    #[test]
    fn a_power_law_has_its_exponent() {
        let points = [(1.0, 2.0), (2.0, 0.5), (4.0, 0.125)];
        assert!((log_log_slope(&points).unwrap() + 2.0).abs() < 1e-14);
        assert_eq!(log_log_slope(&[(1.0, 0.0), (2.0, 1.0)]), None);
    }
}
