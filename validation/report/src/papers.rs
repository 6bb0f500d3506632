//! Status of every element of the papers, by the metrics of a report.

use super::CaseReport;
use super::width::share_of_gate;
use crate::case::RunSummary;
use crate::evidence::{Element, MetricName, PAPERS, Paper, RunName};
use crate::metric::{COVERAGE, Metric, Verdict};
use crate::observation::Outcome;

/// Status of an element; the worst of several metrics is the first here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// A number of ours lies outside of what the paper prints.
    Contradicted,
    /// A gate on it fails, or our number falls short of what the paper shows.
    NotReproduced,
    /// It would count as reproduced with wrong physics or a wrong input as well, by a control that it is meant to feel, no control makes it
    /// fall, or two standard uncertainties of its value reach out of what is printed or exceed the gate's half width.
    NotShown,
    /// Gates pass, numbers agree, or tests hold it, and a control makes it fall, as does every control that it is meant to feel.
    Reproduced,
    /// Nothing here speaks of it, for a stated reason or because its metrics or runs are not part of the tier.
    NotCovered,
}

impl Status {
    /// All entries, in the order of the page.
    pub const ALL: [Self; 5] =
        [Self::Reproduced, Self::NotShown, Self::NotReproduced, Self::Contradicted, Self::NotCovered];

    /// Name.
    pub fn word(self) -> &'static str {
        match self {
            Self::Contradicted => "contradicted",
            Self::NotReproduced => "not reproduced",
            Self::NotShown => "not shown",
            Self::Reproduced => "reproduced",
            Self::NotCovered => "not covered",
        }
    }

    /// Status that a metric gives to an element that names it: the paper's number decides if there is one, else the
    /// gate; none for an observed metric.
    pub fn of(name: &MetricName, metric: &Metric) -> Option<Self> {
        let is_uncertain = match name.printed {
            Some(printed) => {
                metric.uncertainty.standard().is_some_and(|own| !printed.tells(metric.value, COVERAGE * own))
            }
            None if metric.verdict() == Verdict::Fail => {
                let margin = metric.gate.as_ref().map(|gate| gate.limit.margin(metric.value));
                margin.zip(metric.uncertainty.standard()).is_some_and(|(margin, own)| -margin < COVERAGE * own)
            }
            None => share_of_gate(metric).is_some_and(|share| share > 1.0),
        };
        Self::of_value(name, metric.value, metric.verdict())
            .map(|status| if is_uncertain { Self::NotShown } else { status })
    }

    /// Status that a value and the verdict of its gate give to an element that names the metric.
    fn of_value(name: &MetricName, value: f64, verdict: Verdict) -> Option<Self> {
        match (name.printed, verdict) {
            (Some(printed), _) if printed.agrees(value) => Some(Self::Reproduced),
            (Some(printed), _) if !printed.shortcoming && value.is_finite() => Some(Self::Contradicted),
            (Some(_), _) | (None, Verdict::Fail) => Some(Self::NotReproduced),
            (None, Verdict::Pass) => Some(Self::Reproduced),
            (None, Verdict::Observed) => None,
        }
    }
}

/// A metric that shows an element.
#[derive(Debug, Clone)]
pub struct Shown<'r> {
    /// Metric as the element names it.
    pub name: &'r MetricName,
    /// The metric.
    pub metric: &'r Metric,
    /// Status that the metric gives to the element; none if it is observed only.
    pub status: Option<Status>,
}

/// A run that has to end without diverging.
#[derive(Debug, Clone)]
pub struct Ended<'r> {
    /// Run as the element names it.
    pub name: &'r RunName,
    /// The run.
    pub run: &'r RunSummary,
    /// "Not reproduced" for a run that diverged, declared or not; `None` otherwise, because finishing shows nothing.
    pub status: Option<Status>,
}

/// Verdict of an element under a control.
struct Tried<'r> {
    /// The control, by case and name.
    control: (&'r str, &'r str),
    /// Whether the element names a metric that is meant to feel it.
    is_meant: bool,
    /// Whether the element still counts as reproduced.
    stands: bool,
}

/// Status of one element, with the metrics and runs that show it.
#[derive(Debug, Clone)]
pub struct ElementOutcome<'r> {
    /// The element.
    pub element: &'r Element,
    /// Status of the element.
    pub status: Status,
    /// The metrics of this report that show it.
    pub shown: Vec<Shown<'r>>,
    /// The runs of this report that it names.
    pub ended: Vec<Ended<'r>>,
    /// Controls that should reject the element but do not, by case and name.
    pub accepts: Vec<(&'r str, &'r str)>,
    /// Whether a control makes it fall by a value; tests have controls of their own.
    pub falls: bool,
}

