//! Expected wall time of several runs, from their times on one core.

/// Gain in speed by every thread of a run beyond its first `[-]`. Small runs gain less, large ones more.
const GAIN: f64 = 0.7;

/// Speed-up of a run on a number of threads relative to one thread `[-]`.
pub fn speed_up(threads: usize) -> f64 {
    1.0 + GAIN * (threads.max(1) - 1) as f64
}

/// Wall time of runs on a number of threads `[s]`, from their times on one core `[s]`: the larger of the time of the longest run on
/// its share of the threads and the time of all runs on all threads.
pub fn wall_time(core_seconds: &[f64], threads: usize) -> f64 {
    let share = threads / core_seconds.len().max(1);
    let longest = core_seconds.iter().copied().fold(0.0, f64::max) / speed_up(share);
    longest.max(core_seconds.iter().sum::<f64>() / threads.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_run_has_all_threads_and_many_have_one_each() {
        assert_eq!(wall_time(&[], 2), 0.0);
        assert_eq!(wall_time(&[10.0], 1), 10.0);
        assert_eq!(wall_time(&[17.0], 2), 10.0);
        assert_eq!(wall_time(&[4.0, 4.0, 4.0, 4.0], 1), 16.0);
        // the second and third share a thread while the first has the other
        assert_eq!(wall_time(&[10.0, 4.0, 4.0], 2), 10.0);
        // two runs of four threads have two each
        assert_eq!(wall_time(&[17.0, 17.0], 4), 10.0);
    }

    #[test]
    fn the_longest_run_bounds_the_time_from_below_and_one_thread_from_above() {
        let runs = [9.0, 7.0, 5.0, 3.0, 3.0, 1.0, 0.5];
        let sum: f64 = runs.iter().sum();
        for threads in 1..12 {
            let time = wall_time(&runs, threads);
            assert!(time >= sum / threads as f64 - 1e-12 && time <= sum + 1e-12, "{time} s on {threads} threads");
            assert!(time >= runs[0] / speed_up(threads) - 1e-12);
        }
        assert!(wall_time(&runs, 2) < 0.6 * sum);
    }
}
