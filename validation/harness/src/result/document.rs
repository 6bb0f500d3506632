//! `metrics.json`: a case's numbers and where they come from, for other programs.

use crate::case::{CaseResult, RunSummary, Tier};
use crate::metric::{Confidence, Limit, Metric, MetricKind, PredictionInterval, Uncertainty, Variant, Verdict};
use crate::store;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The whole file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricsDocument {
    /// Name of the case.
    pub case: String,
    /// Tier that the parameters started from.
    pub tier: Tier,
    /// SHA-256 over the runs' final states: the same on any machine and number of threads.
    pub state_hash: String,
    /// First digits of the SHA-256 over names, variants and limits of the gates; empty in results of earlier versions.
    #[serde(default)]
    pub gates: String,
    /// Provenance of the numbers.
    pub provenance: Provenance,
    /// Number of gates by the words of their severities; empty where no report judged them.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub tally: BTreeMap<String, usize>,
    /// The runs and how they ended.
    pub runs: Vec<RunSummary>,
    /// Metrics of all runs.
    pub metrics: Vec<MetricEntry>,
}

/// Provenance of the numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of Bagnold.
    pub version: String,
    /// Commit that the program was built from, with `+changes` if its sources differ from it, or `unknown`.
    pub commit: String,
    /// Hash of sources, locked dependencies, compiler, profile and instruction set, and of the program's own file where it has
    /// laws or cases of another crate.
    pub source_hash: String,
    /// Cargo's profile, and how the solver is optimised in it.
    pub profile: String,
    /// Instruction set that the loops over particles run with, chosen at run time; empty in results of earlier versions.
    #[serde(default)]
    pub instruction_set: String,
    /// Instruction set extensions that the compiler could count on everywhere else.
    pub target_features: String,
    /// Command that repeats the case.
    pub command: String,
    /// Threads at hand for all runs together.
    pub threads: usize,
    /// Sum of the runs' wall times, also of those taken from the store `[s]`.
    pub wall_seconds: f64,
    /// Mean wall time per particle and step `[µs]`; null if no step was taken.
    pub microseconds_per_particle_step: Option<f64>,
    /// Runs taken from the store instead of simulated.
    pub runs_from_store: usize,
}

/// One number with its verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricEntry {
    /// Stable snake_case name.
    pub name: String,
    /// Run or runs that the number is of, `key=value,…`.
    pub variant: Variant,
    /// The value; null if it is not a finite number.
    pub value: Option<f64>,
    /// Unit of the value and of its limit.
    pub unit: String,
    /// The reference's value in the same unit.
    pub reference: Option<f64>,
    /// Source of the reference.
    pub source: Option<String>,
    /// Confidence in the reference.
    pub confidence: Option<Confidence>,
    /// Kind of reference that the verdict rests on.
    pub kind: MetricKind,
    /// The gate's limit, such as `{"at_most": 0.7}`; null if the number is only observed.
    pub limit: Option<Limit>,
    /// Reason for the value of the limit.
    pub reason: Option<String>,
    /// Distance to the limit in the metric's unit, negative where it is broken.
    pub margin: Option<f64>,
    /// The gate's outcome.
    pub verdict: Verdict,
    /// Reason why there is no value, or the part of a run that the value leaves out; absent where neither is the case.
    #[serde(default, alias = "not_steady", skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Parts of what value and reference are known to; absent where nothing is known.
    #[serde(default, skip_serializing_if = "Uncertainty::is_empty")]
    pub uncertainty: Uncertainty,
    /// 95 % prediction interval of the true value, from the errors of comparable predictions; absent without such
    /// comparisons.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prediction: Option<PredictionInterval>,
    /// Relative tolerance of the baseline `[-]`.
    pub snapshot_tolerance: f64,
    /// Absolute floor of that tolerance, in the metric's unit.
    pub snapshot_floor: f64,
}

impl Provenance {
    /// The provenance of a result that was computed on `threads` threads.
    pub fn of(result: &CaseResult, threads: usize) -> Self {
        Self {
            version: store::version().to_owned(),
            commit: store::commit().to_owned(),
            source_hash: store::identity_or_unique(result.origin).to_owned(),
            profile: store::profile().to_owned(),
            instruction_set: store::instruction_set().to_owned(),
            target_features: store::target_features().to_owned(),
            command: result.command.clone(),
            threads,
            wall_seconds: result.wall_seconds(),
            microseconds_per_particle_step: result.microseconds_per_particle_step(),
            runs_from_store: result.runs.iter().filter(|run| run.from_store).count(),
        }
    }
}

