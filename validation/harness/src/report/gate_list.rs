//! The list of gates, `tests/snapshots/gates/TIER.txt`: every gate that a tier has ever had, a line each. A gate that is no longer
//! judged stays in the list, and the CHANGELOG has to say why it went: a limit cannot be lost in a change of something else.

use super::accepted::{Baseline, MetricKey, tier_name};
use super::error::{BaselineError, read_if_there};
use crate::case::Tier;
use crate::input::DOCUMENT;
use crate::metric::Variant;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Beginning of a bullet of the CHANGELOG that names gates. The gates follow in backquotes, as `CASE METRIC` for all of
/// a metric's or `CASE METRIC [VARIANT]` for those of some runs.
const REMOVED: &str = "- Gates removed:";

const HEAD: &str = "# Every gate that this tier has ever had: case | metric | variant. `bagnold report --accept` adds to it. No line is taken\n\
    # away: a gate that went is named in the CHANGELOG, in a bullet that begins with `- Gates removed:`.\n";

/// The gates of a tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GateList {
    gates: BTreeSet<MetricKey>,
}

impl GateList {
    /// The file of a tier in the folder of all accepted values.
    #[must_use]
    pub fn path(folder: &Path, tier: Tier) -> PathBuf {
        folder.join("gates").join(format!("{}.txt", tier_name(tier)))
    }

    /// Reads the list of a tier; a missing file is an empty list.
    ///
    /// # Errors
    /// If the file is there but cannot be read, or a line of it is no gate.
    pub fn read(folder: &Path, tier: Tier) -> Result<Self, BaselineError> {
        let path = Self::path(folder, tier);
        let Some(text) = read_if_there(&path, DOCUMENT)? else { return Ok(Self::default()) };
        let mut list = Self::default();
        for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.starts_with('#')) {
            let message = || format!("line {} is {line:?} instead of `case | metric | variant`", index + 1);
            let gate = gate(line).ok_or_else(|| BaselineError::Content { path: path.clone(), message: message() })?;
            list.gates.insert(gate);
        }
        Ok(list)
    }

    /// Adds the gates among accepted values.
    pub fn add(&mut self, accepted: &Baseline) {
        self.gates.extend(accepted.gates().cloned());
    }

    /// Writes the list, sorted.
    ///
    /// # Errors
    /// If the folder or file cannot be written.
    pub fn write(&self, folder: &Path, tier: Tier) -> Result<(), BaselineError> {
        let path = Self::path(folder, tier);
        let text = self.gates.iter().fold(HEAD.to_owned(), |text, MetricKey { case, metric, variant }| {
            text + &format!("{case} | {metric} | {variant}\n")
        });
        let write = || {
            std::fs::create_dir_all(path.parent().unwrap_or(folder))?;
            std::fs::write(&path, text)
        };
        write().map_err(|source| BaselineError::Write { path: path.clone(), source })
    }

    /// Contradictions between the list, the gates among all accepted values of the tier and the CHANGELOG, a line each:
    /// gates that went without a word, and gates that are not in the list.
    #[must_use]
    pub fn differences(&self, accepted: &Baseline, changelog: &str) -> Vec<String> {
        let now: BTreeSet<&MetricKey> = accepted.gates().collect();
        let removed = removed(changelog);
        let is_explained = |gate: &MetricKey| removed.iter().any(|removed| removed.names(gate));
        let name = |gate: &MetricKey| format!("{} {} [{}]", gate.case, gate.metric, gate.variant);
        let gone = self.gates.iter().filter(|gate| !now.contains(gate) && !is_explained(gate));
        let gone = gone.map(|gate| {
            format!(
                "{} is no longer judged: restore the gate, or say in CHANGELOG.md why it went (`{REMOVED} ...`)",
                name(gate)
            )
        });
        let new = now.iter().filter(|gate| !self.gates.contains(**gate));
        let new =
            new.map(|gate| format!("{} is not in the list of gates: `bagnold report --accept` adds it", name(gate)));
        gone.chain(new).collect()
    }
}

fn gate(line: &str) -> Option<MetricKey> {
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    let &[case, metric, variant] = cells.as_slice() else { return None };
    Some(MetricKey { case: case.to_owned(), metric: metric.to_owned(), variant: variant.parse().ok()? })
}

