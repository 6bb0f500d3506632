//! A check: what is measured, with its reference, limit and reason.

use super::file::{CheckText, Distance, Reduction};
use super::probe::{ColumnWindow, unit_of};
use crate::case::ParameterError;
use crate::input::{FieldError, MeasuredFiles, check_text, parted};
use crate::measured::{Measurements, WantedColumns};
use crate::metric::{Confidence, Limit, Metric, MetricKind, Origin, Variant};
use std::path::Path;

/// Quantity that a check reads.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum CheckedQuantity {
    /// A metric of the case itself.
    Metric(String),
    /// A value of a column.
    Value(ColumnWindow, Reduction),
    /// The distance of a column from a measured series.
    Distance(ColumnWindow, Box<Measurements>, Distance),
    /// The order in which another check shrinks with a varied parameter.
    Order {
        /// The other check.
        of: String,
        /// Name of the varied parameter.
        in_parameter: String,
    },
    /// The difference of another check between two variants, over its value in the second.
    Difference {
        /// The other check.
        of: String,
        /// The two variants that are compared.
        between: (Variant, Variant),
    },
}

/// A check whose fields are typed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StudyCheck {
    pub(super) name: String,
    /// Variants that are meant.
    pub(super) only: Variant,
    pub(super) read: CheckedQuantity,
    reference: Option<f64>,
    standard_uncertainty: Option<f64>,
    source: Option<String>,
    confidence: Confidence,
    pub(super) limit: Option<Limit>,
    reason: String,
    /// Half width of the limit where the reference's own uncertainty sets it.
    scatter: Option<f64>,
}

impl CheckedQuantity {
    /// The measured series that a column is compared with.
    pub(super) fn measured(&self) -> Option<&Measurements> {
        if let Self::Distance(_, measured, _) = self { Some(measured) } else { None }
    }
}

impl StudyCheck {
    /// Types a check; files that it names stand beside the study.
    pub(super) fn of(text: &CheckText, beside: &Path) -> Result<Self, FieldError> {
        check_metric_name(&text.name)?;
        let read = read(text, beside)?;
        let measured = read.measured();
        let source = text.source.clone().or_else(|| measured.map(Measurements::source));
        let confidence = text.confidence.or(measured.and_then(Measurements::confidence)).unwrap_or(Confidence::Low);
        for (field, value) in [("source", &text.source), ("reason", &text.reason)] {
            value.as_ref().map_or(Ok(()), |value| check_text(field, value))?;
        }
        let stated = measured.filter(|_| confidence != Confidence::Unverified);
        // the file's limit counts in standard uncertainties
        let is_residual = text.distance.is_none_or(|own| own == Distance::Residual);
        let (limit, reason) = match (limit(text)?, stated.filter(|_| is_residual).and_then(Measurements::limit)) {
            ((None, _), Some((limit, reason))) => (Some(limit), reason),
            ((Some(own), _), Some((Limit::AtMost(theirs), _))) if upper(own) > theirs => {
                let (field, bound) = match own {
                    Limit::AtMost(bound) => ("at_most", bound),
                    Limit::AtLeast(bound) => ("at_least", bound),
                    Limit::Within(_, bound) => ("within", bound),
                };
                let rule = format!("no looser than {theirs}, the `# limit` of the measurements");
                return Err(FieldError::new(field, bound, &rule, "leave one of the two out"));
            }
            (own, _) => own,
        };
        if limit.is_some() && confidence == Confidence::Unverified {
            let remedy = "leave the limit out, or name a source by which the reference can be checked";
            return Err(FieldError::new("confidence", "unverified", "higher for a check with a limit", remedy));
        }
        if text.reference.is_some() && text.source.is_none() {
            let remedy = "name the source of the number: instrument, author and year, or equation";
            return Err(FieldError::new("source", "missing", "given beside `reference`", remedy));
        }
        Ok(Self {
            name: text.name.clone(),
            only: text.only.clone().unwrap_or_default(),
            read,
            reference: text.reference,
            standard_uncertainty: text.standard_uncertainty,
            source,
            confidence,
            limit,
            reason,
            scatter: text.within_uncertainties.zip(text.standard_uncertainty).map(|(factor, one)| factor * one),
        })
    }

    /// The scalar reference with its standard uncertainty, if there is one.
    pub(super) fn reference(&self) -> Option<(f64, Option<f64>)> {
        Some((self.reference?, self.standard_uncertainty))
    }

    /// The metric of a value that was read.
    pub(super) fn metric(&self, variant: &Variant, value: f64, unit: &str) -> Metric {
        let is_verification = self.confidence == Confidence::Exact || self.source.is_none();
        let metric = Metric::observed(&self.name, variant, value, unit)
            .of_kind(if is_verification { MetricKind::Verification } else { MetricKind::Validation })
            .gated_by(self.limit, &self.reason)
            .as_wide_as_scatter(self.scatter)
            .with_snapshot_tolerance(1e-6, self.drift())
            .of_user();
        let Some(source) = &self.source else { return metric };
        // of a distance from a measured series, none is perfect; a residual in uncertainties is no quantity of an experiment
        let expected = match self.read {
            CheckedQuantity::Distance(_, _, Distance::Residual) => None,
            _ => self.read.measured().map_or(self.reference, |_| Some(0.0)),
        };
        let metric = metric.against(expected, source, self.confidence);
        metric.known_to(Origin::Experiment, self.standard_uncertainty, source)
    }

