//! The process of a report: the committed values are read before anything is simulated; afterwards cases are judged, pages are
//! written, and the exit code follows.

use super::baseline::Baseline;
use super::error::ReportError;
use super::judgement::{Judgement, judge};
use super::moved::{MovedValue, moved};
use super::summary::Terminal;
use super::{
    CaseReport, CommittedValues, Exit, ExpectedFailures, GateList, MetricKey, Report, ReportProvenance, junit, papers,
    put_junit, summary, unchanged,
};
use crate::case::{Features, Tier};
use crate::evidence::{ValidatedComparison, ValidationSet};
use crate::metric::Verdict;
use crate::output::{FileError, OutputFolder, write_whole};
use crate::store::{Drawings, provenance};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Most values that have moved on the terminal.
const MOST_MOVED: usize = 10;

/// Settings of a report, each with the cases that have its field.
pub type ChangedCases = Vec<(String, Vec<String>)>;

/// Inputs and options of a report.
#[derive(Debug, Clone)]
pub struct ReportRequest {
    /// Heading of the first page.
    pub title: String,
    /// Values to compare with.
    pub committed: CommittedValues,
    /// Names of the cases or studies, with their tiers.
    pub named: Vec<(String, Tier)>,
    /// Settings that make cases differ from their baselines.
    pub changed: ChangedCases,
    /// The options whose coverage is shown; none for a suite.
    pub features: Option<Features>,
    /// Folder of an earlier report to compare with instead.
    pub against: Option<PathBuf>,
    /// Whether the values become the baseline.
    pub accept: bool,
    /// Whether a value that has moved is an error.
    pub deny_moved: bool,
    /// File for the verdicts as JUnit's XML.
    pub junit: Option<PathBuf>,
    /// Output folder.
    pub folder: PathBuf,
    /// Rows of the verdicts that are shown, and their width.
    pub terminal: Terminal,
    /// Command that makes it again.
    pub command: String,
    /// Every option, where a report that was made by the same from the same need not be made again.
    pub options: Option<String>,
}

/// A report whose cases are being simulated.
#[derive(Debug)]
pub struct ReportProcess {
    request: ReportRequest,
    baseline: Baseline,
    expected_failures: ExpectedFailures,
    claimed: OutputFolder,
    /// Digest of what it is made from.
    inputs: Option<String>,
    started: Instant,
}

/// A finished report.
#[derive(Debug)]
pub struct ReportOutcome {
    /// The exit code.
    pub exit: Exit,
    /// The verdicts in words.
    pub text: String,
    /// The cases; empty where nothing has changed since the report was made.
    pub cases: Vec<CaseReport>,
}

impl ReportRequest {
    /// Reads the committed values and claims the folder; or returns the outcome of the report there, if nothing has changed since.
    ///
    /// # Errors
    /// Committed values or an earlier report that are malformed, a folder that cannot be written.
    pub fn begin(self) -> Result<Result<ReportProcess, ReportOutcome>, ReportError> {
        let baseline = self.baseline()?;
        let inputs = self.options.as_ref().and_then(|options| unchanged::inputs(options, &self.committed));
        if let Some((exit, text)) = inputs.as_ref().and_then(|inputs| unchanged::said(&self.folder, inputs)) {
            return Ok(Err(ReportOutcome { exit, text, cases: Vec::new() }));
        }
        let claimed = OutputFolder::claim(&self.folder)?;
        let expected_failures = self.committed.expected_failures()?;
        let started = Instant::now();
        Ok(Ok(ReportProcess { request: self, baseline, expected_failures, claimed, inputs, started }))
    }

    /// Values of an earlier report, or the committed ones.
    fn baseline(&self) -> Result<Baseline, ReportError> {
        if let Some(folder) = &self.against {
            let names: Vec<String> = self.named.iter().map(|(name, _)| name.clone()).collect();
            let tier = self.named.first().map_or(Tier::Quick, |(_, tier)| *tier);
            return Ok(Baseline::of_report(folder, &names, tier)?);
        }
        let mut baseline = Baseline::default();
        for (name, tier) in &self.named {
            baseline.extend(self.committed.baseline(name, *tier)?);
        }
        Ok(baseline)
    }
}

