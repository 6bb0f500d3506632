//! A judgement for programs: `metrics.json` and JUnit's XML.

use super::{CodeComparison, JudgedCode, MetricComparison};
use crate::metric::{Metric, Verdict};
use crate::number::with_unit;
use crate::report::Severity;
use crate::report::scatter::{QuantityBias, quantities_of};
use crate::result::gates_digest;
use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};
use serde_json::{Value, json};

/// The word of a verdict in `metrics.json`.
pub(super) fn word(verdict: Option<Verdict>) -> &'static str {
    verdict.map_or("not_judged", Verdict::word)
}

/// Bias and scatter of a code's results against the references, by quantity.
pub(super) fn biases<'a>(case: &str, metrics: impl IntoIterator<Item = &'a Metric>) -> Vec<QuantityBias> {
    quantities_of([(case, metrics.into_iter().collect::<Vec<_>>())])
}

/// Metrics that a code gives.
pub(super) fn given(judged: &JudgedCode) -> impl Iterator<Item = &Metric> {
    judged.metrics.iter().filter_map(|one| one.foreign.as_ref())
}

/// `metrics.json`.
pub(super) fn document(judgement: &CodeComparison) -> Value {
    let case = &judgement.own.name;
    let code = |judged: &JudgedCode| {
        let tally = judged.tally();
        let bias = |bias: &QuantityBias| {
            json!({
                "quantity": bias.quantity,
                "comparisons": bias.found.comparisons,
                "bias": bias.found.bias,
                "bias_interval": bias.found.interval,
                "scatter": bias.found.scatter,
                "model_deviation": bias.found.model_deviation(),
            })
        };
        json!({
            "name": judged.submission.code.name,
            "version": judged.submission.code.version,
            "law": judged.submission.law,
            // null where it was made for today's gates, or does not say
            "moved": judged.moved,
            "tally": tally.by_word(),
            "quantities": biases(case, given(judged)).iter().map(bias).collect::<Vec<_>>(),
            "metrics": judged.metrics.iter().map(entry).collect::<Vec<_>>(),
        })
    };
    json!({
        "case": case,
        "tier": judgement.own.tier,
        "program": env!("CARGO_PKG_VERSION"),
        "inputs": super::inputs::digest(&judgement.own.parameters_toml),
        "gates": gates_digest(&judgement.own.metrics),
        "codes": judgement.codes.iter().map(code).collect::<Vec<_>>(),
    })
}

fn entry(one: &MetricComparison) -> Value {
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    let metric = one.foreign.as_ref().unwrap_or(&one.own);
    let reference = metric.reference.as_ref();
    let gate = metric.gate.as_ref();
    let margin = one.foreign.as_ref().zip(gate).and_then(|(foreign, gate)| finite(gate.limit.margin(foreign.value)));
    json!({
        "name": metric.name,
        "variant": metric.variant,
        "unit": metric.unit,
        "kind": metric.kind,
        // null where the code gave none
        "value": one.foreign.as_ref().and_then(|foreign| finite(foreign.value)),
        "bagnold": finite(one.own.value),
        "reference": reference.and_then(|reference| reference.value),
        "source": reference.map(|reference| &reference.source),
        "confidence": reference.map(|reference| reference.confidence),
        "limit": gate.map(|gate| gate.limit),
        "reason": gate.map(|gate| &gate.reason),
        "margin": margin,
        "verdict": word(one.verdict()),
    })
}

/// A suite for each code, a test for each gate; what was not given is skipped.
pub(super) fn junit(judgement: &CodeComparison) -> String {
    let mut document = quick_junit::Report::new(format!("bagnold judge {}", judgement.own.name));
    for judged in &judgement.codes {
        let name = format!("{} {}", judged.submission.code.name, judged.submission.code.version);
        let mut suite = TestSuite::new(name.trim());
        suite.add_test_cases(judged.metrics.iter().filter_map(|one| {
            let gate = one.foreign.as_ref().unwrap_or(&one.own).gate.as_ref()?;
            let limit = gate.limit.in_words(|bound| with_unit(bound, &one.own.unit));
            let value =
                one.foreign.as_ref().map(|own| format!("{}, limit {limit}", with_unit(own.value, &one.own.unit)));
            let said = value.unwrap_or_else(|| format!("limit {limit}"));
            let status = match one.verdict() {
                Some(Verdict::Pass) => TestCaseStatus::success(),
                Some(Verdict::Fail) => {
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    status.set_type(Severity::NewFailure.word()).set_message(said.as_str());
                    status
                }
                Some(Verdict::Observed) => return None,
                None => {
                    let mut status = TestCaseStatus::skipped();
                    status.set_message("not judged: no value was submitted");
                    status
                }
            };
            let variant = &one.own.variant;
            let test = if variant.is_empty() { one.own.name.clone() } else { format!("{} [{variant}]", one.own.name) };
            let mut test = TestCase::new(test, status);
            test.set_classname(format!("bagnold.{}", judgement.own.name))
                .set_system_out(format!("{said}; {}", gate.reason));
            Some(test)
        }));
        // a page of skipped tests would be green
        let tally = judged.tally();
        if tally.all() == tally.of(Severity::NotJudged) {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
            status.set_type("not judged").set_message("no gate was judged");
            suite.add_test_case(TestCase::new("gates", status));
        }
        document.add_test_suite(suite);
    }
    document.to_string().expect("text that the crate itself has cleaned always serialises")
}
