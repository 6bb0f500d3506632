//! A judgement for programs: `metrics.json` and JUnit's XML.

use super::{CodeComparison, JudgedCode, MetricComparison};
use crate::case::Tier;
use crate::metric::{Confidence, Limit, Metric, MetricKind, Variant, Verdict};
use crate::report::scatter::{QuantityBias, quantities_of};
use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};
use serde::Serialize;

/// `metrics.json`.
#[derive(Debug, Serialize)]
pub(super) struct Document {
    case: String,
    tier: Tier,
    codes: Vec<CodeDocument>,
}

#[derive(Debug, Serialize)]
struct CodeDocument {
    name: String,
    version: String,
    holding: usize,
    failing: usize,
    not_given: usize,
    quantities: Vec<BiasEntry>,
    metrics: Vec<VerdictEntry>,
}

/// Bias and scatter of a quantity over its comparisons.
#[derive(Debug, Serialize)]
struct BiasEntry {
    quantity: String,
    comparisons: usize,
    bias: f64,
    bias_interval: (f64, f64),
    scatter: f64,
    model_deviation: Option<f64>,
}

#[derive(Debug, Serialize)]
struct VerdictEntry {
    name: String,
    variant: Variant,
    unit: String,
    kind: MetricKind,
    /// The code's value; null where none was given.
    value: Option<f64>,
    /// Ours.
    bagnold: Option<f64>,
    reference: Option<f64>,
    source: Option<String>,
    confidence: Option<Confidence>,
    limit: Option<Limit>,
    reason: Option<String>,
    margin: Option<f64>,
    verdict: &'static str,
}

/// The word of a verdict in `metrics.json`.
pub(super) fn word(verdict: Option<Verdict>) -> &'static str {
    match verdict {
        Some(Verdict::Pass) => "pass",
        Some(Verdict::Fail) => "fail",
        Some(Verdict::Observed) => "observed",
        None => "not_given",
    }
}

/// Bias and scatter of what a code gives.
pub(super) fn biases<'a>(case: &str, metrics: impl IntoIterator<Item = &'a Metric>) -> Vec<QuantityBias> {
    quantities_of([(case, metrics.into_iter().collect::<Vec<_>>())])
}

/// What was given of a code.
pub(super) fn given(judged: &JudgedCode) -> impl Iterator<Item = &Metric> {
    judged.metrics.iter().filter_map(|one| one.foreign.as_ref())
}

pub(super) fn document(judgement: &CodeComparison) -> Document {
    let case = judgement.own.name.clone();
    let code = |judged: &JudgedCode| {
        let (holding, failing, not_given) = judged.counts();
        let bias = |bias: QuantityBias| BiasEntry {
            quantity: bias.quantity,
            comparisons: bias.found.comparisons,
            bias: bias.found.bias,
            bias_interval: bias.found.interval,
            scatter: bias.found.scatter,
            model_deviation: bias.found.model_deviation(),
        };
        CodeDocument {
            name: judged.code.name.clone(),
            version: judged.code.version.clone(),
            holding,
            failing,
            not_given,
            quantities: biases(&case, given(judged)).into_iter().map(bias).collect(),
            metrics: judged.metrics.iter().map(entry).collect(),
        }
    };
    Document { case: case.clone(), tier: judgement.own.tier, codes: judgement.codes.iter().map(code).collect() }
}

fn entry(one: &MetricComparison) -> VerdictEntry {
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    let metric = one.foreign.as_ref().unwrap_or(&one.own);
    let reference = metric.reference.as_ref();
    let gate = metric.gate.as_ref();
    VerdictEntry {
        name: metric.name.clone(),
        variant: metric.variant.clone(),
        unit: metric.unit.clone(),
        kind: metric.kind,
        value: one.foreign.as_ref().and_then(|foreign| finite(foreign.value)),
        bagnold: finite(one.own.value),
        reference: reference.and_then(|reference| reference.value),
        source: reference.map(|reference| reference.source.clone()),
        confidence: reference.map(|reference| reference.confidence),
        limit: gate.map(|gate| gate.limit),
        reason: gate.map(|gate| gate.reason.clone()),
        margin: one.foreign.as_ref().zip(gate).and_then(|(foreign, gate)| finite(gate.limit.margin(foreign.value))),
        verdict: word(one.verdict()),
    }
}

/// A suite for each code, a test for each gate; what was not given is skipped.
pub(super) fn junit(judgement: &CodeComparison) -> String {
    let mut document = quick_junit::Report::new(format!("bagnold judge {}", judgement.own.name));
    for judged in &judgement.codes {
        let name = format!("{} {}", judged.code.name, judged.code.version);
        let mut suite = TestSuite::new(name.trim());
        suite.add_test_cases(judged.metrics.iter().filter_map(|one| {
            let gate = one.foreign.as_ref().unwrap_or(&one.own).gate.as_ref()?;
            let status = match one.verdict() {
                Some(Verdict::Pass) => TestCaseStatus::success(),
                Some(Verdict::Fail) => {
                    let value = one.foreign.as_ref().map_or(f64::NAN, |foreign| foreign.value);
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    status.set_type("gate").set_message(format!("{value} {}, limit {:?}", one.own.unit, gate.limit));
                    status
                }
                Some(Verdict::Observed) => return None,
                None => {
                    let mut status = TestCaseStatus::skipped();
                    status.set_message("not given");
                    status
                }
            };
            let variant = &one.own.variant;
            let test = if variant.is_empty() { one.own.name.clone() } else { format!("{} [{variant}]", one.own.name) };
            let mut test = TestCase::new(test, status);
            test.set_classname(format!("bagnold.{}", judgement.own.name)).set_system_out(gate.reason.clone());
            Some(test)
        }));
        document.add_test_suite(suite);
    }
    document.to_string().expect("text that the crate itself has cleaned always serialises")
}
