//! The list of gates, `tests/snapshots/gates/TIER.txt`: every gate that a tier has ever had, a line each, with its limit. A gate that is no
//! longer judged stays in the list, and `gates_removed.toml` has to say why it went: a limit cannot be lost or moved in a change of
//! something else.

use super::baseline::{Baseline, MetricKey};
use super::error::{damaged, read_if_there};
use super::put;
use crate::case::{ParameterError, Tier};
use crate::input::{DOCUMENT, WRITTEN_BY_HAND};
use crate::metric::{Metric, Variant, Verdict};
use crate::number::four_digits;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// File of the gates that went, in the folder of all baseline values.
const REMOVED: &str = "gates_removed.toml";

const HEAD: &str = "# Every gate that this tier has ever had: case | metric | variant | limit. `bagnold report --accept` adds to it. No line is\n\
    # taken away: a gate that went is an entry of tests/snapshots/gates_removed.toml.\n";

/// Placeholder of a limit that has not been accepted yet.
const UNKNOWN: &str = "?";

/// The gates of a tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GateList {
    gates: BTreeMap<MetricKey, String>,
}

impl GateList {
    /// The file of a tier in the folder of the baseline.
    pub fn path(folder: &Path, tier: Tier) -> PathBuf {
        folder.join("gates").join(format!("{}.txt", tier.name()))
    }

    /// Reads the list of a tier; a missing file is an empty list.
    ///
    /// # Errors
    /// If the file is there but cannot be read, or a line of it is no gate.
    pub fn read(folder: &Path, tier: Tier) -> Result<Self, ParameterError> {
        let path = Self::path(folder, tier);
        let Some(text) = read_if_there(&path, DOCUMENT)? else { return Ok(Self::default()) };
        let mut list = Self::default();
        for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.starts_with('#')) {
            let reason = || format!("line {} is {line:?} instead of `case | metric | variant | limit`", index + 1);
            let (key, limit) = gate(line).ok_or_else(|| damaged(&path, reason()))?;
            list.gates.insert(key, limit);
        }
        Ok(list)
    }

    /// Adds the gates of a case with their limits.
    pub fn add(&mut self, case: &str, metrics: &[Metric]) {
        self.gates.extend(limits(case, metrics));
    }

    /// Limits of a case's gates that differ from the accepted ones, a line each.
    pub fn moved_limits(&self, case: &str, metrics: &[Metric]) -> Vec<String> {
        let moved = limits(case, metrics).filter_map(|(key, limit)| {
            let accepted = self.gates.get(&key).filter(|own| **own != UNKNOWN && **own != limit)?;
            let name = format!("{} {} [{}]", key.case, key.metric, key.variant);
            Some(format!("{name}: its limit was {accepted} and is {limit}; `bagnold report --accept` takes it"))
        });
        moved.collect()
    }

    /// Cases whose baseline values are older than what judges them: a gate has a limit that was never accepted.
    pub fn older<'a>(&self, baseline: &'a Baseline) -> BTreeSet<&'a str> {
        let is_older = |gate: &&MetricKey| self.gates.get(*gate).is_none_or(|limit| limit == UNKNOWN);
        baseline.gates().filter(is_older).map(|gate| &*gate.case).collect()
    }

    /// Writes the list, sorted.
    ///
    /// # Errors
    /// If the folder or file cannot be written.
    pub fn write(&self, folder: &Path, tier: Tier) -> Result<(), ParameterError> {
        let text = self.gates.iter().fold(HEAD.to_owned(), |text, (MetricKey { case, metric, variant }, limit)| {
            text + &format!("{case} | {metric} | {variant} | {limit}\n")
        });
        Ok(put(&Self::path(folder, tier), text)?)
    }

    /// Contradictions between the list, the gates among all baseline values of its tier and the gates that went, a line each:
    /// gates that went without a reason, and gates that are not in the list.
    pub fn differences(&self, tier: Tier, baseline: &Baseline, removed: &RemovedGates) -> Vec<String> {
        let now: BTreeSet<&MetricKey> = baseline.gates().collect();
        let is_explained = |gate: &MetricKey| removed.removed.iter().any(|removed| removed.names(gate, tier));
        let name = |gate: &MetricKey| format!("{} {} [{}]", gate.case, gate.metric, gate.variant);
        let gone = self.gates.keys().filter(|gate| !now.contains(gate) && !is_explained(gate));
        let gone = gone.map(|gate| {
            format!("{} is no longer judged: restore the gate, or add it to {REMOVED} with the reason", name(gate))
        });
        let new = now.iter().filter(|gate| !self.gates.contains_key(**gate));
        let new =
            new.map(|gate| format!("{} is not in the list of gates: `bagnold report --accept` adds it", name(gate)));
        gone.chain(new).collect()
    }
}

/// The gates that judged a case, with their limits.
fn limits<'m>(case: &'m str, metrics: &'m [Metric]) -> impl Iterator<Item = (MetricKey, String)> {
    let judged = metrics.iter().filter(|metric| metric.verdict() != Verdict::Observed);
    judged.filter_map(move |metric| {
        let limit = metric.gate.as_ref()?.limit.in_words(four_digits);
        Some((MetricKey::of(case, metric), limit))
    })
}

