//! Standard uncertainties of a comparison from runs at both ends of the range of an input, and from a run with a finer spacing.
//!
//! An input is spread evenly over its range, or its logarithm where the range is a factor. The error E = S − D of the comparison is
//! taken for straight on either side of the case's own value, and its uncertainty is the root mean square of what it then differs by
//! from the error at that value:
//!
//! u² = (p e_low² + (1 − p) e_high²)/3,
//!
//! with the place p of the own value in the range, 0 at the lower end. In the middle of a range with a straight E this is
//! |E_high − E_low|/√12. An own value that stands at an end of its range may be as far off as the range is wide, and u is twice that.
//! Both ends may move E to the same side: their difference would then hide the effect of the input, but u does not.

use super::sensitivity_table::{RangeEnd, SensitivityRow};
use crate::metric::{Metric, Variant};

/// The key of a variant that names no input: the spacing.
const SPACING: &str = "resolution";

/// The rows of a comparison. Of one whose spacing was not run, those of the same comparison with another spacing, for what an input does
/// depends little on it; with the variant that they are of.
pub(super) fn rows_of<'t>(
    table: &'t [SensitivityRow],
    metric: &Metric,
) -> (Vec<&'t SensitivityRow>, Option<&'t Variant>) {
    let named = || table.iter().filter(|row| row.quantity == metric.name);
    let own: Vec<&SensitivityRow> = named().filter(|row| row.variant == metric.variant).collect();
    if !own.is_empty() {
        return (own, None);
    }
    let Some(like) = named().find(|row| is_same_but_for_spacing(&row.variant, &metric.variant)) else {
        return (own, None);
    };
    (named().filter(|row| row.variant == like.variant).collect(), Some(&like.variant))
}

fn is_same_but_for_spacing(one: &Variant, other: &Variant) -> bool {
    let is_other = |key: &&str| *key != SPACING;
    let keys = |variant: &Variant| variant.parts().map(|(key, _)| key.to_owned()).collect::<Vec<_>>();
    keys(one) == keys(other)
        && one.get(SPACING).is_some()
        && one.parts().map(|(key, _)| key).filter(is_other).all(|key| one.get(key) == other.get(key))
}

/// Mean error over the repetitions with an input at an end of its range; none where it was not run.
fn mean_error(rows: &[&SensitivityRow], input: &str, end: RangeEnd) -> Option<f64> {
    let errors: Vec<f64> =
        rows.iter().filter(|row| row.input == input && row.end == end).map(|row| row.value - row.reference).collect();
    (!errors.is_empty()).then(|| errors.iter().sum::<f64>() / errors.len() as f64)
}

/// Standard uncertainty of an error by an input whose own value stands at a place of its range, from 0 at the lower to 1 at the upper end.
pub(super) fn by_input(rows: &[&SensitivityRow], input: &str, place: f64) -> Option<f64> {
    let own = mean_error(rows, "", RangeEnd::Own)?;
    let [low, high] = [RangeEnd::Low, RangeEnd::High].map(|end| Some(mean_error(rows, input, end)? - own));
    let (low, high) = (low?, high?);
    Some(((place * low * low + (1.0 - place) * high * high) / 3.0).sqrt())
}

/// Standard uncertainty that a spacing leaves.
pub(super) fn by_spacing(rows: &[&SensitivityRow], spacing: &str) -> Option<f64> {
    let (own, refined) = (mean_error(rows, "", RangeEnd::Own)?, mean_error(rows, spacing, RangeEnd::Refined)?);
    Some(2.0 * (refined - own).abs() / 3.0_f64.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(ends: [(RangeEnd, f64); 3]) -> Vec<SensitivityRow> {
        let row = |(end, value): (RangeEnd, f64)| SensitivityRow {
            input: if end == RangeEnd::Own { String::new() } else { "friction".to_owned() },
            end,
            repeat: 0,
            quantity: "run_out".to_owned(),
            variant: "a=1,resolution=20".parse().expect("a variant"),
            value,
            reference: 0.0,
        };
        ends.map(row).to_vec()
    }

    type Function = fn(f64) -> f64;

    /// The root mean square of what a function of the place differs by from its value at the own place.
    fn by_sum(function: impl Fn(f64) -> f64, place: f64) -> f64 {
        let points = 20_000;
        let at = |k: i32| (f64::from(k) + 0.5) / f64::from(points);
        let sum: f64 = (0..points).map(|k| (function(at(k)) - function(place)).powi(2)).sum();
        (sum / f64::from(points)).sqrt()
    }

    #[test]
    fn an_input_is_propagated_as_by_summing_over_its_range() {
        // straight; at an end; bent at the own value; both ends to the same side
        let functions: [(Function, f64); 5] = [
            (|x| 3.0 * x, 0.5),
            (|x| 3.0 * x, 0.3),
            (|x| 3.0 * x, 1.0),
            (|x| if x < 0.25 { x - 0.25 } else { 4.0 * (x - 0.25) }, 0.25),
            (|x| (x - 0.5).abs(), 0.5),
        ];
        for (function, place) in functions {
            let table = rows([
                (RangeEnd::Own, function(place)),
                (RangeEnd::Low, function(0.0)),
                (RangeEnd::High, function(1.0)),
            ]);
            let found = by_input(&table.iter().collect::<Vec<_>>(), "friction", place).expect("ends");
            let expected = by_sum(function, place);
            assert!((found / expected - 1.0).abs() < 1e-4, "{found} for {expected} at {place}");
        }
    }

    #[test]
    fn a_spacing_that_was_not_run_has_the_rows_of_another_one_and_another_column_has_none() {
        let table = rows([(RangeEnd::Own, 1.0), (RangeEnd::Low, 1.1), (RangeEnd::High, 0.9)]);
        let of = |variant: &str| {
            let metric = Metric::observed("run_out", &variant.parse().expect("a variant"), 1.0, "-");
            let (rows, like) = rows_of(&table, &metric);
            (rows.len(), like.is_some())
        };
        assert_eq!(of("a=1,resolution=20"), (3, false));
        assert_eq!(of("a=1,resolution=60"), (3, true));
        assert_eq!(of("a=2,resolution=60"), (0, false));
        assert_eq!(of("a=1,seed=2,resolution=60"), (0, false));
        assert_eq!(of("a=1"), (0, false));
    }
}
