//! A profile that holds what is no number fails its run, whatever the metrics made of it, and a run that diverged its gates.

use crate::case::RunSummary;
use crate::metric::{DIVERGED, Metric};
use crate::observation::Outcome;
use crate::output::Table;

/// Begins the names of tables that are profiles.
const PROFILE: &str = "profile";

/// Marks the runs whose profiles are not finite as diverged, unless their divergence is a result.
pub(in crate::case) fn fail_broken_profiles(runs: &mut [RunSummary], tables: &[Table]) {
    for table in tables.iter().filter(|table| table.name.starts_with(PROFILE)) {
        let Some(message) = broken(table) else { continue };
        let is_of = |run: &RunSummary| table.name.ends_with(&run.variant.file_name());
        // of runs whose names end alike the longest is meant
        let own =
            (0..runs.len()).filter(|&run| is_of(&runs[run])).max_by_key(|&run| runs[run].variant.to_string().len());
        for run in own.map_or(0..runs.len(), |run| run..run + 1) {
            if !matches!(runs[run].outcome, Outcome::Diverged { .. }) {
                runs[run].outcome = Outcome::Diverged { message: message.clone(), expected: false };
            }
        }
    }
}

/// Removes the values of gates whose runs diverged unexpectedly, so that none of them passes.
pub(in crate::case) fn fail_diverged(metrics: &mut [Metric], runs: &[RunSummary]) {
    let reason = DIVERGED.to_owned();
    for run in runs.iter().filter(|run| run.diverged_unexpectedly()) {
        for metric in metrics.iter_mut().filter(|metric| metric.gate.is_some()) {
            if metric.variant.includes(&run.variant) {
                *metric = metric.clone().unless(Some(&reason));
            }
        }
    }
}

/// Description of the first number in a table that is not finite: column, row and value.
fn broken(table: &Table) -> Option<String> {
    table.rows.iter().enumerate().find_map(|(row, values)| {
        let column = values.iter().position(|value| !value.is_finite())?;
        let heading = table.columns.get(column).map_or("?", String::as_str);
        let value = values[column];
        Some(format!(
            "its table {} holds {value} under `{heading}` in row {}; look for a parameter that makes the reference or \
             the average meaningless",
            table.name,
            row + 1
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Variant;

    fn run(resolution: u64) -> RunSummary {
        RunSummary {
            variant: Variant::of("resolution", resolution),
            outcome: Outcome::Finished,
            particles: 1,
            steps: 1,
            simulated_time: 1.0,
            wall_seconds: 1.0,
            threads: 1,
            microseconds_per_particle_step: None,
            state_hash: String::new(),
            from_store: false,
        }
    }

    fn table(name: &str, value: f64) -> Table {
        Table::of_rows(name.to_owned(), &["y [m]", "u [m/s]"], [vec![0.0, 1.0], vec![0.1, value]])
    }

    #[test]
    fn the_run_of_a_broken_profile_fails_and_no_other() {
        for value in [f64::NAN, f64::INFINITY] {
            let mut runs = [run(10), run(20)];
            let tables = [table("profile-resolution-10", 2.0), table("profile-resolution-20", value)];
            fail_broken_profiles(&mut runs, &tables);
            assert_eq!(runs[0].outcome, Outcome::Finished);
            let Outcome::Diverged { message, expected: false } = &runs[1].outcome else {
                panic!("{:?}", runs[1].outcome)
            };
            assert!(
                message.contains("profile-resolution-20 holds") && message.contains("`u [m/s]` in row 2"),
                "{message}"
            );
        }
    }

    #[test]
    fn a_series_may_hold_what_was_not_measured() {
        let mut runs = [run(10)];
        fail_broken_profiles(&mut runs, &[table("series-resolution-10", f64::NAN)]);
        assert_eq!(runs[0].outcome, Outcome::Finished);
    }
}
