//! The width of a gate as a stacked bar: what is known of the uncertainty of value and reference, over the gate's half width.

use crate::metric::{COVERAGE, Metric};
use crate::number::{two_digits, with_unit};
use serde_json::{Value, json};

/// Length of a bar that fills the gate `[px]`.
const LENGTH: f64 = 120.0;

/// Twice the stated standard uncertainty of a metric over the half width of its gate `[-]`; none where one of them is unknown. Above 1 the gate
/// cannot tell a right value from a wrong one.
pub(super) fn share_of_gate(metric: &Metric) -> Option<f64> {
    let half_width = Some(metric.gate.as_ref()?.limit.half_width()).filter(|half| half.is_finite() && *half > 0.0)?;
    Some(COVERAGE * metric.uncertainty.standard()? / half_width)
}

/// Uncertainty bar of a metric; `None` if no uncertainty is known.
pub(super) fn width(metric: &Metric) -> Option<Value> {
    let standard = metric.uncertainty.standard().filter(|standard| *standard > 0.0)?;
    let unit = |value: f64| with_unit(value, &metric.unit);
    let expanded = COVERAGE * standard;
    let of_gate = share_of_gate(metric);
    let share = of_gate.unwrap_or(1.0);
    // Uncertainties add as squares: a part's length is its share of the square of the sum.
    let length = LENGTH * share.min(1.0);
    let mut x = 0.0;
    let mut parts = Vec::new();
    let mut words = vec![format!("± {} (twice the standard uncertainty)", unit(expanded))];
    for part in metric.uncertainty.parts() {
        let wide = length * (part.standard / standard).powi(2);
        parts.push(json!({ "class": part.origin, "x": format!("{x:.1}"), "width": format!("{wide:.1}") }));
        x += wide;
        words.push(format!("{} {}: {}", part.origin.name(), unit(part.standard), part.source));
    }
    let of_gate =
        of_gate.map(|share| format!(", {}\u{202f}% of the limit", two_digits(100.0 * share))).unwrap_or_default();
    let names: Vec<&str> = metric.uncertainty.parts().iter().map(|part| part.origin.name()).collect();
    let statement = format!("± {} known{of_gate}: {}", unit(expanded), names.join(", "));
    // the sum in words below the bar, and everything in words, with the source of each part
    Some(json!({ "parts": parts, "statement": statement, "words": words.join("; ") }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Limit, Origin, Variant};

    #[test]
    fn parts_fill_the_share_of_the_gate_that_their_sum_takes() {
        let metric =
            Metric::observed("run_out", &Variant::default(), 2.0, "m").gated(Limit::Within(1.0, 3.0), "a reason");
        assert!(width(&metric).is_none(), "nothing is known");
        let metric = metric.known_to(Origin::Digitisation, Some(0.15), "other readings").known_to(
            Origin::Repeat,
            Some(0.2),
            "five seeds",
        );
        // 0.25, twice of it is half of the gate: 60 px, of which 9/25 and 16/25
        let bar = width(&metric).expect("known");
        let part = |class: &str, x: &str, width: &str| json!({ "class": class, "x": x, "width": width });
        assert_eq!(bar["parts"], json!([part("digitisation", "0.0", "21.6"), part("repeat", "21.6", "38.4")]));
        let says = |field: &str, text: &str| bar[field].as_str().is_some_and(|own| own.contains(text));
        assert!(says("statement", "of the limit: digitisation, repetition"), "{bar}");
        assert!(says("words", "repetition 0.2\u{202f}m: five seeds"), "{bar}");
        let too_wide = metric.known_to(Origin::Experiment, Some(5.0), "theirs");
        let bar = width(&too_wide).expect("known");
        let wide = |part: &Value| part["width"].as_str().and_then(|wide| wide.parse::<f64>().ok()).expect("a number");
        let ends: f64 = bar["parts"].as_array().expect("parts").iter().map(wide).sum();
        assert!((ends - LENGTH).abs() < 0.2, "no longer than the gate");
    }
}
