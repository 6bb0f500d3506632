//! The two papers, element by element: every numbered equation, table, figure, number and claim, what became of it here,
//! and by what that is shown. The rows stand in `reference-data/papers`; whether one is reproduced is not written there but
//! follows from the metrics that it names.

use crate::metric::Variant;
use serde::Deserialize;
use std::sync::LazyLock;

/// One paper with all its elements.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paper {
    /// Short name, of its file and in addresses of the page.
    #[serde(skip)]
    pub name: String,
    /// Authors and title.
    pub title: String,
    /// Text that was read, with the parts that it lacks.
    pub source: String,
    /// Elements in the order of the paper.
    #[serde(rename = "element")]
    pub elements: Vec<Element>,
}

/// One equation, table, figure, number or claim.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Name, unique in its paper, such as `eq-13`, `fig-8` or `claim-short-run-out`.
    pub id: String,
    /// Location of the element in the paper.
    pub place: String,
    /// Statement of the element.
    #[serde(rename = "says")]
    pub statement: String,
    /// File that holds it, from the root of the workspace; none without one.
    pub implemented: Option<String>,
    /// Tests that hold it, `path/of/file.rs::function`, from the root of the workspace.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Error that makes one of the tests fail, where nothing else shows the element (`bagnold-dev mutate --tests`).
    pub control: Option<String>,
    /// Metrics that show it.
    #[serde(default)]
    pub metrics: Vec<MetricName>,
    /// Runs that have to end without diverging; that they do reproduces nothing.
    #[serde(default)]
    pub runs: Vec<RunName>,
    /// Figures that draw it: `case/beginning of the figure's name`.
    #[serde(default)]
    pub figures: Vec<String>,
    /// Reason for which it is not covered, where neither a metric nor a test determines its status.
    pub not_covered: Option<String>,
    /// Note for the reader; may be empty.
    #[serde(default)]
    pub note: String,
}

/// Metrics of a case: those of a name whose variant has all the parts that are given.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetricName {
    /// Case.
    pub case: String,
    /// Name.
    pub metric: String,
    /// Keys and values that the variants of all these metrics contain.
    #[serde(default)]
    pub variant: Variant,
    /// Number or range that the paper prints; none if the metric's own gate decides.
    pub printed: Option<Printed>,
}

/// Runs of a case: those whose variant has all the parts that are given.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunName {
    /// Case.
    pub case: String,
    /// Keys and values that the variants of all these runs contain.
    pub variant: Variant,
}

/// A number or range that a paper prints, in the metric's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printed {
    /// The number itself, where one is printed.
    pub value: Option<f64>,
    /// Least value that agrees with it.
    pub at_least: Option<f64>,
    /// Largest value that agrees with it.
    pub at_most: Option<f64>,
    /// Whether a number outside is a shortcoming of ours; else it contradicts the paper.
    #[serde(default)]
    pub shortcoming: bool,
}

impl Printed {
    /// Whether a number agrees with what is printed; NaN never does.
    pub fn agrees(&self, value: f64) -> bool {
        let is_above = self.at_least.is_none_or(|bound| value >= bound);
        is_above && self.at_most.is_none_or(|bound| value <= bound)
    }

    /// Whether a number known to ± `expanded` is told from the other side of what is printed: within a range half as wide, or as far from an
    /// end.
    pub fn tells(&self, value: f64, expanded: f64) -> bool {
        match (self.at_least, self.at_most) {
            (Some(low), Some(high)) if (low..=high).contains(&value) => low == high || expanded <= 0.5 * (high - low),
            (Some(low), Some(high)) => expanded <= (low - value).max(value - high),
            (Some(end), None) | (None, Some(end)) => expanded <= (value - end).abs(),
            (None, None) => true,
        }
    }
}

/// The key of a variant that says which quantity of its runs a metric is of.
const QUANTITY: &str = "quantity";

impl MetricName {
    /// Whether it names the metric of a case: one of another `quantity` is another number.
    pub fn names(&self, metric: &str, variant: &Variant) -> bool {
        let same_quantity = self.variant.get(QUANTITY) == variant.get(QUANTITY);
        self.metric == metric && same_quantity && variant.includes(&self.variant)
    }
}

impl RunName {
    /// Whether it names the run of a case.
    pub fn names(&self, run: &Variant) -> bool {
        run.includes(&self.variant)
    }
}

impl Paper {
    /// Reads a text; `name` is that of its file, without folder and ending.
    ///
    /// # Errors
    /// Text that is malformed, with its line and field.
    pub fn parse(name: &str, text: &str) -> Result<Self, toml::de::Error> {
        Ok(Self { name: name.to_owned(), ..toml::from_str(text)? })
    }
}

macro_rules! shipped {
    ($name:literal) => {{
        let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reference-data/papers/", $name, ".toml"));
        Paper::parse($name, text).unwrap_or_else(|error| panic!("failed to read {}.toml: {error}", $name))
    }};
}

/// The papers that the program accounts for.
///
/// # Panics
/// If a row is malformed. No user can bring that about: the rows are part of the program, and tests read every one of them.
pub static PAPERS: LazyLock<Vec<Paper>> = LazyLock::new(|| vec![shipped!("salehizadeh"), shipped!("kazemi")]);

#[cfg(test)]
#[path = "papers_tests.rs"]
mod tests;
