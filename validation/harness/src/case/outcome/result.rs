//! Results of a finished case for reports, files and tests: plain data, whatever the case's types were.

use crate::case::Tier;
use crate::control::{Control, ControlTrial};
use crate::figure::{Animation, Figure};
use crate::metric::{FlowRegime, Metric, Variant, Verdict};
use crate::observation::{Frame, Outcome};
use crate::output::Table;
use crate::store::{CodeOrigin, hexadecimal};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// One run of a case in brief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunSummary {
    /// Name of the run; empty if the case has a single run.
    pub variant: Variant,
    /// Outcome of the run.
    pub outcome: Outcome,
    /// Flow particles.
    pub particles: usize,
    /// Time steps taken.
    pub steps: u64,
    /// Simulated time `[s]`.
    pub simulated_time: f64,
    /// Wall time of the simulation, also if it was taken from the store `[s]`.
    pub wall_seconds: f64,
    /// Threads that the run's loops used.
    pub threads: usize,
    /// Wall time per particle and step `[µs]`; `None` if no step was taken.
    pub microseconds_per_particle_step: Option<f64>,
    /// Hash of the final state's bits.
    pub state_hash: String,
    /// Taken from the store instead of simulated.
    pub from_store: bool,
}

impl RunSummary {
    /// Particles × steps `[-]`.
    pub fn particle_steps(&self) -> f64 {
        self.particles as f64 * self.steps as f64
    }

    /// Whether the run diverged although its case did not declare it.
    pub fn diverged_unexpectedly(&self) -> bool {
        matches!(self.outcome, Outcome::Diverged { expected: false, .. })
    }
}

/// A finished case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CaseResult {
    /// Name on the command line.
    pub name: String,
    /// Origin of the code of the case: these packages or another crate.
    pub origin: CodeOrigin,
    /// Description in one line.
    pub summary: String,
    /// A paragraph: what is simulated and what it is judged against.
    pub description: String,
    /// The tier that its parameters started from.
    pub tier: Tier,
    /// The parameters as run: a complete file for `bagnold run`.
    pub parameters_toml: String,
    /// Command that repeats the case; `case.toml` stands for a file holding `parameters_toml`.
    pub command: String,
    /// Judged and observed numbers in report order.
    pub metrics: Vec<Metric>,
    /// Figures of the case.
    pub figures: Vec<Figure>,
    /// Moving pictures.
    pub animations: Vec<Animation>,
    /// Profiles and time series.
    pub tables: Vec<Table>,
    /// The runs in the case's order.
    pub runs: Vec<RunSummary>,
    /// Values that each run depends on, by field name, in the order of `runs`; null if JSON cannot hold them.
    pub run_parameters: Vec<serde_json::Value>,
    /// The regime of each run's flow, in the order of `runs`.
    pub regimes: Vec<FlowRegime>,
    /// Snapshots of each run, in the order of `runs`.
    pub frames: Vec<Vec<Frame>>,
    /// The state in which each run was found to have diverged, in the order of `runs`.
    pub first_bad: Vec<Option<Frame>>,
    /// SHA-256 over the runs' state hashes in order.
    pub state_hash: String,
}

impl CaseResult {
    /// Sum of the runs' wall times `[s]`.
    pub fn wall_seconds(&self) -> f64 {
        self.runs.iter().map(|run| run.wall_seconds).sum()
    }

    /// Particles × steps over all runs `[-]`.
    pub fn particle_steps(&self) -> f64 {
        self.runs.iter().map(RunSummary::particle_steps).sum()
    }

    /// Mean wall time per particle and step `[µs]`; `None` if no step was taken.
    pub fn microseconds_per_particle_step(&self) -> Option<f64> {
        microseconds_each(self.wall_seconds(), self.particle_steps())
    }

    /// The result with a label beside the name of each run, number, table and picture; `named` adds it to a variant.
    pub fn labelled(mut self, label: &Variant, named: impl Fn(&Variant) -> Variant) -> Self {
        if label.is_empty() {
            return self;
        }
        let suffix = label.suffix();
        let caption = |caption: &mut String| *caption = format!("{label}: {caption}");
        let variants = self.metrics.iter_mut().map(|metric| &mut metric.variant);
        for variant in variants.chain(self.runs.iter_mut().map(|run| &mut run.variant)) {
            *variant = named(variant);
        }
        self.tables.iter_mut().for_each(|table| table.name += &suffix);
        for figure in &mut self.figures {
            figure.name += &suffix;
            caption(&mut figure.caption);
        }
        for animation in &mut self.animations {
            animation.name += &suffix;
            caption(&mut animation.caption);
        }
        self
    }

    /// The result with the runs of another one behind its own, and all that was made of them.
    pub fn and(mut self, other: Self) -> Self {
        self.metrics.extend(other.metrics);
        self.figures.extend(other.figures);
        self.animations.extend(other.animations);
        self.tables.extend(other.tables);
        self.runs.extend(other.runs);
        self.run_parameters.extend(other.run_parameters);
        self.regimes.extend(other.regimes);
        self.frames.extend(other.frames);
        self.first_bad.extend(other.first_bad);
        self
    }

    /// Trial of a control that gave this result, beside the right case.
    pub fn trial(&self, control: Control, right: &Self) -> ControlTrial {
        let runs = |result: &Self| result.runs.iter().map(|run| run.variant.clone()).collect::<Vec<Variant>>();
        let diverged = self.unexpected_divergences().next().is_some();
        ControlTrial::of(control, (&right.metrics, &runs(right)), (&self.metrics, &runs(self)), diverged)
    }

    /// Metrics whose gate does not hold.
    pub fn failures(&self) -> impl Iterator<Item = &Metric> {
        self.metrics.iter().filter(|metric| metric.verdict() == Verdict::Fail)
    }

    /// Runs that diverged although the case did not declare it.
    pub fn unexpected_divergences(&self) -> impl Iterator<Item = &RunSummary> {
        self.runs.iter().filter(|run| run.diverged_unexpectedly())
    }
}

/// Hash over the hashes of several states.
pub fn hash_of_states<'a>(states: impl Iterator<Item = &'a String>) -> String {
    let mut hash = Sha256::new();
    for state in states {
        hash.update(state.as_bytes());
        // A separator, so that no two lists of hashes run together to the same bytes.
        hash.update([0]);
    }
    hexadecimal(&hash.finalize())
}

/// Wall time over the number of things done in it `[µs]`.
pub(in crate::case) fn microseconds_each(wall_seconds: f64, count: f64) -> Option<f64> {
    (count > 0.0).then(|| wall_seconds * 1e6 / count)
}
