//! Detection of a mutation: by a gate, a divergence, the snapshot, or not at all.

use super::{MutantRun, Mutation, Scope};
use crate::metric::{Limit, Metric, Verdict};
use crate::report::Baseline;
use serde::{Deserialize, Serialize};

/// A gate that held and fails now.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Broken {
    /// Name of the case.
    pub case: String,
    /// The metric as it is with the error.
    pub metric: Metric,
}

impl Broken {
    /// Excess of the value beyond its limit, over the limit's size `[-]`; infinite for NaN.
    fn excess(&self) -> f64 {
        let Some(gate) = &self.metric.gate else { return 0.0 };
        let size = match gate.limit {
            Limit::AtMost(bound) | Limit::AtLeast(bound) => bound.abs(),
            Limit::Within(lower, upper) => upper - lower,
        };
        let excess = -gate.limit.margin(self.metric.value) / size;
        if excess.is_nan() { f64::INFINITY } else { excess }
    }
}

/// Strongest detection of a mutation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Detection {
    /// Gates that held without the error, the one furthest beyond its limit first.
    Gate(Vec<Broken>),
    /// A run that diverged, or a program that stopped: the case and what it said.
    Stop(String),
    /// A test that passes without the error.
    Test(String),
    /// Values that moved by more than they may, and no gate among them.
    Snapshot,
    /// No gate, stop or baseline value kills the mutation.
    Nothing,
}

impl Detection {
    /// Whether `bagnold report` fails by it on its own.
    pub fn is_certain(&self) -> bool {
        matches!(self, Self::Gate(_) | Self::Stop(_))
    }
}

/// Outcome of one mutation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MutationOutcome {
    /// Mutation that was run.
    pub error: Mutation,
    /// The cases that ran, in order.
    pub cases: Vec<String>,
    /// Strongest detection.
    pub catch: Detection,
    /// Values that moved beyond their snapshot tolerance, came or went.
    pub drifted: usize,
    /// First of them, as a sentence; empty without any.
    pub first_drift: String,
    /// Wall time of its runs `[s]`.
    pub wall_seconds: f64,
}

/// One case with and without the error. A case that did not end has no sighting but a reason.
pub type MutationComparison<'a> = (&'a Scope, &'a MutantRun, Result<MutantRun, String>);

/// Judges the output of the cases with an error, each against its output without the error.
pub fn judge(error: &Mutation, comparisons: &[MutationComparison<'_>]) -> MutationOutcome {
    let (mut broken, mut stops, mut drifts, mut wall_seconds) = (Vec::new(), Vec::new(), Vec::new(), 0.0);
    for (scope, right, wrong) in comparisons {
        let case = &scope.case;
        match wrong {
            Err(reason) => stops.push(format!("{case}: {reason}")),
            Ok(wrong) => {
                wall_seconds += wrong.wall_seconds;
                stops.extend(wrong.diverged.iter().map(|message| format!("{case}: {message}")));
                broken.extend(broken_gates(case, right, wrong));
                let baseline = Baseline::of(case, &right.metrics);
                drifts.extend(
                    baseline.differences(case, &wrong.metrics).into_iter().map(|text| format!("{case}: {text}")),
                );
            }
        }
    }
    broken.sort_by(|a: &Broken, b: &Broken| b.excess().total_cmp(&a.excess()));
    let catch = if !broken.is_empty() {
        Detection::Gate(broken)
    } else if let Some(first) = stops.into_iter().next() {
        Detection::Stop(first)
    } else if !drifts.is_empty() {
        Detection::Snapshot
    } else {
        Detection::Nothing
    };
    MutationOutcome {
        error: error.clone(),
        cases: comparisons.iter().map(|(scope, ..)| scope.case.clone()).collect(),
        catch,
        drifted: drifts.len(),
        first_drift: drifts.into_iter().next().unwrap_or_default(),
        wall_seconds,
    }
}

/// Gates of a case that hold without the error and with it fail or judge nothing any longer.
fn broken_gates<'a>(case: &'a str, right: &'a MutantRun, wrong: &'a MutantRun) -> impl Iterator<Item = Broken> + 'a {
    right.metrics.iter().filter(|metric| metric.verdict() == Verdict::Pass).filter_map(move |metric| {
        let is_it = |other: &&Metric| other.name == metric.name && other.variant == metric.variant;
        // a run that stops is a witness of its own
        let gone = || wrong.diverged.is_empty().then(|| Metric { value: f64::NAN, ..metric.clone() });
        let judged = wrong.metrics.iter().find(is_it).filter(|other| other.verdict() != Verdict::Observed);
        let metric = judged.cloned().or_else(gone)?;
        (metric.verdict() != Verdict::Pass).then(|| Broken { case: case.to_owned(), metric })
    })
}

