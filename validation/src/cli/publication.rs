//! Output of `bagnold run` for finished cases and studies, and its form in a report.

use super::arguments::RunArguments;
use super::error::ProgramError;
use super::expectation::Expectation;
use super::profile::StageTimer;
use super::{Exit, print, say, summary, tell};
use crate::case::{CaseResult, Registry, Tier};
use crate::measured::Measurements;
use crate::metric::{Metric, Variant, Verdict};
use crate::output::{FileError, OutputFolder};
use crate::report::{
    self, Baseline, CaseReport, KnownFailureStatus, KnownFailures, MetricKey, Report, ReportProvenance,
};
use crate::result::{MetricsDocument, write_case};
use crate::store::Store;
use std::io::Write;
use std::time::Instant;

/// Publication of a command's results.
pub(super) struct ResultPublication<'a> {
    pub(super) command: &'a RunArguments,
    pub(super) title: String,
    pub(super) tier: Tier,
    pub(super) baseline: Baseline,
    pub(super) known: KnownFailures,
    /// Accepted values of the case with default parameters, whose gates must be judged.
    pub(super) accepted: Baseline,
    /// The runs of the case as it comes.
    pub(super) all_runs: Vec<Variant>,
    /// Whether parameters and runs are the default ones.
    pub(super) is_whole: bool,
    /// Whether a file or a setting may have changed parameters, of which some take gates away.
    pub(super) has_own_parameters: bool,
    /// Measurements of which the folder receives copies.
    pub(super) measured: Vec<&'a Measurements>,
    /// Whether the times of these runs tell how long others will take.
    pub(super) learns: bool,
}

/// Output folder, and the time spent on the publication.
pub(super) struct Publication<'a> {
    pub(super) claimed: OutputFolder,
    pub(super) store: &'a Store,
    pub(super) registry: Registry,
    pub(super) expectation: Expectation,
    pub(super) started: Instant,
    pub(super) profile: StageTimer,
}

