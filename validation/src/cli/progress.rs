//! Progress of the runs of cases: part done, time left, speed.

use super::display::{Display, time_left};
use crate::case::{Monitor, PreparedCase};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// Resolution of the bar.
const PARTS: u64 = 10_000;

/// Time between two updates `[ms]`: a step may take less than a terminal needs for a line.
const UPDATE_INTERVAL: u64 = 100;

/// Progress of one run.
struct RunState {
    name: String,
    /// Expected cost over that of all runs `[-]`.
    weight: f64,
    /// Bits of the part that is done, 0 … 1, and of that with which it began here; a NaN before that.
    done: AtomicU64,
    begun: AtomicU64,
    /// Particle-steps, and those with which it began here; none for a run from the store.
    particle_steps: AtomicU64,
    first_steps: AtomicU64,
}

impl RunState {
    /// Part that is done, and what of it was done here `[-]`.
    fn parts(&self) -> (f64, f64) {
        let read = |bits: &AtomicU64| f64::from_bits(bits.load(Ordering::Relaxed));
        let (done, begun) = (read(&self.done), read(&self.begun));
        (done, if begun.is_nan() { 0.0 } else { done - begun })
    }
}

/// Progress of all runs.
struct OverallProgress {
    runs: Vec<RunState>,
    finished: AtomicUsize,
    begin: Instant,
    /// Description of the last work done.
    doing: Mutex<String>,
}

impl OverallProgress {
    /// Part of all work that is done `[-]`.
    fn done(&self) -> f64 {
        self.runs.iter().map(|run| run.weight * run.parts().0).sum::<f64>().min(1.0)
    }

    fn text(&self) -> String {
        let here: f64 = self.runs.iter().map(|run| run.weight * run.parts().1).sum();
        let computed = |run: &RunState| {
            run.particle_steps.load(Ordering::Relaxed).saturating_sub(run.first_steps.load(Ordering::Relaxed))
        };
        let steps: u64 = self.runs.iter().map(computed).sum();
        let elapsed = self.begin.elapsed();
        let rate = steps as f64 / elapsed.as_secs_f64().max(1e-3);
        format!(
            "{}  {}/{} runs  {:.2} M particle-steps/s  {}",
            time_left(here, 1.0 - self.done(), elapsed),
            self.finished.load(Ordering::Relaxed),
            self.runs.len(),
            rate * 1e-6,
            self.doing.lock().unwrap_or_else(PoisonError::into_inner)
        )
    }
}

/// Progress of all runs of some cases.
pub(super) struct RunsBar {
    display: Display,
    state: Arc<OverallProgress>,
    /// Milliseconds from the beginning to the last update.
    updated: AtomicU64,
}

impl RunsBar {
    pub(super) fn new(cases: &[Box<dyn PreparedCase>], quiet: bool) -> Self {
        let runs: Vec<(String, f64)> = cases
            .iter()
            .flat_map(|case| {
                let name = |run| format!("{} {}", case.name(), case.variant(run)).trim_end().to_owned();
                (0..case.run_count()).map(move |run| (name(run), case.particle_steps(run).max(1.0)))
            })
            .collect();
        let total: f64 = runs.iter().map(|(_, cost)| cost).sum();
        let state = |(name, cost): (String, f64)| RunState {
            name,
            weight: cost / total,
            done: AtomicU64::new(0),
            begun: AtomicU64::new(f64::NAN.to_bits()),
            particle_steps: AtomicU64::new(0),
            first_steps: AtomicU64::new(0),
        };
        let state = Arc::new(OverallProgress {
            runs: runs.into_iter().map(state).collect(),
            finished: AtomicUsize::new(0),
            begin: Instant::now(),
            doing: Mutex::default(),
        });
        let display = Display::new(PARTS, "{bar:24} {percent:>3} %  {wide_msg}", quiet);
        let told = Arc::clone(&state);
        let lines = display.lines;
        display.refresh_by(move || {
            let percent = if lines { format!("{:.1} % done  ", 100.0 * told.done()) } else { String::new() };
            percent + &told.text()
        });
        Self { display, state, updated: AtomicU64::new(0) }
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.display.clear();
    }

    fn show(&self, doing: String) {
        *self.state.doing.lock().unwrap_or_else(PoisonError::into_inner) = doing;
        // A saturating cast.
        self.display.bar.set_position(((self.state.done() * PARTS as f64) as u64).min(PARTS));
        self.display.bar.set_message(self.state.text());
    }

    /// Whether this caller is the one to update the bar now.
    fn is_due(&self) -> bool {
        let now = u64::try_from(self.display.begin.elapsed().as_millis()).unwrap_or(u64::MAX);
        let last = self.updated.load(Ordering::Relaxed);
        now >= last + UPDATE_INTERVAL
            && self.updated.compare_exchange(last, now, Ordering::Relaxed, Ordering::Relaxed).is_ok()
    }
}

impl Monitor for RunsBar {
    fn started(&self, run: usize) {
        self.show(self.state.runs[run].name.clone());
    }

    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64) {
        let state = &self.state.runs[run];
        let part = if total > 0.0 { (simulated / total).clamp(0.0, 1.0) } else { 0.0 };
        if f64::from_bits(state.begun.load(Ordering::Relaxed)).is_nan() {
            state.begun.store(part.to_bits(), Ordering::Relaxed);
            state.first_steps.store(particle_steps as u64, Ordering::Relaxed);
        }
        state.done.store(part.to_bits(), Ordering::Relaxed);
        state.particle_steps.store(particle_steps as u64, Ordering::Relaxed);
        if self.is_due() {
            self.show(format!("{}: {simulated:.3} of {total:.3} s simulated", state.name));
        }
    }

    fn told(&self, run: usize, news: &str) {
        self.display.say(&format!("{}: {news}", self.state.runs[run].name));
    }

    fn finished(&self, run: usize) {
        self.state.runs[run].done.store(1.0_f64.to_bits(), Ordering::Relaxed);
        self.state.finished.fetch_add(1, Ordering::Relaxed);
        self.show(self.state.runs[run].name.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_work_does_not_count_for_the_rate() {
        let run = RunState {
            name: String::new(),
            weight: 1.0,
            done: AtomicU64::new(0.75_f64.to_bits()),
            begun: AtomicU64::new(0.5_f64.to_bits()),
            particle_steps: AtomicU64::new(0),
            first_steps: AtomicU64::new(0),
        };
        assert_eq!(run.parts(), (0.75, 0.25));
    }
}
