//! Shipped scenes against what is known of them. Their balances are gates of the case; what is here takes several scenes.

use crate::threads::alone;
use bagnold_harness::case::{CaseFile, Changes, Silent, Tier, execute};
use bagnold_harness::output::Table;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_validation::REGISTRY;
use std::path::Path;

/// The series of a shipped scene.
fn series(name: &str) -> Table {
    changed(name, |_| ())
}

/// The same with other parameters.
fn changed(name: &str, change: impl FnOnce(&mut toml::Table)) -> Table {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/scenes").join(name);
    let CaseFile { case, tier, mut fields, .. } = CaseFile::read(&path).expect("a scene");
    change(&mut fields);
    let changes = Changes { file: Some((&path, fields)), ..Changes::default() };
    let prepared = REGISTRY.find(&case).and_then(|case| case.prepare(tier.unwrap_or(Tier::Quick), &changes));
    let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
    alone();
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

#[test]
fn rough_side_walls_shorten_the_run_out_in_a_channel() {
    // twelve particles over the height and six across
    let coarse = |fields: &mut toml::Table| {
        fields.insert("spacing".to_owned(), (0.1 / 12.0).into());
        fields.insert("interval".to_owned(), 0.02.into());
    };
    let front = |table: &Table| {
        let column = table.columns.iter().position(|name| name.starts_with("front")).expect("a front gauge");
        table.rows.last().expect("rows")[column]
    };
    let with = changed("channel-collapse.toml", coarse);
    let without = changed("channel-collapse.toml", |fields| {
        coarse(fields);
        let list = |fields: &mut toml::Table, name: &str| fields[name].as_array().cloned().expect("a list");
        let named = |entry: &toml::Value, name: &str| entry["name"].as_str() == Some(name);
        let walls: Vec<_> = list(fields, "walls").into_iter().filter(|wall| !named(wall, "sides")).collect();
        let gauges: Vec<_> = list(fields, "gauges").into_iter().filter(|gauge| !named(gauge, "on-the-sides")).collect();
        fields.insert("walls".to_owned(), walls.into());
        fields.insert("gauges".to_owned(), gauges.into());
        let sides = fields["sides"].as_table_mut().expect("sides");
        for (side, plane) in [("front", 0.0), ("back", 0.05)] {
            sides.insert(side.to_owned(), toml::Table::from_iter([("mirror".to_owned(), plane.into())]).into());
        }
    });
    let (with, without) = (front(&with), front(&without));
    println!("front at {with} m between side walls, at {without} m between mirrors");
    assert!(with > 0.15 && without < 0.45, "{with} m and {without} m");
    assert!(with < 0.95 * without, "{with} m with side walls, {without} m without");
}