/// Numbers of errors by their strongest witness: a gate, a run that diverged or a program that stopped, a test alone, the snapshot
/// alone, nothing.
pub fn tally(findings: &[MutationOutcome]) -> [usize; 5] {
    let mut tally = [0; 5];
    for finding in findings {
        let place = match finding.catch {
            Detection::Gate(_) => 0,
            Detection::Stop(_) => 1,
            Detection::Test(_) => 2,
            Detection::Snapshot => 3,
            Detection::Nothing => 4,
        };
        tally[place] += 1;
    }
    tally
}

/// Shares of the errors that were noticed, and that make `bagnold report` fail on its own, by a gate or a divergence `[-]`.
pub fn shares_caught(tally: [usize; 5]) -> (f64, f64) {
    let all: usize = tally.iter().sum();
    let [gate, stop, .., nothing] = tally;
    let share = |part: usize| part as f64 / all.max(1) as f64;
    (share(all - nothing), share(gate + stop))
}

/// Whether both shares are as large as they must be.
pub fn holds(tally: [usize; 5]) -> bool {
    let (caught, gated) = shares_caught(tally);
    caught >= super::LEAST_CAUGHT && gated >= super::LEAST_GATED
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Variant;

    fn sighting(value: f64, gated: bool) -> MutantRun {
        let metric = Metric::observed("error", &Variant::default(), value, "%").with_snapshot_tolerance(0.1, 0.0);
        let metric = if gated { metric.gated(Limit::AtMost(2.0), "a reason") } else { metric };
        MutantRun { metrics: vec![metric], diverged: Vec::new(), wall_seconds: 1.0 }
    }

    fn found(right: &MutantRun, wrong: Result<MutantRun, String>) -> MutationOutcome {
        let scope = Scope { case: "film".to_owned(), settings: Vec::new() };
        let (name, description) = ("von-karman".to_owned(), "κ = 0.45 instead of 0.41".to_owned());
        let error =
            Mutation { name, description, cases: Vec::new(), tests: Vec::new(), generated: false, places: Vec::new() };
        judge(&error, &[(&scope, right, wrong)])
    }

    #[test]
    fn the_strongest_witness_counts() {
        let right = sighting(1.0, true);
        assert!(matches!(found(&right, Ok(sighting(3.0, true))).catch, Detection::Gate(broken) if broken.len() == 1));
        assert_eq!(found(&right, Ok(sighting(1.5, true))).catch, Detection::Snapshot);
        assert_eq!(found(&right, Ok(sighting(1.05, true))).catch, Detection::Nothing);
        assert!(matches!(found(&right, Err("stopped".to_owned())).catch, Detection::Stop(_)));
        let diverged = MutantRun { diverged: vec!["at once".to_owned()], ..right.clone() };
        assert!(matches!(found(&right, Ok(diverged)).catch, Detection::Stop(_)));
    }

    #[test]
    fn a_gate_that_fails_anyway_is_no_witness() {
        assert_eq!(found(&sighting(2.5, true), Ok(sighting(4.0, true))).catch, Detection::Snapshot);
        assert_eq!(found(&sighting(1.0, false), Ok(sighting(1.0, false))).catch, Detection::Nothing);
        assert!(matches!(found(&sighting(1.0, true), Ok(sighting(f64::NAN, true))).catch, Detection::Gate(_)));
    }

    #[test]
    fn a_gate_that_judges_nothing_any_longer_is_a_witness() {
        let gone = MutantRun { metrics: Vec::new(), ..sighting(1.0, true) };
        assert!(matches!(found(&sighting(1.0, true), Ok(gone.clone())).catch, Detection::Gate(_)));
        assert!(matches!(found(&sighting(1.0, true), Ok(sighting(1.0, false))).catch, Detection::Gate(_)));
        let diverged = MutantRun { diverged: vec!["at once".to_owned()], ..gone };
        assert!(matches!(found(&sighting(1.0, true), Ok(diverged)).catch, Detection::Stop(_)));
    }

    #[test]
    fn shares_count_divergence_with_the_gates() {
        assert_eq!(shares_caught([15, 2, 0, 2, 1]), (0.95, 0.85));
        assert!(holds([15, 2, 0, 2, 1]));
        assert!(!holds([15, 2, 0, 1, 2]));
        assert!(!holds([15, 1, 0, 3, 1]));
    }
}
