//! A metric: one number that a case is judged by, with what it is judged against.

mod quantity;
mod regime;
mod steadiness;
mod uncertainty;
pub mod variant;

pub use quantity::Quantity;
pub use quantity::quantities;
pub use regime::{FlowRegime, PredictionInterval, REGIME_NUMBERS};
pub use steadiness::unsteadiness;
pub use uncertainty::{ComparisonPart, Origin, Uncertainty, UncertaintyComponent};
pub use variant::{Value, Variant};

use serde::{Deserialize, Serialize};

/// Kind of reference that a verdict rests on; the four are never mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, Default)]
#[serde(rename_all = "snake_case")]
pub enum MetricKind {
    /// The run's own account: nothing is lost, and mass, momentum and energy add up. It says nothing of the physics.
    Bookkeeping,
    /// Against an exact solution of the model's own equations, or a convergence order.
    #[default]
    Verification,
    /// Against an experiment, a published fit or other people's simulations.
    Validation,
    /// Against a sentence, a figure or a number of one of the two papers that the models come from.
    Statement,
}

/// The outcome of a gate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The gate holds.
    Pass,
    /// The gate does not hold.
    Fail,
    /// There is no gate: the value is reported only.
    Observed,
}

impl Verdict {
    /// Word in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Observed => "observed",
        }
    }

    /// Confidence with this name; `None` for an unknown name.
    pub fn of_word(word: &str) -> Option<Self> {
        [Self::Pass, Self::Fail, Self::Observed].into_iter().find(|own| own.word() == word)
    }
}

/// Confidence in a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Confidence {
    /// Exact for the model.
    Exact,
    /// Read in two or more independent documents.
    High,
    /// Read in one document that quotes the original.
    Medium,
    /// Sources conflict.
    Low,
    /// Known in the field, no document at hand; never gates.
    Unverified,
}

impl Confidence {
    /// Confidences that a file may state for its values.
    pub const STATED: &'static str = "high, medium, low, unverified";

    /// Confidence of one of those words.
    pub fn stated(word: &str) -> Option<Self> {
        let all = [Self::High, Self::Medium, Self::Low, Self::Unverified];
        Self::STATED.split(", ").zip(all).find(|(known, _)| *known == word).map(|(_, own)| own)
    }
}

/// The rule of a gate, in the metric's unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// value ≤ bound.
    AtMost(f64),
    /// value ≥ bound.
    AtLeast(f64),
    /// lower ≤ value ≤ upper.
    Within(f64, f64),
}

impl Limit {
    /// Whether `value` respects the limit. What is not a finite number never does, and a bound that is not one holds
    /// nothing: both say that something was not measured or not known.
    pub fn holds(self, value: f64) -> bool {
        let (lower, upper) = match self {
            Self::AtMost(bound) => (f64::MIN, bound),
            Self::AtLeast(bound) => (bound, f64::MAX),
            Self::Within(lower, upper) => (lower, upper),
        };
        lower.is_finite() && upper.is_finite() && (lower..=upper).contains(&value)
    }

    /// The rule, with its bounds as `digits` writes them: `≤ 0.7`, `0.5 … 2`.
    pub fn in_words(self, digits: impl Fn(f64) -> String) -> String {
        match self {
            Self::AtMost(bound) => format!("≤ {}", digits(bound)),
            Self::AtLeast(bound) => format!("≥ {}", digits(bound)),
            Self::Within(lower, upper) => format!("{} … {}", digits(lower), digits(upper)),
        }
    }

    /// Distance of `value` to the nearest bound, in the metric's unit; negative where the limit is broken.
    pub fn margin(self, value: f64) -> f64 {
        match self {
            Self::AtMost(bound) => bound - value,
            Self::AtLeast(bound) => value - bound,
            Self::Within(lower, upper) => (value - lower).min(upper - value),
        }
    }

    /// Size of the bound or half the distance of both, in the metric's unit.
    pub fn half_width(self) -> f64 {
        match self {
            Self::AtMost(bound) | Self::AtLeast(bound) => bound.abs(),
            Self::Within(lower, upper) => 0.5 * (upper - lower),
        }
    }
}

/// Owner of a gate. The order is that of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GateOwner {
    /// The user: a check of a study, or measurements with a limit.
    User,
    /// The case.
    #[default]
    Case,
}

/// A gate: the limit and the reason why it is where it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Gate {
    /// Limit that the value must keep.
    pub limit: Limit,
    /// Reason for the value of the limit, one sentence.
    pub reason: String,
    /// Owner of the gate.
    #[serde(default)]
    pub owner: GateOwner,
    /// Half width in the metric's unit where scatter alone sets it, of repetitions or of a measurement; none for a limit
    /// that has another reason.
    pub statistical: Option<f64>,
}

/// Reference that a value is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// The reference's value in the metric's unit, where it is a number.
    pub value: Option<f64>,
    /// Source of the reference: equation, paper or solver.
    pub source: String,
    /// Confidence in the reference.
    pub confidence: Confidence,
}

/// Reason for which a metric of a diverged run has no value.
pub const DIVERGED: &str = "its run diverged, so that no number of it means anything";

