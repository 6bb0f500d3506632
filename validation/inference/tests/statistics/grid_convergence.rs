//! Tests of the index: series of known order, and how often its band holds the limit when runs scatter.

use bagnold_inference::statistics::{Mean, grid_convergence};
use rand::{RngExt, SeedableRng};

fn means(value: impl Fn(f64) -> f64, error: f64) -> [Mean; 3] {
    [40, 60, 90].map(|n| Mean { resolution: n, value: value(1.0 / n as f64), standard_error: error, runs: 5 })
}

#[test]
fn the_order_and_the_error_of_a_power_series_are_found() {
    for order in [0.5, 1.0, 1.5, 2.0] {
        let found = grid_convergence(&means(|h| 2.0 + 30.0 * libm::pow(h, order), 0.0)).expect("ascending");
        assert!((found.order - order).abs() < 1e-4, "{found:?} for {order}");
        // 1.25 times the true error of the finest value
        let exact = 1.25 * 30.0 * libm::pow(1.0 / 90.0, order);
        let finest = 2.0 + 30.0 * libm::pow(1.0 / 90.0, order);
        assert!((found.index / (exact / finest) - 1.0).abs() < 1e-3, "{found:?} for {order}");
        assert!((found.limit - 2.0).abs() < 1e-3 && found.open_orders.1 - found.open_orders.0 < 0.03);
    }
}

#[test]
fn a_series_of_four_uses_all_of_them() {
    let series = |n: usize| Mean { resolution: n, value: 3.0 - 4.0 / n as f64, standard_error: f64::NAN, runs: 1 };
    let found = grid_convergence(&[10, 20, 30, 60].map(series)).expect("ascending");
    assert!((found.order - 1.0).abs() < 1e-4 && (found.limit - 3.0).abs() < 1e-4, "{found:?}");
    assert_eq!(found.scatter, None);
    assert_eq!(grid_convergence(&[10, 20].map(series)), None);
    assert_eq!(grid_convergence(&[10, 30, 20].map(series)), None);
}

#[test]
fn oscillation_is_found_with_a_wide_band() {
    let turning = [(40, 1.0), (60, 1.2), (90, 1.1)].map(|(resolution, value)| Mean {
        resolution,
        value,
        standard_error: f64::NAN,
        runs: 1,
    });
    let found = grid_convergence(&turning).expect("ascending");
    assert!(found.index > 0.2 / 1.1, "no narrower than the values lie apart: {found:?}");
}

#[test]
fn scatter_leaves_orders_open_and_is_pooled_over_the_resolutions() {
    let noisy = means(|h| 2.0 + 3000.0 * h * h, 0.5);
    let found = grid_convergence(&noisy).expect("ascending");
    assert_eq!(found.open_orders, (0.4, 2.0));
    let variances = noisy.iter().map(|mean| 5.0 * (0.5 / mean.value).powi(2)).sum::<f64>();
    assert!(found.scatter.is_some_and(|scatter| (scatter - (variances / 3.0).sqrt()).abs() < 1e-12));
    // one run at the finest: the others tell its scatter, and its band is the wider
    let mut single = noisy;
    single[2].runs = 1;
    single[2].standard_error = f64::NAN;
    let wider = grid_convergence(&single).expect("ascending");
    assert!(wider.scatter.is_some() && wider.index > found.index, "{wider:?}");
}

/// A normal number.
fn normal(random: &mut rand_pcg::Pcg64) -> f64 {
    let (radius, angle): (f64, f64) = (1.0 - random.random::<f64>(), random.random());
    (-2.0 * libm::log(radius)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * angle)
}

/// Share of 300 studies of `runs` seeds at 20, 30 and 45 rows whose band of the finest holds the limit 1. The error of the
/// coarsest is `coarsest`; runs scatter by `scatter`.
fn coverage((order, coarsest): (f64, f64), scatter: f64, runs: usize) -> f64 {
    let mut random = rand_pcg::Pcg64::seed_from_u64(29);
    let held = (0..300).filter(|study| {
        let error = if study % 2 == 0 { coarsest } else { -coarsest };
        let means = [20_usize, 30, 45].map(|rows| {
            let exact = 1.0 + error * libm::pow(20.0 / rows as f64, order);
            let values: Vec<f64> = (0..runs).map(|_| exact * (1.0 + scatter * normal(&mut random))).collect();
            Mean::of(rows, &values).expect("values")
        });
        let found = grid_convergence(&means).expect("ascending");
        (means[2].value - 1.0).abs() <= found.index * means[2].value.abs()
    });
    held.count() as f64 / 300.0
}

#[test]
fn bands_hold_the_limit_at_every_order_and_scatter() {
    for order in [0.5, 1.0, 2.0] {
        for coarsest in [0.02, 0.1, 0.3] {
            for scatter in [0.0, 0.01, 0.02, 0.03] {
                for runs in [3, 5] {
                    let share = coverage((order, coarsest), scatter, runs);
                    assert!(share >= 0.9, "order {order}, {coarsest}, scatter {scatter}, {runs} runs: {share} of 0.95");
                }
            }
        }
    }
}

#[test]
fn a_mean_has_the_error_of_its_scatter() {
    let mean = Mean::of(40, &[1.0, 2.0, 3.0]).expect("values");
    assert!((mean.value - 2.0).abs() < 1e-15 && (mean.standard_error - (1.0f64 / 3.0).sqrt()).abs() < 1e-15);
    assert!(Mean::of(40, &[1.0]).is_some_and(|mean| mean.standard_error.is_nan()));
    assert_eq!(Mean::of(40, &[]), None);
}
