//! Digests of the gates that a submission was made for.

use super::Submission;
use crate::case::{AnyCase, Changes, ParameterError, Tier};
use crate::metric::Metric;
use crate::result::gates_digest;

/// Digits of the digest of one limit.
const DIGITS: usize = 4;

/// Digest of the gates of a case at a tier, and those of its limits, separated by blanks; empty for a case without limits before a run.
///
/// # Errors
/// A tier whose parameters the case refuses, which no case does.
pub(super) fn gates_of(case: &'static dyn AnyCase, tier: Tier) -> Result<(String, String), ParameterError> {
    Ok(digests(&case.prepare(tier, &Changes::default())?.asked().metrics))
}

fn digests(metrics: &[Metric]) -> (String, String) {
    let gated: Vec<&Metric> = metrics.iter().filter(|metric| metric.gate.is_some()).collect();
    let limits: Vec<String> = gated.iter().map(|metric| gates_digest([*metric])[..DIGITS].to_owned()).collect();
    if gated.is_empty() { Default::default() } else { (gates_digest(gated), limits.join(" ")) }
}

/// Notice of a submission that was made for other gates than today's.
pub(super) fn notice(submission: &Submission, (today, limits): &(String, String)) -> Option<String> {
    let made = submission.gates.as_ref().filter(|made| *made != today)?;
    let (then, now): (Vec<&str>, Vec<&str>) = (submission.limits.split(' ').collect(), limits.split(' ').collect());
    let missing = |these: &[&str], those: &[&str]| these.iter().filter(|limit| !those.contains(limit)).count();
    let moved = missing(&now, &then).max(missing(&then, &now));
    let moved = if submission.limits.is_empty() { String::new() } else { format!(": limits of {moved} moved") };
    Some(format!("made for gates {made}, now {today}{moved}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Limit, Variant};

    #[test]
    fn a_moved_limit_is_counted_and_a_moved_value_is_not() {
        let gates = |values: [f64; 2], limits: [f64; 2]| {
            let metric = |name: &str, value, limit| {
                Metric::observed(name, &Variant::default(), value, "%").gated(Limit::AtMost(limit), "a limit")
            };
            digests(&[metric("front", values[0], limits[0]), metric("height", values[1], limits[1])])
        };
        let (digest, limits) = gates([0.1, 0.2], [1.0, 2.0]);
        let text = format!(
            "case = \"film\"\ngates = \"{digest}\"\nlimits = \"{limits}\"\n[code]\nname = \"a\"\n[[run]]\nnumbers.front = 1\n"
        );
        let submission: Submission = toml::from_str(&text).expect("a submission");
        assert_eq!(notice(&submission, &gates([0.3, 0.4], [1.0, 2.0])), None);
        let today = gates([0.1, 0.2], [1.0, 3.0]);
        let expected = format!("made for gates {digest}, now {}: limits of 1 moved", today.0);
        assert_eq!(notice(&submission, &today), Some(expected));
    }
}
