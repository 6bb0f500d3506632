//! Rules that scenes share: names, lines, times, measured series.

use super::MeasuredSeries;
use super::setting::shown;
use crate::case::ParameterError;
use crate::input::{check_name, check_text};
use bagnold_solver::vector::Vector;
use std::collections::BTreeSet;

/// Most rows of a series.
const MOST_SAMPLES: f64 = 1e5;

/// Longest line of a gauge, in spacings `[-]`: memory.
const LONGEST_LINE: f64 = 1e5;

/// Refuses a gauge's line to a place that is shorter than a spacing `[m]`, or longer than [`LONGEST_LINE`] spacings.
pub(crate) fn check_line<const D: usize>(
    to: &Vector<D>,
    length: f64,
    spacing: f64,
    across: &str,
) -> Result<(), ParameterError> {
    if length > spacing && length <= LONGEST_LINE * spacing {
        return Ok(());
    }
    let (rule, remedy) = if length > spacing {
        (format!("at most {LONGEST_LINE} spacings from `from`"), "make the line shorter")
    } else {
        (format!("farther from `from` than the spacing{across}"), "make the line longer")
    };
    Err(ParameterError::field("to", shown(to), &rule, remedy))
}

/// Names that are unlike each other and may stand in files.
pub(super) fn check(own: &str, lists: [(&str, Vec<&str>); 3]) -> Result<(), ParameterError> {
    let fit =
        |name: &str| !name.is_empty() && name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '-');
    let mut seen = BTreeSet::new();
    let named = lists
        .iter()
        .flat_map(|(list, names)| names.iter().enumerate().map(move |(k, name)| (format!("{list}[{k}].name"), *name)));
    for (field, name) in std::iter::once(("name".to_owned(), own)).chain(named) {
        // walls and inlets are called alike by gauges
        let kind = field.split('[').next().unwrap_or_default().replace("inlets", "walls");
        let refused = |rule, remedy| Err(ParameterError::field(&field, format!("\"{name}\""), rule, remedy));
        if !fit(name) {
            return refused("made of letters, digits and hyphens only", "rename it: files are named after it");
        }
        check_name(&field, name)?;
        if !seen.insert((kind, name)) {
            return refused("unique", "give each another name");
        }
    }
    Ok(())
}

/// The wall, or inlet, that a field of a gauge names is one of the scene.
pub(super) fn check_wall<'a>(
    field: &str,
    wall: &str,
    walls: impl Iterator<Item = &'a str>,
) -> Result<(), ParameterError> {
    let names: Vec<&str> = walls.collect();
    if names.contains(&wall) {
        return Ok(());
    }
    let all = if names.is_empty() { "it has none".to_owned() } else { names.join(", ") };
    let rule = format!("the name of a wall of the scene ({all})");
    Err(ParameterError::field(field, format!("\"{wall}\""), &rule, "correct the name"))
}

/// Measured series have a gauge, times and positive values.
pub(super) fn check_measured(
    measured: &[MeasuredSeries],
    is_gauge: impl Fn(&str) -> bool,
) -> Result<(), ParameterError> {
    for (k, measured) in measured.iter().enumerate() {
        let field = |name: &str| format!("measured[{k}].{name}");
        if !is_gauge(&measured.gauge) {
            let value = format!("\"{}\"", measured.gauge);
            return Err(ParameterError::field(&field("gauge"), value, "the name of a gauge", "correct the name"));
        }
        check_text(&field("source"), &measured.source)?;
        if let Some(row) = measured.points.iter().position(|&(time, value)| !(time >= 0.0 && value > 0.0)) {
            let (time, value) = measured.points[row];
            let name = field(&format!("points[{row}]"));
            let rule = "a time of 0 or later and a positive value";
            return Err(ParameterError::field(&name, format!("({time}, {value})"), rule, "correct the row"));
        }
    }
    Ok(())
}

/// Rows of the series that are neither too many nor none.
pub(super) fn check_times(interval: f64, duration: f64) -> Result<(), ParameterError> {
    let remedy = "give about a hundredth of the duration";
    let rule = if interval > duration {
        format!("at most the duration, {duration} s")
    } else if interval * MOST_SAMPLES < duration {
        format!("at least {} s, a {MOST_SAMPLES}th of the duration", duration / MOST_SAMPLES)
    } else {
        return Ok(());
    };
    Err(ParameterError::field("interval", format!("{interval} s"), &rule, remedy))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_neither_shorter_than_a_spacing_nor_endless() {
        let to = Vector::<2>::new(1.0, 0.5);
        assert!(check_line(&to, 1.0, 0.1, "").is_ok());
        let error = |length| check_line(&to, length, 0.1, "").expect_err("refused").within("gauges[2]").to_string();
        assert_eq!(
            error(0.05),
            "`gauges[2].to` is (1, 0.5), but must be farther from `from` than the spacing; make the line longer"
        );
        assert!(error(1e6).ends_with("must be at most 100000 spacings from `from`; make the line shorter"));
    }
}
