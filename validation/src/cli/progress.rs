//! Progress of the runs of cases: part done, time left, speed.

use super::display::{Display, Work, time_left};
use super::expectation::Expectation;
use super::tell;
use crate::case::{Monitor, PreparedCase, StateOutput};
use crate::result::States;
use std::time::Instant;

/// Progress of one run.
struct RunProgress {
    name: String,
    /// Expected cost over that of all runs `[-]`.
    weight: f64,
    /// Part that is done, 0 … 1 `[-]`.
    done: f64,
    particle_steps: f64,
    /// Part and particle-steps that were done when it began here; none before, and for a run from the store.
    begun: Option<(f64, f64)>,
}

impl RunProgress {
    /// Part and particle-steps that were done here.
    fn here(&self) -> (f64, f64) {
        self.begun.map_or((0.0, 0.0), |(done, steps)| (self.done - done, self.particle_steps - steps))
    }
}

/// Progress of all runs.
struct AllRuns {
    runs: Vec<RunProgress>,
    finished: usize,
    begin: Instant,
    /// The run that was worked on last, and simulated and all time of it `[s]` while it runs.
    last: (usize, Option<(f64, f64)>),
}

impl Work for AllRuns {
    fn part(&self) -> f64 {
        self.runs.iter().map(|run| run.weight * run.done).sum::<f64>().min(1.0)
    }

    fn text(&self) -> String {
        let here: f64 = self.runs.iter().map(|run| run.weight * run.here().0).sum();
        let steps: f64 = self.runs.iter().map(|run| run.here().1).sum();
        let elapsed = self.begin.elapsed();
        let name = self.runs.get(self.last.0).map_or("", |run| &run.name);
        let simulated = |(time, all): (f64, f64)| format!(": {time:.3} of {all:.3} s simulated");
        format!(
            "{}  {}/{} runs  {:.2} M particle-steps/s  {name}{}",
            time_left(here, 1.0 - self.part(), elapsed),
            self.finished,
            self.runs.len(),
            1e-6 * steps / elapsed.as_secs_f64().max(1e-3),
            self.last.1.map(simulated).unwrap_or_default()
        )
    }
}

/// Shows the progress of all runs of some cases, and passes on their states and times.
pub(super) struct RunsBar<'a> {
    display: Display<AllRuns>,
    quiet: bool,
    states: Option<&'a States>,
    expectation: Option<&'a Expectation>,
}

impl<'a> RunsBar<'a> {
    pub(super) fn new(
        cases: &[Box<dyn PreparedCase>],
        quiet: bool,
        states: Option<&'a States>,
        expectation: Option<&'a Expectation>,
    ) -> Self {
        let of_case = |case: &dyn PreparedCase| -> Vec<RunProgress> {
            let run = |run| RunProgress {
                name: format!("{} {}", case.name(), case.variant(run)).trim_end().to_owned(),
                weight: case.estimate(run).particle_steps.max(1.0),
                done: 0.0,
                particle_steps: 0.0,
                begun: None,
            };
            (0..case.run_count()).map(run).collect()
        };
        let mut runs: Vec<RunProgress> = cases.iter().flat_map(|case| of_case(case.as_ref())).collect();
        let total: f64 = runs.iter().map(|run| run.weight).sum();
        runs.iter_mut().for_each(|run| run.weight /= total);
        let all = AllRuns { runs, finished: 0, begin: Instant::now(), last: (0, None) };
        Self { display: Display::new(all, quiet), quiet, states, expectation }
    }
}

impl Monitor for RunsBar<'_> {
    fn started(&self, run: usize) {
        self.display.change(|all| all.last = (run, None));
        self.expectation.inspect(|expectation| expectation.started(run));
    }

    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64) {
        let part = if total > 0.0 { (simulated / total).clamp(0.0, 1.0) } else { 0.0 };
        self.display.change(|all| {
            let state = &mut all.runs[run];
            state.begun.get_or_insert((part, particle_steps));
            (state.done, state.particle_steps) = (part, particle_steps);
            all.last = (run, Some((simulated, total)));
        });
    }

    fn told(&self, run: usize, news: &str) {
        if !self.quiet {
            self.display.change(|all| tell(&format!("{}: {news}", all.runs[run].name)));
        }
    }

    fn finished(&self, run: usize) {
        self.display.change(|all| {
            all.runs[run].done = 1.0;
            all.finished += 1;
            all.last = (run, None);
        });
        self.expectation.inspect(|expectation| expectation.finished(run));
    }

    fn output(&self, run: usize) -> Option<&dyn StateOutput> {
        self.states?.run(run)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_work_does_not_count_for_the_rate() {
        let run = RunProgress {
            name: String::new(),
            weight: 1.0,
            done: 0.75,
            particle_steps: 30.0,
            begun: Some((0.5, 20.0)),
        };
        assert_eq!(run.here(), (0.25, 10.0));
    }
}
