//! Shipped scenes against what is known of them. Their balances are gates of the case; what is here takes several scenes.

use bagnold_validation::case::{CaseFile, Changes, Silent, Tier, execute};
use bagnold_validation::cases::REGISTRY;
use bagnold_validation::output::Table;
use bagnold_validation::store::{Store, StorePolicy};
use std::path::Path;

/// The series of a shipped scene.
fn series(name: &str) -> Table {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/scenes").join(name);
    let CaseFile { case, tier, fields, .. } = CaseFile::read(&path).expect("a scene");
    let changes = Changes { file: Some((&path, fields)), ..Changes::default() };
    let prepared = REGISTRY.find(&case).and_then(|case| case.prepare(tier.unwrap_or(Tier::Quick), &changes));
    let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
    let mut results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent).expect("a result");
    let mut tables = results.remove(0).tables;
    tables.remove(0)
}

/// Mean discharge `[kg/(m s)]` between two times `[s]`.
fn discharge(table: &Table, from: f64, to: f64) -> f64 {
    let column = table.columns.iter().position(|name| name.contains("has crossed")).expect("a flux gauge");
    let at = |time: f64| table.rows.iter().find(|row| row[0] >= time - 1e-9).expect("a time in the series");
    let (first, last) = (at(from), at(to));
    (last[column] - first[column]) / (last[0] - first[0])
}

#[test]
#[ignore = "minutes: three hoppers"]
fn hoppers_discharge_steadily_and_as_the_opening_to_the_power_of_three_halves() {
    let widths = [0.036_f64, 0.048, 0.064];
    let rates = ["hopper-36.toml", "hopper-48.toml", "hopper-64.toml"].map(|name| {
        let table = series(name);
        let (early, late) = (discharge(&table, 0.2, 0.4), discharge(&table, 0.4, 0.6));
        println!("{name}: {early} and {late} kg/(m s)");
        assert!((early / late - 1.0).abs() < 0.1, "{name}: {early} and then {late} kg/(m s)");
        discharge(&table, 0.2, 0.6)
    });
    // least squares in logarithms
    let points: Vec<(f64, f64)> = widths.iter().zip(rates).map(|(width, rate)| (width.ln(), rate.ln())).collect();
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let exponent = mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x).powi(2));
    println!("exponent {exponent}");
    assert!((exponent - 1.5).abs() < 0.2, "exponent {exponent}");
}
