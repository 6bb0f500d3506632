//! The loop of a run: steps until an end time, with an observer on the way.

use crate::run::{Divergence, Observer, RunProgress, StopReason};

/// Simulation that a run advances step by step.
pub(crate) trait Stepping<const D: usize> {
    /// Time `[s]`.
    fn now(&self) -> f64;
    /// Steps taken.
    fn steps_taken(&self) -> u64;
    /// Length of the next step as far as it is known `[s]`.
    fn next_step(&self) -> f64;
    /// Takes one step.
    fn take_one(&mut self) -> Result<(), Divergence<D>>;
}

/// Runs along a course, showing the observer the state at the start, then at the first step after every multiple of its
/// interval, and at the end.
pub(crate) fn run<S: Stepping<D>, const D: usize>(
    simulation: &mut S,
    course: &mut RunProgress,
    observer: &mut impl Observer<S>,
) -> StopReason<D> {
    let origin = match course.origin {
        Some(origin) => origin,
        None => {
            let origin = *course.origin.insert(simulation.now());
            course.observed_step = simulation.steps_taken();
            if observer.observe(simulation).is_break() {
                return StopReason::Stopped;
            }
            origin
        }
    };
    loop {
        course.step = simulation.next_step();
        // half a step of slack, so that rounding does not add a step
        if simulation.now() >= course.end - 0.5 * course.step {
            break;
        }
        if observer.pause(simulation, course).is_break() {
            return StopReason::Interrupted;
        }
        if let Err(divergence) = simulation.take_one() {
            return StopReason::Diverged(divergence);
        }
        let due = ((simulation.now() - origin) / course.interval + 1e-9).floor() as u64;
        if due > course.observed {
            course.observed = due;
            course.observed_step = simulation.steps_taken();
            if observer.observe(simulation).is_break() {
                return StopReason::Stopped;
            }
        }
    }
    if course.observed_step < simulation.steps_taken() && observer.observe(simulation).is_break() {
        return StopReason::Stopped;
    }
    StopReason::Finished
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Watching;
    use std::ops::ControlFlow;

    /// Steps of a tenth of a second, which nothing stops.
    struct Clock(u64);

    impl Stepping<2> for Clock {
        fn now(&self) -> f64 {
            self.0 as f64 / 10.0
        }

        fn steps_taken(&self) -> u64 {
            self.0
        }

        fn next_step(&self) -> f64 {
            0.1
        }

        fn take_one(&mut self) -> Result<(), Divergence<2>> {
            self.0 += 1;
            Ok(())
        }
    }

    /// Steps at which a run to an end `[s]` is observed, and how it ends; the observer stops it at a step.
    fn observed(end: f64, stop_at: u64) -> (Vec<u64>, bool) {
        let mut seen = Vec::new();
        let mut watch = Watching(|clock: &Clock| {
            seen.push(clock.0);
            if clock.0 == stop_at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let reason = run(&mut Clock(3), &mut RunProgress::new(end, 0.25), &mut watch);
        (seen, matches!(reason, StopReason::Finished))
    }

    #[test]
    fn a_run_is_seen_at_its_start_after_every_interval_and_once_at_its_end() {
        // 0.25 s and 0.75 s after the start lie between two steps
        assert_eq!(observed(1.3, 99), (vec![3, 6, 8, 11, 13], true));
        // half a step of slack
        assert_eq!(observed(0.96, 99), (vec![3, 6, 8, 10], true));
        assert_eq!(observed(0.94, 99), (vec![3, 6, 8, 9], true));
        assert_eq!(observed(1.3, 3), (vec![3], false));
        assert_eq!(observed(1.3, 8), (vec![3, 6, 8], false));
    }
}