impl From<&Metric> for MetricEntry {
    fn from(metric: &Metric) -> Self {
        let reference = metric.reference.as_ref();
        let gate = metric.gate.as_ref();
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        Self {
            name: metric.name.clone(),
            variant: metric.variant.clone(),
            value: finite(metric.value),
            unit: metric.unit.clone(),
            reference: reference.and_then(|reference| reference.value).and_then(finite),
            source: reference.map(|reference| reference.source.clone()),
            confidence: reference.map(|reference| reference.confidence),
            kind: metric.kind,
            limit: gate.map(|gate| gate.limit),
            reason: gate.map(|gate| gate.reason.clone()),
            margin: gate.and_then(|gate| finite(gate.limit.margin(metric.value))),
            verdict: metric.verdict(),
            remark: metric.remark.clone(),
            uncertainty: metric.uncertainty.clone(),
            prediction: metric.prediction.clone(),
            snapshot_tolerance: metric.snapshot_tolerance,
            snapshot_floor: metric.snapshot_floor,
        }
    }
}

impl MetricsDocument {
    /// The document of a result that was computed on `threads` threads.
    pub fn of(result: &CaseResult, threads: usize) -> Self {
        Self {
            case: result.name.clone(),
            tier: result.tier,
            state_hash: result.state_hash.clone(),
            gates: gates_digest(&result.metrics),
            provenance: Provenance::of(result, threads),
            tally: BTreeMap::new(),
            runs: result.runs.clone(),
            metrics: result.metrics.iter().map(MetricEntry::from).collect(),
        }
    }

    /// The document as text that ends with a line feed.
    pub fn text(&self) -> String {
        pretty(self)
    }
}

/// First digits of the SHA-256 over names, variants and limits of gates: results of one digest were judged alike.
pub fn gates_digest<'a>(metrics: impl IntoIterator<Item = &'a Metric>) -> String {
    let gated = metrics.into_iter().filter_map(|metric| metric.gate.as_ref().map(|gate| (metric, gate)));
    let lines: Vec<String> =
        gated.map(|(metric, gate)| format!("{} {} {:?}\n", metric.name, metric.variant, gate.limit)).collect();
    store::hexadecimal(&Sha256::digest(lines.concat()))[..8].to_owned()
}

/// Indented JSON that ends with a line feed.
pub fn pretty<T: Serialize>(value: &T) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("plain data without maps always serialises");
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gates_have_a_digest_of_their_limits_and_not_of_their_values() {
        let of = |value: f64, limit: f64| {
            let metric = Metric::observed("velocity_l2", &Variant::of("resolution", 40), value, "%");
            gates_digest(&[metric.gated(Limit::AtMost(limit), "first order")])
        };
        assert_eq!(of(0.1, 0.7), of(0.2, 0.7));
        assert_ne!(of(0.1, 0.7), of(0.1, 0.8));
        assert_eq!(of(0.1, 0.7).len(), 8);
    }

    #[test]
    fn an_entry_has_the_agreed_keys_and_null_for_what_is_not_a_number() {
        let metric = Metric::observed("velocity_l2", &Variant::of("resolution", 40), f64::NAN, "%")
            .against(Some(0.0), "exact", Confidence::Exact)
            .gated(Limit::AtMost(0.7), "first order");
        let text = serde_json::to_string(&MetricEntry::from(&metric)).expect("serialises");
        assert_eq!(
            text,
            r#"{"name":"velocity_l2","variant":"resolution=40","value":null,"unit":"%","reference":0.0,"source":"exact","confidence":"exact","kind":"verification","limit":{"at_most":0.7},"reason":"first order","margin":null,"verdict":"fail","snapshot_tolerance":1e-6,"snapshot_floor":0.0}"#
        );
    }

    #[test]
    fn an_entry_is_read_back_as_written() {
        let metric = Metric::observed("final_height", &Variant::default(), 0.1 + 0.2, "m")
            .gated(Limit::Within(0.2, 0.4), "band");
        // also one whose scatter is not a number, because it has no value
        let nothing = Metric { value: f64::NAN, ..metric.clone() }.with_snapshot_tolerance(0.1, f64::NAN);
        for entry in [metric, nothing].map(|metric| MetricEntry::from(&metric)) {
            let text = serde_json::to_string(&entry).expect("serialises");
            assert_eq!(serde_json::from_str::<MetricEntry>(&text).expect("reads back"), entry);
        }
    }
}
