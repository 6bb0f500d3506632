//! Whether what is averaged over a window has stopped changing.

/// Largest change over the last third of a run with which a mean counts as steady, over the mean `[-]`. A flow that comes from
/// rest exponentially is then 0.15 % from its end at most.
const LARGEST_CHANGE: f64 = 0.01;

/// Reason why a mean over the last `window` `[s]` of a series of (time `[s]`, value) is not steady; none if it is, or
/// if there is no series. `quantity` names what the series is of.
pub fn unsteadiness(quantity: &str, series: impl Iterator<Item = (f64, f64)>, window: f64) -> Option<String> {
    let samples: Vec<(f64, f64)> = series.collect();
    // another code may give its profile alone
    let end = samples.last().filter(|_| samples.iter().any(|(_, value)| value.is_finite()))?.0;
    let third = end / 3.0;
    let mean = |until: f64| {
        let inside = samples.iter().filter(|(time, _)| *time > until - window && *time <= until);
        let (sum, count) = inside.fold((0.0, 0.0), |(sum, count), (_, value)| (sum + value, count + 1.0));
        sum / count
    };
    let (last, before) = (mean(end), mean(end - third));
    let change = (last - before) / last.abs();
    (change.is_nan() || change.abs() > LARGEST_CHANGE).then(|| {
        format!(
            "not steady: {quantity} changed by {:+.1} % over the last third of the run, {third:.3} s, where {:.0} % is allowed",
            100.0 * change,
            100.0 * LARGEST_CHANGE
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn approach(time_constant: f64) -> impl Iterator<Item = (f64, f64)> {
        (1..=1000).map(move |k| f64::from(k) * 5e-3).map(move |t| (t, 1.0 - (-t / time_constant).exp()))
    }

    #[test]
    fn a_flow_from_rest_is_steady_once_it_is_within_a_sixth_of_a_percent() {
        // 5 s: e^(-5/τ) is what is missing at the end
        assert_eq!(unsteadiness("the mean", approach(0.6), 0.5), None);
        let unsteady = unsteadiness("the mean", approach(1.5), 0.5).expect("3.6 % are missing");
        assert!(unsteady.starts_with("not steady: the mean changed by +"), "{unsteady}");
        for missing in [2e-3_f64, 5e-3, 2e-2] {
            assert!(unsteadiness("the mean", approach(-5.0 / missing.ln()), 0.01).is_some(), "{missing}");
        }
    }

    #[test]
    fn drift_is_unsteady_and_fluctuation_is_steady() {
        let drift = (0..1000).map(|k| (f64::from(k), 1.0 - 5e-5 * f64::from(k)));
        assert!(unsteadiness("the mean", drift, 100.0).is_some());
        let waves = (0..1000).map(|k| (f64::from(k), 1.0 + 0.3 * (0.7 * f64::from(k)).sin()));
        assert_eq!(unsteadiness("the mean", waves, 100.0), None);
        assert_eq!(unsteadiness("the mean", std::iter::empty(), 100.0), None);
        let unknown = (0..10).map(|k| (f64::from(k), f64::NAN));
        assert_eq!(unsteadiness("the mean", unknown, 3.0), None);
        let broken = (0..10).map(|k| (f64::from(k), if k < 8 { 1.0 } else { f64::NAN }));
        assert!(unsteadiness("the mean", broken, 3.0).is_some());
    }
}