/// Standard uncertainties that an expanded one has, for 95 % `[-]`.
pub const COVERAGE: f64 = 2.0;

/// One judged or observed number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[must_use]
pub struct Metric {
    /// Stable snake_case name, such as `velocity_l2`.
    pub name: String,
    /// Run or runs that the metric is of; empty if the case has a single run.
    pub variant: Variant,
    /// Value of the metric in its unit.
    pub value: f64,
    /// Unit, `-` for none, `%` for percent.
    pub unit: String,
    /// Reference that the value is compared with, if any.
    pub reference: Option<Reference>,
    /// Kind of reference that the verdict rests on.
    pub kind: MetricKind,
    /// The gate, if there is one; a metric without a gate is observed.
    pub gate: Option<Gate>,
    /// Whether a page opens with it, right behind what fails: what its reader asked for, where nothing judges it.
    #[serde(default)]
    pub leads: bool,
    /// Reason why the metric has no value, or the part of a run that its value leaves out.
    pub remark: Option<String>,
    /// Uncertainty of value and reference, as far as it is known.
    #[serde(default)]
    pub uncertainty: Uncertainty,
    /// 95 % prediction interval of the true value, from the errors of comparable predictions; none without such
    /// comparisons.
    pub prediction: Option<PredictionInterval>,
    /// Relative tolerance of the baseline: how far the value may move before a change is reported `[-]`.
    pub snapshot_tolerance: f64,
    /// Absolute floor of that tolerance, in the metric's unit: the value's own noise.
    pub snapshot_floor: f64,
}

