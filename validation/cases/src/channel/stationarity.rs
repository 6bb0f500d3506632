//! When a flow is stationary: its depth mean U changes by less than a tolerance over U/(2 g i), several times in a row.
//!
//! U/(2 g i) is the time in which a deviation of a turbulent flow decays by e: the bed's friction goes with U², so that
//! dU/dt = g i (1 − U²/U_∞²).

use super::AveragingWindowEnd;
use serde::{Deserialize, Serialize};

/// The flow at the end of an interval of the criterion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct StationaritySample {
    /// Time `[s]`.
    pub time: f64,
    /// Depth mean of the velocity `[m/s]`.
    pub mean_velocity: f64,
    /// Relative change since the mark before `[-]`; none at the first.
    pub change: Option<f64>,
}

/// Watches the depth mean of the velocity.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Stationarity {
    until: AveragingWindowEnd,
    /// g i `[m/s²]`.
    acceleration: f64,
    pub(super) marks: Vec<StationaritySample>,
    /// Time at which the criterion was met `[s]`.
    pub(super) reached: Option<f64>,
}

impl Stationarity {
    pub(super) fn new(until: AveragingWindowEnd, acceleration: f64) -> Self {
        Self { until, acceleration, marks: Vec::new(), reached: None }
    }

    /// A sample of the depth mean `[m/s]` at a time `[s]`.
    pub(super) fn observe(&mut self, time: f64, mean_velocity: f64) {
        let AveragingWindowEnd::Stationary { tolerance, checks, .. } = self.until else { return };
        if self.reached.is_some() {
            return;
        }
        let change = match self.marks.last() {
            None => None,
            Some(last) if time >= last.time + last.mean_velocity.abs() / (2.0 * self.acceleration) => {
                Some(mean_velocity / last.mean_velocity - 1.0)
            }
            Some(_) => return,
        };
        self.marks.push(StationaritySample { time, mean_velocity, change });
        let small = |mark: &&StationaritySample| mark.change.is_some_and(|change| change.abs() < tolerance);
        if self.marks.iter().rev().take(checks).filter(small).count() == checks {
            self.reached = Some(time);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNTIL: AveragingWindowEnd = AveragingWindowEnd::Stationary { tolerance: 0.005, checks: 3, at_most: 100.0 };

    /// U = U_∞ tanh(g i t/U_∞ + c), the answer of dU/dt = g i (1 − U²/U_∞²), sampled every 10 ms.
    fn watched(until: AveragingWindowEnd, share: f64) -> Stationarity {
        let (steady, acceleration) = (1.3, 0.2943);
        let mut watch = Stationarity::new(until, acceleration);
        for sample in 0..4000 {
            let time = 0.01 * f64::from(sample);
            watch.observe(time, steady * (acceleration * time / steady + f64::atanh(share)).tanh());
        }
        watch
    }

    #[test]
    fn a_flow_that_speeds_up_is_stationary_after_three_small_changes() {
        let watch = watched(UNTIL, 0.8);
        let changes: Vec<f64> = watch.marks.iter().filter_map(|mark| mark.change).collect();
        assert_eq!(watch.marks[0].time, 0.0);
        // the first interval lasts 0.8 U_∞/(2 g i) = 1.767 s
        assert!((watch.marks[1].time - 1.77).abs() < 1e-9, "{:?}", watch.marks[1]);
        let (small, large) = (&changes[changes.len() - 3..], &changes[..changes.len() - 3]);
        assert!(
            small.iter().all(|change| *change < 0.005) && large.iter().all(|change| *change > 0.005),
            "{changes:?}"
        );
        assert_eq!(watch.reached, watch.marks.last().map(|mark| mark.time));
    }

    #[test]
    fn a_steady_flow_needs_three_intervals_and_a_fixed_time_no_criterion() {
        let watch = watched(UNTIL, 0.999_999_9);
        assert_eq!(watch.marks.len(), 4);
        let watch = watched(AveragingWindowEnd::Time(1.0), 0.9);
        assert!(watch.marks.is_empty() && watch.reached.is_none());
    }
}
