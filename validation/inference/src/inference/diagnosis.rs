//! Diagnosis of the data, their uncertainties and the model from the residuals at the best point.

/// Distance from the median in robust standard deviations from which on a residual is an outlier.
const OUTLYING: f64 = 4.0;

/// Data beyond the parameters below which a robust standard deviation means little.
const LEAST_FREEDOM: usize = 5;

/// Places of residuals farther from their median than four robust standard deviations, with that distance over one of
/// them; none with few data. The robust standard deviation is 1.4826 times the median distance from the median, enlarged
/// by 1 + 4/ν for ν data beyond the parameters: of few data the middle half is often close together by chance.
pub fn outliers(residuals: &[f64], parameters: usize) -> Vec<(usize, f64)> {
    let Some(freedom) = residuals.len().checked_sub(parameters).filter(|freedom| *freedom >= LEAST_FREEDOM) else {
        return Vec::new();
    };
    let centre = median(residuals);
    let distances: Vec<f64> = residuals.iter().map(|residual| (residual - centre).abs()).collect();
    // a fit takes parameters' worth of scatter out of the residuals
    let fitted = (residuals.len() as f64 / freedom as f64).sqrt();
    let deviation = 1.4826 * median(&distances) * fitted * (1.0 + 4.0 / freedom as f64);
    let beyond =
        |(place, distance): (usize, &f64)| (*distance > OUTLYING * deviation).then(|| (place, distance / deviation));
    distances.iter().enumerate().filter_map(beyond).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
}
