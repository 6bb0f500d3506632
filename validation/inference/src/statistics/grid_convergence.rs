//! The grid convergence index of three or more resolutions with the scatter of repeated runs.
//!
//! Roache's index 1.25 |f_3 − f_2|/(r^p − 1) takes the order p from two differences. That is right for values without noise;
//! a scatter of a few per cent makes an order of its own, and an order that is held above 1 hides a slower approach. Here
//! f = f_∞ + c h^p is fitted for every order from 0.4 to 2, with the means weighted by their errors, and every order counts
//! that the data do not exclude: those whose χ²/(n − 2) is at most t², with Student's t of the pooled scatter. An order's half
//! width is made of Roache's error and of what the scatter leaves open of f_∞,
//!
//! √((1.25 |f_fine − f_∞|)² + (t s_∞)²),
//!
//! and the index is the widest of them. Without scatter that is Roache's index at the observed order. Means that no order
//! fits within their scatter, or whose scatter is not known, scatter at least by what the best fit leaves, over n − 2 degrees
//! of freedom (Birge).

use super::student_quantile;

/// Mean of repeated runs with the standard error of that mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Particles over the reference length.
    pub resolution: usize,
    /// Mean of the values at this spacing.
    pub value: f64,
    /// Standard error of the mean; not a number for a single run.
    pub standard_error: f64,
    /// Number of runs.
    pub runs: usize,
}

impl Mean {
    /// The mean of repeated runs; none without runs.
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

/// Orders that are tried, so that an approach with the root of the spacing has neighbours on both sides `[-]`.
const ORDERS: (f64, f64) = (0.4, 2.0);

/// Steps between them.
const STEPS: usize = 64;

/// Confidence level of the index `[-]`.
const CONFIDENCE: f64 = 0.95;

/// Student's factor of that confidence for a scatter that is known exactly `[-]`.
const NORMAL_QUANTILE: f64 = 1.96;

/// Error of means whose scatter is not known, which weighs them equally and is below any that counts `[-]`.
const WITHOUT_SCATTER: f64 = 1e-9;

/// Relative uncertainty of the finest of some means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridConvergence {
    /// The order that fits best, 0.4 … 2 `[-]`.
    pub order: f64,
    /// Orders that the scatter leaves open, the least and the largest `[-]`.
    pub open_orders: (f64, f64),
    /// Half width of the finest mean's 95 % interval over its value, scatter included `[-]`.
    pub index: f64,
    /// Limit of the means at infinite resolution, in their unit.
    pub limit: f64,
    /// Relative standard deviation of single runs, pooled over the resolutions `[-]`; none without repeated runs.
    pub scatter: Option<f64>,
}

/// The index of means in ascending resolution; none for fewer than three or if the resolutions do not ascend.
pub fn grid_convergence(means: &[Mean]) -> Option<GridConvergence> {
    let fine = means.last().filter(|_| means.len() >= 3)?;
    if !means.windows(2).all(|pair| pair[0].resolution < pair[1].resolution) {
        return None;
    }
    let pooled = pooled_scatter(means);
    let quantile = pooled.map_or(NORMAL_QUANTILE, |(_, freedom)| student_quantile(CONFIDENCE, freedom));
    let scatter = pooled.map(|(scatter, _)| scatter);
    let error = |mean: &Mean| {
        let own = scatter.unwrap_or(0.0) / (mean.runs as f64).sqrt();
        own.max(WITHOUT_SCATTER) * mean.value.abs()
    };
    let points: Vec<[f64; 3]> =
        means.iter().map(|mean| [fine.resolution as f64 / mean.resolution as f64, mean.value, error(mean)]).collect();
    let fits: Vec<PowerLawFit> = (0..=STEPS)
        .map(|step| PowerLawFit::of(&points, ORDERS.0 + (ORDERS.1 - ORDERS.0) * step as f64 / STEPS as f64))
        .collect::<Option<_>>()?;
    let best = best_order(&points, &fits)?;
    let freedom = (means.len() - 2) as f64;
    let is_scatter = scatter.is_some() && best.misfit <= quantile * quantile * freedom;
    let misfit = if is_scatter { 1.0 } else { (best.misfit / freedom).sqrt().max(1.0) };
    let half_width = |fit: &PowerLawFit| {
        let error = SAFETY * (fine.value - fit.limit);
        let open = quantile * misfit * fit.error;
        (error * error + open * open).sqrt()
    };
    let is_open = |fit: &&PowerLawFit| fit.misfit <= freedom * (quantile * misfit).powi(2);
    // the best is always open: its misfit is scatter
    let (mut widest, mut orders) = (half_width(&best), (best.order, best.order));
    for fit in fits.iter().filter(is_open) {
        widest = widest.max(half_width(fit));
        orders = (orders.0.min(fit.order), orders.1.max(fit.order));
    }
    Some(GridConvergence {
        order: best.order,
        open_orders: orders,
        index: widest / fine.value.abs(),
        limit: best.limit,
        scatter,
    })
}

