//! Straight lines by least squares.

/// y = intercept + slope x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearFit {
    /// Slope, unit of y over unit of x.
    pub slope: f64,
    /// Intercept, unit of y.
    pub intercept: f64,
    /// Share of the variance of y that the line explains `[-]`.
    pub r_squared: f64,
    /// Standard error of the slope from the scatter about the line; not a number with two points.
    pub standard_error: f64,
}

/// The least-squares line through points (x, y); none for fewer than two distinct x.
pub fn linear_fit(points: &[(f64, f64)]) -> Option<LinearFit> {
    let mut products = [0.0; 3];
    let (x, y) = add_products(points, &mut products);
    let [xx, xy, yy] = products;
    let slope = xy / xx;
    let intercept = y - slope * x;
    let residual: f64 = points.iter().map(|p| (p.1 - intercept - slope * p.0).powi(2)).sum();
    let (r_squared, standard_error) = (1.0 - residual / yy, (residual / (points.len() as f64 - 2.0) / xx).sqrt());
    slope.is_finite().then_some(LinearFit { slope, intercept, r_squared, standard_error })
}

/// Adds Σ x x, Σ x y and Σ y y of points (x, y) about their mean, and returns the mean.
fn add_products(points: &[(f64, f64)], products: &mut [f64; 3]) -> (f64, f64) {
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    for point in points {
        products[0] += (point.0 - x) * (point.0 - x);
        products[1] += (point.0 - x) * (point.1 - y);
        products[2] += (point.1 - y) * (point.1 - y);
    }
    (x, y)
}

/// A fitted value with its standard error, both in the value's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedValue {
    /// The value.
    pub value: f64,
    /// Standard error from the scatter about the fit.
    pub standard_error: f64,
}

/// The slope that groups of points (x, y) share, each group with an intercept of its own; none without two distinct x in
/// a group and one point more than there are intercepts and slope.
pub fn common_slope(groups: &[Vec<(f64, f64)>]) -> Option<FittedValue> {
    let mut products = [0.0; 3];
    for points in groups {
        add_products(points, &mut products);
    }
    let [xx, xy, yy] = products;
    let freedom = groups.iter().map(Vec::len).sum::<usize>().checked_sub(groups.len() + 1)?;
    let value = xy / xx;
    let residual = (yy - value * xy).max(0.0);
    (freedom > 0 && value.is_finite())
        .then(|| FittedValue { value, standard_error: (residual / freedom as f64 / xx).sqrt() })
}

/// Exponent of a power law with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponent {
    /// n in y = c xⁿ `[-]`.
    pub value: f64,
    /// Standard error from the scatter about the line `[-]`; not a number with two points.
    pub standard_error: f64,
    /// c in y = c xⁿ, in the unit of y over that of xⁿ.
    pub coefficient: f64,
}

/// The power law through points of positive coordinates, by least squares of the logarithms; none with fewer than two.
pub fn power_law(points: &[(f64, f64)]) -> Option<Exponent> {
    if points.iter().any(|(x, y)| !(*x > 0.0 && *y > 0.0)) {
        return None;
    }
    let logarithms: Vec<_> = points.iter().map(|(x, y)| (libm::log(*x), libm::log(*y))).collect();
    let LinearFit { slope, intercept, standard_error, .. } = linear_fit(&logarithms)?;
    Some(Exponent { value: slope, standard_error, coefficient: libm::exp(intercept) })
}

/// Slope of the line through (ln x, ln y); none where a value is not positive.
pub fn log_log_slope(points: &[(f64, f64)]) -> Option<f64> {
    power_law(points).map(|law| law.value)
}
