//! Every metric against its gate, the baseline and the list of known failures; every run against divergence.

use super::accepted::{Drift, MetricKey};
use super::known_failures::{KnownFailure, KnownFailureStatus};
use super::papers::PaperSummary;
use super::power::GatePower;
use super::{CaseReport, Report};
use crate::metric::{Metric, MetricKind, Variant, Verdict};
use crate::observation::Outcome;

/// Severity of a result; the order is that of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A gate fails that is not listed, or the list of known failures contradicts the result.
    Failure,
    /// A listed gate fails as expected.
    KnownFailure,
    /// No gate fails, but the value has drifted from the baseline.
    Drifted,
    /// The gate holds.
    Pass,
    /// There is no gate.
    Observed,
}

/// One metric, judged.
#[derive(Debug, Clone)]
pub struct JudgedMetric<'r> {
    /// The metric.
    pub metric: &'r Metric,
    /// Against its gate.
    pub verdict: Verdict,
    /// Against the list of known failures.
    pub standing: KnownFailureStatus,
    /// Against the baseline.
    pub drift: Drift,
    /// Power of its gate.
    pub power: GatePower,
}

impl JudgedMetric<'_> {
    /// The worst of the three verdicts.
    #[must_use]
    pub fn severity(&self) -> Severity {
        match (&self.standing, self.verdict) {
            (standing, _) if standing.is_error() => Severity::Failure,
            (KnownFailureStatus::Known(_), _) => Severity::KnownFailure,
            (_, Verdict::Fail) => Severity::Failure,
            _ if self.drift.is_failure() => Severity::Drifted,
            (_, Verdict::Pass) => Severity::Pass,
            (_, Verdict::Observed) => Severity::Observed,
        }
    }
}

/// One case, judged; metrics with the worst first, then those that a page opens with, then the user's own gates before those of the case, what is measured
/// against before the run's own account, those of one name together.
#[derive(Debug, Clone)]
pub struct JudgedCase<'r> {
    /// The case.
    pub case: &'r CaseReport,
    /// Its metrics.
    pub metrics: Vec<JudgedMetric<'r>>,
    /// Baseline values that the case no longer measures.
    pub vanished: Vec<MetricKey>,
    /// Runs that diverged without having declared it: variant and message.
    pub diverged: Vec<(&'r Variant, &'r str)>,
}

impl JudgedCase<'_> {
    /// The worst of the case; an empty case is observed.
    #[must_use]
    pub fn severity(&self) -> Severity {
        let worst = self.metrics.iter().map(JudgedMetric::severity).min().unwrap_or(Severity::Observed);
        if !self.diverged.is_empty() || !self.case.not_judged.is_empty() {
            Severity::Failure
        } else if !self.vanished.is_empty() {
            worst.min(Severity::Drifted)
        } else {
            worst
        }
    }

    /// Number of metrics with this severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.metrics.iter().filter(|judged| judged.severity() == severity).count()
    }
}

/// Gates of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GateTally {
    /// Gates that hold and reject a control, or that none was asked of.
    pub hold: usize,
    /// Gates that hold and reject no control, or whose value is less certain than they are wide.
    pub cannot_tell: usize,
    /// Gates that fail and are not listed.
    pub fail: usize,
    /// Gates that fail and are listed.
    pub known: usize,
}

/// Comparisons with the baseline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DriftTally {
    /// Values within their tolerance.
    pub unchanged: usize,
    /// Values outside, in another unit, or vanished.
    pub drifted: usize,
    /// Values without a baseline.
    pub new: usize,
}

/// A judged report.
#[derive(Debug, Clone, Default)]
pub struct Judgement<'r> {
    /// Cases, the worst first, else in the report's order.
    pub cases: Vec<JudgedCase<'r>>,
    /// Gates of the runs' own account.
    pub bookkeeping: GateTally,
    /// Gates against exact solutions.
    pub verification: GateTally,
    /// Gates against experiments and published fits.
    pub validation: GateTally,
    /// Gates against what the papers say; a known failure there is a statement that is not reproduced.
    pub statements: GateTally,
    /// Comparisons with the baseline.
    pub drift: DriftTally,
    /// Entries of the list of known failures that contradict the results.
    pub contradictions: usize,
    /// Listed known failures whose metric this report does not have: of other tiers or other cases.
    pub known_elsewhere: usize,
    /// Runs that diverged without having declared it.
    pub diverged: usize,
    /// Gates of the baseline that are not judged.
    pub not_judged: usize,
    /// Status of the elements of each paper.
    pub papers: Vec<PaperSummary<'r>>,
}

