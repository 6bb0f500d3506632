//! A file of `reference-data/papers` → a paper; every rule that a row can break.

use super::super::ReferenceError;
use super::{Element, FigureName, MetricName, Paper, Printed, RunName, TestName};
use crate::metric::Variant;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    source: String,
    #[serde(default, rename = "element")]
    elements: Vec<ElementRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ElementRow {
    id: String,
    place: String,
    says: String,
    implemented: String,
    #[serde(default)]
    tests: Vec<String>,
    control: Option<String>,
    #[serde(default)]
    metrics: Vec<MetricRow>,
    #[serde(default)]
    runs: Vec<RunName>,
    #[serde(default)]
    figures: Vec<String>,
    status: Option<String>,
    because: Option<String>,
    #[serde(default)]
    note: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MetricRow {
    case: String,
    metric: String,
    #[serde(default)]
    variant: Variant,
    /// A printed number and how far ours may be off, in the metric's unit.
    printed: Option<f64>,
    tolerance: Option<f64>,
    /// Or a printed range, open to one side if one end is missing.
    at_least: Option<f64>,
    at_most: Option<f64>,
    /// Status of a number of ours outside the printed range.
    outside: Option<String>,
}

/// Kinds of element, by the beginning of its name.
const KINDS: [&str; 5] = ["eq-", "table-", "fig-", "number-", "claim-"];

/// Statuses that are written, all of them *not covered* in a report; the others are computed.
const SETTLED: [&str; 3] = ["replaced", "not stated clearly", NOT_COVERED];
const NOT_COVERED: &str = "not covered";

/// Words for a number outside of what is printed; the first is meant where none is given.
const OUTSIDE: [(&str, bool); 2] = [("contradicted", true), ("not reproduced", false)];

/// A row with its place, for refusals.
struct RowPlace<'a> {
    file: &'a str,
    row: usize,
    id: &'a str,
}

impl RowPlace<'_> {
    fn refuse(&self, field: &str, value: &str, rule: impl Into<String>) -> ReferenceError {
        let place = format!("{}, row {} (`{}`)", self.file, self.row, self.id);
        let defect = format!("`{field}` is {value:?}, but must be {}", rule.into());
        ReferenceError::Text { place, defect }
    }
}

impl Paper {
    /// Reads a text; `name` is that of its file, without folder and ending.
    ///
    /// # Errors
    /// If the text is malformed, or a row breaks a rule; the error names file, row, field, value and rule.
    pub fn parse(name: &str, text: &str) -> Result<Self, ReferenceError> {
        let path = format!("reference-data/papers/{name}.toml");
        let file: File = toml::from_str(text).map_err(|error| ReferenceError::Text {
            place: path.clone(),
            defect: error.to_string().trim_end().to_owned(),
        })?;
        let mut elements: Vec<Element> = Vec::with_capacity(file.elements.len());
        for (index, row) in file.elements.into_iter().enumerate() {
            let id = row.id.clone();
            let place = RowPlace { file: &path, row: index + 1, id: &id };
            if let Some(other) = elements.iter().position(|other| other.id == row.id) {
                return Err(place.refuse("id", &row.id, format!("unique; row {} has it already", other + 1)));
            }
            elements.push(element(row, &place)?);
        }
        Ok(Self { name: name.to_owned(), title: file.title, source: file.source, elements })
    }
}

fn element(row: ElementRow, place: &RowPlace<'_>) -> Result<Element, ReferenceError> {
    let plain = |text: &str| text.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
    if !KINDS.iter().any(|kind| row.id.len() > kind.len() && row.id.starts_with(kind)) || !plain(&row.id) {
        let rule = format!("one of {} and more of a-z, 0-9 and -", KINDS.join(", "));
        return Err(place.refuse("id", &row.id, rule));
    }
    for (field, text) in [("place", &row.place), ("says", &row.says)] {
        if text.trim().is_empty() {
            return Err(place.refuse(field, text, "a text; write one"));
        }
    }
    let implemented = match row.implemented.trim() {
        "" => return Err(place.refuse("implemented", "", "the path of a file, or \"none\"")),
        "none" => None,
        path => Some(path.to_owned()),
    };
    let settled = settled(&row, place)?;
    let tests = row.tests.iter().map(|test| test_name(test, place)).collect::<Result<Vec<_>, _>>()?;
    let metrics = row.metrics.into_iter().map(|metric| metric_name(metric, place)).collect::<Result<Vec<_>, _>>()?;
    let figures = row.figures.iter().map(|figure| figure_name(figure, place)).collect::<Result<Vec<_>, _>>()?;
    if settled.is_none() && tests.is_empty() && metrics.is_empty() && row.runs.is_empty() {
        let rule =
            format!("one of {}, where no metric, run or test says what became of the element", SETTLED.join(", "));
        return Err(place.refuse("status", "", rule));
    }
    let ElementRow { id, place, says, note, control, runs, .. } = row;
    Ok(Element { id, place, statement: says, implemented, tests, control, metrics, runs, figures, settled, note })
}

