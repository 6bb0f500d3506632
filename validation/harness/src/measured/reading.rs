//! The file of measurements.

use super::{MeasuredColumn, Measurements, Said};
use crate::case::ParameterError;
use crate::input::{DOCUMENT, FieldError, TextTable, is_mark, name_and_unit, plain_lines, read_text, unit};
use crate::metric::Confidence;
use crate::output::FileError;
use std::path::Path;

/// Keys of comments that mean something here.
const KEYS: [&str; 6] = ["limit", "figure", "panel", "curve", "source", "confidence"];

/// Keys of tables that are read elsewhere, such as by calibrations.
const OTHER_KEYS: [&str; 5] = ["quantity", "unit", "kind", "uncertainty", "licence"];

/// No measurement is larger, in whatever unit; squares of such numbers are still finite.
const LARGEST: f64 = 1e30;

pub(super) fn read(path: &Path) -> Result<Measurements, ParameterError> {
    let text = read_text(path, DOCUMENT).map_err(|error| FileError::unreadable(path, &error))?;
    Ok(parse(path, &text).map_err(|error| error.in_file(path))?)
}

fn parse(path: &Path, text: &str) -> Result<Measurements, FieldError> {
    let text = &*plain_lines(text);
    let table = TextTable::parse(text, path)?;
    if table.headings.len() != 3 {
        return Err(FieldError::new(
            "columns",
            format!("{} ({})", table.headings.len(), table.headings.join(", ")),
            "three: what was varied, what was measured, and its standard uncertainty, each with its unit",
            "such as y/h [-],u [m/s],uncertainty [m/s]",
        ));
    }
    let columns: Vec<MeasuredColumn> = table
        .headings
        .iter()
        .zip(table.columns)
        .map(|(heading, values)| column(heading, values))
        .collect::<Result<_, _>>()?;
    let Ok([abscissa, measured, uncertainty]) = <[MeasuredColumn; 3]>::try_from(columns) else {
        unreachable!("there are three columns")
    };
    let factor = same_kind(&uncertainty.unit, &measured.unit).ok_or_else(|| {
        if let Some(unknown) = [&measured, &uncertainty].into_iter().find(|own| !unit::is_known(&own.unit)) {
            let (value, rule) = (format!("[{}]", unknown.unit), "a unit that is known, such as [cm/s] or [kPa]");
            return FieldError::new(&unknown.name, value, rule, "mend the heading");
        }
        let rule = format!("a unit of the same kind as [{}], which is that of {}", measured.unit, measured.name);
        FieldError::new(&uncertainty.name, format!("[{}]", uncertainty.unit), &rule, "mend the heading")
    })?;
    if let Some(row) = uncertainty.values.iter().position(|value| *value <= 0.0) {
        let value = format!("{} in row {}", uncertainty.values[row], row + 1);
        let remedy = "give a standard deviation; without one there is nothing to compare by";
        return Err(FieldError::new(&uncertainty.name, value, "positive", remedy));
    }
    Ok(Measurements {
        path: path.to_owned(),
        text: text.to_owned(),
        uncertainty: uncertainty.values.iter().map(|value| value * factor).collect(),
        abscissa,
        measured,
        said: said(text)?,
    })
}

fn column(heading: &str, values: Vec<f64>) -> Result<MeasuredColumn, FieldError> {
    let Some((name, unit)) = name_and_unit(heading) else {
        let rule = "a heading with its unit in brackets";
        return Err(FieldError::new(heading, format!("\"{heading}\""), rule, "such as \"x [cm]\""));
    };
    if let Some(row) = values.iter().position(|value| is_mark(*value)) {
        let defect = format!("{} in row {}, a mark of a missing value", values[row], row + 1);
        return Err(FieldError::finding(heading, defect, "leave the row out"));
    }
    if let Some(row) = values.iter().position(|value| !value.is_finite() || value.abs() > LARGEST) {
        let value = format!("{} in row {}", values[row], row + 1);
        return Err(FieldError::new(heading, value, "finite numbers up to 1e30", "leave the row out or mend it"));
    }
    Ok(MeasuredColumn { name: name.to_owned(), unit: unit.to_owned(), values })
}

/// The factor from one unit to another `[-]`; of the same text it is 1, also where the unit is unknown.
pub(super) fn same_kind(from: &str, to: &str) -> Option<f64> {
    if from == to { Some(1.0) } else { unit::factor(from, to) }
}

/// Values that the comments give. A key with a slip of the pen is refused: a limit must not vanish.
fn said(text: &str) -> Result<Said, FieldError> {
    let mut said = Said::default();
    for line in text.lines().filter_map(|line| line.trim_start().strip_prefix('#')) {
        let Some((key, value)) = line.split_once(':') else { continue };
        let (key, value) = (key.trim().to_lowercase(), value.trim().to_owned());
        if value.is_empty() || OTHER_KEYS.contains(&key.as_str()) {
            continue;
        }
        let wrong = |rule: &str, remedy: &str| Err(FieldError::new(&format!("# {key}"), &value, rule, remedy));
        match key.as_str() {
            "limit" => match value.parse::<f64>() {
                Ok(limit) if limit > 0.0 && limit.is_finite() => said.limit = Some(limit),
                _ => return wrong("a positive number", "such as 2, in standard uncertainties"),
            },
            "figure" => said.figure = Some(value),
            "panel" => said.panel = Some(value),
            "curve" => said.curve = Some(value),
            "source" => said.source = Some(value),
            "confidence" => match Confidence::stated(&value) {
                Some(confidence) => said.confidence = Some(confidence),
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
