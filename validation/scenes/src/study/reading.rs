//! Readings of a check in a study: metrics, values and distances of columns, and orders of earlier checks.

use super::check::{CheckedQuantity, StudyCheck};
use super::file::Reduction;
use super::probe::{self, ColumnWindow, RunCurve};
use super::{Study, file};
use crate::case::CaseResult;
use crate::input::FieldError;
use crate::measured::{COARSE, coarse_in_words};
use crate::metric::{Metric, Origin, Uncertainty, Value, Variant};
use crate::statistics::{grouped, log_log_slope};
use bagnold_number::four_digits;

/// Reading of a check in one run.
pub(super) struct Reading {
    /// The run: keys of the study and of the case.
    pub(super) variant: Variant,
    pub(super) value: f64,
    pub(super) unit: String,
    /// Curve of the reading; none for a metric of the case.
    pub(super) curve: Option<RunCurve>,
    /// Uncertainty that the case states for the value.
    pub(super) uncertainty: Uncertainty,
    /// Reason for a missing value, or the rows that the value leaves out.
    pub(super) remark: Option<String>,
}

impl Reading {
    fn new(variant: Variant, value: f64, unit: impl Into<String>, curve: Option<RunCurve>) -> Self {
        let remark = value.is_nan().then(|| "there is no finite value to take it from".to_owned());
        Self { variant, value, unit: unit.into(), curve, uncertainty: Uncertainty::default(), remark }
    }

    /// The reading of a column in a run, and how many of its rows have a value.
    fn of_column(variant: Variant, value: f64, unit: &str, column: &ColumnWindow, curve: RunCurve) -> Self {
        let (wet, all, over) = (curve.wet().count(), curve.points.len(), &curve.over);
        let ends = [curve.points.first(), curve.points.last()];
        let [from, to] = ends.map(|end| four_digits(end.map_or(f64::NAN, |end| end.0)));
        let counted = format!("`{}` has a value in {wet} of {all} rows, {over} from {from} to {to}", column.heading());
        let remark = (value.is_nan() || wet < all).then_some(counted);
        Self { remark, ..Self::new(variant, value, unit, Some(curve)) }
    }
}

impl Study {
    /// Readings of a check in all runs; for an order, those of the checks before it.
    pub(super) fn readings(
        &self,
        check: &StudyCheck,
        results: &[CaseResult],
        earlier: &[Metric],
    ) -> Result<Vec<Reading>, FieldError> {
        if let CheckedQuantity::Order { of, in_parameter } = &check.read {
            return Ok(orders(earlier, of, in_parameter, &check.only));
        }
        if let CheckedQuantity::Difference { of, between } = &check.read {
            return differences(earlier, of, between, &check.only);
        }
        let mut readings = Vec::new();
        for (changed, result) in self.changes.iter().zip(results) {
            let of_run = |run: &Variant| joined(&changed.variant, run);
            match &check.read {
                CheckedQuantity::Metric(name) => {
                    let metrics = probe::metrics(result, name)?;
                    readings.extend(metrics.into_iter().map(|metric| Reading {
                        uncertainty: metric.uncertainty.clone(),
                        remark: metric.remark.clone(),
                        ..Reading::new(of_run(&metric.variant), metric.value, &metric.unit, None)
                    }));
                }
                CheckedQuantity::Value(column, reduction) => {
                    for curve in column.curves(result)? {
                        let value = curve.value(*reduction);
                        let (over, own) = (probe::unit_of(&curve.over), probe::unit_of(&column.column));
                        let unit = match reduction {
                            Reduction::Reaches(_) => over.to_owned(),
                            Reduction::Slope => format!("{own}/{over}"),
                            _ => own.to_owned(),
                        };
                        let half = curve.resolution_of(*reduction);
                        let mut reading = Reading::of_column(of_run(&curve.run), value, &unit, column, curve);
                        reading.uncertainty.add(Origin::Numerical, Some(half), "half a row of particles");
                        readings.push(reading);
                    }
                }
                CheckedQuantity::Distance(column, measured, distance) => {
                    for curve in column.curves(result)? {
                        let points = measured.in_units(probe::unit_of(&curve.over), probe::unit_of(&column.column))?;
                        let value = curve.distance(&points, column.window, *distance);
                        let unit = match distance {
                            file::Distance::Residual => "-",
                            file::Distance::RelativeL2 => "%",
                            file::Distance::Largest | file::Distance::Mean => probe::unit_of(&column.column),
                        };
                        let rows = curve.beside_rows(&points, column.window, *distance);
                        let coarse = coarse_in_words(&rows, probe::unit_of(&column.column));
                        let bare = RunCurve { resolution: Vec::new(), ..curve.clone() };
                        let by_resolution = bare.distance(&points, column.window, *distance) - value;
                        let mut reading = Reading::of_column(of_run(&curve.run), value, unit, column, curve);
                        reading.uncertainty.add(Origin::Numerical, Some(by_resolution), COARSE);
                        readings.push(Reading { remark: reading.remark.clone().or(coarse), ..reading });
                    }
                }
                CheckedQuantity::Order { .. } | CheckedQuantity::Difference { .. } => {}
            }
        }
        readings.retain(|reading| reading.variant.includes(&check.only));
        Ok(readings)
    }
}

