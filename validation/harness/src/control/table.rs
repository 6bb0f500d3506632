//! The committed tables of controls that were tried before, one a case: errors of the solver, and changes that are too dear for a
//! report.

use super::reading::text;
use super::{Control, ControlTrial, Found};
use crate::metric::{Variant, Verdict};
use crate::output::csv_text;
use crate::store::provenance;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A number of a control, or, without a metric, that one of its runs diverged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Row {
    control: String,
    metric: String,
    variant: Variant,
    value: f64,
    verdict: String,
}

const DIVERGED: &str = "diverged";

/// Word for a metric that the control does not have.
const MISSING: &str = "missing";

/// Numbers of the controls of a case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriedControls {
    /// SHA-256 of the solver's sources that they were tried with.
    solver_hash: String,
    /// The commit of those.
    commit: String,
    tried: BTreeMap<String, (Vec<Found>, bool)>,
}

impl TriedControls {
    /// Table of these trials by this program's solver.
    pub fn by_this_program(trials: &[ControlTrial]) -> Self {
        let (solver_hash, commit) = (provenance::solver_hash().to_owned(), provenance::commit().to_owned());
        let entry = |trial: &ControlTrial| (trial.control.name.clone(), (trial.found.clone(), trial.diverged));
        Self { solver_hash, commit, tried: trials.iter().map(entry).collect() }
    }

    /// The file of a case, in the folder of the controls.
    pub fn file(case: &str) -> String {
        format!("tried/{case}.csv")
    }

    /// The table of a case that the program carries; empty where it carries none.
    ///
    /// # Panics
    /// If it is malformed, which a test excludes.
    pub fn shipped(case: &str) -> Self {
        let read = |text| Self::parse(text).unwrap_or_else(|error| panic!("{}: {error}", Self::file(case)));
        text(&Self::file(case)).map_or_else(Self::default, read)
    }

    /// Reads a table.
    ///
    /// # Errors
    /// A row that is none.
    pub fn parse(text: &str) -> Result<Self, csv::Error> {
        let head = text.lines().next().and_then(|line| line.strip_prefix("# solver ")?.split_once(" commit "));
        let (solver_hash, commit) = head.unwrap_or_default();
        let mut table = Self { solver_hash: solver_hash.to_owned(), commit: commit.to_owned(), tried: BTreeMap::new() };
        for row in csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes()).deserialize() {
            let Row { control, metric, variant, value, verdict } = row?;
            let (found, diverged) = table.tried.entry(control).or_default();
            if verdict == DIVERGED {
                *diverged = true;
                continue;
            }
            found.push(Found { metric, variant, value, verdict: Verdict::of_word(&verdict) });
        }
        Ok(table)
    }

    /// The table as a file has it.
    ///
    /// # Errors
    /// None that a row of numbers and names can bring about.
    pub fn text(&self) -> Result<String, csv::Error> {
        let mut rows = Vec::new();
        for (control, (found, diverged)) in &self.tried {
            let row = |metric: &str, variant: &Variant, value: f64, verdict: &str| Row {
                control: control.clone(),
                metric: metric.to_owned(),
                variant: variant.clone(),
                value,
                verdict: verdict.to_owned(),
            };
            if *diverged {
                rows.push(row("", &Variant::default(), f64::NAN, DIVERGED));
            }
            for Found { metric, variant, value, verdict } in found {
                rows.push(row(metric, variant, *value, verdict.map_or(MISSING, Verdict::word)));
            }
        }
        Ok(format!("# solver {} commit {}\n{}", self.solver_hash, self.commit, csv_text(rows)?))
    }

    /// Whether another table has the same numbers, whichever solver gave them.
    pub fn agrees(&self, other: &Self) -> bool {
        // by their text, for what is not measured is no number
        let rows = |table: &Self| table.text().map(|text| text.split_once('\n').map(|(_, rows)| rows.to_owned())).ok();
        rows(self) == rows(other)
    }

    /// Result of a control; none where it was never tried.
    pub fn trial(&self, control: &Control) -> Option<ControlTrial> {
        let (found, diverged) = self.tried.get(&control.name)?.clone();
        let tried_at = (self.solver_hash != provenance::solver_hash()).then(|| self.commit.clone());
        Some(ControlTrial { control: control.clone(), found, diverged, tried_at })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_as_it_was_written() {
        let control = Control {
            name: "still".to_owned(),
            error: "nothing moves".to_owned(),
            solver: Some("none".to_owned()),
            rejected_by: vec!["front".to_owned()],
            ..Control::default()
        };
        let variant: Variant = "a=3,start=rest".parse().expect("a variant");
        let found = |metric: &str, value, verdict| Found {
            metric: metric.to_owned(),
            variant: variant.clone(),
            value,
            verdict,
        };
        let all = vec![
            found("front", 0.25, Some(Verdict::Fail)),
            found("height", f64::INFINITY, Some(Verdict::Pass)),
            found("width", 1.0, None),
        ];
        let trial = ControlTrial { control: control.clone(), found: all, diverged: true, tried_at: None };
        let table = TriedControls::by_this_program(std::slice::from_ref(&trial));
        let read = TriedControls::parse(&table.text().expect("a text")).expect("a table");
        assert_eq!(read, table);
        assert_eq!(read.trial(&control), Some(trial));
        assert_eq!(read.trial(&Control { name: "moving".to_owned(), ..control }), None);
        assert!(read.agrees(&table) && !read.agrees(&TriedControls::default()));
    }
}
