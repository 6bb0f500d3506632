//! Metrics as lines of text, and metrics against such lines.

use bagnold_validation::metric::{Metric, Verdict};

/// Significant figures of a value in a snapshot.
const FIGURES: i32 = 4;

/// A line of a snapshot: `name | variant | value | unit | verdict`.
#[derive(Debug, PartialEq)]
struct Line<'a> {
    name: &'a str,
    variant: &'a str,
    value: f64,
    unit: &'a str,
    verdict: &'a str,
}

/// The metrics as a snapshot holds them.
pub(crate) fn text(metrics: &[Metric]) -> String {
    metrics.iter().map(|metric| line(metric) + "\n").collect()
}

fn line(metric: &Metric) -> String {
    let Metric { name, variant, unit, .. } = metric;
    format!("{name} | {variant} | {} | {unit} | {}", rounded(metric.value), word(metric.verdict()))
}

/// Every metric that is not as in the snapshot, a line each.
pub(crate) fn drifts(snapshot: &str, metrics: &[Metric]) -> Vec<String> {
    let mut expected: Vec<Line<'_>> = Vec::new();
    let mut drifts: Vec<String> = Vec::new();
    for text in snapshot.lines().filter(|text| !text.trim().is_empty()) {
        match parsed(text) {
            Some(line) => expected.push(line),
            None => drifts.push(format!("  unreadable line in the snapshot: {text}")),
        }
    }
    for metric in metrics {
        let place = expected.iter().position(|line| line.name == metric.name && line.variant == metric.variant);
        match place.map(|place| expected.remove(place)) {
            Some(line) => drifts.extend(drift(&line, metric)),
            None => drifts.push(format!("  not in the snapshot: {}", line(metric))),
        }
    }
    drifts.extend(expected.iter().map(|line| format!("  no longer measured: {} | {}", line.name, line.variant)));
    drifts
}

fn drift(expected: &Line<'_>, metric: &Metric) -> Option<String> {
    // The snapshot's own rounding adds to what the value may move.
    let tolerance = metric.snapshot_tolerance * expected.value.abs()
        + metric.snapshot_floor
        + half_a_unit_of_the_last_figure(expected.value);
    let change = metric.value - expected.value;
    let both_nan = metric.value.is_nan() && expected.value.is_nan();
    let holds = both_nan || metric.value == expected.value || change.abs() <= tolerance;
    if holds && metric.unit == expected.unit && word(metric.verdict()) == expected.verdict {
        return None;
    }
    Some(format!(
        "  {} [{}]: {} {} ({}) → {} {} ({}), change {change:.3e}, tolerance {tolerance:.3e}",
        metric.name,
        metric.variant,
        rounded(expected.value),
        expected.unit,
        expected.verdict,
        rounded(metric.value),
        metric.unit,
        word(metric.verdict()),
    ))
}

fn parsed(text: &str) -> Option<Line<'_>> {
    let cells: Vec<&str> = text.split('|').map(str::trim).collect();
    let &[name, variant, value, unit, verdict] = cells.as_slice() else { return None };
    Some(Line { name, variant, value: value.parse().ok()?, unit, verdict })
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
        Verdict::Observed => "observed",
    }
}

/// Four significant figures, such as `0.5522`, `12.35`, `1.235e-6`.
fn rounded(value: f64) -> String {
    match exponent(value) {
        Some(exponent) if (-3..FIGURES).contains(&exponent) => {
            let decimals = usize::try_from(FIGURES - 1 - exponent).unwrap_or(0);
            format!("{value:.decimals$}")
        }
        Some(_) => format!("{value:.3e}"),
        None if value == 0.0 => "0".to_owned(),
        None => value.to_string(),
    }
}

/// The power of ten of the rounded value: 9.9999 counts as 10.00. None for 0 and what is not finite.
fn exponent(value: f64) -> Option<i32> {
    (value != 0.0 && value.is_finite())
        .then(|| format!("{value:.3e}"))
        .and_then(|text| text.split_once('e')?.1.parse().ok())
}

fn half_a_unit_of_the_last_figure(value: f64) -> f64 {
    exponent(value).map_or(0.0, |exponent| 0.5 * 10f64.powi(exponent + 1 - FIGURES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_validation::metric::Limit;

    fn metric(value: f64) -> Metric {
        Metric::observed("velocity_l2", "resolution=40", value, "%")
            .gated(Limit::AtMost(1.0), "for the test")
            .with_snapshot_tolerance(0.01, 0.001)
    }

    #[test]
    fn values_have_four_figures_and_are_read_back() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (0.55219, "0.5522"),
            (9.99996, "10.00"),
            (-12.3456, "-12.35"),
            (1234.56, "1235"),
            (123_456.0, "1.235e5"),
            (0.000_123_456, "1.235e-4"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(rounded(value), text);
            assert!(drifts(&super::text(&[metric(value)]), &[metric(value)]).is_empty(), "{value}");
        }
    }

    #[test]
    fn drift_below_the_tolerance_passes_and_above_it_fails() {
        let snapshot = text(&[metric(0.5)]);
        assert_eq!(snapshot, "velocity_l2 | resolution=40 | 0.5000 | % | pass\n");
        // 0.01 · 0.5 + 0.001 + 0.00005 of rounding = 0.00605
        for value in [0.506, 0.494] {
            assert_eq!(drifts(&snapshot, &[metric(value)]), [""; 0]);
        }
        for value in [0.5061, 0.4939, f64::NAN, f64::INFINITY] {
            assert_eq!(drifts(&snapshot, &[metric(value)]).len(), 1, "{value}");
        }
        assert_eq!(
            drifts(&snapshot, &[metric(0.51)]),
            ["  velocity_l2 [resolution=40]: 0.5000 % (pass) → 0.5100 % (pass), change 1.000e-2, tolerance 6.050e-3"]
        );
    }

    #[test]
    fn unit_verdict_and_the_set_of_metrics_count() {
        let snapshot = text(&[metric(1.0)]);
        assert_eq!(drifts(&snapshot, &[metric(1.001)]).len(), 1, "within the tolerance, but the gate fails now");
        let other_unit = Metric { unit: "-".to_owned(), ..metric(1.0) };
        assert_eq!(drifts(&snapshot, &[other_unit]).len(), 1);
        assert_eq!(drifts(&snapshot, &[]), ["  no longer measured: velocity_l2 | resolution=40"]);
        assert_eq!(
            drifts("", &[metric(0.5)]),
            ["  not in the snapshot: velocity_l2 | resolution=40 | 0.5000 | % | pass"]
        );
        assert_eq!(drifts("what is this", &[]), ["  unreadable line in the snapshot: what is this"]);
    }
}
