//! One case at one tier: simulated or taken from the store, then judged.

use crate::physics::expected_failures::{self, owing_tier};
use crate::structure::words::{LONGEST_CAPTION, LONGEST_REASON, words};
use bagnold_harness::case::{CaseResult, Changes, Silent, Tier, execute};
use bagnold_harness::metric::{Limit, Metric, Verdict};
use bagnold_harness::observation::Outcome;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_report::{ExpectedFailures, ListStatus};
use bagnold_validation::REGISTRY;
use std::sync::{Mutex, PoisonError};

/// A case already uses every core; two at a time would only disturb each other.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Results of a case, simulated or from the store: no two tests simulate the same runs.
pub(crate) fn results(case: &str, tier: Tier) -> Vec<CaseResult> {
    let prepared = REGISTRY
        .find(case)
        .and_then(|case| case.prepare(tier, &Changes::default()))
        .unwrap_or_else(|error| panic!("{case}: {error}"));
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent);
    results.unwrap_or_else(|error| panic!("{case}: {error}"))
}

/// Fails with one line for each thing that is wrong with a case.
pub(crate) fn assert_gates(case: &str, tier: Tier) {
    let list = expected_failures::read();
    for result in results(case, tier) {
        assert!(result.metrics.iter().any(|metric| metric.verdict() != Verdict::Observed), "{case} has no gate");
        let complaints = complaints(&result, &list, tier);
        assert!(
            complaints.is_empty(),
            "{case}, {tier} tier: {} of {} metrics or runs are not as they should be\n{}",
            complaints.len(),
            result.metrics.len() + result.runs.len(),
            complaints.join("\n")
        );
    }
}

/// Complaints about a result, a line each: diverged runs, failed gates, contradictions of the list of expected failures.
pub(crate) fn complaints(result: &CaseResult, list: &ExpectedFailures, tier: Tier) -> Vec<String> {
    let diverged = result.unexpected_divergences().map(|run| match &run.outcome {
        Outcome::Diverged { message, .. } => format!("  [{}] {message}", run.variant),
        outcome => format!("  [{}] counts as diverged, but ended as {outcome:?}", run.variant),
    });
    let gates = result.metrics.iter().filter_map(|metric| complaint(metric, &list.status(&result.name, metric)));
    let references = result.metrics.iter().filter_map(excluded_reference);
    let reasons = result.metrics.iter().filter_map(long_reason);
    let captions = result.figures.iter().map(|figure| (&figure.name, &figure.caption));
    let captions = captions.chain(result.animations.iter().map(|moving| (&moving.name, &moving.caption)));
    let long = captions.filter(|(_, caption)| words(caption) > LONGEST_CAPTION);
    let captions = long.map(|(name, caption)| format!("  {name}: a caption of {} words: {caption}", words(caption)));
    let stale = list
        .failures
        .iter()
        .filter(|entry| entry.case == result.name && owing_tier(entry) == Some(tier))
        .filter(|entry| {
            !result.metrics.iter().any(|metric| metric.name == entry.metric && metric.variant == entry.variant)
        })
        .map(|entry| {
            format!(
                "  {} [{}] is an expected failure, but is not measured: remove the entry",
                entry.metric, entry.variant
            )
        });
    diverged.chain(gates).chain(references).chain(reasons).chain(captions).chain(stale).collect()
}

/// A gate that the value it is compared with would not pass: no band may lie beside its own reference.
fn excluded_reference(metric: &Metric) -> Option<String> {
    let (gate, value) = (metric.gate.as_ref()?, metric.reference.as_ref()?.value?);
    let limit = gate.limit;
    (!limit.holds(value)).then(|| {
        format!(
            "  {} [{}]: its reference, {value}, lies outside of its own limit, {}",
            metric.name,
            metric.variant,
            rule(limit)
        )
    })
}

/// A gate whose reason a reader in a hurry does not read.
fn long_reason(metric: &Metric) -> Option<String> {
    let reason = &metric.gate.as_ref()?.reason;
    let number = words(reason);
    (number > LONGEST_REASON)
        .then(|| format!("  {} [{}]: a reason of {number} words: {reason}", metric.name, metric.variant))
}

fn complaint(metric: &Metric, listed: &ListStatus) -> Option<String> {
    let why = match listed {
        ListStatus::Unlisted if metric.verdict() == Verdict::Fail => "the gate fails".to_owned(),
        ListStatus::Unlisted | ListStatus::AsListed(_) => return None,
        ListStatus::PassesAgain(entry) => {
            format!("an expected failure since {} now passes: remove the entry", entry.date)
        }
        ListStatus::Worse(entry) => {
            format!("an expected failure became worse than its best value {:e}", entry.best_value)
        }
        ListStatus::WithoutGate(_) => "an expected failure, but the metric has no gate: remove the entry".to_owned(),
    };
    let Metric { name, variant, value, unit, .. } = metric;
    let limit = metric.gate.as_ref().map_or_else(String::new, |gate| {
        format!(", limit {} {unit}, margin {:.4e} {unit}", rule(gate.limit), gate.limit.margin(*value))
    });
    Some(format!("  {name} [{variant}] = {value:.6e} {unit}{limit}: {why}"))
}

fn rule(limit: Limit) -> String {
    match limit {
        Limit::AtMost(bound) => format!("≤ {bound}"),
        Limit::AtLeast(bound) => format!("≥ {bound}"),
        Limit::Within(lower, upper) => format!("{lower} … {upper}"),
    }
}
