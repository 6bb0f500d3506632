//! The verdict, computed once: the severity of every gate by its limit, its controls and the list of expected failures, every value
//! beside the baseline, every run, and the exit code that follows. Pages, JUnit and commands read it.

use super::baseline::{Change, MetricKey};
use super::expected_failures::{ExpectedFailure, ListStatus};
use super::papers::PaperSummary;
use super::power::Doubt;
use super::{CaseReport, Exit, Report};
use crate::metric::{Metric, MetricKind, Variant, Verdict};
use crate::number::with_unit;
use crate::observation::Outcome;
use std::collections::BTreeMap;

/// Severity of a gate, the one that weighs most first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Outside its limit and not listed, or worse than the list of expected failures says.
    NewFailure,
    /// Without a value, or of a run that cannot be judged.
    NotJudged,
    /// Within its limit, or without one, though listed as an expected failure: the entry must go.
    UnexpectedPass,
    /// Outside its limit, as listed.
    ExpectedFailure,
    /// Within its limit, but no control makes its value fail, or two standard uncertainties exceed its half width.
    Inconclusive,
    /// Within its limit.
    Pass,
}

impl Severity {
    /// All entries, the one of the largest weight first.
    pub const ALL: [Self; 6] = [
        Self::NewFailure,
        Self::NotJudged,
        Self::UnexpectedPass,
        Self::ExpectedFailure,
        Self::Inconclusive,
        Self::Pass,
    ];

    /// Word on pages, in files and on the terminal.
    pub const fn word(self) -> &'static str {
        match self {
            Self::NewFailure => "new failure",
            Self::NotJudged => "not judged",
            Self::UnexpectedPass => "unexpected pass",
            Self::ExpectedFailure => "expected failure",
            Self::Inconclusive => "inconclusive",
            Self::Pass => "pass",
        }
    }

    /// Whether it changes the exit code.
    pub fn is_error(self) -> bool {
        self <= Self::UnexpectedPass
    }

    /// Severity of the gate of a metric; none without a gate that judges, unless the list names it.
    pub(super) fn of(metric: &Metric, listed: &ListStatus, doubt: Option<Doubt>) -> Option<Self> {
        Some(match metric.verdict() {
            Verdict::Observed if !listed.is_error() => return None,
            Verdict::Fail if !metric.value.is_finite() => Self::NotJudged,
            Verdict::Fail if matches!(listed, ListStatus::AsListed(_)) => Self::ExpectedFailure,
            Verdict::Pass if !listed.is_error() && doubt.is_some() => Self::Inconclusive,
            Verdict::Pass if !listed.is_error() => Self::Pass,
            Verdict::Fail => Self::NewFailure,
            _ => Self::UnexpectedPass,
        })
    }
}

/// Kinds of gate in the order of a page, with their names.
pub(super) const KINDS: [(MetricKind, &str); 4] = [
    (MetricKind::Validation, "against measurements"),
    (MetricKind::Statement, "statements of the papers"),
    (MetricKind::Verification, "exact solutions and other codes"),
    (MetricKind::Bookkeeping, "bookkeeping"),
];

/// Rank of a metric or a case on a page: the severities that fail, then values that have moved, other gates, and what is only
/// observed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// A gate that is a new or an expected failure, not judged, or passes unexpectedly.
    Failing(Severity),
    /// No gate fails, but a value has moved from the baseline.
    Moved,
    /// Gates are within their limits.
    Within,
    /// There is no gate.
    Observed,
}

/// One metric, judged.
#[derive(Debug, Clone)]
pub struct JudgedMetric<'r> {
    /// The metric.
    pub metric: &'r Metric,
    /// Severity of its gate; none without one that judges.
    pub severity: Option<Severity>,
    /// Status in the list of expected failures.
    pub listed: ListStatus,
    /// Change against the baseline.
    pub change: Change,
    /// Reason for which it is inconclusive, where it is within its limit.
    pub doubt: Option<Doubt>,
}

impl<'r> JudgedMetric<'r> {
    fn of(report: &Report, case: &CaseReport, metric: &'r Metric) -> Self {
        let listed = report.expected_failures.status(&case.name, metric);
        let (change, doubt) = (report.baseline.change(&case.name, metric), Doubt::of(case, metric));
        Self { metric, severity: Severity::of(metric, &listed, doubt), listed, change, doubt }
    }

    /// Rank on a page.
    pub fn rank(&self) -> Rank {
        match self.severity {
            Some(severity) if severity <= Severity::ExpectedFailure => Rank::Failing(severity),
            _ if self.change.has_moved() => Rank::Moved,
            Some(_) => Rank::Within,
            None => Rank::Observed,
        }
    }

