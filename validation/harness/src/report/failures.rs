//! What fails, in two lines each: metric and variant, then the value beside its limit. Why a known failure fails stands
//! in the metric's row on the page of its case.

use super::judgement::{JudgedCase, JudgedMetric, Severity};
use super::known_failures::KnownFailureStatus;
use super::rows::{note, statement, worst_mark};
use super::view::{BannerItem, VerdictMark, anchor};
use crate::metric::GateOwner;

/// Runs that diverged, then gates: unexpected failures first, the user's own gates before those of the case.
pub(super) fn of(cases: &[JudgedCase<'_>]) -> Vec<BannerItem> {
    let mut items: Vec<((Severity, GateOwner), BannerItem)> = Vec::new();
    for case in cases {
        for &(variant, message) in &case.diverged {
            let item = BannerItem {
                mark: VerdictMark { word: "diverged", ..VerdictMark::FAIL },
                case: case.case.name.clone(),
                anchor: "runs".to_owned(),
                what: "a run diverged".to_owned(),
                variant: variant.to_string(),
                statement: message.to_owned(),
                note: String::new(),
            };
            items.push(((Severity::Failure, GateOwner::User), item));
        }
        for judged in case.metrics.iter().filter(|judged| judged.severity() <= Severity::KnownFailure) {
            let item = BannerItem {
                mark: worst_mark(judged),
                case: case.case.name.clone(),
                anchor: anchor(&case.case.name, &judged.metric.name, &judged.metric.variant),
                what: judged.metric.name.clone(),
                variant: judged.metric.variant.to_string(),
                statement: statement(judged),
                note: short_note(judged),
            };
            items.push(((judged.severity(), judged.metric.gate_owner()), item));
        }
    }
    // Stable: equal ones keep the order of the page.
    items.sort_by_key(|(order, _)| *order);
    items.into_iter().map(|(_, item)| item).collect()
}

/// What the list of known failures says, without its reason.
fn short_note(judged: &JudgedMetric<'_>) -> String {
    let whole = note(judged);
    match &judged.standing {
        KnownFailureStatus::Known(entry) => {
            whole.strip_suffix(&entry.reason).map_or(whole.clone(), |short| short.trim_end_matches(": ").to_owned())
        }
        _ => whole,
    }
}