fn gate(line: &str) -> Option<(MetricKey, String)> {
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    let &[case, metric, variant, limit] = cells.as_slice() else { return None };
    let key = MetricKey { case: case.to_owned(), metric: metric.to_owned(), variant: variant.parse().ok()? };
    Some((key, limit.to_owned()))
}

/// The gates that went.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RemovedGates {
    #[serde(default)]
    removed: Vec<RemovedGate>,
}

/// Gates of a case and a metric that went.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct RemovedGate {
    case: String,
    metric: String,
    /// Common part of their variants; empty for all.
    variant: Variant,
    /// The one tier that they went from.
    tier: Option<Tier>,
    /// Reason why they went; it has to be given.
    #[serde(rename = "reason")]
    _reason: String,
}

impl RemovedGates {
    /// Reads the file in the folder of all baseline values; a missing file is an empty list.
    ///
    /// # Errors
    /// If the file cannot be read, or an entry has an unknown or a missing field.
    pub fn read(folder: &Path) -> Result<Self, ParameterError> {
        let path = folder.join(REMOVED);
        let Some(text) = read_if_there(&path, WRITTEN_BY_HAND)? else { return Ok(Self::default()) };
        toml::from_str(&text).map_err(|error| damaged(&path, error.to_string()))
    }
}

impl RemovedGate {
    fn names(&self, gate: &MetricKey, tier: Tier) -> bool {
        let has_all = self.variant.parts().all(|(key, value)| gate.variant.get(key) == Some(value));
        (&self.case, &self.metric) == (&gate.case, &gate.metric) && has_all && self.tier.is_none_or(|own| own == tier)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    fn metric(name: &str, variant: &str) -> Metric {
        Metric::observed(name, &variant.parse().expect("a variant"), 0.5, "-").gated(Limit::AtMost(1.0), "a reason")
    }

    fn baseline(metrics: &[Metric]) -> Baseline {
        Baseline::of("film", metrics)
    }

    #[test]
    fn a_gate_that_goes_without_a_word_is_found() {
        let (one, other) =
            (metric("flux", "fluid=water,resolution=20"), metric("velocity", "fluid=water,resolution=20"));
        let mut list = GateList::default();
        list.add("film", &[one.clone(), other.clone()]);
        let none = RemovedGates::default();
        assert_eq!(list.differences(Tier::Quick, &baseline(&[one.clone(), other.clone()]), &none), [""; 0]);

        // a metric that vanishes, one that keeps its value and loses its limit, and one whose reference loses its confidence
        let unverified = other.clone().against(None, "a source", crate::metric::Confidence::Unverified);
        for without in
            [vec![one.clone()], vec![one.clone(), Metric { gate: None, ..other }], vec![one.clone(), unverified]]
        {
            let lost = |case: &str, metric: &str, rest: &str| {
                let text = format!(
                    "[[removed]]\ncase = '{case}'\nmetric = '{metric}'\nreason = 'of no use'\nvariant = {rest}"
                );
                list.differences(Tier::Quick, &baseline(&without), &toml::from_str(&text).expect("TOML"))
            };
            for other in [
                ("film", "flux", "''"),
                ("other", "velocity", "''"),
                ("film", "velocity", "'fluid=honey'"),
                ("film", "velocity", "''\ntier = 'paper'"),
            ] {
                let said = lost(other.0, other.1, other.2);
                let expected = "film velocity [fluid=water,resolution=20] is no longer judged";
                assert!(said.len() == 1 && said[0].starts_with(expected), "{said:?}");
            }
            assert_eq!(lost("film", "velocity", "'resolution=20'\ntier = 'quick'"), [""; 0]);
            assert_eq!(lost("film", "velocity", "''"), [""; 0]);
        }
        let new = list.differences(
            Tier::Quick,
            &baseline(&[one, metric("velocity", "fluid=water,resolution=20"), metric("shift", "")]),
            &none,
        );
        assert!(new.len() == 1 && new[0].starts_with("film shift [] is not in the list"), "{new:?}");
    }

    #[test]
    fn a_list_is_read_back_and_keeps_what_went() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut list = GateList::read(folder.path(), Tier::Quick).expect("nothing there");
        list.add("film", &[metric("flux", "fluid=water"), metric("shift", "")]);
        list.write(folder.path(), Tier::Quick).expect("written");
        let mut read = GateList::read(folder.path(), Tier::Quick).expect("readable");
        assert_eq!(read, list);
        read.add("film", &[metric("velocity", "")]);
        assert_eq!(read.gates.len(), 3);
        let wider = metric("velocity", "").gated(Limit::AtMost(2.0), "a reason");
        let moved = read.moved_limits("film", &[wider, metric("flux", "fluid=water"), metric("new", "")]);
        assert!(
            moved.len() == 1 && moved[0].starts_with("film velocity []: its limit was ≤ 1 and is ≤ 2"),
            "{moved:?}"
        );
        std::fs::write(GateList::path(folder.path(), Tier::Quick), "film | flux\n").expect("written");
        let error = GateList::read(folder.path(), Tier::Quick).expect_err("damaged").to_string();
        assert!(error.contains("line 1 is \"film | flux\""), "{error}");
    }
}