impl<'r> ElementOutcome<'r> {
    fn of(element: &'r Element, cases: &'r [CaseReport]) -> Self {
        let of_name = |name: &'r MetricName| {
            let metrics = cases.iter().filter(|case| case.name == name.case).flat_map(|case| &case.metrics);
            let named = metrics.filter(|metric| name.names(&metric.name, &metric.variant));
            named.map(|metric| Shown { name, metric, status: Status::of(name, metric) })
        };
        let shown: Vec<Shown<'r>> = element.metrics.iter().flat_map(of_name).collect();
        let of_run = |name: &'r RunName| {
            let runs = cases.iter().filter(|case| case.name == name.case).flat_map(|case| &case.runs);
            runs.filter(|run| name.names(&run.variant)).map(|run| {
                let diverged = matches!(run.outcome, Outcome::Diverged { .. });
                Ended { name, run, status: diverged.then_some(Status::NotReproduced) }
            })
        };
        let ended: Vec<Ended<'r>> = element.runs.iter().flat_map(of_run).collect();
        let status = match &element.not_covered {
            Some(_) => Status::NotCovered,
            None if element.metrics.is_empty() && element.runs.is_empty() => Status::Reproduced,
            None => Self::computed(element, &shown, &ended),
        };
        let trials = Self::tried(&shown, cases);
        let accepts: Vec<_> =
            trials.iter().filter(|tried| tried.is_meant && tried.stands).map(|tried| tried.control).collect();
        let falls = trials.iter().any(|tried| !tried.stands);
        let is_shown = accepts.is_empty() && (falls || shown.is_empty());
        let status = if status == Status::Reproduced && !is_shown { Status::NotShown } else { status };
        Self { element, status, shown, ended, accepts, falls }
    }

    /// The controls that have values of what the element names, with what it says of them.
    fn tried(shown: &[Shown<'r>], cases: &'r [CaseReport]) -> Vec<Tried<'r>> {
        let mut trials = Vec::new();
        for case in cases {
            let own: Vec<&Shown<'r>> = shown.iter().filter(|shown| shown.name.case == case.name).collect();
            for trial in &case.controls {
                let found = |shown: &&&Shown<'r>| {
                    trial.found(&shown.metric.name, &shown.metric.variant).filter(|found| !trial.is_lost(found))
                };
                let tried: Vec<&&Shown<'r>> = own.iter().filter(|shown| found(shown).is_some()).collect();
                // an error that leaves every value as it is says nothing of the statement
                let moves = |shown: &&&Shown<'r>| {
                    let right = shown.metric.value;
                    found(shown).is_some_and(|found| (found.value - right).abs() > 1e-9 * right.abs())
                };
                let stands = |shown: &&&Shown<'r>| {
                    let status =
                        found(shown).and_then(|found| Status::of_value(shown.name, found.value, found.verdict?));
                    status == Some(Status::Reproduced)
                };
                if tried.iter().any(moves) {
                    trials.push(Tried {
                        control: (case.name.as_str(), trial.control.name.as_str()),
                        is_meant: tried.iter().any(|shown| trial.control.is_named_by(&shown.metric.name)),
                        stands: tried.iter().all(stands),
                    });
                }
            }
        }
        trials
    }

    /// The worst of all that the element names; where none of it is bad and some of it is not run, or not judged, at this tier, that
    /// is what is said: half of a statement does not reproduce it.
    fn computed(element: &Element, shown: &[Shown<'_>], ended: &[Ended<'_>]) -> Status {
        let judged = shown.iter().filter_map(|shown| shown.status).chain(ended.iter().filter_map(|ended| ended.status));
        let is_judged = |name: &MetricName| shown.iter().any(|shown| shown.name == name && shown.status.is_some());
        let is_whole = element.metrics.iter().all(is_judged);
        match judged.min() {
            Some(Status::Reproduced) | None if !is_whole => Status::NotCovered,
            Some(worst) => worst,
            None => Status::NotCovered,
        }
    }

    /// Whether tests alone hold it: nothing of it is computed in a report.
    pub fn rests_on_tests(&self) -> bool {
        self.status == Status::Reproduced && self.shown.is_empty() && self.ended.is_empty()
    }
}

/// Summary of a paper: the status of each of its elements.
#[derive(Debug, Clone)]
pub struct PaperSummary<'r> {
    /// The paper.
    pub paper: &'r Paper,
    /// Elements in order.
    pub elements: Vec<ElementOutcome<'r>>,
}

impl<'r> PaperSummary<'r> {
    /// Status of every element of a paper, from the metrics of these cases.
    pub fn of(paper: &'r Paper, cases: &'r [CaseReport]) -> Self {
        Self { paper, elements: paper.elements.iter().map(|element| ElementOutcome::of(element, cases)).collect() }
    }

    /// Number of elements with this status.
    pub fn count(&self, status: Status) -> usize {
        self.elements.iter().filter(|fate| fate.status == status).count()
    }
}

/// Papers with elements that name at least one of the cases.
pub fn accounted(cases: &[CaseReport]) -> &'static [Paper] {
    let is_named = |case: &CaseReport| {
        let elements = PAPERS.iter().flat_map(|paper| &paper.elements);
        elements.flat_map(|element| &element.metrics).any(|name| name.case == case.name)
    };
    if cases.iter().any(is_named) { &PAPERS } else { &[] }
}

#[cfg(test)]
#[path = "papers_tests.rs"]
mod tests;