impl ResultPublication<'_> {
    /// Writes numbers, tables, states and the page, and prints the verdicts.
    pub(super) fn publish(
        self,
        results: &[CaseResult],
        publication: Publication<'_>,
        output: &mut (dyn Write + Send),
    ) -> Result<Exit, ProgramError> {
        let Self { command, mut known, accepted, all_runs, is_whole, has_own_parameters, .. } = self;
        if has_own_parameters {
            let judged = |key: &MetricKey| results.iter().any(|result| is_gated(result, key));
            known.failures.retain(|failure| judged(&failure.key()));
        }
        let Publication { claimed, store, registry, expectation, started, mut profile } = publication;
        let folder = claimed.folder().to_owned();
        let threads = rayon::current_num_threads();
        for result in results {
            let document = MetricsDocument::of(result, threads);
            write_case(claimed.staging(), result, &document)
                .and_then(|()| self.measured.iter().try_for_each(|own| own.keep(claimed.staging())))
                .map_err(|error| FileError::unwritable(&folder, &error))?;
            if command.json {
                print(output, &document.text());
            }
        }
        let not_judged = |result: &CaseResult| {
            let is_run = |own: &Variant| result.runs.iter().any(|run| run.variant == *own);
            let gone = accepted.not_judged(&result.name, &result.metrics).into_iter();
            let is_due = |key: &MetricKey| key.variant.run_among(&all_runs).map_or(is_whole, is_run);
            let is_meant = |key: &MetricKey| has_own_parameters && loses_its_gate_by_parameters(result, key);
            gone.filter(|(key, _)| is_due(key) && !is_meant(key)).collect::<Vec<_>>()
        };
        let page = Report {
            title: self.title,
            tier: self.tier,
            generated: ReportProvenance::of_this_program(started.elapsed(), String::new()),
            cases: results
                .iter()
                .map(|result| CaseReport { not_judged: not_judged(result), ..case_report(result, registry) })
                .collect(),
            baseline: self.baseline,
            against: None,
            known_failures: known.clone(),
            papers: &[],
            features: None,
        };
        report::write_alone(&page, claimed.staging(), &store.drawings().in_format(command.figures.format()))?;
        claimed.publish()?;
        if self.learns {
            expectation.learn(results, store.root(), threads);
        }
        profile.over("page");
        if let Some(path) = &command.junit {
            report::write_junit(&page, path)?;
        }
        if !command.json {
            for result in results {
                say(output, &summary::of_case(result, |metric| is_known(&known, result, metric)));
            }
            if results.iter().any(|result| result.unexpected_divergences().next().is_some()) {
                let states = "of a run that diverged, NAME.pvd ends with the last good state, NAME-first-bad.pvd is the one after";
                say(output, &format!("{}: {states}\n", folder.join("snapshots").display()));
            }
            say(output, &format!("written to {}\n", folder.join("index.html").display()));
        }
        if command.profile {
            tell(profile.in_words(results, threads).trim_end_matches('\n'));
        }
        for case in &page.cases {
            let mut lines = summary::not_judged(&case.name, &case.not_judged);
            if has_own_parameters && let Some(result) = results.iter().find(|result| result.name == case.name) {
                let gates = accepted.not_judged(&case.name, &case.metrics).into_iter().map(|(key, _)| key);
                let is_run = |key: &MetricKey| {
                    result.runs.iter().any(|run| key.variant.run_among(&all_runs) == Some(&run.variant))
                };
                lines += &summary::without_reference(
                    gates.filter(|key| is_run(key) && loses_its_gate_by_parameters(result, key)),
                );
            }
            match lines.trim_end() {
                "" => {}
                lines if command.json => tell(lines),
                _ => say(output, &lines),
            }
        }
        let is_judged = page.cases.iter().all(|case| case.not_judged.is_empty());
        Ok(Exit::of(results, |result, metric| is_known(&known, result, metric)).unless_whole(is_judged))
    }
}

fn is_gated(result: &CaseResult, key: &MetricKey) -> bool {
    let own = |metric: &&Metric| MetricKey::of(&result.name, metric) == *key;
    result.metrics.iter().find(own).is_some_and(|metric| metric.verdict() != Verdict::Observed)
}

/// Whether a metric is measured, and by a steady run, but without a gate: its reference does not hold for these parameters.
fn loses_its_gate_by_parameters(result: &CaseResult, key: &MetricKey) -> bool {
    let is_unsteady = |metric: &Metric| {
        metric.not_steady.is_some() && (key.variant.includes(&metric.variant) || metric.variant.includes(&key.variant))
    };
    let own = |metric: &&Metric| MetricKey::of(&result.name, metric) == *key;
    let without_gate = result.metrics.iter().find(own).is_some_and(|metric| metric.gate.is_none());
    without_gate && !result.metrics.iter().any(is_unsteady)
}

/// A finished case as a report shows it.
pub(super) fn case_report(result: &CaseResult, registry: Registry) -> CaseReport {
    CaseReport {
        name: result.name.clone(),
        summary: result.summary.clone(),
        description: result.description.clone(),
        parameters_toml: result.parameters_toml.clone(),
        command: result.command.clone(),
        metrics: result.metrics.clone(),
        quantities: registry.find(&result.name).map_or(&[], |case| case.quantities()),
        controls: Vec::new(),
        not_judged: Vec::new(),
        figures: result.figures.clone(),
        animations: result.animations.clone(),
        runs: result.runs.clone(),
        run_parameters: result.run_parameters.clone(),
        metrics_json: MetricsDocument::of(result, rayon::current_num_threads()).text(),
    }
}

/// Whether a failing gate is listed, and fails as listed.
pub(super) fn is_known(known: &KnownFailures, result: &CaseResult, metric: &Metric) -> bool {
    matches!(known.standing(&result.name, metric), KnownFailureStatus::Known(_))
}