    /// Remark of the list of expected failures, in a sentence.
    pub fn note(&self) -> String {
        let best = |value: f64| with_unit(value, &self.metric.unit);
        match &self.listed {
            ListStatus::Unlisted => String::new(),
            ListStatus::AsListed(entry) => {
                let (now, best) = (with_unit(self.metric.value, &self.metric.unit), best(entry.best_value));
                let best = if now == best { String::new() } else { format!(" (best {best})") };
                let tried =
                    if entry.tried.is_empty() { String::new() } else { format!(" Tried: {}", entry.tried.trim()) };
                format!("Expected failure since {}{best}, {}: {}{tried}", entry.date, entry.kind.words(), entry.reason)
            }
            ListStatus::PassesAgain(_) => {
                "Listed as an expected failure, but the gate passes: remove the entry.".to_owned()
            }
            ListStatus::Worse(entry) => {
                format!("Expected failure since {}, but worse than its best, {}.", entry.date, best(entry.best_value))
            }
            ListStatus::WithoutGate(_) => {
                "Listed as an expected failure, but no such gate exists: remove the entry.".to_owned()
            }
        }
    }
}

/// One judged case. Metrics: the worst first, then those that open a page, then gates of the user before those of the case, comparisons
/// before the balances of the run, metrics of one name together.
#[derive(Debug, Clone)]
pub struct JudgedCase<'r> {
    /// The case.
    pub case: &'r CaseReport,
    /// Metrics of the case with their verdicts.
    pub metrics: Vec<JudgedMetric<'r>>,
    /// Baseline values that the case no longer measures.
    pub vanished: Vec<MetricKey>,
    /// Runs that diverged without having declared it: variant and message.
    pub diverged: Vec<(&'r Variant, &'r str)>,
}

impl<'r> JudgedCase<'r> {
    fn of(report: &'r Report, case: &'r CaseReport) -> Self {
        let metrics = case.metrics.iter().map(|metric| JudgedMetric::of(report, case, metric));
        let mut metrics: Vec<JudgedMetric<'r>> = metrics.collect();
        let first_of_name = |name: &str| case.metrics.iter().position(|metric| metric.name == name);
        metrics.sort_by_key(|judged| {
            let (metric, rank) = (judged.metric, judged.rank());
            let is_behind = rank >= Rank::Moved && !metric.leads;
            let kind = KINDS.iter().position(|(kind, _)| *kind == metric.kind);
            (is_behind, rank, metric.gate_owner(), kind, first_of_name(&metric.name))
        });
        let diverged = case.runs.iter().filter_map(|run| match &run.outcome {
            Outcome::Diverged { message, expected: false } => Some((&run.variant, message.as_str())),
            _ => None,
        });
        let vanished = report.baseline.vanished(&case.name, &case.metrics);
        Self { case, metrics, vanished, diverged: diverged.collect() }
    }

    /// Rank on a page; an empty case is observed.
    pub fn rank(&self) -> Rank {
        let worst = self.metrics.iter().map(JudgedMetric::rank).min().unwrap_or(Rank::Observed);
        if !self.diverged.is_empty() || !self.case.not_judged.is_empty() {
            Rank::Failing(Severity::NewFailure)
        } else if !self.vanished.is_empty() {
            worst.min(Rank::Moved)
        } else {
            worst
        }
    }

    /// Gates of the case, including gates of the baseline that this run does not judge.
    pub fn tally(&self) -> Tally {
        let gone = self.case.not_judged.iter().map(|_| Severity::NotJudged);
        Tally(self.metrics.iter().filter_map(|judged| judged.severity).chain(gone).collect())
    }
}

/// Severities of some gates.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally(pub Vec<Severity>);

impl Tally {
    /// Total number.
    pub fn all(&self) -> usize {
        self.0.len()
    }

    /// Number of entries of a severity.
    pub fn of(&self, severity: Severity) -> usize {
        self.0.iter().filter(|own| **own == severity).count()
    }

    /// The gates and their number in each severity, without those that have none; the new failures always.
    pub fn in_words(&self) -> String {
        let counts = Severity::ALL.into_iter().rev().map(|severity| (severity, self.of(severity)));
        let shown = counts.filter(|(severity, number)| *number > 0 || *severity == Severity::NewFailure);
        let words = shown.map(|(severity, number)| match severity {
            Severity::NewFailure | Severity::ExpectedFailure => plural(number, severity.word()),
            _ => format!("{number} {}", severity.word()),
        });
        format!("{}: {}", plural(self.all(), "gate"), words.collect::<Vec<_>>().join(", "))
    }

