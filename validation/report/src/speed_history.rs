//! `speeds.csv` beside `history.csv`: what a particle-step of every case took whenever the baseline was taken anew.

use super::error::{BaselineError, read_if_there};
use crate::case::{CaseResult, Tier};
use crate::input::DOCUMENT;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A speed at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpeedRow {
    /// Version of the program.
    pub version: String,
    /// Commit that was checked out when the case ran.
    pub base_commit: String,
    /// Tier of its parameters.
    pub tier: Tier,
    /// The case.
    pub case: String,
    /// Wall time of a run per particle and step, mean over the runs that were simulated, not taken from a store `[µs]`.
    pub microseconds_per_particle_step: f64,
    /// Threads of its runs.
    pub threads: usize,
}

/// Speeds of one tier, oldest first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpeedHistory {
    /// The rows in the file's order.
    pub rows: Vec<SpeedRow>,
}

impl SpeedHistory {
    /// The file beside the history of the gated figures.
    #[must_use]
    pub fn path(history: &Path) -> PathBuf {
        history.with_file_name("speeds.csv")
    }

    /// Reads the speeds of a tier; a missing file is an empty history.
    ///
    /// # Errors
    /// If the file is there but cannot be read or is malformed.
    pub fn read(path: &Path, tier: Tier) -> Result<Self, BaselineError> {
        let Some(text) = read_if_there(path, DOCUMENT)? else { return Ok(Self::default()) };
        let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize().collect::<Result<Vec<SpeedRow>, _>>();
        let rows =
            rows.map_err(|error| BaselineError::Content { path: path.to_owned(), message: error.to_string() })?;
        Ok(Self { rows: rows.into_iter().filter(|row| row.tier == tier).collect() })
    }

    /// Appends the speed of a result whose runs were simulated; one that came out of a store says nothing new.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append(path: &Path, (version, base_commit): (&str, &str), result: &CaseResult) -> Result<(), BaselineError> {
        let fresh: Vec<_> = result.runs.iter().filter(|run| !run.from_store && run.particle_steps() > 0.0).collect();
        let steps: f64 = fresh.iter().map(|run| run.particle_steps()).sum();
        let Some(first) = fresh.first() else { return Ok(()) };
        let seconds: f64 = fresh.iter().map(|run| run.wall_seconds).sum();
        let row = SpeedRow {
            version: version.to_owned(),
            base_commit: base_commit.to_owned(),
            tier: result.tier,
            case: result.name.clone(),
            microseconds_per_particle_step: 1e6 * seconds / steps,
            threads: first.threads,
        };
        let unwritten = |source| BaselineError::Write { path: path.to_owned(), source };
        let is_new = !path.exists();
        let file = std::fs::OpenOptions::new().create(true).append(true).open(path).map_err(unwritten)?;
        let mut writer = csv::WriterBuilder::new().has_headers(is_new).from_writer(file);
        writer.serialize(row).map_err(|error| unwritten(error.into()))?;
        writer.flush().map_err(unwritten)
    }

    /// Speeds of a case, oldest first `[µs]`.
    #[must_use]
    pub fn of(&self, case: &str) -> Vec<f64> {
        let own = self.rows.iter().filter(|row| row.case == case);
        own.map(|row| row.microseconds_per_particle_step).collect()
    }
}
