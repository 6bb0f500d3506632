//! Coverage of the options of laws, operators and boundaries by the cases, and the kind of evidence for each.
//!
//! Options come from the parameters' own types, uses from the runs, and how an option is judged from the metrics of these runs. What no
//! case uses is declared in `validation/report/coverage.toml`, with the tests that hold it or the reason why none does.

use super::CaseReport;
use crate::case::{FeatureOption, Features};
use crate::metric::{Metric, MetricKind, Verdict};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// Grade of the evidence from the runs of a case that use an option, the strongest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Grade {
    /// Against experiments, published fits or other people's simulations.
    Measured,
    /// By an observed order of convergence.
    Converging,
    /// Against an exact solution of the model.
    Exact,
    /// Against what a paper states.
    Statement,
    /// By the run's own balances.
    Balance,
    /// Against the baseline alone.
    Baseline,
}

impl Grade {
    /// All entries, the strongest first.
    pub const ALL: [Self; 6] =
        [Self::Measured, Self::Converging, Self::Exact, Self::Statement, Self::Balance, Self::Baseline];

    /// The letter that stands for it in a cell, and its meaning.
    pub fn letter_and_meaning(self) -> (char, &'static str) {
        match self {
            Self::Measured => ('M', "gates against measurements, published fits or external simulations"),
            Self::Converging => ('C', "gates on an observed order of convergence"),
            Self::Exact => ('E', "gates against exact solutions"),
            Self::Statement => ('S', "gates on statements of a paper"),
            Self::Balance => ('B', "gates on balances of mass, momentum and energy"),
            Self::Baseline => ('R', "regression: compared with the baseline only"),
        }
    }

    /// The grade that a gate of this metric gives; none for a metric without one.
    fn of(metric: &Metric) -> Option<Self> {
        if metric.verdict() == Verdict::Observed {
            return None;
        }
        Some(match metric.kind {
            MetricKind::Validation => Self::Measured,
            MetricKind::Verification if metric.name.starts_with("observed_order") => Self::Converging,
            MetricKind::Verification => Self::Exact,
            MetricKind::Statement => Self::Statement,
            MetricKind::Bookkeeping => Self::Balance,
        })
    }
}

/// Gates of a case on an option: their number by grade, and how many of all fail.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CaseCoverage {
    /// Gates of each grade.
    pub gates: BTreeMap<Grade, usize>,
    /// Gates that fail.
    pub failing: usize,
}

/// One option, over all cases of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct OptionCoverage {
    /// The option.
    pub option: FeatureOption,
    /// Coverage by each case, in the report's order; none if no run of the case uses the option.
    pub cases: Vec<Option<CaseCoverage>>,
    /// Declaration of the option, if there is one.
    pub declared: Option<&'static DeclaredOption>,
}

impl OptionCoverage {
    /// Whether no case of the report uses it.
    pub fn is_unused(&self) -> bool {
        self.cases.iter().all(Option::is_none)
    }
}

/// An option that no case uses.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeclaredOption {
    /// The parameter.
    pub feature: String,
    /// The option.
    pub option: String,
    /// Tests that hold it, `path/of/file.rs::function`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Reason why no test covers the option, or the part that its tests leave out.
    #[serde(default)]
    pub open: String,
}

/// A parameter that chooses runs or files and no physics.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Selection {
    /// The parameter.
    pub feature: String,
    /// Runs or files that the parameter chooses.
    pub because: String,
}

/// The content of `coverage.toml`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declarations {
    /// Parameters that are no features.
    #[serde(default, rename = "selection")]
    pub selections: Vec<Selection>,
    /// Options that no case uses.
    #[serde(default, rename = "option")]
    pub options: Vec<DeclaredOption>,
}

impl Declarations {
    /// Whether a parameter chooses runs or files only.
    pub fn is_selection(&self, feature: &str) -> bool {
        self.selections.iter().any(|selection| selection.feature == feature)
    }

    /// Declaration of an option.
    pub fn of(&self, option: &FeatureOption) -> Option<&DeclaredOption> {
        self.options.iter().find(|own| own.feature == option.feature && own.option == option.option)
    }
}

/// Declarations that this program was built with.
pub static DECLARATIONS: LazyLock<Declarations> =
    LazyLock::new(|| toml::from_str(include_str!("../coverage.toml")).expect("a test reads the file that is built in"));

/// Coverage of every option that the parameters offer, by the cases of a report.
pub fn coverage(features: &Features, cases: &[CaseReport]) -> Vec<OptionCoverage> {
    let chosen: Vec<Vec<BTreeSet<FeatureOption>>> =
        cases.iter().map(|case| case.run_parameters.iter().map(|run| features.chosen(run)).collect()).collect();
    let of_option = |option: FeatureOption| {
        let of_case = |(case, chosen): (&CaseReport, &Vec<BTreeSet<FeatureOption>>)| {
            let runs = case.runs.iter().zip(chosen).filter(|(_, chosen)| chosen.contains(&option));
            let variants: Vec<_> = runs.map(|(run, _)| &run.variant).collect();
            let is_of_them = |metric: &&Metric| variants.iter().any(|run| metric.variant.concerns(run));
            (!variants.is_empty()).then(|| {
                let mut covered = CaseCoverage::default();
                for metric in case.metrics.iter().filter(is_of_them) {
                    if let Some(grade) = Grade::of(metric) {
                        *covered.gates.entry(grade).or_default() += 1;
                        covered.failing += usize::from(metric.verdict() == Verdict::Fail);
                    }
                }
                covered
            })
        };
        let cases = cases.iter().zip(&chosen).map(of_case).collect();
        OptionCoverage { cases, declared: DECLARATIONS.of(&option), option }
    };
    features.options().filter(|option| !DECLARATIONS.is_selection(&option.feature)).map(of_option).collect()
}
