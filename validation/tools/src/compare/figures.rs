//! Profiles and histories of several runs of a case in one figure.

use super::reading::Results;
use crate::figure::{Axis, Figure, Panel};
use crate::output::Table;
use std::collections::BTreeSet;

/// A figure for each table that two folders have at least: every column over the first one, a curve for each folder.
pub(super) fn all(all: &[Results], case: &str) -> Vec<Figure> {
    let of = |results: &Results| results.cases.get(case).map(|own| own.tables.clone()).unwrap_or_default();
    let tables: Vec<Vec<Table>> = all.iter().map(of).collect();
    let mut seen = BTreeSet::new();
    let names: Vec<String> =
        tables.iter().flatten().map(|table| table.name.clone()).filter(|name| seen.insert(name.clone())).collect();
    names.into_iter().filter_map(|name| figure(all, case, &name, &tables)).collect()
}

fn figure(all: &[Results], case: &str, name: &str, tables: &[Vec<Table>]) -> Option<Figure> {
    let named = tables.iter().map(|tables| tables.iter().find(|table| table.name == name)).enumerate();
    let own: Vec<(usize, &Table)> = named.filter_map(|(folder, table)| Some((folder, table?))).collect();
    let (_, first) = *own.first().filter(|_| own.len() > 1)?;
    let (x, others) = first.columns.split_first()?;
    let panels = others.iter().map(|column| {
        let mut panel = Panel::new("", Axis::linear(x), Axis::linear(column));
        for (folder, table) in &own {
            let place = |heading: &String| table.columns.iter().position(|other| other == heading);
            if let (Some(x), Some(y)) = (place(x), place(column)) {
                let points = table.rows.iter().filter_map(|row| Some((*row.get(x)?, *row.get(y)?)));
                panel.line(&all[*folder].label, *folder, points);
            }
        }
        panel
    });
    let labels: Vec<&str> = own.iter().map(|(folder, _)| all[*folder].label.as_str()).collect();
    let caption = format!("{case}, table {name}: {}.", labels.join(", "));
    Some(Figure::new(&format!("{case}-{name}"), &caption, panels.collect()).in_columns(2))
}