impl Judgement<'_> {
    /// The tallies of all kinds.
    #[must_use]
    pub fn tallies(&self) -> [GateTally; 4] {
        [self.bookkeeping, self.verification, self.validation, self.statements]
    }

    /// Whether anything failed that is not a known failure: a gate, the list itself, or a run. Drift is not counted:
    /// it is the snapshot's verdict, not the gate's.
    #[must_use]
    pub fn has_unexpected_failure(&self) -> bool {
        let fails = self.tallies().iter().any(|tally| tally.fail > 0);
        fails || self.contradictions > 0 || self.diverged > 0 || self.not_judged > 0
    }

    /// Whether a value has left its tolerance, its unit or its side of a gate, or is no longer measured. New values have
    /// nothing to have drifted from.
    #[must_use]
    pub fn has_drift(&self) -> bool {
        self.drift.drifted > 0
    }

    /// Gates of any kind that fail, listed or not.
    #[must_use]
    pub fn failing_gates(&self) -> usize {
        self.tallies().iter().map(|tally| tally.fail + tally.known).sum()
    }

    /// Gates of any kind that hold and cannot tell a right value from a wrong one.
    #[must_use]
    pub fn blind_gates(&self) -> usize {
        self.tallies().iter().map(|tally| tally.cannot_tell).sum()
    }

    /// Gates of any kind that hold.
    #[must_use]
    pub fn holding_gates(&self) -> usize {
        self.tallies().iter().map(|tally| tally.hold).sum()
    }

    /// Whether every gate holds, nothing drifted, and there was a gate at all.
    #[must_use]
    pub fn is_green(&self) -> bool {
        self.holding_gates() + self.blind_gates() > 0
            && self.failing_gates() == 0
            && self.drift.drifted == 0
            && !self.has_unexpected_failure()
    }
}

/// Judges every case of `report`.
#[must_use]
pub fn judge(report: &Report) -> Judgement<'_> {
    let mut cases: Vec<JudgedCase<'_>> = report.cases.iter().map(|case| judge_case(report, case)).collect();
    let papers = report.papers.iter().map(|paper| PaperSummary::of(paper, &report.cases)).collect();
    let mut judgement = Judgement { papers, ..Judgement::default() };
    let listed_here = |failure: &&KnownFailure| {
        let is_it = |metric: &Metric| metric.name == failure.metric && metric.variant == failure.variant;
        report.cases.iter().any(|case| case.name == failure.case && case.metrics.iter().any(is_it))
    };
    let known = &report.known_failures.failures;
    judgement.known_elsewhere = known.len() - known.iter().filter(listed_here).count();
    for case in &cases {
        judgement.diverged += case.diverged.len();
        judgement.drift.drifted += case.vanished.len();
        judgement.not_judged += case.case.not_judged.len();
        for judged in &case.metrics {
            judgement.count(judged);
        }
    }
    // Stable: cases of one severity keep the registry's order.
    cases.sort_by_key(JudgedCase::severity);
    judgement.cases = cases;
    judgement
}

impl Judgement<'_> {
    fn count(&mut self, judged: &JudgedMetric<'_>) {
        let tally = match judged.metric.kind {
            MetricKind::Bookkeeping => &mut self.bookkeeping,
            MetricKind::Verification => &mut self.verification,
            MetricKind::Validation => &mut self.validation,
            MetricKind::Statement => &mut self.statements,
        };
        match (judged.verdict, &judged.standing) {
            (Verdict::Observed, _) => {}
            (Verdict::Pass, _) if judged.power.is_blind() => tally.cannot_tell += 1,
            (Verdict::Pass, _) => tally.hold += 1,
            (Verdict::Fail, KnownFailureStatus::Known(_)) => tally.known += 1,
            (Verdict::Fail, _) => tally.fail += 1,
        }
        if judged.standing.is_error() {
            self.contradictions += 1;
        }
        match judged.drift {
            Drift::New => self.drift.new += 1,
            Drift::Unchanged { .. } => self.drift.unchanged += 1,
            Drift::Drifted { .. } | Drift::UnitChanged { .. } | Drift::VerdictChanged { .. } => self.drift.drifted += 1,
        }
    }
}

fn judge_case<'r>(report: &'r Report, case: &'r CaseReport) -> JudgedCase<'r> {
    let mut metrics: Vec<JudgedMetric<'r>> = case
        .metrics
        .iter()
        .map(|metric| JudgedMetric {
            metric,
            verdict: metric.verdict(),
            standing: report.known_failures.standing(&case.name, metric),
            drift: report.baseline.drift(&case.name, metric),
            power: GatePower::of(case, metric),
        })
        .collect();
    let first_of_name = |name: &str| case.metrics.iter().position(|metric| metric.name == name);
    let weight = |kind: MetricKind| match kind {
        MetricKind::Validation => 0,
        MetricKind::Statement => 1,
        MetricKind::Verification => 2,
        MetricKind::Bookkeeping => 3,
    };
    metrics.sort_by_key(|judged| {
        let metric = judged.metric;
        let severity = judged.severity();
        let is_behind = severity > Severity::KnownFailure && !metric.leads;
        (is_behind, severity, metric.gate_owner(), weight(metric.kind), first_of_name(&metric.name))
    });
    let diverged = case.runs.iter().filter_map(|run| match &run.outcome {
        Outcome::Diverged { message, expected: false } => Some((&run.variant, message.as_str())),
        _ => None,
    });
    JudgedCase {
        case,
        metrics,
        vanished: report.baseline.vanished(&case.name, &case.metrics),
        diverged: diverged.collect(),
    }
}