    /// Drift of a value that is not told: of columns that cancel, whose rest is rounding, a tenth of the limit.
    fn drift(&self) -> f64 {
        let (CheckedQuantity::Value(column, _), Some(Limit::Within(lower, upper))) = (&self.read, self.limit) else {
            return 0.0;
        };
        if column.is_combined() && lower < 0.0 && upper > 0.0 { 0.05 * (upper - lower) } else { 0.0 }
    }
}

fn check_metric_name(name: &str) -> Result<(), FieldError> {
    let is_word = name.starts_with(|first: char| first.is_ascii_lowercase())
        && name.chars().all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_');
    if is_word && name.len() <= 60 {
        return Ok(());
    }
    let rule = "a word of lower-case letters, digits and `_`, at most 60 of them";
    Err(FieldError::new("name", format!("\"{name}\""), rule, "give a name such as \"front_position\""))
}

/// Quantity of a check: exactly one of the ways.
fn read(text: &CheckText, beside: &Path) -> Result<CheckedQuantity, FieldError> {
    let fields = toml::Table::try_from(text).unwrap_or_default();
    let ways = ["metric", "value", "compare", "order_of", "difference_of"];
    let given: Vec<&str> = ways.into_iter().filter(|way| fields.contains_key(*way)).collect();
    let [way] = given[..] else {
        let value = if given.is_empty() { "none of them".to_owned() } else { given.join(" and ") };
        let rule = "exactly one of `metric`, `value`, `compare`, `order_of` and `difference_of`";
        let remedy = "write a line such as value = \"last\" with table and column, or compare = \"measured.csv\"";
        return Err(FieldError::new("value", value, rule, remedy));
    };
    let belongs = [
        (&["table", "column", "plus", "minus", "over", "from", "to"][..], "value and compare"),
        (&["distance"], "compare"),
        (&["order_in"], "order_of"),
        (&["between"], "difference_of"),
    ];
    for (names, with) in belongs.into_iter().filter(|(_, with)| !with.contains(way)) {
        if let Some(field) = names.iter().find(|field| fields.contains_key(**field)) {
            let rule = format!("absent beside `{way}`: it belongs to {with}");
            return Err(FieldError::new(field, "given", &rule, "leave it out"));
        }
    }
    match way {
        "metric" => Ok(CheckedQuantity::Metric(text.metric.clone().unwrap_or_default())),
        "order_of" => {
            let missing = || {
                let remedy = "name the parameter as [[vary]] does, such as \"spacing\"";
                FieldError::new("order_in", "missing", "given beside `order_of`", remedy)
            };
            let in_parameter = text.order_in.clone().ok_or_else(missing)?;
            Ok(CheckedQuantity::Order { of: text.order_of.clone().unwrap_or_default(), in_parameter })
        }
        "difference_of" => {
            let remedy = "name two variants, such as [\"spacing=0.02\", \"spacing=0.01\"]";
            let Some(between) = text.between.clone() else {
                return Err(FieldError::new("between", "missing", "given beside `difference_of`", remedy));
            };
            if between.0 == between.1 || between.0.is_empty() || between.1.is_empty() {
                let value = format!("[\"{}\", \"{}\"]", between.0, between.1);
                return Err(FieldError::new("between", value, "two different variants", remedy));
            }
            Ok(CheckedQuantity::Difference { of: text.difference_of.clone().unwrap_or_default(), between })
        }
        _ => {
            let column = column(text)?;
            if let Some(reduction) = text.value {
                let (field, number, remedy) = match reduction {
                    Reduction::At(place) => ("value.at", place, "give a place within the run"),
                    Reduction::Reaches(level) => ("value.reaches", level, "give a value that the column reaches"),
                    _ => ("value", 0.0, ""),
                };
                if !number.is_finite() {
                    return Err(FieldError::new(field, number, "a finite number", remedy));
                }
                return Ok(CheckedQuantity::Value(column, reduction));
            }
            if text.reference.is_some() || text.standard_uncertainty.is_some() {
                let remedy = "leave it out: the file has its own values and uncertainties";
                return Err(FieldError::new("reference", "given", "absent beside `compare`", remedy));
            }
            let files = text.compare.clone().unwrap_or_else(|| MeasuredFiles::Repeats(Vec::new()));
            let measured = measured(&files, &column, beside)
                .map_err(|error| FieldError::finding("compare", error, "correct the file, or name another one"))?;
            Ok(CheckedQuantity::Distance(column, Box::new(measured), text.distance.unwrap_or(Distance::Residual)))
        }
    }
}

