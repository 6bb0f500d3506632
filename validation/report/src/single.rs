//! The end of `bagnold run`: one case or study, judged and written into its folder.

use super::baseline::{Baseline, MetricKey};
use super::error::ReportError;
use super::judgement::judge;
use super::summary::Terminal;
use super::{CaseReport, Exit, ExpectedFailures, Report, ReportProvenance, junit, put_junit, summary};
use crate::metric::{Metric, Variant, Verdict};
use crate::output::{FileError, OutputFolder};
use crate::result::{MetricsDocument, write_case};
use crate::store::Drawings;
use std::path::PathBuf;
use std::time::Instant;

/// Basis on which a case or study is judged.
#[derive(Debug)]
pub struct SingleRun {
    /// Time at which the simulation began.
    pub started: Instant,
    /// The values to compare with.
    pub baseline: Baseline,
    /// The gates that are expected to fail.
    pub expected_failures: ExpectedFailures,
    /// Baseline of the case with default parameters, whose gates must be judged.
    pub gates: Baseline,
    /// The runs of the case as it comes.
    pub all_runs: Vec<Variant>,
    /// Whether parameters and runs are the default ones.
    pub is_whole: bool,
    /// Whether a file or a setting may have changed parameters, of which some take gates away.
    pub has_own_parameters: bool,
    /// File for the verdicts as JUnit's XML.
    pub junit: Option<PathBuf>,
    /// Rows of the verdicts that are shown, and their width.
    pub terminal: Terminal,
}

/// A finished run.
#[derive(Debug)]
pub struct SingleOutcome {
    /// The exit code.
    pub exit: Exit,
    /// The text of `metrics.json`.
    pub json: String,
    /// The verdicts in words.
    pub text: String,
    /// Gates that are not judged, in words.
    pub remarks: String,
    /// The verdict in a line.
    pub verdict: String,
    /// The case.
    pub case: CaseReport,
}

impl SingleRun {
    /// Judges the case and writes numbers, tables, states and the page.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn finish(
        mut self,
        mut case: CaseReport,
        claimed: OutputFolder,
        drawings: &Drawings,
    ) -> Result<SingleOutcome, ReportError> {
        if self.has_own_parameters {
            let fails = |key: &MetricKey| case.metric(key).is_some_and(|own| own.verdict() == Verdict::Fail);
            self.expected_failures.failures.retain(|failure| fails(&failure.key()));
        }
        let folder = claimed.folder().to_owned();
        let remarks;
        (case.not_judged, remarks) = self.not_judged(&case);
        let mut report = Report {
            generated: ReportProvenance::of_this_program(self.started.elapsed(), String::new()),
            baseline: self.baseline,
            expected_failures: self.expected_failures,
            ..Report::of(case.name.clone(), case.tier, vec![case])
        };
        let judgement = judge(&report);
        let mut document = MetricsDocument::of(judgement.cases[0].case, rayon::current_num_threads());
        document.tally = judgement.tally().by_word();
        write_case(claimed.staging(), judgement.cases[0].case, &document)
            .map_err(|error| FileError::unwritable(&folder, &error))?;
        super::write_alone(&judgement, claimed.staging(), drawings)?;
        claimed.publish()?;
        if let Some(path) = &self.junit {
            put_junit(path, &junit::text(&judgement))?;
        }
        let mut text: String = judgement.cases.iter().map(|case| summary::of_case(case, self.terminal)).collect();
        if judgement.diverged() > 0 {
            let states =
                "of a run that diverged, NAME.pvd ends with the last good state, NAME-first-bad.pvd is the one after";
            text += &format!("{}: {states}\n", folder.join("snapshots").display());
        }
        let page = folder.join("index.html");
        let verdict = format!("{}. Report: {}\n", judgement.in_words(), page.display());
        let exit = judgement.exit();
        Ok(SingleOutcome { exit, json: document.text(), text, remarks, verdict, case: report.cases.remove(0) })
    }

    /// Gates that the runs of a case had to judge, with what took each away; and remarks on all gates that they do not judge.
    fn not_judged(&self, case: &CaseReport) -> (Vec<(MetricKey, String)>, String) {
        let run = |key: &MetricKey| key.variant.run_among(&self.all_runs);
        let is_run = |own: &Variant| case.runs.iter().any(|run| run.variant == *own);
        let without_reference = |key: &MetricKey| self.has_own_parameters && loses_its_gate_by_parameters(case, key);
        let gone = self.gates.not_judged(&case.name, &case.metrics).into_iter();
        let (meant, gone): (Vec<_>, Vec<_>) = gone.partition(|(key, _)| without_reference(key));
        let due = gone.into_iter().filter(|(key, _)| run(key).map_or(self.is_whole, is_run)).collect::<Vec<_>>();
        let meant = meant.into_iter().map(|(key, _)| key).filter(|key| run(key).is_some_and(is_run));
        let remarks = summary::not_judged(&due) + &summary::without_reference(meant);
        (due, remarks)
    }
}

/// Whether a metric of a steady run is without a gate or not measured at all: its reference does not hold for these parameters.
fn loses_its_gate_by_parameters(case: &CaseReport, key: &MetricKey) -> bool {
    let is_unsteady = |metric: &Metric| {
        metric.reason_of_absence().is_some()
            && (key.variant.includes(&metric.variant) || metric.variant.includes(&key.variant))
    };
    case.metric(key).is_none_or(|metric| metric.gate.is_none()) && !case.metrics.iter().any(is_unsteady)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{case, gated};
    use super::*;

    /// The user's parameters, not a fault, take away what the shipped case measures or judges.
    #[test]
    fn gates_of_the_shipped_case_that_own_parameters_take_away_are_no_failure() {
        let key = MetricKey::of("film", &gated("plug", 0.3));
        let observed = Metric { gate: None, ..gated("plug", 0.3) };
        for (metrics, is_lost) in [(vec![gated("plug", 0.3)], false), (vec![observed], true), (Vec::new(), true)] {
            assert_eq!(loses_its_gate_by_parameters(&case("film", metrics), &key), is_lost);
        }
        let unsteady = gated("plug", f64::NAN).remarked(Some("not steady".to_owned()));
        assert!(!loses_its_gate_by_parameters(&case("film", vec![unsteady]), &key), "the run is at fault");
    }
}
