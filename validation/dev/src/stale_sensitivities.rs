//! Tables of `validation/harness/sensitivities` that are no longer of the program: a metric or an input has another name, the case another value of
//! an input, or its results have moved.

use crate::REGISTRY;
use crate::case::{Changes, Tier};
use crate::evidence::{
    RangeEnd, SensitivityRow, StatedUncertainty, ValidatedComparison, ValidationSet, completed, sensitivity_table,
};
use crate::metric::{ComparisonPart, Confidence, Metric, MetricKind};
use std::collections::BTreeSet;

/// Largest relative change of a value with nominal inputs since its table was made: a derivative of a result that
/// changes by a hundredth changes by about as much, of which an uncertainty with two digits shows nothing.
const MOVED: f64 = 0.01;

/// Baseline comparisons of the paper tier.
const PAPER: &str = include_str!("../../harness/snapshots/comparisons/paper.csv");

/// Names of all cases that state ranges.
fn stating() -> impl Iterator<Item = (&'static str, &'static StatedUncertainty)> {
    let stated = |name: &'static str| Some((name, StatedUncertainty::of(name)?));
    let all = REGISTRY.iter().filter_map(move |case| stated(case.name()));
    all.filter(|(_, stated)| !stated.ranges.is_empty())
}

/// Differences of a table from the current program, line by line.
fn stale(
    case: &str,
    stated: &StatedUncertainty,
    table: &[SensitivityRow],
    baseline: &[&ValidatedComparison],
) -> Vec<String> {
    let mut found = Vec::new();
    let own = || table.iter().filter(|row| row.end == RangeEnd::Own && row.repeat == 0);
    for row in baseline {
        let metric = Metric::observed(&row.quantity, &row.variant, row.value, &row.unit);
        let is_of_a_range = stated.ranges.iter().any(|range| range.is_of(&row.variant));
        if !is_of_a_range || stated.says(ComparisonPart::Input, &metric) {
            continue;
        }
        match own().find(|own| own.quantity == row.quantity && own.variant == row.variant) {
            None => found.push(format!("{case}: {} of {} is not in the table", row.quantity, row.variant)),
            Some(own) if (own.value - row.value).abs() > MOVED * row.value.abs() => found.push(format!(
                "{case}: {} of {} is {} in the table and {} in the baseline",
                row.quantity, row.variant, own.value, row.value
            )),
            Some(_) => {}
        }
    }
    // columns that only a longer tier has stand in a table too
    let longer = ValidationSet::parse(PAPER).expect("the comparisons of the paper tier");
    let of_longer = longer.comparisons.iter().filter(|row| row.case == case);
    let quantities: BTreeSet<&str> =
        baseline.iter().copied().chain(of_longer).map(|row| row.quantity.as_str()).collect();
    let unknown: BTreeSet<&str> =
        own().map(|row| row.quantity.as_str()).filter(|name| !quantities.contains(name)).collect();
    found.extend(unknown.iter().map(|name| format!("{case}: no comparison of the baseline is called {name}")));
    found
}

#[test]
fn tables_are_of_the_program() {
    let baseline = ValidationSet::shipped();
    for (case, stated) in stating() {
        let rows: Vec<&ValidatedComparison> = baseline.comparisons.iter().filter(|row| row.case == case).collect();
        let found = stale(case, stated, sensitivity_table(case), &rows);
        assert!(
            found.is_empty(),
            "run `cargo run -p bagnold-dev -- sensitivities {case}` again:\n{}",
            found.join("\n")
        );
    }
}

#[test]
fn a_renamed_metric_and_a_moved_value_make_a_table_stale() {
    let baseline = ValidationSet::shipped();
    let case = "incline-collapse";
    let stated = StatedUncertainty::of(case).expect("ranges");
    let rows: Vec<&ValidatedComparison> = baseline.comparisons.iter().filter(|row| row.case == case).collect();
    let table = sensitivity_table(case);
    let with = |change: fn(&mut SensitivityRow)| {
        let mut table = table.to_vec();
        table.iter_mut().for_each(change);
        stale(case, stated, &table, &rows)
    };
    assert_eq!(with(|_| {}), Vec::<String>::new());
    assert!(with(|row| row.quantity.push('s')).iter().any(|line| line.contains("is not in the table")));
    assert!(with(|row| row.quantity.push('s')).iter().any(|line| line.contains("no comparison of the baseline")));
    assert!(with(|row| row.value *= 1.02).iter().all(|line| line.contains("in the baseline")));
    assert_eq!(with(|row| row.value *= 1.02).len(), rows.len());
    assert_eq!(with(|row| row.value *= 1.001), Vec::<String>::new());
}

#[test]
fn ranges_are_about_the_values_that_the_cases_have() {
    for (name, stated) in stating() {
        let case = REGISTRY.find(name).expect("a case");
        let prepared = case.prepare(Tier::Quick, &Changes::default()).expect("the tier is valid");
        let parameters: toml::Value = toml::from_str(prepared.parameters_toml()).expect("parameters");
        for range in &stated.ranges {
            let first = range.low.first().and_then(|setting| setting.split_once('='));
            let (path, _) = first.unwrap_or_else(|| panic!("{name}: {} has no path", range.name));
            let number = |value: &toml::Value| value.as_float().or(value.as_integer().map(|value| value as f64));
            let at =
                |table| path.split('.').try_fold(table, |table: &toml::Value, key| table.get(key)).and_then(number);
            // what a range is only for may have its own value in the list of runs
            let variants = parameters.get("variants").and_then(toml::Value::as_array);
            let listed = variants.into_iter().flatten().filter_map(|variant| variant.get("set")).filter_map(at);
            let listed: Vec<f64> = listed.filter(|_| !range.only_for.is_empty()).collect();
            let own: Vec<f64> = at(&parameters).into_iter().chain(listed).collect();
            let is_own = own.iter().any(|own| (own - range.own).abs() <= 1e-9 * own.abs());
            assert!(is_own, "{name}: {path} is {own:?} in the case and {} in uncertainty.toml", range.own);
        }
    }
}

#[test]
fn a_bed_of_particles_has_the_uncertainty_by_the_inputs_of_the_layer_with_its_closures() {
    let bed = StatedUncertainty::of("bed-load").expect("a file");
    for slope in ["0.02", "0.03", "0.05"] {
        let variant = format!("slope={slope},start=rest").parse().expect("a variant");
        let of_layer = Metric::observed("transport_ratio", &variant, 1.0, "-").of_kind(MetricKind::Validation).against(
            Some(1.0),
            "a formula",
            Confidence::High,
        );
        let layer = &completed("bed-load-1d", vec![of_layer])[0];
        let expected = layer.uncertainty.of_part(ComparisonPart::Input).expect("ranges");
        let variant = format!("formulation=dilating,slope={slope}").parse().expect("a variant");
        let part = bed.parts.iter().find(|own| own.part == ComparisonPart::Input && own.variant == variant);
        let stated = part.and_then(|own| own.relative).expect("a number");
        assert!((stated - expected).abs() <= 0.005, "slope {slope}: {stated} in bed-load, {expected} in bed-load-1d");
    }
}
