//! Digests of the gates that a submission was made for.

use super::Submission;
use crate::metric::Metric;
use crate::result::gates_digest;

/// Digits of the digest of one limit.
const DIGITS: usize = 4;

/// Digest of the gates of metrics, and those of their limits, separated by blanks.
pub(super) fn digests(metrics: &[Metric]) -> (String, String) {
    let gated = metrics.iter().filter(|metric| metric.gate.is_some());
    let limits: Vec<String> = gated.map(|metric| gates_digest([metric])[..DIGITS].to_owned()).collect();
    (gates_digest(metrics), limits.join(" "))
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