/// The measurements that a column is compared with, by its name.
fn measured(files: &MeasuredFiles, column: &ColumnWindow, beside: &Path) -> Result<Measurements, ParameterError> {
    let name = parted(&column.column).0;
    let over = column.over.as_deref().map(|over| parted(over).0);
    let wanted =
        WantedColumns { over, quantity: if column.is_combined() { &[] } else { &[name] }, ..Default::default() };
    Measurements::read(&files.beside(beside), wanted)
}

fn column(text: &CheckText) -> Result<ColumnWindow, FieldError> {
    let needed = |field: &str, value: &Option<String>| {
        let remedy = "run the case once: the files and headings in its folder tables/ are possible values";
        value.clone().ok_or_else(|| FieldError::new(field, "missing", "given beside `value` or `compare`", remedy))
    };
    let window = (text.from.unwrap_or(f64::NEG_INFINITY), text.to.unwrap_or(f64::INFINITY));
    if window.0.is_nan() || window.1.is_nan() || window.0 > window.1 {
        let value = format!("{} … {}", window.0, window.1);
        return Err(FieldError::new("from", value, "at most `to`", "exchange the two"));
    }
    let column = needed("column", &text.column)?;
    let others = [("plus", text.plus.clone(), 1.0), ("minus", text.minus.clone(), -1.0)];
    for (field, other, _) in &others {
        if let Some(other) = other.as_ref().filter(|other| unit_of(other) != unit_of(&column)) {
            let rule = format!("a column in the unit of `column`, {}", unit_of(&column));
            return Err(FieldError::new(field, format!("\"{other}\""), &rule, "name another column"));
        }
    }
    Ok(ColumnWindow { table: needed("table", &text.table)?, column, others, over: text.over.clone(), window })
}

/// Largest value that a limit allows.
fn upper(limit: Limit) -> f64 {
    match limit {
        Limit::AtMost(bound) | Limit::Within(_, bound) => bound,
        Limit::AtLeast(_) => f64::INFINITY,
    }
}

/// The limit and its reason.
fn limit(text: &CheckText) -> Result<(Option<Limit>, String), FieldError> {
    let limits = [
        ("at_most", text.at_most.map(Limit::AtMost)),
        ("at_least", text.at_least.map(Limit::AtLeast)),
        ("within", text.within.map(|(lower, upper)| Limit::Within(lower, upper))),
        ("within_uncertainties", text.within_uncertainties.map(Limit::AtMost)),
    ];
    let given: Vec<(&str, Limit)> =
        limits.iter().filter_map(|(name, limit)| limit.map(|limit| (*name, limit))).collect();
    if let Some(reference) = text.reference
        && !reference.is_finite()
    {
        return Err(FieldError::new("reference", reference, "a finite number", "leave it out if it is not known"));
    }
    match given[..] {
        [] if text.reason.is_some() => {
            let remedy = "add at_most, at_least, within or within_uncertainties, or leave the reason out";
            Err(FieldError::new("reason", "given", "beside a limit", remedy))
        }
        [] => Ok((None, String::new())),
        [("within_uncertainties", Limit::AtMost(factor))] => {
            let (Some(reference), Some(uncertainty)) = (text.reference, text.standard_uncertainty) else {
                let rule = "beside `reference` and `standard_uncertainty`";
                return Err(FieldError::new("within_uncertainties", factor, rule, "give both, or another limit"));
            };
            let width = factor * uncertainty;
            let reason = format!("within {factor} standard uncertainties of the reference");
            let reason = text.reason.as_ref().map_or(reason.clone(), |own| format!("{reason}: {own}"));
            Ok((Some(Limit::Within(reference - width, reference + width)), reason))
        }
        [(field, limit)] => {
            let (is_sound, value) = match limit {
                Limit::AtMost(bound) | Limit::AtLeast(bound) => (bound.is_finite(), bound.to_string()),
                Limit::Within(lower, upper) => {
                    (lower.is_finite() && upper.is_finite() && lower <= upper, format!("{lower} … {upper}"))
                }
            };
            if let Limit::AtMost(bound) = limit
                && text.compare.is_some()
                && bound < 0.0
            {
                let (rule, remedy) = ("0 or more", "give the largest acceptable distance from the measurements");
                return Err(FieldError::new(field, value, rule, remedy));
            }
            if !is_sound {
                return Err(FieldError::new(field, value, "finite, the smaller bound first", "correct the numbers"));
            }
            let missing = || {
                let remedy = "explain in a sentence why the limit has this value";
                FieldError::new("reason", "missing", "given beside a limit", remedy)
            };
            let reason = text.reason.clone().filter(|reason| !reason.trim().is_empty()).ok_or_else(missing)?;
            Ok((Some(limit), reason))
        }
        [first, second, ..] => {
            let value = format!("{} and {}", first.0, second.0);
            Err(FieldError::new("at_most", value, "the only limit", "within = [lower, upper] has both bounds"))
        }
    }
}