impl Metric {
    /// An observed verification metric; the `with_…` methods and fields refine it.
    pub fn observed(name: &str, variant: &Variant, value: f64, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            variant: variant.clone(),
            value,
            unit: unit.to_owned(),
            snapshot_tolerance: 1e-6,
            ..Self::default()
        }
    }

    /// Adds a gate with its reason.
    pub fn gated(mut self, limit: Limit, reason: &str) -> Self {
        self.gate = Some(Gate { limit, reason: reason.to_owned(), owner: GateOwner::Case, statistical: None });
        self
    }

    /// Says that its gate, if it has one, is as wide as scatter alone makes it: half its width, in the metric's unit. Where the
    /// spacing is known to move the value by more, the gate does not judge it.
    pub fn as_wide_as_scatter(mut self, half_width: Option<f64>) -> Self {
        if let Some(gate) = &mut self.gate {
            gate.statistical = half_width;
        }
        self
    }

    /// Whether the spacing may move the value, twice its standard uncertainty, by more than the scatter that its gate is as
    /// wide as: the gate then says nothing of the physics.
    pub fn is_coarser_than_gate(&self) -> bool {
        let width = self.gate.as_ref().and_then(|gate| gate.statistical);
        width.zip(self.uncertainty.of(&[Origin::Numerical])).is_some_and(|(width, spacing)| COVERAGE * spacing > width)
    }

    /// Marks its gate, if it has one, as stated by the user.
    pub fn of_user(mut self) -> Self {
        if let Some(gate) = &mut self.gate {
            gate.owner = GateOwner::User;
        }
        self
    }

    /// Owner of the metric's gate; the case if it has no gate.
    pub fn gate_owner(&self) -> GateOwner {
        self.gate.as_ref().map_or(GateOwner::Case, |gate| gate.owner)
    }

    /// Adds a gate where there is a limit; else it stays observed.
    pub fn gated_by(self, limit: Option<Limit>, reason: &str) -> Self {
        if let Some(limit) = limit { self.gated(limit, reason) } else { self }
    }

    /// Adds a reference.
    pub fn against(mut self, value: Option<f64>, source: &str, confidence: Confidence) -> Self {
        self.reference = Some(Reference { value, source: source.to_owned(), confidence });
        self
    }

    /// Adds a reference that is exact for the model: what its equations, a conservation law or its definition give.
    pub fn exactly(self, value: f64, source: &str) -> Self {
        self.against(Some(value), source, Confidence::Exact)
    }

    /// Adds a standard uncertainty of value or reference, in the metric's unit, with the sentence that explains it. An unknown
    /// uncertainty, or one that is not positive, adds nothing.
    pub fn known_to(mut self, origin: Origin, standard: Option<f64>, source: &str) -> Self {
        self.uncertainty.add(origin, standard, source);
        self
    }

    /// The reference's value where the metric is a comparison with something from outside: a measurement, a published fit or
    /// another's simulation, whose number is known and verified.
    pub fn compared_with(&self) -> Option<f64> {
        let reference = self.reference.as_ref().filter(|_| self.kind == MetricKind::Validation)?;
        let is_from_outside = !matches!(reference.confidence, Confidence::Exact | Confidence::Unverified);
        reference.value.filter(|value| is_from_outside && value.is_finite())
    }

    /// Adds the interval of the true value, if it is known.
    pub fn predicted(self, prediction: Option<PredictionInterval>) -> Self {
        Self { prediction, ..self }
    }

    /// Puts the metric at the top of its page.
    pub fn leading(mut self) -> Self {
        self.leads = true;
        self
    }

    /// Adds all that is known of the uncertainty of a metric that this one is read from.
    pub fn known_as(mut self, other: &Uncertainty) -> Self {
        for part in other.parts() {
            self.uncertainty.add(part.origin, Some(part.standard), &part.source);
        }
        self
    }

    /// Removes the value if the run is not steady, with the reason; a gate then fails.
    pub fn unless(mut self, not_steady: Option<&String>) -> Self {
        if let Some(reason) = not_steady {
            (self.value, self.remark) = (f64::NAN, Some(reason.clone()));
        }
        self
    }

    /// Adds the reason of a missing value, or the part of a run that the value omits.
    pub fn remarked(self, remark: Option<String>) -> Self {
        Self { remark, ..self }
    }

    /// Reason for a missing value, where one is known; none beside a value.
    pub fn reason_of_absence(&self) -> Option<&String> {
        self.remark.as_ref().filter(|_| self.value.is_nan())
    }

    /// Reason for a missing value, in a word or two.
    pub fn without_value(&self) -> Option<&'static str> {
        let reason = self.reason_of_absence()?;
        Some(match reason.as_str() {
            DIVERGED => "diverged",
            reason if reason.starts_with("not steady") => "not steady",
            _ => "no value",
        })
    }

    /// Sets what the verdict rests on.
    pub fn of_kind(mut self, kind: MetricKind) -> Self {
        self.kind = kind;
        self
    }

    /// Sets the baseline's relative tolerance `[-]` and absolute floor (metric's unit).
    pub fn with_snapshot_tolerance(mut self, relative: f64, floor: f64) -> Self {
        self.snapshot_tolerance = relative;
        // what has no value has no scatter either, and JSON has no word for it
        self.snapshot_floor = if floor.is_finite() { floor } else { 0.0 };
        self
    }

    /// The gate's outcome. An unverified reference never gates, nor does a width of scatter that the spacing exceeds.
    pub fn verdict(&self) -> Verdict {
        let unverified =
            self.reference.as_ref().is_some_and(|reference| reference.confidence == Confidence::Unverified);
        let judging = self.gate.as_ref().filter(|_| !unverified && !self.is_coarser_than_gate());
        match judging.map(|gate| gate.limit.holds(self.value)) {
            Some(true) => Verdict::Pass,
            Some(false) => Verdict::Fail,
            None => Verdict::Observed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BROKEN: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    #[test]
    fn nan_fails_every_gate() {
        let limits = [Limit::AtMost(1.0), Limit::AtLeast(-1.0), Limit::Within(-1.0, 1.0)];
        for limit in limits {
            assert!(limit.holds(0.0), "{limit:?}");
            for value in BROKEN {
                assert!(!limit.holds(value), "{limit:?} holds {value}");
                let metric = Metric::observed("front", &Variant::default(), value, "m").gated(limit, "a reason");
                assert_eq!(metric.verdict(), Verdict::Fail);
            }
        }
    }

    #[test]
    fn a_width_of_scatter_does_not_judge_what_the_spacing_moves_by_more() {
        let metric = |spacing: Option<f64>| {
            Metric::observed("run_out", &Variant::default(), 1.3, "-")
                .gated(Limit::Within(0.8, 1.2), "twice the scatter")
                .as_wide_as_scatter(Some(0.2))
                .known_to(Origin::Repeat, Some(0.5), "five seeds")
                .known_to(Origin::Numerical, spacing, "a study")
        };
        assert_eq!(metric(None).verdict(), Verdict::Fail);
        assert_eq!(metric(Some(0.09)).verdict(), Verdict::Fail);
        assert_eq!(metric(Some(0.11)).verdict(), Verdict::Observed);
        // a limit of physics holds for every spacing
        assert_eq!(metric(Some(0.11)).as_wide_as_scatter(None).verdict(), Verdict::Fail);
    }

    #[test]
    fn a_metric_is_read_back_from_the_binary_form_that_trials_leave() {
        let prediction = PredictionInterval {
            lower: 0.4,
            upper: 0.6,
            comparisons: 12,
            input_uncertainty: None,
            unit_length: None,
            quantity: "front".to_owned(),
            regime: FlowRegime::default(),
            warnings: Vec::new(),
        };
        for reason in [None, Some("not steady: it rises".to_owned())] {
            let mut metric = Metric::observed("front", &Variant::default(), 0.5, "m").unless(reason.as_ref());
            metric.prediction = reason.is_none().then(|| prediction.clone());
            let bytes = postcard::to_allocvec(&metric).expect("plain data");
            let read: Metric = postcard::from_bytes(&bytes).expect("the same");
            assert_eq!((read.name, read.remark, read.prediction), (metric.name, reason, metric.prediction));
        }
    }

    #[test]
    fn a_gate_without_finite_edges_holds_nothing() {
        for edge in BROKEN {
            for limit in [
                Limit::AtMost(edge),
                Limit::AtLeast(edge),
                Limit::Within(edge, 1.0),
                Limit::Within(-1.0, edge),
                Limit::Within(edge, edge),
            ] {
                assert!(!limit.holds(0.0), "{limit:?}");
            }
        }
    }
}