/// Gates that the CHANGELOG says went.
#[derive(Debug, PartialEq)]
struct RemovedGates {
    case: String,
    metric: String,
    /// Keys and values that the variants of all these gates contain.
    variant: Variant,
}

impl RemovedGates {
    fn parse(text: &str) -> Option<Self> {
        let (case, rest) = text.split_once(' ')?;
        let (metric, variant) = rest.split_once(" [").unwrap_or((rest, "]"));
        let variant = variant.strip_suffix(']')?.parse().ok()?;
        Some(Self { case: case.to_owned(), metric: metric.to_owned(), variant })
    }

    fn names(&self, gate: &MetricKey) -> bool {
        let has_all = self.variant.parts().all(|(key, value)| gate.variant.get(key) == Some(value));
        (&self.case, &self.metric) == (&gate.case, &gate.metric) && has_all
    }
}

/// The gates that the bullets of the CHANGELOG name, continued lines included.
fn removed(changelog: &str) -> Vec<RemovedGates> {
    let mut found = Vec::new();
    let mut within = false;
    for line in changelog.lines() {
        within = line.starts_with(REMOVED) || (within && line.starts_with("  "));
        if within {
            found.extend(line.split('`').skip(1).step_by(2).filter_map(RemovedGates::parse));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Limit, Metric};

    fn metric(name: &str, variant: &str) -> Metric {
        Metric::observed(name, &variant.parse().expect("a variant"), 0.5, "-").gated(Limit::AtMost(1.0), "a reason")
    }

    fn accepted(metrics: &[Metric]) -> Baseline {
        Baseline::of("film", metrics)
    }

    #[test]
    fn a_gate_that_goes_without_a_word_is_found() {
        let (one, other) =
            (metric("flux", "fluid=water,resolution=20"), metric("velocity", "fluid=water,resolution=20"));
        let mut list = GateList::default();
        list.add(&accepted(&[one.clone(), other.clone()]));
        assert_eq!(list.differences(&accepted(&[one.clone(), other.clone()]), ""), [""; 0]);

        // a metric that vanishes, one that keeps its value and loses its limit, and one whose reference loses its confidence
        let unverified = other.clone().against(None, "a source", crate::metric::Confidence::Unverified);
        for without in
            [vec![one.clone()], vec![one.clone(), Metric { gate: None, ..other }], vec![one.clone(), unverified]]
        {
            let lost = |changelog: &str| list.differences(&accepted(&without), changelog);
            let said = lost(
                "- Gates removed: `film flux`, no longer of use\n  `other velocity`, `film velocity [fluid=honey]`\n",
            );
            assert!(
                said.len() == 1 && said[0].starts_with("film velocity [fluid=water,resolution=20] is no longer judged"),
                "{said:?}"
            );
            assert_eq!(lost("- Other.\n  `film velocity`\n").len(), 1, "another bullet names no gates");
            assert_eq!(lost("- Gates removed: it was\n  `film velocity [resolution=20]`\n"), [""; 0]);
            assert_eq!(lost("- Gates removed: `film velocity`: it was wrong\n"), [""; 0]);
        }
        let new = list
            .differences(&accepted(&[one, metric("velocity", "fluid=water,resolution=20"), metric("drift", "")]), "");
        assert!(new.len() == 1 && new[0].starts_with("film drift [] is not in the list"), "{new:?}");
    }

    #[test]
    fn a_list_is_read_back_and_keeps_what_went() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut list = GateList::read(folder.path(), Tier::Quick).expect("nothing there");
        list.add(&accepted(&[metric("flux", "fluid=water"), metric("drift", "")]));
        list.write(folder.path(), Tier::Quick).expect("written");
        let mut read = GateList::read(folder.path(), Tier::Quick).expect("readable");
        assert_eq!(read, list);
        read.add(&accepted(&[metric("velocity", "")]));
        assert_eq!(read.gates.len(), 3);
        std::fs::write(GateList::path(folder.path(), Tier::Quick), "film | flux\n").expect("written");
        let error = GateList::read(folder.path(), Tier::Quick).expect_err("damaged").to_string();
        assert!(error.contains("line 1 is \"film | flux\""), "{error}");
    }
}