/// Relative standard deviation of single runs `[-]` and its degrees of freedom; none without repeated runs. Resolutions
/// share it, since a few seeds each say little.
fn pooled_scatter(means: &[Mean]) -> Option<(f64, usize)> {
    let repeated = means.iter().filter(|mean| mean.runs > 1 && mean.standard_error.is_finite());
    let (sum, freedom) = repeated.fold((0.0, 0), |(sum, freedom), mean| {
        let variance = (mean.standard_error / mean.value).powi(2) * mean.runs as f64;
        (sum + variance * (mean.runs - 1) as f64, freedom + mean.runs - 1)
    });
    (freedom > 0).then(|| ((sum / freedom as f64).sqrt(), freedom))
}

/// f = limit + c h^order through points (h, f, error).
#[derive(Debug, Clone, Copy, PartialEq)]
struct PowerLawFit {
    order: f64,
    limit: f64,
    /// Standard error of the limit, from those of the points.
    error: f64,
    /// χ².
    misfit: f64,
}

impl PowerLawFit {
    fn of(points: &[[f64; 3]], order: f64) -> Option<Self> {
        let (mut one, mut x, mut xx) = (0.0, 0.0, 0.0);
        for &[spacing, _, error] in points {
            let (power, weight) = (libm::pow(spacing, order), 1.0 / (error * error));
            one += weight;
            x += weight * power;
            xx += weight * power * power;
        }
        let middle = x / one;
        let spread = xx - x * middle;
        let (mut mean, mut product) = (0.0, 0.0);
        for &[spacing, value, error] in points {
            let weight = 1.0 / (error * error);
            mean += weight * value / one;
            product += weight * (libm::pow(spacing, order) - middle) * value;
        }
        let slope = product / spread;
        let residual = |&[spacing, value, error]: &[f64; 3]| {
            ((value - mean - slope * (libm::pow(spacing, order) - middle)) / error).powi(2)
        };
        let misfit = points.iter().map(residual).sum::<f64>();
        let error = (1.0 / one + middle * middle / spread).sqrt();
        (misfit.is_finite() && error.is_finite()).then_some(Self { order, limit: mean - slope * middle, error, misfit })
    }
}

/// The fit of least χ², between the neighbours of the best that was tried, by golden section.
fn best_order(points: &[[f64; 3]], fits: &[PowerLawFit]) -> Option<PowerLawFit> {
    let (place, mut best) = fits.iter().copied().enumerate().min_by(|a, b| a.1.misfit.total_cmp(&b.1.misfit))?;
    let mut lower = fits[place.saturating_sub(1)].order;
    let mut upper = fits[(place + 1).min(fits.len() - 1)].order;
    let section = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (left, right) = (upper - section * (upper - lower), lower + section * (upper - lower));
        let (left, right) = (PowerLawFit::of(points, left)?, PowerLawFit::of(points, right)?);
        let better = if left.misfit < right.misfit { left } else { right };
        if better.misfit < best.misfit {
            best = better;
        }
        if left.misfit < right.misfit { upper = right.order } else { lower = left.order }
    }
    Some(best)
}
