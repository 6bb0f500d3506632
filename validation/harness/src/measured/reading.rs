//! The files of measurements: one form for figures, checks, calibrations, submissions and sweeps.

use super::{Measurements, Said};
use crate::case::ParameterError;
use crate::evidence::NumberColumn;
use crate::input::{
    DOCUMENT, FieldError, MeasuredFiles, TableRows, is_uncertainty, name_and_unit, plain_lines, read_text, renamed,
    unit, unnumbered,
};
use crate::metric::Confidence;
use crate::output::FileError;
use crate::statistics::mean_and_variance;
use std::collections::BTreeMap;
use std::path::Path;

/// Keys of comments that mean something here.
const KEYS: [&str; 6] = ["limit", "figure", "panel", "curve", "source", "confidence"];

/// A heading and a row of a file.
const ROW: &str =
    "write `t [s],front [cm],uncertainty [cm]` above `0.1,14,0.5`, repeats as `front #1 [cm],front #2 [cm]`";

/// Form of repeats and of own headings in a case file, study or plan.
const NAMED: &str =
    "in a case file give { files = […], columns = { t = \"t [s]\", front = [\"a [cm]\", \"b [cm]\"] } }";
const REPEATS: &str = "columns.front = [\"a [cm]\", \"b [cm]\"]";

/// Names of the columns that are meant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WantedColumns<'a> {
    /// Name of the abscissa; without one the first column, or the number of the row.
    pub over: Option<&'a str>,
    /// Names of the measured quantity, of which any will do; without one the only quantity.
    pub quantity: &'a [&'a str],
}

impl WantedColumns<'_> {
    /// Test of a column for the measured quantity, by its name with or without the gauge in front.
    fn fits(&self, column: &NumberColumn) -> bool {
        let name = unnumbered(&column.name);
        let is_one = |wanted: &&str| name == *wanted || wanted.rsplit_once(": ").is_some_and(|(_, own)| own == name);
        self.quantity.is_empty() || self.quantity.iter().any(is_one)
    }
}

/// Columns of one or several files: repeats and their standard uncertainties.
struct MeasuredColumns {
    text: String,
    over: NumberColumn,
    repeats: Vec<NumberColumn>,
    stated: Vec<NumberColumn>,
    variants: Vec<String>,
}

pub(super) fn read(given: &MeasuredFiles, wanted: WantedColumns<'_>) -> Result<Measurements, ParameterError> {
    let names = if let MeasuredFiles::Named { columns, .. } = given { Some(columns) } else { None };
    let read = |path: &Path| -> Result<MeasuredColumns, ParameterError> {
        let text = read_text(path, DOCUMENT).map_err(|error| FileError::unreadable(path, &error))?;
        Ok(parse(path, &plain_lines(&text), names, wanted).map_err(|error| error.in_file(path))?)
    };
    let [first, others @ ..] = given.files() else {
        return Err(ParameterError::field("file", "no file", "", "name a CSV file with measurements"));
    };
    let mut whole = read(first)?;
    for path in others {
        whole.add(read(path)?).map_err(|error| error.in_file(path))?;
    }
    let is_as_it_stands = names.is_none() && others.is_empty();
    let measurements = whole.measurements(first, is_as_it_stands).map_err(|error| error.in_file(first))?;
    Ok(Measurements { files: 1 + others.len(), ..measurements })
}

