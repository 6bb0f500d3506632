//! The grid convergence index of three resolutions (Roache), with the scatter of repeated runs.

/// Mean of repeated runs with the standard error of that mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Particles over the reference length.
    pub resolution: usize,
    /// Mean.
    pub value: f64,
    /// Standard error of the mean; not a number for a single run.
    pub standard_error: f64,
    /// Number of runs.
    pub runs: usize,
}

impl Mean {
    /// The mean of repeated runs; none without runs.
    #[must_use]
    pub fn of(resolution: usize, values: &[f64]) -> Option<Self> {
        let n = values.len() as f64;
        let value = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - value) * (v - value)).sum::<f64>() / (n - 1.0);
        (!values.is_empty()).then_some(Self {
            resolution,
            value,
            standard_error: (variance / n).sqrt(),
            runs: values.len(),
        })
    }
}

/// Safety factor of the index with three resolutions `[-]`.
const SAFETY: f64 = 1.25;

/// Relative uncertainty of the finest of three means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridConvergence {
    /// Observed order, 1 … 2; 1 where it cannot be told `[-]`.
    pub order: f64,
    /// The index 1.25 |f_3 − f_2|/(r^p − 1)/|f_3| `[-]`.
    pub index: f64,
    /// The finest mean's standard error over its value `[-]`.
    pub scatter: f64,
}

/// The index of three means in ascending resolution; none if the resolutions do not ascend.
///
/// The order p is that of the three values, clipped to 1 … 2. It is 1 where the sequence is not monotone, or where a
/// difference lies within two standard errors and so says nothing of an order.
#[must_use]
pub fn grid_convergence(means: &[Mean; 3]) -> Option<GridConvergence> {
    let [coarse, middle, fine] = means;
    let ratio = |a: &Mean, b: &Mean| b.resolution as f64 / a.resolution as f64;
    let (first, last) = (ratio(coarse, middle), ratio(middle, fine));
    if !(first > 1.0 && last > 1.0) {
        return None;
    }
    let (d1, d2) = (middle.value - coarse.value, fine.value - middle.value);
    let error = |a: &Mean, b: &Mean| {
        let square = |error: f64| if error.is_nan() { 0.0 } else { error * error };
        (square(a.standard_error) + square(b.standard_error)).sqrt()
    };
    let told = d1.abs() > 2.0 * error(coarse, middle) && d2.abs() > 2.0 * error(middle, fine);
    let order = if d1 * d2 > 0.0 && told { observed_order(d1, d2, first, last).clamp(1.0, 2.0) } else { 1.0 };
    Some(GridConvergence {
        order,
        index: SAFETY * d2.abs() / (libm::pow(last, order) - 1.0) / fine.value.abs(),
        scatter: if fine.standard_error.is_nan() { 0.0 } else { fine.standard_error / fine.value.abs() },
    })
}

/// p of d_1/d_2 = r_2^p (r_1^p − 1)/(r_2^p − 1), which rises with p, by bisection between 0 and 10.
fn observed_order(d1: f64, d2: f64, r1: f64, r2: f64) -> f64 {
    let ratio = |p: f64| libm::pow(r2, p) * (libm::pow(r1, p) - 1.0) / (libm::pow(r2, p) - 1.0);
    let (mut lower, mut upper) = (1e-6, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (lower + upper);
        if ratio(middle) < d1 / d2 { lower = middle } else { upper = middle }
    }
    0.5 * (lower + upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn means(value: impl Fn(f64) -> f64, error: f64) -> [Mean; 3] {
        [40, 60, 90].map(|n| Mean { resolution: n, value: value(1.0 / n as f64), standard_error: error, runs: 5 })
    }

    #[test]
    fn the_order_and_the_error_of_a_power_series_are_found() {
        for order in [1.0, 1.5, 2.0] {
            let found = grid_convergence(&means(|h| 2.0 + 30.0 * libm::pow(h, order), 0.0)).expect("ascending");
            assert!((found.order - order).abs() < 1e-6, "{found:?} for {order}");
            // 1.25 times the true error of the finest value
            let exact = 1.25 * 30.0 * libm::pow(1.0 / 90.0, order);
            let finest = 2.0 + 30.0 * libm::pow(1.0 / 90.0, order);
            assert!((found.index - exact / finest).abs() < 1e-6);
        }
    }

    #[test]
    fn what_scatters_or_turns_has_order_one() {
        let noisy = grid_convergence(&means(|h| 2.0 + 3000.0 * h * h, 0.5)).expect("ascending");
        assert_eq!(noisy.order, 1.0);
        assert!((noisy.scatter - 0.5 / (2.0 + 3000.0 / 8100.0)).abs() < 1e-12);
        let turning = [(40, 1.0), (60, 1.2), (90, 1.1)].map(|(resolution, value)| Mean {
            resolution,
            value,
            standard_error: f64::NAN,
            runs: 1,
        });
        let found = grid_convergence(&turning).expect("ascending");
        assert!(found.order == 1.0 && (found.index - 1.25 * 0.1 / 0.5 / 1.1).abs() < 1e-12);
        let swapped = [turning[1], turning[0], turning[2]];
        assert_eq!(grid_convergence(&swapped), None);
    }

    #[test]
    fn a_mean_has_the_error_of_its_scatter() {
        let mean = Mean::of(40, &[1.0, 2.0, 3.0]).expect("values");
        assert!((mean.value - 2.0).abs() < 1e-15 && (mean.standard_error - (1.0f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!(Mean::of(40, &[1.0]).is_some_and(|mean| mean.standard_error.is_nan()));
        assert_eq!(Mean::of(40, &[]), None);
    }
}
