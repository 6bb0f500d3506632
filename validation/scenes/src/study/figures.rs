//! Figures of the checks' readings beside their references.

use super::check::{CheckedQuantity, StudyCheck};
use super::file::Reduction;
use super::{Reading, probe};
use crate::figure::{Axis, Figure, Mark, Panel};
use crate::input::FieldError;
use crate::measured::HALF_A_ROW;

/// Adds the figure of a check's column, or draws its reference into that which an earlier check has made.
pub(super) fn add(figures: &mut Vec<Figure>, check: &StudyCheck, readings: &[Reading]) -> Result<(), FieldError> {
    let (CheckedQuantity::Value(column, _) | CheckedQuantity::Distance(column, ..)) = &check.read else {
        return Ok(());
    };
    let Some(first) = readings.iter().find_map(|reading| reading.curve.as_ref()) else { return Ok(()) };
    let heading = column.heading();
    let signs = heading.replace('+', "plus").replace('−', "minus");
    let mut name = name_of(&format!("{}-{signs}", column.table));
    // a column over another one than an earlier check takes has axes of its own
    if figures.iter().any(|figure| figure.name == name && figure.panels[0].x.label != first.over) {
        name = name_of(&format!("{name}-over-{}", first.over));
    }
    let place = figures.iter().position(|figure| figure.name == name).unwrap_or_else(|| {
        let panel = Panel::new("", Axis::linear(&first.over), Axis::linear(&heading));
        let caption = format!("{heading} over {}, as simulated", first.over);
        figures.push(Figure::new(&name, &caption, vec![panel]));
        figures.len() - 1
    });
    let figure = &mut figures[place];
    let panel = &mut figure.panels[0];
    let next = |panel: &Panel| panel.series.iter().map(|series| series.colour + 1).max().unwrap_or(0);
    for reading in readings {
        let label = match reading.variant.to_string() {
            label if label.is_empty() => "simulated".to_owned(),
            label => label,
        };
        let Some(curve) = &reading.curve else { continue };
        let same_run = panel.series.iter().find(|series| series.label == label).map(|series| series.colour);
        let slot = same_run.unwrap_or_else(|| next(panel));
        // an earlier check may have drawn the same window; another window is a line of its own in the run's colour
        let is_drawn = |point: &(f64, f64)| {
            panel.series.iter().any(|series| series.colour == slot && series.points.contains(point))
        };
        if !curve.wet().all(|point| is_drawn(&point)) {
            let label = if same_run.is_some() { "" } else { &label };
            panel.line(label, slot, curve.points.iter().copied());
            // the width that a residual is counted in where it exceeds the measurement's
            let points = curve.points.iter().filter_map(|(x, y)| {
                let (_, half) = curve.resolution.iter().find(|(other, _)| other == x)?;
                Some((*x, y - half, y + half))
            });
            let points: Vec<_> = points.filter(|point| point.1.is_finite()).collect();
            if !points.is_empty() {
                panel.band(HALF_A_ROW, points);
            }
        }
    }
    let colour = next(panel);
    if let CheckedQuantity::Distance(column, measured, _) = &check.read {
        let points = measured.in_units(probe::unit_of(&first.over), probe::unit_of(&column.column))?;
        let cloud = points.iter().map(|point| (point[0], point[1]));
        let series = panel.draw(&measured.legend(), Mark::Points, colour, cloud);
        series.error = points.iter().map(|point| point[2]).collect();
        let said = format!(", as simulated; points with their standard uncertainty: {}", measured.source());
        figure.caption = figure.caption.replacen(", as simulated", &said, 1);
    } else if let CheckedQuantity::Value(_, Reduction::Slope) = &check.read {
        // a slope has no place among the column's values
    } else if let Some((value, uncertainty)) = check.reference() {
        if let CheckedQuantity::Value(_, Reduction::Reaches(_)) = &check.read {
            let values = || first.points.iter().map(|point| point.1);
            let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
            panel.reference(&check.name, [(value, low), (value, high)]);
            figure.caption += &format!("; dashed: reference of {}", check.name);
            return Ok(());
        }
        let ends = first.points.first().zip(first.points.last()).map_or((0.0, 1.0), |(from, to)| (from.0, to.0));
        panel.reference(&check.name, [(ends.0, value), (ends.1, value)]);
        if let Some(uncertainty) = uncertainty {
            let edges = [ends.0, ends.1].map(|x| (x, value - uncertainty, value + uncertainty));
            panel.band("", edges);
        }
        let shaded = if uncertainty.is_some() { " (shaded: its standard uncertainty)" } else { "" };
        // checks of several runs may share a name
        let names = figure.caption.split_once("; dashed: ").map(|(_, names)| names);
        let joint = names.map_or("; dashed: reference of ", |_| " and of ");
        if !names.is_some_and(|names| names.split(' ').any(|name| name == check.name)) {
            figure.caption += &format!("{joint}{}{shaded}", check.name);
        }
    }
    Ok(())
}

/// A file name: letters, digits and dashes.
fn name_of(text: &str) -> String {
    let letters: String = text.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '-' }).collect();
    let words: Vec<&str> = letters.split('-').filter(|word| !word.is_empty()).collect();
    words.join("-").to_lowercase()
}