fn parse(
    path: &Path,
    text: &str,
    names: Option<&BTreeMap<String, toml::Value>>,
    wanted: WantedColumns<'_>,
) -> Result<MeasuredColumns, FieldError> {
    let table = TableRows::of(text, path)?;
    let listed = table.headings().join(", ");
    let wrong = |defect: &str, missing: Option<&&str>| {
        let (defect, remedy) = missing.map_or((defect.to_owned(), format!("{ROW}, or {NAMED}")), |name| {
            let name = name.rsplit_once(": ").map_or(*name, |(_, own)| own);
            let columns = format!("columns = {{ \"{name}\" = \"HEADING [UNIT]\" }}");
            (format!("no column `{name}` among "), format!("rename one, or give {{ files = […], {columns} }}"))
        });
        FieldError::finding("columns", format!("{defect}{listed}"), &remedy)
    };
    if listed.is_empty() {
        return Err(wrong("no heading for each column", None));
    }
    let renamed = names.map(|names| renamed(table.headings(), names)).transpose()?;
    let mut columns = Vec::new();
    for (place, heading) in table.headings().iter().enumerate() {
        let heading = renamed.as_ref().map_or(*heading, |renamed| &renamed[place]);
        let is_number = |(_, words): &(usize, Vec<&str>)| words[place].parse::<f64>().is_ok();
        match name_and_unit(heading) {
            Some(named) => columns.push(NumberColumn::of(&table.rows, place, heading, named)?),
            None if place == 0 && names.is_none() && wanted.over.is_none() && table.rows.iter().all(is_number) => {
                let rule = "a heading with its unit in brackets";
                return Err(FieldError::new(heading, format!("\"{heading}\""), rule, &format!("{ROW}, or {NAMED}")));
            }
            // a label
            None => {}
        }
    }
    let is_meant = |own: &NumberColumn| !wanted.quantity.is_empty() && wanted.fits(own);
    let is_stated = |own: &&NumberColumn| is_uncertainty(&own.name) && !is_meant(own);
    let (stated, values): (Vec<&NumberColumn>, Vec<_>) = columns.iter().partition(is_stated);
    let is_over = |own: &&&NumberColumn| wanted.over.is_none_or(|name| own.name == name);
    let over = *values.iter().find(is_over).ok_or_else(|| wrong("", wanted.over.as_ref()))?;
    let has_rows_alone = wanted.over.is_none() && is_meant(over);
    let others = || values.iter().copied().filter(|own| has_rows_alone || !std::ptr::eq(*own, over));
    let first = others().find(|own| wanted.fits(own)).ok_or_else(|| wrong("", wanted.quantity.first()))?;
    let is_repeat = |own: &&NumberColumn| unnumbered(&own.name) == unnumbered(&first.name);
    let (repeats, rest): (Vec<_>, Vec<_>) = others().partition(is_repeat);
    // a third column is the uncertainty, whatever its name
    let third = rest.first().copied().filter(|_| columns.len() == 3);
    if third.is_none() && !rest.is_empty() && wanted.quantity.is_empty() {
        return Err(wrong("several quantities: ", None));
    }
    let behind = columns.iter().skip_while(|own| !is_repeat(own)).find(is_stated);
    let place = table.headings().iter().position(|heading| *heading == "variant");
    let rows = (1..=table.rows.len()).map(|row| row as f64).collect();
    let number = NumberColumn { name: "row".to_owned(), unit: "-".to_owned(), values: rows };
    Ok(MeasuredColumns {
        text: text.to_owned(),
        over: if has_rows_alone { number } else { over.clone() },
        repeats: repeats.into_iter().cloned().collect(),
        stated: behind.or_else(|| stated.first().copied()).or(third).into_iter().cloned().collect(),
        variants: place.map_or_else(Vec::new, |place| table.rows.iter().map(|row| row.1[place].to_owned()).collect()),
    })
}

/// Values of a column in another unit.
pub(super) fn in_unit(column: &NumberColumn, to: &str) -> Result<Vec<f64>, FieldError> {
    let factor = unit::factor(&column.unit, to).ok_or_else(|| {
        let rule = match [to, &column.unit].into_iter().find(|own| !unit::is_known(own)) {
            Some(unknown) => format!("a known unit, such as [cm/s] or [kPa]; [{unknown}] is unknown"),
            None => format!("a unit that converts to [{to}]"),
        };
        FieldError::new(&column.name, format!("[{}]", column.unit), &rule, "correct the unit in the heading")
    })?;
    Ok(column.values.iter().map(|value| value * factor).collect())
}

pub(super) fn heading(column: &NumberColumn) -> String {
    format!("{} [{}]", column.name, column.unit)
}

impl MeasuredColumns {
    /// Adds the repeats of another file.
    fn add(&mut self, other: Self) -> Result<(), FieldError> {
        let over = in_unit(&other.over, &self.over.unit)?;
        let is_same = |(own, other): (&f64, &f64)| (own - other).abs() <= 1e-9 * own.abs().max(other.abs());
        if over.len() != self.over.values.len() || !self.over.values.iter().zip(&over).all(is_same) {
            let rule =
                format!("the values of the first file, {:?} [{}], in every repeat", self.over.values, self.over.unit);
            let remedy = "interpolate the repeats to these values, or give the files separately";
            return Err(FieldError::new(&self.over.name, format!("{over:?}"), &rule, remedy));
        }
        self.repeats.extend(other.repeats);
        self.stated.extend(other.stated);
        Ok(())
    }

