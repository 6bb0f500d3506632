//! The files of measurements: one form for figures, checks, calibrations, submissions and sweeps.

use super::{Measurements, Said, WantedColumns};
use crate::case::ParameterError;
use crate::evidence::{MeasuredColumns, NumberColumn, heading, in_unit, there};
use crate::input::{FieldError, MeasuredFiles, unnumbered};
use crate::metric::Confidence;
use crate::statistics::mean_and_variance;
use std::path::Path;

/// Keys of comments that mean something here.
const KEYS: [&str; 6] = ["limit", "figure", "panel", "curve", "source", "confidence"];

/// Forms of repeats.
const REPEATS: &str = "columns of one name, or a list of files in the place of this one";

/// Reads measurements with their uncertainties.
pub(super) fn read(given: &MeasuredFiles, wanted: WantedColumns<'_>) -> Result<Measurements, ParameterError> {
    let whole = MeasuredColumns::read::<ParameterError>(given, wanted)?;
    let (path, files) = (&given.files()[0], given.files().len());
    let is_as_it_stands = files == 1 && !matches!(given, MeasuredFiles::Named { .. });
    let measurements = measurements(whole, path, is_as_it_stands).map_err(|error| error.in_file(path))?;
    Ok(Measurements { files, ..measurements })
}

/// Mean, scatter and standard uncertainty of each row. Repeats that agree by chance scatter as those of the other rows do.
fn measurements(all: MeasuredColumns, path: &Path, is_as_it_stands: bool) -> Result<Measurements, FieldError> {
    let (first, rows) = (&all.repeats[0], all.over.values.len());
    let in_first = |own: &NumberColumn| in_unit(own, &first.unit);
    let repeats: Vec<Vec<f64>> = all.repeats.iter().map(in_first).collect::<Result<_, _>>()?;
    let stated: Vec<Vec<f64>> = all.stated.iter().map(in_first).collect::<Result<_, _>>()?;
    for (own, values) in all.stated.iter().zip(&stated) {
        if let Some(row) = values.iter().position(|value| *value <= 0.0) {
            let value = format!("{} in row {}", own.values[row], row + 1);
            let remedy = "give a standard deviation above 0";
            return Err(FieldError::new(&own.name, value, "positive", remedy));
        }
    }
    let own: Vec<Vec<f64>> = (0..rows).map(|row| there(&repeats, row)).collect();
    let spread: Vec<(f64, f64)> = own.iter().map(|row| mean_and_variance(row.iter().copied())).collect();
    // a row that one repeat alone has scatters as the others do
    let known: Vec<f64> = spread.iter().zip(&own).filter(|(_, row)| row.len() > 1).map(|(row, _)| row.1).collect();
    let pooled = known.iter().sum::<f64>() / known.len().max(1) as f64;
    let uncertainty = |row: usize| {
        let stated = stated.iter().map(|own| own[row]).fold(0.0, f64::max);
        libm::hypot((spread[row].1.max(pooled) / own[row].len() as f64).sqrt(), stated)
    };
    let uncertainty: Vec<f64> = (0..rows).map(uncertainty).collect();
    if uncertainty.contains(&0.0) {
        let defect = if repeats.len() == 1 { "has no uncertainty" } else { "is equal in all repeats" };
        let defect = format!("{} {defect}", heading(first));
        let remedy = format!("add a column `uncertainty [{}]`, or repeats: {REPEATS}", first.unit);
        return Err(FieldError::finding("columns", defect, &remedy));
    }
    let measured = NumberColumn {
        name: unnumbered(&first.name).to_owned(),
        unit: first.unit.clone(),
        values: spread.iter().map(|row| row.0).collect(),
    };
    let is_complete = own.iter().all(|row| row.len() == repeats.len());
    let text = match (is_as_it_stands, is_complete) {
        (true, _) => all.text.clone(),
        (_, true) => all.rewritten(),
        // what a repeat lacks cannot be written
        _ => {
            let stated =
                NumberColumn { name: "uncertainty".to_owned(), values: uncertainty.clone(), ..measured.clone() };
            let (over, text) = (all.over.clone(), all.text.clone());
            let repeats = vec![measured.clone()];
            MeasuredColumns { text, over, repeats, stated: vec![stated], variants: Vec::new() }.rewritten()
        }
    };
    Ok(Measurements {
        path: path.to_owned(),
        said: said(&all.text)?,
        text,
        measured,
        uncertainty,
        repeats: repeats.len(),
        files: 1,
        scatter: spread.iter().map(|row| row.1.sqrt()).collect(),
        abscissa: all.over,
        variants: all.variants,
    })
}

/// Values that the comments give. A key with a slip of the pen is refused: a limit must not vanish.
fn said(text: &str) -> Result<Said, FieldError> {
    let mut said = Said::default();
    for line in text.lines().filter_map(|line| line.trim_start().strip_prefix('#')) {
        let Some((key, value)) = line.split_once(':') else {
            // a limit in another form must not vanish either
            let number =
                |rest: &str| rest.trim_start_matches([' ', '=', '\t']).starts_with(|c: char| c.is_ascii_digit());
            if line.trim().to_lowercase().strip_prefix("limit").is_some_and(number) {
                return Err(FieldError::new(
                    "# limit",
                    line.trim(),
                    "followed by a colon",
                    "write `# limit: 2`, in standard uncertainties",
                ));
            }
            continue;
        };
        let (key, value) = (key.trim().to_lowercase(), value.trim().to_owned());
        if value.is_empty() {
            continue;
        }
        let wrong = |rule: &str, remedy: &str| Err(FieldError::new(&format!("# {key}"), &value, rule, remedy));
        match key.as_str() {
            "limit" => match value.parse::<f64>() {
                // of several files the strictest
                Ok(limit) if limit > 0.0 && limit.is_finite() => {
                    said.limit = Some(said.limit.map_or(limit, |other| other.min(limit)));
                }
                _ => return wrong("a positive number", "give it in standard uncertainties, such as 2"),
            },
            "figure" => said.figure = said.figure.or(Some(value)),
            "panel" => said.panel = said.panel.or(Some(value)),
            "curve" => said.curve = said.curve.or(Some(value)),
            "source" => said.source = said.source.or(Some(value)),
            "confidence" => match Confidence::stated(&value) {
                Some(confidence) => said.confidence = said.confidence.max(Some(confidence)),
                None => return wrong(&format!("one of {}", Confidence::STATED), "without one it is low"),
            },
            _ => {
                // comments are free; what is one letter off a key is no comment
                if let Some(meant) = KEYS.into_iter().find(|known| strsim::osa_distance(&key, known) == 1) {
                    let rule = format!("a comment of another form, or one of the keys {}", KEYS.join(", "));
                    return wrong(&rule, &format!("did you mean `{meant}`?"));
                }
            }
        }
    }
    Ok(said)
}