    /// Numbers by the words of their severities.
    pub fn by_word(&self) -> BTreeMap<String, usize> {
        Severity::ALL.into_iter().map(|severity| (severity.word().to_owned(), self.of(severity))).collect()
    }
}

/// A count.
pub(super) fn plural(number: usize, word: &str) -> String {
    if number == 1 { format!("1 {word}") } else { format!("{number} {word}s") }
}

/// A judged report.
#[derive(Debug, Clone)]
pub struct Judgement<'r> {
    /// The report.
    pub report: &'r Report,
    /// Cases, the worst first, else in the report's order.
    pub cases: Vec<JudgedCase<'r>>,
    /// Entries of the list of expected failures that contradict the results, each in a sentence.
    pub contradictions: Vec<(&'r ExpectedFailure, String)>,
    /// Status of the elements of each paper.
    pub papers: Vec<PaperSummary<'r>>,
}

impl<'r> Judgement<'r> {
    /// All metrics, each with its case.
    pub fn metrics(&self) -> impl Iterator<Item = (&JudgedCase<'r>, &JudgedMetric<'r>)> {
        self.cases.iter().flat_map(|case| case.metrics.iter().map(move |judged| (case, judged)))
    }

    /// All gates.
    pub fn tally(&self) -> Tally {
        Tally(self.cases.iter().flat_map(|case| case.tally().0).collect())
    }

    /// Gates of one kind.
    pub fn tally_of(&self, kind: MetricKind) -> Tally {
        let own = self.metrics().filter(|(_, judged)| kind == judged.metric.kind);
        Tally(own.filter_map(|(_, judged)| judged.severity).collect())
    }

    /// The verdict in a line: all gates, and how many values have moved from the baseline.
    pub fn in_words(&self) -> String {
        let (moved, diverged) = (self.moved(), self.diverged());
        let mut text = self.tally().in_words();
        if moved + self.unchanged() > 0 {
            text += &format!("; {moved} of {} moved", plural(moved + self.unchanged(), "value"));
        }
        if diverged > 0 {
            text += &format!("; {} diverged", plural(diverged, "run"));
        }
        text
    }

    /// Runs that diverged without having declared it.
    pub fn diverged(&self) -> usize {
        self.cases.iter().map(|case| case.diverged.len()).sum()
    }

    /// Values that have left their tolerance, their unit or their side of a gate, or are no longer measured. New values have
    /// nothing to have moved from.
    pub fn moved(&self) -> usize {
        let vanished: usize = self.cases.iter().map(|case| case.vanished.len()).sum();
        vanished + self.metrics().filter(|(_, judged)| judged.change.has_moved()).count()
    }

    /// Values that are as in the baseline.
    pub fn unchanged(&self) -> usize {
        self.metrics().filter(|(_, judged)| matches!(judged.change, Change::Unchanged { .. })).count()
    }

    /// The exit code. A divergence weighs more than a gate, since its metrics mean nothing. Moved values do not count: they are
    /// the baseline's verdict, not the gate's.
    pub fn exit(&self) -> Exit {
        let is_error = |case: &JudgedCase<'_>| matches!(case.rank(), Rank::Failing(severity) if severity.is_error());
        if self.diverged() > 0 {
            Exit::Diverged
        } else if self.cases.iter().any(is_error) || !self.contradictions.is_empty() {
            Exit::GateFailed
        } else {
            Exit::Held
        }
    }
}

/// Judges every case of `report`.
pub fn judge(report: &Report) -> Judgement<'_> {
    let mut cases: Vec<JudgedCase<'_>> = report.cases.iter().map(|case| JudgedCase::of(report, case)).collect();
    // Stable: cases of one rank keep the registry's order.
    cases.sort_by_key(JudgedCase::rank);
    let papers = report.papers.iter().map(|paper| PaperSummary::of(paper, &report.cases)).collect();
    let mut judgement = Judgement { report, cases, contradictions: Vec::new(), papers };
    for failure in &report.expected_failures.failures {
        let found =
            judgement.metrics().find(|(case, judged)| MetricKey::of(&case.case.name, judged.metric) == failure.key());
        let contradiction = match found {
            Some((_, judged)) => judged.listed.is_error().then(|| judged.note()),
            None => {
                let is_unknown = report.listed_in_vain.contains(&failure.key());
                is_unknown.then(|| "no study measures this; correct or delete the entry".to_owned())
            }
        };
        judgement.contradictions.extend(contradiction.map(|words| (failure, words)));
    }
    judgement
}