    /// Mean, scatter and standard uncertainty of each row. Repeats that agree by chance scatter as those of the other rows do.
    fn measurements(self, path: &Path, is_as_it_stands: bool) -> Result<Measurements, FieldError> {
        let (first, rows) = (&self.repeats[0], self.over.values.len());
        let in_first = |own: &NumberColumn| in_unit(own, &first.unit);
        let repeats: Vec<Vec<f64>> = self.repeats.iter().map(in_first).collect::<Result<_, _>>()?;
        let stated: Vec<Vec<f64>> = self.stated.iter().map(in_first).collect::<Result<_, _>>()?;
        for (own, values) in self.stated.iter().zip(&stated) {
            if let Some(row) = values.iter().position(|value| *value <= 0.0) {
                let value = format!("{} in row {}", own.values[row], row + 1);
                let remedy = "give a standard deviation above 0";
                return Err(FieldError::new(&own.name, value, "positive", remedy));
            }
        }
        let spread: Vec<(f64, f64)> =
            (0..rows).map(|row| mean_and_variance(repeats.iter().map(|own| own[row]))).collect();
        let pooled = spread.iter().map(|row| row.1).sum::<f64>() / rows as f64;
        let uncertainty = |row: usize| {
            let stated = stated.iter().map(|own| own[row]).fold(0.0, f64::max);
            libm::hypot((spread[row].1.max(pooled) / repeats.len() as f64).sqrt(), stated)
        };
        let uncertainty: Vec<f64> = (0..rows).map(uncertainty).collect();
        if uncertainty.contains(&0.0) {
            let defect = if repeats.len() == 1 { "has no uncertainty" } else { "is equal in all repeats" };
            let defect = format!("{} {defect}", heading(first));
            let remedy = format!("add a column `uncertainty [{}]`, or give repeats: {REPEATS}", first.unit);
            return Err(FieldError::finding("columns", defect, &remedy));
        }
        Ok(Measurements {
            path: path.to_owned(),
            said: said(&self.text)?,
            text: if is_as_it_stands { self.text.clone() } else { self.rewritten() },
            measured: NumberColumn {
                name: unnumbered(&first.name).to_owned(),
                unit: first.unit.clone(),
                values: spread.iter().map(|row| row.0).collect(),
            },
            uncertainty,
            repeats: repeats.len(),
            files: 1,
            scatter: spread.iter().map(|row| row.1.sqrt()).collect(),
            abscissa: self.over,
            variants: self.variants,
        })
    }

    /// A file that gives the same without names of columns and other files.
    fn rewritten(&self) -> String {
        let columns = || std::iter::once(&self.over).chain(&self.repeats).chain(&self.stated);
        let line = |cell: &dyn Fn(&NumberColumn) -> String| columns().map(cell).collect::<Vec<_>>().join(",");
        let comments = self.text.lines().filter(|line| line.trim_start().starts_with('#')).map(str::to_owned);
        let rows = (0..self.over.values.len()).map(|row| line(&|own| own.values[row].to_string()));
        comments.chain([line(&heading)]).chain(rows).map(|line| line + "\n").collect()
    }
}

/// Values that the comments give. A key with a slip of the pen is refused: a limit must not vanish.
fn said(text: &str) -> Result<Said, FieldError> {
    let mut said = Said::default();
    for line in text.lines().filter_map(|line| line.trim_start().strip_prefix('#')) {
        let Some((key, value)) = line.split_once(':') else { continue };
        let (key, value) = (key.trim().to_lowercase(), value.trim().to_owned());
        if value.is_empty() {
            continue;
        }
        let wrong = |rule: &str, remedy: &str| Err(FieldError::new(&format!("# {key}"), &value, rule, remedy));
        match key.as_str() {
            "limit" => match value.parse::<f64>() {
                Ok(limit) if limit > 0.0 && limit.is_finite() => said.limit = Some(limit),
                _ => return wrong("a positive number", "give it in standard uncertainties, such as 2"),
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
