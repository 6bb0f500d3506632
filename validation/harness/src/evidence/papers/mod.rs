//! The two papers, element by element: every numbered equation, table, figure, number and claim, what became of it here,
//! and by what that is shown. The rows stand in `reference-data/papers`; whether one is reproduced is not written there but
//! follows from the metrics that it names.

mod file;
#[cfg(test)]
mod tests;

use crate::metric::Variant;
use serde::Deserialize;
use std::fmt;
use std::sync::LazyLock;

/// One paper with all its elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Paper {
    /// Short name, of its file and in addresses of the page.
    pub name: String,
    /// Authors and title.
    pub title: String,
    /// Text that was read, with the parts that it lacks.
    pub source: String,
    /// Elements in the order of the paper.
    pub elements: Vec<Element>,
}

/// One equation, table, figure, number or claim.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// Name, unique in its paper, such as `eq-13`, `fig-8` or `claim-short-run-out`.
    pub id: String,
    /// Location of the element in the paper.
    pub place: String,
    /// Statement of the element.
    pub statement: String,
    /// The file that has it, from the root of the workspace; none where nothing does.
    pub implemented: Option<String>,
    /// Tests that hold it.
    pub tests: Vec<TestName>,
    /// Error that makes one of the tests fail, where nothing else shows the element (`bagnold-dev mutate --tests`).
    pub control: Option<String>,
    /// Metrics that show it.
    pub metrics: Vec<MetricName>,
    /// Runs that have to end without diverging.
    pub runs: Vec<RunName>,
    /// Figures that draw it.
    pub figures: Vec<FigureName>,
    /// Reason for which it is not covered, if neither a metric nor a test determines its status.
    pub settled: Option<String>,
    /// Note for the reader; may be empty.
    pub note: String,
}

/// A test by its file and function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TestName {
    /// File from the root of the workspace.
    pub file: String,
    /// Function.
    pub function: String,
}

impl fmt::Display for TestName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}::{}", self.file, self.function)
    }
}

/// Metrics of a case: those of a name whose variant has all the parts that are given.
#[derive(Debug, Clone, PartialEq)]
pub struct MetricName {
    /// Case.
    pub case: String,
    /// Name.
    pub metric: String,
    /// Keys and values that the variants of all these metrics contain.
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

/// A number or range that a paper prints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printed {
    /// The number itself, in the metric's unit, where one is printed.
    pub value: Option<f64>,
    /// Least value that agrees with it, in the metric's unit.
    pub lowest: f64,
    /// Largest value that agrees with it.
    pub highest: f64,
    /// Whether a number outside contradicts the paper; else it fails to reproduce what the paper shows.
    pub contradicts: bool,
}

impl Printed {
    /// Whether a number agrees with what is printed; NaN never does.
    #[must_use]
    pub fn agrees(&self, value: f64) -> bool {
        (self.lowest..=self.highest).contains(&value)
    }
}

/// Figures of a case whose name begins like this.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigureName {
    /// Case.
    pub case: String,
    /// Beginning of the name.
    pub figure: String,
}

/// The key of a variant that says which quantity of its runs a metric is of.
const QUANTITY: &str = "quantity";

impl MetricName {
    /// Whether it names the metric of a case: one of another `quantity` is another number.
    #[must_use]
    pub fn names(&self, metric: &str, variant: &Variant) -> bool {
        let same_quantity = self.variant.get(QUANTITY) == variant.get(QUANTITY);
        self.metric == metric && same_quantity && variant.includes(&self.variant)
    }
}

impl RunName {
    /// Whether it names the run of a case.
    #[must_use]
    pub fn names(&self, run: &Variant) -> bool {
        run.includes(&self.variant)
    }
}

/// The papers that the program accounts for.
///
/// # Panics
/// If a row is malformed. No user can bring that about: the rows are part of the program, and tests read every one of them.
pub static PAPERS: LazyLock<Vec<Paper>> = LazyLock::new(|| {
    let read = |name: &str, text: &str| match Paper::parse(name, text) {
        Ok(paper) => paper,
        Err(error) => panic!("failed to {error}"),
    };
    vec![
        read(
            "salehizadeh",
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reference-data/papers/salehizadeh.toml")),
        ),
        read("kazemi", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reference-data/papers/kazemi.toml"))),
    ]
});