impl ReportProcess {
    /// Judges the cases, writes the pages and returns the failures.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn finish(mut self, cases: Vec<CaseReport>, drawings: &Drawings) -> Result<ReportOutcome, ReportError> {
        if self.request.accept {
            self.baseline = accept(&self.request.committed, &cases)?;
        }
        let report = self.report(cases);
        let judgement = judge(&report);
        super::write(&judgement, self.claimed.staging(), drawings)?;
        let (exit, text) = self.said(&judgement);
        if let Some(inputs) = self.inputs {
            let kept = unchanged::keep(self.claimed.staging(), inputs, exit, &text);
            kept.map_err(|error| FileError::unwritable(self.claimed.staging(), &error))?;
        }
        self.claimed.publish()?;
        if let Some(path) = &self.request.junit {
            put_junit(path, &junit::text(&judgement))?;
        }
        Ok(ReportOutcome { exit, text, cases: report.cases })
    }

    fn report(&mut self, mut cases: Vec<CaseReport>) -> Report {
        let request = &self.request;
        let is_changed = |case: &str| request.changed.iter().any(|(_, cases)| cases.iter().any(|own| own == case));
        // references of other parameters take gates away, and other values pass
        for case in cases.iter_mut().filter(|case| !is_changed(&case.name)) {
            case.not_judged = self.baseline.not_judged(&case.name, &case.metrics);
        }
        let fails = |key: &MetricKey| {
            let own = cases.iter().find(|case| case.name == key.case);
            own.and_then(|case| case.metric(key)).is_some_and(|metric| metric.verdict() == Verdict::Fail)
        };
        let listed = &mut self.expected_failures.failures;
        listed.retain(|failure| !is_changed(&failure.case) || fails(&failure.key()));
        let with = request.changed.iter().map(|(setting, _)| format!(" with --set {setting}"));
        let title = request.title.clone() + &with.collect::<String>();
        // a suite may have several
        let tiers = request.named.iter().map(|(_, tier)| *tier);
        let tier = tiers.min_by_key(|tier| *tier != Tier::Quick).unwrap_or(Tier::Quick);
        Report {
            generated: ReportProvenance::of_this_program(self.started.elapsed(), request.command.clone()),
            features: request.features.clone(),
            papers: if request.committed == CommittedValues::OfCases { papers::accounted(&cases) } else { &[] },
            baseline: std::mem::take(&mut self.baseline),
            against: request.against.as_ref().map(|folder| folder.display().to_string()),
            listed_in_vain: request.committed.listed_in_vain(&self.expected_failures),
            expected_failures: std::mem::take(&mut self.expected_failures),
            ..Report::of(title, tier, cases)
        }
    }

    /// The exit code and the verdicts in words: what fails in the order of the cases, then what is at odds with committed values.
    fn said(&self, judgement: &Judgement<'_>) -> (Exit, String) {
        let report = judgement.report;
        let judged = |case: &CaseReport| judgement.cases.iter().find(|judged| std::ptr::eq(judged.case, case));
        let terminal = self.request.terminal;
        let failures = report.cases.iter().filter_map(judged).map(|case| summary::failures(case, terminal));
        let mut text: String = failures.collect();
        text.extend(report.cases.iter().map(|case| summary::not_judged(&case.not_judged)));
        let file = self.request.committed.list_of_failures();
        text.extend(judgement.contradictions.iter().map(|(failure, words)| {
            let (case, metric, variant) = (&failure.case, &failure.metric, &failure.variant);
            format!("EXPECTED FAILURE: {file}: {case} {metric} {variant}: {words}\n")
        }));
        let moved: Vec<MovedValue> = moved(judgement).into_iter().filter(|own| own.is_beyond).collect();
        let shown = if terminal.is_verbose { moved.len() } else { moved.len().min(MOST_MOVED) };
        text.extend(moved[..shown].iter().map(|moved| format!("moved: {moved}\n")));
        if shown < moved.len() {
            text += &format!("moved: {} more, shown with -v\n", moved.len() - shown);
        }
        let limits = self.moved_limits(report);
        text.extend(limits.iter().map(|moved| format!("moved: {moved}\n")));
        let mut exit = judgement.exit();
        if exit == Exit::Held && moved.len() + limits.len() > 0 {
            if self.request.deny_moved {
                exit = Exit::GateFailed;
            } else {
                text += "moved without a new failure: the exit code is 0 unless --deny moved is given\n";
            }
        }
        for (setting, cases) in &self.request.changed {
            let (own, all) = (cases.len(), report.cases.len());
            text += &format!(
                "with --set {setting}: {own} of {all} cases ({}), beside baselines without it; ",
                cases.join(", ")
            );
            text += "the others lack the field or vary it themselves\n";
        }
        let page = self.request.folder.join("index.html");
        text += &format!("runs: {}\n", summary::runs(report.cases.iter().flat_map(|case| &case.runs)));
        text += &format!("{}. Report: {}\n", judgement.in_words(), page.display());
        (exit, text)
    }

    /// Limits that differ from the accepted ones; none beside an earlier report or for a suite, which has no list.
    fn moved_limits(&self, report: &Report) -> Vec<String> {
        let is_compared = self.request.against.is_none() && self.request.changed.is_empty();
        if !is_compared || self.request.committed != CommittedValues::OfCases {
            return Vec::new();
        }
        let of_case = |case: &CaseReport| {
            let list = GateList::read(&self.request.committed.folder(), case.tier).ok()?;
            Some(list.moved_limits(&case.name, &case.metrics))
        };
        report.cases.iter().filter_map(of_case).flatten().collect()
    }
}

/// Makes the values of these cases the baseline.
fn accept(committed: &CommittedValues, cases: &[CaseReport]) -> Result<Baseline, ReportError> {
    let mut baseline = Baseline::default();
    let folder = committed.folder();
    for case in cases {
        let fresh = Baseline::of(&case.name, &case.metrics);
        fresh.write(&folder, &case.name, case.tier, provenance::commit())?;
        if *committed == CommittedValues::OfCases {
            let mut gates = GateList::read(&folder, case.tier)?;
            gates.add(&case.name, &case.metrics);
            gates.write(&folder, case.tier)?;
            let path = folder.join("comparisons").join(format!("{}.csv", case.tier));
            accept_comparisons(&path, case).map_err(|error| FileError::unwritable(&path, &error))?;
        }
        baseline.extend(fresh);
    }
    Ok(baseline)
}

/// Accepts the comparisons of a case with measurements, with the regimes of its flows.
fn accept_comparisons(path: &Path, case: &CaseReport) -> io::Result<()> {
    let text = match std::fs::read_to_string(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
        text => text?,
    };
    let mut set = ValidationSet::parse(&text).map_err(io::Error::other)?;
    let runs: Vec<_> = case.runs.iter().map(|run| run.variant.clone()).zip(case.regimes.iter().copied()).collect();
    set.replace(&case.name, ValidatedComparison::all(&case.name, &case.metrics, &runs));
    let text = set.text().map_err(io::Error::other)?;
    std::fs::create_dir_all(path.parent().unwrap_or(path))?;
    write_whole(path, text.as_bytes())
}
