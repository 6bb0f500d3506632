//! Columns of files of measurements: what was varied, what was measured, repeats and stated uncertainties.

use super::NumberColumn;
use crate::input::{
    DOCUMENT, FieldError, MeasuredFiles, TableRows, is_uncertainty, name_and_unit, plain_lines, read_text, renamed,
    unit, unnumbered,
};
use crate::output::{FileError, caution};
use crate::statistics::{Extrapolation, interpolated, mean_and_variance};
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the number of a row, where nothing was varied.
const ROW_NUMBER: &str = "row";
/// Relative difference of values that are the same `[-]`.
const SAME: f64 = 1e-9;

/// A heading and a row of a file.
const ROW: &str =
    "write `t [s],front [cm],uncertainty [cm]` above `0.1,14,0.5`, repeats as `front #1 [cm],front #2 [cm]`";

/// Form of repeats and of own headings in a case file, study or plan.
const NAMED: &str =
    "in a case file give { files = […], columns = { t = \"t [s]\", front = [\"a [cm]\", \"b [cm]\"] } }";
/// Names of the columns that are meant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WantedColumns<'a> {
    /// Name of the abscissa; without one the first column, or the number of the row.
    pub over: Option<&'a str>,
    /// Names of the measured quantity, of which any will do; without one the only quantity.
    pub quantity: &'a [&'a str],
    /// Whether it is a series of one gauge over time: an only quantity of another name will do too, if it is no other column of a gauge.
    pub of_time: bool,
}