/// Reason for which an element is not covered; begins with the written status where that says more.
fn settled(row: &ElementRow, place: &RowPlace<'_>) -> Result<Option<String>, ReferenceError> {
    match (&row.status, &row.because) {
        (None, None) => Ok(None),
        (None, Some(reason)) => Err(place.refuse("because", reason, "absent where no `status` is written")),
        (Some(word), _) if !SETTLED.contains(&word.as_str()) => {
            let rule = format!("one of {}; every other status is computed", SETTLED.join(", "));
            Err(place.refuse("status", word, rule))
        }
        (Some(word), Some(reason)) if !reason.trim().is_empty() => {
            Ok(Some(if word == NOT_COVERED { reason.clone() } else { format!("{word}: {reason}") }))
        }
        (Some(_), _) => Err(place.refuse("because", "", "the reason for the `status`; write one")),
    }
}

fn test_name(text: &str, place: &RowPlace<'_>) -> Result<TestName, ReferenceError> {
    match text.split_once("::") {
        Some((file, function)) if file.ends_with(".rs") && !function.is_empty() => {
            Ok(TestName { file: file.to_owned(), function: function.to_owned() })
        }
        _ => Err(place.refuse("tests", text, "`path/of/file.rs::function`")),
    }
}

fn figure_name(text: &str, place: &RowPlace<'_>) -> Result<FigureName, ReferenceError> {
    match text.split_once('/') {
        Some((case, figure)) if !case.is_empty() && !figure.is_empty() => {
            Ok(FigureName { case: case.to_owned(), figure: figure.to_owned() })
        }
        _ => Err(place.refuse("figures", text, "`case/beginning of the figure's name`")),
    }
}

fn metric_name(row: MetricRow, place: &RowPlace<'_>) -> Result<MetricName, ReferenceError> {
    let (lowest, highest) = match (row.printed, row.tolerance, row.at_least, row.at_most) {
        (Some(value), Some(tolerance), None, None) => {
            if !(tolerance >= 0.0 && tolerance.is_finite() && value.is_finite()) {
                let rule = "a finite number that is not negative, beside a finite `printed`";
                return Err(place.refuse("tolerance", &tolerance.to_string(), rule));
            }
            (value - tolerance, value + tolerance)
        }
        (Some(value), None, None, None) => {
            return Err(place.refuse("printed", &value.to_string(), "with a `tolerance`; 0 if there is none"));
        }
        (None, Some(tolerance), ..) => {
            return Err(place.refuse("tolerance", &tolerance.to_string(), "beside a `printed` number"));
        }
        (Some(value), ..) => {
            return Err(place.refuse("printed", &value.to_string(), "without `at_least` and `at_most`"));
        }
        (None, None, lower, upper) => (lower.unwrap_or(f64::NEG_INFINITY), upper.unwrap_or(f64::INFINITY)),
    };
    if lowest > highest || lowest.is_nan() || highest.is_nan() {
        return Err(place.refuse("at_least", &lowest.to_string(), format!("at most `at_most`, {highest}")));
    }
    let is_printed = lowest > f64::NEG_INFINITY || highest < f64::INFINITY;
    let contradicts = match &row.outside {
        None => OUTSIDE[0].1,
        Some(word) if !is_printed => return Err(place.refuse("outside", word, "absent where nothing is printed")),
        Some(word) => {
            let found = OUTSIDE.iter().find(|(known, _)| known == word);
            found.ok_or_else(|| place.refuse("outside", word, "one of contradicted, not reproduced"))?.1
        }
    };
    let printed = is_printed.then_some(Printed { value: row.printed, lowest, highest, contradicts });
    Ok(MetricName { case: row.case, metric: row.metric, variant: row.variant, printed })
}
