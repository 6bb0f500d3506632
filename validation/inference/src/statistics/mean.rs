//! Means, and how far values are from what they should be.

/// Mean of values; NaN without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean and variance of values; of a single one itself and 0.
pub fn mean_and_variance(values: impl ExactSizeIterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
    (mean, squares / (count - 1.0).max(1.0))
}

/// √(Σ (value − exact)²/Σ exact²) of pairs (value, exact) `[-]`.
pub fn relative_l2(pairs: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let (error, scale) = pairs.into_iter().fold((0.0, 0.0), |(error, scale), (value, exact)| {
        (error + (value - exact) * (value - exact), scale + exact * exact)
    });
    (error / scale).sqrt()
}