/// Values of the repeats that have one in a row.
pub fn there(repeats: &[Vec<f64>], row: usize) -> Vec<f64> {
    repeats.iter().map(|own| own[row]).filter(|value| value.is_finite()).collect()
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
#[derive(Debug)]
pub struct MeasuredColumns {
    /// Text of the first file.
    pub text: String,
    /// What was varied.
    pub over: NumberColumn,
    /// What was measured, each time.
    pub repeats: Vec<NumberColumn>,
    /// Standard uncertainties.
    pub stated: Vec<NumberColumn>,
    /// Words of a column `variant`; empty without one.
    pub variants: Vec<String>,
}

impl MeasuredColumns {
    /// Reads one or several files of repeats. Those at other values of what was varied are interpolated to the values of the first file, and
    /// are not a number where they have none.
    ///
    /// # Errors
    /// A file that cannot be read or lacks a column, repeats without common values.
    pub fn read<E: From<FileError> + From<FieldError>>(
        given: &MeasuredFiles,
        wanted: WantedColumns<'_>,
    ) -> Result<Self, E> {
        let names = match given {
            MeasuredFiles::Named { columns, .. } if !columns.is_empty() => Some(columns),
            _ => None,
        };
        let read = |path: &Path| -> Result<Self, E> {
            let text = read_text(path, DOCUMENT).map_err(|error| FileError::unreadable(path, &error))?;
            Ok(parse(path, &plain_lines(&text), names, wanted).map_err(|error| error.in_file(path))?)
        };
        let [first, others @ ..] = given.files() else {
            return Err(FieldError::finding("file", "no file", "name a CSV file with measurements").into());
        };
        let mut whole = read(first)?;
        for path in others {
            whole.add(read(path)?, path).map_err(|error| error.in_file(path))?;
        }
        Ok(whole)
    }

    /// What was varied and the mean of the repeats, in units of the same kinds.
    ///
    /// # Errors
    /// A unit of another kind.
    pub fn means(&self, over: &str, measured: &str) -> Result<Vec<(f64, f64)>, FieldError> {
        let repeats: Vec<Vec<f64>> = self.repeats.iter().map(|own| in_unit(own, measured)).collect::<Result<_, _>>()?;
        let mean = |row: usize| mean_and_variance(there(&repeats, row).into_iter()).0;
        Ok(in_unit(&self.over, over)?.into_iter().enumerate().map(|(row, x)| (x, mean(row))).collect())
    }
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
            if table.headings().iter().any(|own| own.trim() == name) {
                return (format!("no unit of `{name}` among "), format!("write it in brackets, such as `{name} [cm]`"));
            }
            let time = if wanted.of_time { "t = \"TIME [s]\", " } else { "" };
            let columns = format!("columns = {{ {time}\"{name}\" = \"HEADING [UNIT]\" }}");
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
    // own headings may stand in any order
    let is_time = |own: &&&NumberColumn| {
        let is_named = names.is_some() && wanted.over.is_none() && ["t", "time"].contains(&own.name.as_str());
        is_named || (wanted.of_time && unit::factor(&own.unit, "s").is_some())
    };
    let over = values.iter().find(is_time).or_else(|| values.iter().find(is_over).filter(|_| !wanted.of_time));
    let over = *over.ok_or_else(|| wrong("no column of what was varied, such as `t`, among ", wanted.over.as_ref()))?;
    let has_rows_alone = wanted.over.is_none() && is_meant(over);
    let others = || values.iter().copied().filter(|own| has_rows_alone || !std::ptr::eq(*own, over));
    let is_other = |own: &NumberColumn| [": ", " along "].iter().any(|mark| own.name.contains(mark));
    let is_alone = |own: &NumberColumn| others().all(|other| unnumbered(&other.name) == unnumbered(&own.name));
    let only = others().next().filter(|own| wanted.of_time && !is_other(own) && is_alone(own));
    let named = others().find(|own| wanted.fits(own)).or(only);
    let first = named.ok_or_else(|| wrong("no measured quantity among ", wanted.quantity.first()))?;
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
    let number = NumberColumn { name: ROW_NUMBER.to_owned(), unit: "-".to_owned(), values: rows };
    Ok(MeasuredColumns {
        text: text.to_owned(),
        over: if has_rows_alone { number } else { over.clone() },
        repeats: repeats.into_iter().cloned().collect(),
        stated: behind.or_else(|| stated.first().copied()).or(third).into_iter().cloned().collect(),
        variants: place.map_or_else(Vec::new, |place| table.rows.iter().map(|row| row.1[place].to_owned()).collect()),
    })
}

/// Values of a column in another unit.
pub fn in_unit(column: &NumberColumn, to: &str) -> Result<Vec<f64>, FieldError> {
    let factor = unit::factor(&column.unit, to).ok_or_else(|| {
        let rule = match [to, &column.unit].into_iter().find(|own| !unit::is_known(own)) {
            Some(unknown) => format!("a known unit, such as [cm/s] or [kPa]; [{unknown}] is unknown"),
            None => format!("a unit that converts to [{to}]"),
        };
        let remedy = match to {
            "-" if unit::is_known(&column.unit) => "divide the values by their scale, and write [-]",
            _ => "correct the unit in the heading",
        };
        FieldError::new(&column.name, format!("[{}]", column.unit), &rule, remedy)
    })?;
    Ok(column.values.iter().map(|value| value * factor).collect())
}

/// Heading of a column, with its unit.
pub fn heading(column: &NumberColumn) -> String {
    format!("{} [{}]", column.name, column.unit)
}

impl MeasuredColumns {
    /// Adds the repeats of another file, and what its comments say.
    fn add(&mut self, mut other: Self, path: &Path) -> Result<(), FieldError> {
        let over = in_unit(&other.over, &self.over.unit)?;
        other.repeats.iter().chain(&other.stated).try_for_each(|own| in_unit(own, &self.repeats[0].unit).map(drop))?;
        let is_same = |(own, other): (&f64, &f64)| (own - other).abs() <= SAME * own.abs().max(other.abs());
        let is_equal = over.len() == self.over.values.len() && self.over.values.iter().zip(&over).all(is_same);
        if !is_equal || other.variants != self.variants {
            let ends = [f64::min, f64::max].map(|end| over.iter().copied().reduce(end).unwrap_or(f64::NAN));
            let room = SAME * (ends[1] - ends[0]).max(ends[1].abs());
            let place = |x: &f64| (ends[0] - room..=ends[1] + room).contains(x).then(|| x.clamp(ends[0], ends[1]));
            let places: Vec<Option<f64>> = self.over.values.iter().map(place).collect();
            let number = places.iter().flatten().count();
            // variants and rows of single values are no axis
            if number == 0 || self.over.name == ROW_NUMBER || !self.variants.is_empty() || !other.variants.is_empty() {
                let rule = format!("in rows of the same {} as in the first file", self.over.name);
                let remedy = "leave the repeat out, or complete it";
                return Err(FieldError::new(&self.over.name, format!("{over:?}"), &rule, remedy));
            }
            for own in other.repeats.iter_mut().chain(&mut other.stated) {
                let mut points: Vec<(f64, f64)> = over.iter().copied().zip(own.values.iter().copied()).collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                let nothing = (Extrapolation::Nothing, Extrapolation::Nothing);
                let at = |place: &Option<f64>| place.and_then(|x| interpolated(&points, x, nothing));
                own.values = places.iter().map(|place| at(place).unwrap_or(f64::NAN)).collect();
            }
            let (name, file, rows) = (&self.over.name, path.display(), places.len());
            let text = format!("{file}: interpolated to the values of `{name}` of the first file");
            match rows - number {
                0 => tracing::info!("{text}"),
                missing => {
                    caution(&format!("{text}; it has none at {missing} of {rows}, which count with one repeat less"))
                }
            }
        }
        let comments = other.text.lines().filter(|line| line.trim_start().starts_with('#'));
        self.text.extend(comments.flat_map(|line| ["\n", line]));
        self.repeats.extend(other.repeats);
        self.stated.extend(other.stated);
        Ok(())
    }

    /// A file that gives the same without names of columns and other files.
    pub fn rewritten(&self) -> String {
        let columns = || std::iter::once(&self.over).chain(&self.repeats).chain(&self.stated);
        let line = |cell: &dyn Fn(&NumberColumn) -> String| columns().map(cell).collect::<Vec<_>>().join(",");
        let comments = self.text.lines().filter(|line| line.trim_start().starts_with('#')).map(str::to_owned);
        let rows = (0..self.over.values.len()).map(|row| line(&|own| own.values[row].to_string()));
        comments.chain([line(&heading)]).chain(rows).map(|line| line + "\n").collect()
    }
}
