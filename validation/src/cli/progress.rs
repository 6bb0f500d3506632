//! The progress bar: how far, how long still, how fast. Hidden when standard error is not a terminal.

use super::logging::BARS;
use crate::case::{Monitor, Prepared};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Instant;

/// Resolution of the bar.
const PARTS: u64 = 10_000;

/// Time between two updates `[ms]`: a step may take less than a terminal needs for a line.
const UPDATE_INTERVAL: u64 = 100;

/// What is known of one run.
struct RunState {
    name: String,
    /// Expected cost over that of all runs `[-]`.
    weight: f64,
    /// Bits of the part that is done, 0 … 1.
    done: AtomicU64,
    /// Particle-steps computed now, so none for a run from the store.
    particle_steps: AtomicU64,
}

/// A bar for all runs of some cases.
pub(super) struct Progress {
    bar: ProgressBar,
    runs: Vec<RunState>,
    finished: AtomicUsize,
    begin: Instant,
    /// Milliseconds from `begin` to the last update.
    updated: AtomicU64,
}

impl Progress {
    pub(super) fn new(cases: &[Box<dyn Prepared>], quiet: bool) -> Self {
        let runs: Vec<(String, f64)> = cases
            .iter()
            .flat_map(|case| {
                let name = |run| format!("{} {}", case.name(), case.variant(run)).trim_end().to_owned();
                (0..case.run_count()).map(move |run| (name(run), case.particle_steps(run).max(1.0)))
            })
            .collect();
        let total: f64 = runs.iter().map(|(_, cost)| cost).sum();
        let bar = if quiet {
            ProgressBar::with_draw_target(Some(PARTS), ProgressDrawTarget::hidden())
        } else {
            BARS.add(ProgressBar::new(PARTS))
        };
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {percent:>3} %  {eta} left  {wide_msg}") {
            bar.set_style(style);
        }
        let state = |(name, cost): (String, f64)| RunState {
            name,
            weight: cost / total,
            done: AtomicU64::new(0),
            particle_steps: AtomicU64::new(0),
        };
        Self {
            bar,
            runs: runs.into_iter().map(state).collect(),
            finished: AtomicUsize::new(0),
            begin: Instant::now(),
            updated: AtomicU64::new(0),
        }
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
        BARS.remove(&self.bar);
    }

    fn show(&self, doing: &str) {
        let done: f64 = self.runs.iter().map(|run| run.weight * f64::from_bits(run.done.load(Ordering::Relaxed))).sum();
        let steps: u64 = self.runs.iter().map(|run| run.particle_steps.load(Ordering::Relaxed)).sum();
        let rate = steps as f64 / self.begin.elapsed().as_secs_f64().max(1e-3);
        // A saturating cast: rounding may leave the sum a little above 1.
        self.bar.set_position(((done * PARTS as f64) as u64).min(PARTS));
        self.bar.set_message(format!(
            "{}/{} runs  {:.2} M particle-steps/s  {doing}",
            self.finished.load(Ordering::Relaxed),
            self.runs.len(),
            rate * 1e-6
        ));
    }

    /// Whether this caller is the one to update the bar now.
    fn is_due(&self) -> bool {
        let now = u64::try_from(self.begin.elapsed().as_millis()).unwrap_or(u64::MAX);
        let last = self.updated.load(Ordering::Relaxed);
        now >= last + UPDATE_INTERVAL
            && self.updated.compare_exchange(last, now, Ordering::Relaxed, Ordering::Relaxed).is_ok()
    }
}

impl Monitor for Progress {
    fn started(&self, run: usize) {
        self.show(&self.runs[run].name);
    }

    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64) {
        let state = &self.runs[run];
        let part = if total > 0.0 { (simulated / total).clamp(0.0, 1.0) } else { 0.0 };
        state.done.store(part.to_bits(), Ordering::Relaxed);
        state.particle_steps.store(particle_steps as u64, Ordering::Relaxed);
        if self.is_due() {
            self.show(&format!("{}: {simulated:.3} of {total:.3} s simulated", state.name));
        }
    }

    fn finished(&self, run: usize) {
        self.runs[run].done.store(1.0_f64.to_bits(), Ordering::Relaxed);
        self.finished.fetch_add(1, Ordering::Relaxed);
        self.show(&self.runs[run].name);
    }
}

/// A bar that counts things of about equal cost.
pub(super) struct Count(ProgressBar);

impl Count {
    pub(super) fn new(what: &str, all: usize, done: usize, quiet: bool) -> Self {
        let bar = if quiet {
            ProgressBar::with_draw_target(Some(all as u64), ProgressDrawTarget::hidden())
        } else {
            BARS.add(ProgressBar::new(all as u64))
        };
        let template = format!("{{bar:24}} {{pos}}/{{len}} {what}  {{eta}} left  {{wide_msg}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        bar.set_position(done as u64);
        Self(bar)
    }

    /// So many more are to be done.
    pub(super) fn expect(&self, more: usize) {
        self.0.inc_length(more as u64);
    }

    /// Shows what is being done.
    pub(super) fn say(&self, doing: &str) {
        self.0.set_message(doing.to_owned());
    }

    /// One more is done.
    pub(super) fn step(&self) {
        self.0.inc(1);
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.0.finish_and_clear();
        BARS.remove(&self.0);
    }
}