/// Slopes of ln |value| of an earlier check over ln of a varied parameter, one for each set of the other keys.
fn orders(earlier: &[Metric], of: &str, in_parameter: &str, only: &Variant) -> Vec<Reading> {
    let own = earlier.iter().filter(|metric| metric.name == of && metric.variant.includes(only));
    let point = |metric: &Metric| {
        let at = metric.variant.get(in_parameter).and_then(Value::number)?;
        Some((without(&metric.variant, &Variant::of(in_parameter, 0.0)), (at, metric.value.abs())))
    };
    let order = |(others, points): (Variant, Vec<(f64, f64)>)| {
        let variant = others.and(in_parameter, Value::list(points.iter().map(|point| point.0)));
        Reading::new(variant, log_log_slope(&points).unwrap_or(f64::NAN), "-", None)
    };
    grouped(own.filter_map(point)).into_iter().map(order).collect()
}

/// Difference of an earlier check between two variants over its value in the second [%], one for each set of the other keys.
fn differences(
    earlier: &[Metric],
    of: &str,
    (first, second): &(Variant, Variant),
    only: &Variant,
) -> Result<Vec<Reading>, FieldError> {
    let own = || earlier.iter().filter(|metric| metric.name == of && metric.variant.includes(only));
    let mut readings = Vec::new();
    for metric in own().filter(|metric| metric.variant.includes(first)) {
        let others = without(&metric.variant, first);
        let is_partner = |other: &&Metric| other.variant.includes(second) && without(&other.variant, second) == others;
        let Some(partner) = own().find(is_partner) else { continue };
        let both = first.parts().fold(others, |variant, (key, value)| match second.get(key) {
            Some(other) => variant.and(key, Value::list([value.clone(), other.clone()])),
            None => variant,
        });
        let share = 100.0 * (metric.value - partner.value) / partner.value.abs();
        readings.push(Reading::new(both, share, "%", None));
    }
    if readings.is_empty() {
        let variants: Vec<String> = own().take(5).map(|metric| format!("\"{}\"", metric.variant)).collect();
        let rule =
            format!("parts of two variants of `{of}` that agree in all other keys, such as {}", variants.join(", "));
        let value = format!("[\"{first}\", \"{second}\"]");
        return Err(FieldError::new("between", value, &rule, "name the keys in which the two differ"));
    }
    Ok(readings)
}

/// A variant without the keys of another.
fn without(variant: &Variant, keys: &Variant) -> Variant {
    let others = variant.parts().filter(|(key, _)| keys.get(key).is_none());
    others.fold(Variant::default(), |variant, (key, value)| variant.and(key, value.clone()))
}

/// The study's keys before those of the case's run. A key that both have stands once if it says the same.
pub(super) fn joined(own: &Variant, run: &Variant) -> Variant {
    let mut all = own.clone();
    for (key, value) in run.parts() {
        match own.get(key) {
            Some(same) if same == value => {}
            Some(_) => all = all.and(&format!("run-{key}"), value.clone()),
            None => all = all.and(key, value.clone()),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metric(name: &str, variant: &str, value: f64) -> Metric {
        Metric::observed(name, &variant.parse().expect("a variant"), value, "%")
    }

    #[test]
    fn an_order_is_the_slope_for_each_set_of_the_other_keys() {
        let error = |spacing: f64, factor: f64, order: i32| factor * spacing.powi(order);
        let mut metrics = Vec::new();
        for (law, order, sign) in [("a", 2, -1.0), ("b", 1, 1.0)] {
            for spacing in [0.01, 0.02, 0.04] {
                let variant = format!("law={law},spacing={spacing}");
                metrics.push(metric("error", &variant, sign * error(spacing, 3.0, order)));
                metrics.push(metric("another", &variant, 1.0));
            }
        }
        let found = orders(&metrics, "error", "spacing", &Variant::default());
        let variants: Vec<String> = found.iter().map(|reading| reading.variant.to_string()).collect();
        assert_eq!(variants, ["law=a,spacing=0.01_0.02_0.04", "law=b,spacing=0.01_0.02_0.04"]);
        assert!((found[0].value - 2.0).abs() < 1e-12 && (found[1].value - 1.0).abs() < 1e-12);
        assert_eq!(orders(&metrics, "error", "spacing", &Variant::of("law", "b")).len(), 1);
    }

    #[test]
    fn a_difference_pairs_runs_that_agree_in_all_other_keys() {
        let metrics = [
            metric("flux", "law=a,rows=10", 0.9),
            metric("flux", "law=a,rows=20", 1.0),
            metric("flux", "law=b,rows=10", -2.2),
            metric("flux", "law=b,rows=20", -2.0),
            metric("flux", "law=c,rows=10", 7.0),
            metric("another", "law=c,rows=20", 1.0),
        ];
        let between = (Variant::of("rows", 10.0), Variant::of("rows", 20.0));
        let found = differences(&metrics, "flux", &between, &Variant::default()).expect("two pairs");
        let shown: Vec<String> =
            found.iter().map(|reading| format!("{} {:.3}", reading.variant, reading.value)).collect();
        assert_eq!(shown, ["law=a,rows=10_20 -10.000", "law=b,rows=10_20 -10.000"]);
        let none = (Variant::of("rows", 10.0), Variant::of("rows", 40.0));
        assert!(differences(&metrics, "flux", &none, &Variant::default()).is_err());
    }

    #[test]
    fn keys_of_study_and_run_stand_once_where_they_say_the_same() {
        let joined = |own: &str, run: &str| {
            joined(&own.parse().expect("a variant"), &run.parse().expect("a variant")).to_string()
        };
        assert_eq!(joined("resolution=20,law=a", "fluid=x,resolution=20"), "resolution=20,law=a,fluid=x");
        assert_eq!(joined("resolution=20", "resolution=40"), "resolution=20,run-resolution=40");
    }
}
