//! Controls: wrong physics or wrong input that gates must reject. A gate that accepts all of them would be green whatever the
//! physics is.
//!
//! The controls of a case stand in `controls/CASE.toml`, those of a canonical study in its own file. Each is a change of
//! parameters, which a report runs beside the case, or an error of the solver (`bagnold-dev mutate list`); what became of the
//! latter, and of changes that are too dear for a report, stands in the committed tables `controls/tried/CASE.csv` that
//! `bagnold-dev controls` renews. A control of a canonical study is dear if the study's table has it.

mod reading;
mod series;
mod table;
mod trial;

pub use reading::of_case;
pub use series::ErrorSeries;
pub use table::TriedControls;
pub use trial::{Answer, ControlTrial, Found};

use crate::metric::Variant;
use serde::Deserialize;

/// Named wrong physics or a named wrong input of one case: changes of parameters, or an error of the solver.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Control {
    /// Name, unique in its case, such as `coulomb-friction`.
    pub name: String,
    /// The error in words.
    pub error: String,
    /// `path=value` changes of the case's parameters; empty for an error of the solver.
    #[serde(default)]
    pub set: Vec<String>,
    /// Keys of the runs that the changes need; all where none is named.
    #[serde(default)]
    pub only: Vec<Variant>,
    /// Whether the control is too slow for a report; its result is then read from the committed table.
    #[serde(default)]
    pub in_table: bool,
    /// An error of the solver by its name.
    pub solver: Option<String>,
    /// Metrics that are meant to feel it and reject it.
    #[serde(default)]
    pub rejected_by: Vec<String>,
    /// Metrics that are meant to feel it and accept it nevertheless.
    #[serde(default)]
    pub accepted_by: Vec<AcceptingMetric>,
}

/// A metric that is meant to feel an error and accepts it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AcceptingMetric {
    /// Name of the metric that accepts the control.
    pub metric: String,
    /// Reason for accepting it.
    pub because: String,
}

impl Control {
    /// Whether a metric is meant to feel the error.
    pub fn is_named_by(&self, metric: &str) -> bool {
        let is_accepted = self.accepted_by.iter().any(|entry| entry.metric == metric);
        is_accepted || self.rejected_by.iter().any(|name| name == metric)
    }

    /// Whether a report runs it beside the case; the others stand in the table.
    pub fn is_of_report(&self) -> bool {
        self.solver.is_none() && !self.in_table
    }

    /// The command that runs it.
    pub fn command(&self, case: &str) -> String {
        if let Some(error) = &self.solver {
            return format!("cargo run -p bagnold-dev -- mutate trial {error} {case}");
        }
        let only: String = self.only.iter().map(|keys| format!(" --only {keys}")).collect();
        let set: String = self.set.iter().map(|change| format!(" --set '{change}'")).collect();
        format!("bagnold run {case}{only}{set}")
    }
}
