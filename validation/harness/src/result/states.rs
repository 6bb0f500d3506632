//! States that runs show on their way, as files for ParaView: a VTU file each, and a PVD file for the flow and one for the
//! walls of every run.

use super::snapshots::{collection, file_name, vtu};
use crate::case::{OutputPlan, PreparedCase, StateOutput};
use crate::observation::Frame;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// States of one run; more are no film but a mistake in the interval.
const MOST_STATES: usize = 10_000;

/// Output of the states of all runs of a case.
pub struct States {
    runs: Vec<RunStates>,
}

/// The states of one run.
struct RunStates {
    folder: PathBuf,
    name: String,
    plan: OutputPlan,
    written: Mutex<StateOutputProgress>,
}

/// Progress of the output of one run.
#[derive(Default)]
struct StateOutputProgress {
    /// Simulations of the run that have begun: a start and a stop are two.
    part: usize,
    /// Time at which the part began `[s]`, and states that were due since.
    begun: Option<(f64, u64)>,
    /// Time of the last state `[s]`.
    last: f64,
    /// Times and files.
    flow: Vec<(f64, String)>,
    walls: Vec<(f64, String)>,
    /// First error; nothing is written after it.
    problem: Option<io::Error>,
}

impl States {
    /// Writers of the states of all runs of a case, in an existing folder.
    pub fn of(case: &dyn PreparedCase, plan: &OutputPlan, folder: &Path) -> Self {
        let run = |run: usize| RunStates {
            folder: folder.to_owned(),
            name: file_name(&case.variant(run)),
            plan: plan.clone(),
            written: Mutex::default(),
        };
        Self { runs: (0..case.run_count()).map(run).collect() }
    }

    /// Returns the receiver of the states of the run with this number.
    pub fn run(&self, run: usize) -> Option<&dyn StateOutput> {
        self.runs.get(run).map(|run| run as &dyn StateOutput)
    }

    /// Writes the files that join the states of a run.
    ///
    /// # Errors
    /// Errors of writing, now or during the run; more states than anyone can look at.
    pub fn finish(self) -> io::Result<()> {
        for run in self.runs {
            let written = run.written.into_inner().unwrap_or_else(PoisonError::into_inner);
            if let Some(problem) = written.problem {
                return Err(problem);
            }
            for (what, states) in [("", &written.flow), ("-walls", &written.walls)] {
                if !states.is_empty() {
                    std::fs::write(run.folder.join(format!("{}{what}.pvd", run.name)), collection(states))?;
                }
            }
        }
        Ok(())
    }
}

impl RunStates {
    fn lock(&self) -> std::sync::MutexGuard<'_, StateOutputProgress> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Only what was asked for.
    fn chosen(&self, mut frame: Frame) -> Frame {
        let is_wanted = |name: &str| self.plan.fields.is_empty() || self.plan.fields.iter().any(|field| field == name);
        frame.scalars.retain(|(name, ..)| is_wanted(name));
        frame.vectors.retain(|(name, ..)| is_wanted(name));
        frame
    }

    fn write(&self, part: usize, number: usize, what: &str, frame: Frame) -> io::Result<String> {
        let part = if part > 1 { format!("-part-{part}") } else { String::new() };
        let folder = format!("{}{what}", self.name);
        std::fs::create_dir_all(self.folder.join(&folder))?;
        let file = format!("{folder}/state{part}_{number:05}.vtu");
        std::fs::write(self.folder.join(&file), vtu(&self.chosen(frame)))?;
        Ok(file)
    }

    fn add(&self, written: &mut StateOutputProgress, flow: Frame, walls: Option<Frame>) -> io::Result<()> {
        let number = written.flow.len();
        if number >= MOST_STATES {
            let text = format!("more than {MOST_STATES} states of {}: choose a larger output.every", self.name);
            return Err(io::Error::other(text));
        }
        let time = flow.time;
        written.flow.push((time, self.write(written.part, number, "", flow)?));
        if let Some(walls) = walls {
            written.walls.push((time, self.write(written.part, number, "-walls", walls)?));
        }
        Ok(())
    }
}

impl StateOutput for RunStates {
    fn is_due(&self, time: f64) -> bool {
        let written = self.lock();
        let Some((begun, states)) = written.begun else { return true };
        // a time before the last one is the start of another simulation
        written.problem.is_none() && (time < written.last || time >= begun + self.plan.every * states as f64)
    }

    fn take(&self, (flow, walls): (Frame, Option<Frame>)) {
        let mut written = self.lock();
        let time = flow.time;
        let begins = written.begun.is_none() || time < written.last;
        if written.problem.is_some() || (!begins && time == written.last) {
            return;
        }
        if begins {
            written.part += 1;
            written.begun = Some((time, 0));
        }
        if let Some((begun, states)) = &mut written.begun {
            // steps longer than the interval leave states out instead of crowding
            *states = (((time - *begun) / self.plan.every).floor() as u64 + 1).max(*states);
        }
        written.last = time;
        if let Err(problem) = self.add(&mut written, flow, walls) {
            written.problem = Some(problem);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn states(folder: &Path, fields: &[&str]) -> States {
        let plan = OutputPlan { every: 0.1, fields: fields.iter().map(|&field| field.to_owned()).collect() };
        let run = RunStates { folder: folder.to_owned(), name: "run".to_owned(), plan, written: Mutex::default() };
        States { runs: vec![run] }
    }

    fn frame(time: f64) -> Frame {
        Frame {
            time,
            position: vec![[0.0; 3]],
            scalars: vec![
                ("pressure".to_owned(), "Pa".to_owned(), vec![1.0]),
                ("id".to_owned(), "-".to_owned(), vec![0.0]),
            ],
            vectors: Vec::new(),
        }
    }

    #[test]
    fn states_are_taken_at_the_interval_and_a_second_simulation_is_a_part_of_its_own() {
        let folder = tempfile::tempdir().expect("a folder");
        let states = states(folder.path(), &["id"]);
        let run = states.run(0).expect("a run");
        for part in [0.0, 1.0] {
            for step in 0..=25 {
                let time = f64::from(step) * 0.01 - part * 1e-3;
                if run.is_due(time) {
                    run.take((frame(time), Some(frame(time))));
                }
            }
            run.take((frame(0.25), None));
        }
        states.finish().expect("written");
        let text = std::fs::read_to_string(folder.path().join("run.pvd")).expect("written");
        assert_eq!(text.matches("<DataSet").count(), 8, "0, 0.1, 0.2 and the end, twice: {text}");
        assert!(text.contains("run/state_00000.vtu") && text.contains("run/state-part-2_00004.vtu"), "{text}");
        let walls = std::fs::read_to_string(folder.path().join("run-walls.pvd")).expect("written");
        assert_eq!(walls.matches("<DataSet").count(), 6, "{walls}");
        let state = std::fs::read_to_string(folder.path().join("run/state_00000.vtu")).expect("written");
        assert!(state.contains("id [-]") && !state.contains("pressure"), "only what was asked for");
    }

    #[test]
    fn unwritable_files_are_reported_at_the_end() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("run"), "a file where a folder should be").expect("writable");
        let states = states(folder.path(), &[]);
        states.run(0).expect("a run").take((frame(0.0), None));
        assert!(!states.run(0).expect("a run").is_due(5.0));
        assert!(states.finish().is_err());
    }
}
