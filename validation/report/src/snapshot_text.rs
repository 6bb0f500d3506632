//! A baseline as text: an insta snapshot, whose content is a line of column names and a line `name | variant | value |
//! unit | verdict` for each metric.

use crate::metric::{Metric, Variant, Verdict};

/// Significant figures of a value: far below any tolerance, and no noise of the last bits.
const FIGURES: i32 = 9;

/// First line of a snapshot, which names the columns for the reader.
const COLUMNS: &str = "name | variant | value | unit | verdict";

/// Names one metric of one run of one case.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MetricKey {
    /// Case name.
    pub case: String,
    /// Metric name.
    pub metric: String,
    /// Variant.
    pub variant: Variant,
}

impl MetricKey {
    /// The key of `metric` in `case`.
    pub fn of(case: &str, metric: &Metric) -> Self {
        Self { case: case.to_owned(), metric: metric.name.clone(), variant: metric.variant.clone() }
    }
}

/// A value of the baseline.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BaselineValue {
    pub(super) value: f64,
    pub(super) unit: String,
    pub(super) verdict: Verdict,
    /// Line in the file: metrics keep the order in which their case reports them.
    pub(super) line: usize,
}

/// Source line of a snapshot, as insta writes it.
const SOURCE: &str = "source: tests/snapshots/main.rs";

/// Begins the line of a snapshot's heading that names a commit.
const COMMIT: &str = "commit: ";

/// Name of the case and tier whose values a snapshot holds.
pub fn description(case: &str, tier: &str) -> String {
    format!("{case} at the {tier} tier")
}

/// A snapshot's content.
pub(super) fn content<'a>(lines: impl IntoIterator<Item = (&'a MetricKey, &'a BaselineValue)>) -> String {
    let mut text = format!("{COLUMNS}\n");
    for (MetricKey { metric, variant, .. }, BaselineValue { value, unit, verdict, .. }) in lines {
        text += &format!("{metric} | {variant} | {} | {unit} | {}\n", number(*value), verdict.word());
    }
    text
}

/// A file; its heading names the commit at which the values were accepted, unless it is empty.
pub(super) fn text(case: &str, tier: &str, commit: &str, content: &str) -> String {
    let commit = if commit.is_empty() { String::new() } else { format!("{COMMIT}{commit}\n") };
    format!("---\n{SOURCE}\ndescription: {}\n{commit}---\n{content}", description(case, tier))
}

/// The lines of a file.
type BaselineLines = Vec<(MetricKey, BaselineValue)>;

/// The commit and the lines of a file; what is wrong with it, if it is no such file or that of another case or tier.
pub(super) fn parse<'a>(text: &'a str, case: &str, tier: &str) -> Result<(&'a str, BaselineLines), String> {
    let expected = description(case, tier);
    let (heading, content) = text
        .strip_prefix("---\n")
        .and_then(|text| text.split_once("\n---\n"))
        .ok_or_else(|| "it has no heading between two lines `---`".to_owned())?;
    let named = |field| heading.lines().find_map(|line| line.strip_prefix(field)).unwrap_or_default();
    let described = named("description: ");
    if described.trim_matches('"') != expected {
        return Err(format!("its description is {described:?} instead of {expected:?}"));
    }
    let mut lines = content.lines();
    let first = lines.next().unwrap_or_default();
    if first != COLUMNS {
        return Err(format!("its first line is {first:?} instead of {COLUMNS:?}"));
    }
    let line = |(index, text): (usize, &'a str)| {
        parse_line(case, index, text).ok_or_else(|| format!("value {} is {text:?} instead of `{COLUMNS}`", index + 1))
    };
    Ok((named(COMMIT), lines.enumerate().map(line).collect::<Result<_, _>>()?))
}

fn parse_line(case: &str, line: usize, text: &str) -> Option<(MetricKey, BaselineValue)> {
    let cells: Vec<&str> = text.split('|').map(str::trim).collect();
    let &[metric, variant, value, unit, verdict] = cells.as_slice() else { return None };
    let key = MetricKey { case: case.to_owned(), metric: metric.to_owned(), variant: variant.parse().ok()? };
    let (value, verdict) = (value.parse().ok()?, Verdict::of_word(verdict)?);
    Some((key, BaselineValue { value, unit: unit.to_owned(), verdict, line }))
}

/// The value that a file holds.
pub(super) fn rounded(value: f64) -> f64 {
    let decimals = usize::try_from(FIGURES - 1).unwrap_or(0);
    format!("{value:.decimals$e}").parse().unwrap_or(value)
}

/// Half a unit of the last digit: the largest rounding error of a value in the file.
pub(super) fn rounding(value: f64) -> f64 {
    exponent(value).map_or(0.0, |exponent| 0.5 * 10f64.powi(exponent + 1 - FIGURES))
}

fn exponent(value: f64) -> Option<i32> {
    (value != 0.0 && value.is_finite())
        .then(|| format!("{value:e}"))
        .and_then(|text| text.split_once('e')?.1.parse().ok())
}

/// A rounded value such as `0.589234123`, `12.35` or `1.2e-6`.
fn number(value: f64) -> String {
    match exponent(value) {
        Some(exponent) if !(-4..FIGURES).contains(&exponent) => format!("{value:e}"),
        Some(_) => value.to_string(),
        // without the sign of a negative zero
        None if value == 0.0 => "0".to_owned(),
        None => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(value: f64) -> (MetricKey, BaselineValue) {
        let variant = Variant::of("resolution", 40);
        let key = MetricKey { case: "film".to_owned(), metric: "velocity_l2".to_owned(), variant };
        (key, BaselineValue { value, unit: "%".to_owned(), verdict: Verdict::Pass, line: 0 })
    }

    /// The content of one line.
    fn content_of((key, value): (MetricKey, BaselineValue)) -> String {
        content([(&key, &value)])
    }

    #[test]
    fn values_have_nine_figures_and_are_read_back() {
        for (value, written) in [
            (0.0, "0"),
            (-0.0, "0"),
            (0.552_191_234_56, "0.552191235"),
            (9.999_999_999_6, "10"),
            (-12.5, "-12.5"),
            (123_456_789_012.0, "1.23456789e11"),
            (0.000_012_345_678_912, "1.23456789e-5"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(rounded(value)), written);
            let file = text("film", "quick", "", &content_of(line(rounded(value))));
            let read = parse(&file, "film", "quick").expect("readable").1[0].1.value;
            assert!(read == rounded(value) || (read.is_nan() && value.is_nan()), "{value}: {read}");
            assert!(!value.is_finite() || (read - value).abs() <= rounding(read), "{value}: {read}");
        }
    }

    #[test]
    fn a_file_is_a_heading_and_a_line_each() {
        let file = text("film", "quick", "0d1e2f", &content_of(line(0.5)));
        assert_eq!(
            file,
            "---\nsource: tests/snapshots/main.rs\ndescription: film at the quick tier\ncommit: 0d1e2f\n---\n\
             name | variant | value | unit | verdict\nvelocity_l2 | resolution=40 | 0.5 | % | pass\n"
        );
        assert_eq!(parse(&file, "film", "quick"), Ok(("0d1e2f", vec![line(0.5)])));
        for (damaged, expected) in [
            (file.replacen("---", "", 1), "it has no heading"),
            (file.replace("film", "bagnold"), "its description"),
            (file.replace("name |", "names |"), "its first line"),
            (file.replace("pass", "passes"), "value 1"),
            (file.replace("0.5", "half"), "value 1"),
            (file.replace(" | %", ""), "value 1"),
        ] {
            let error = parse(&damaged, "film", "quick").expect_err("refused");
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
