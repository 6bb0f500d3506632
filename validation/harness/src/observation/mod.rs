//! Observation of a run: plain data that does not depend on the simulation it came from.

pub mod energy;
mod energy_book;
mod motion;
pub mod pictures;

pub use energy_book::EnergyBook;
pub use motion::{MotionFrame, MotionSequence};

use serde::{Deserialize, Serialize};

/// Outcome of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Reached its end time.
    Finished,
    /// Stopped by its own criterion.
    Stopped {
        /// The criterion, in words.
        criterion: String,
    },
    /// Diverged; the last good state was kept.
    Diverged {
        /// Particle, place, time and quantity of the divergence, in words.
        message: String,
        /// Whether the case declares this divergence as its expected result.
        expected: bool,
    },
}

/// One particle picture for VTU files and field figures; every per-particle array has the same length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Time `[s]`.
    pub time: f64,
    /// Positions `[m]`, third component 0 in 2-D.
    pub position: Vec<[f64; 3]>,
    /// Named scalars with their units, such as ("pressure", "Pa", values).
    pub scalars: Vec<(String, String, Vec<f64>)>,
    /// Named vectors with their units, such as ("velocity", "m/s", values).
    pub vectors: Vec<(String, String, Vec<[f64; 3]>)>,
}

impl Frame {
    /// A scalar of every particle by its name; empty where the picture has no such scalar.
    pub fn scalar(&self, name: &str) -> &[f64] {
        self.scalars.iter().find(|(other, _, _)| other == name).map_or(&[], |(_, _, values)| values)
    }

    /// A vector of every particle by its name; empty where the picture has no such vector.
    pub fn vector(&self, name: &str) -> &[[f64; 3]] {
        self.vectors.iter().find(|(other, _, _)| other == name).map_or(&[], |(_, _, values)| values)
    }

    /// Speeds of all particles `[m/s]`.
    pub fn speeds(&self) -> Vec<f64> {
        self.vector("velocity").iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).collect()
    }

    /// Pressures of all particles `[kPa]`.
    pub fn pressures(&self) -> Vec<f64> {
        self.scalar("pressure").iter().map(|p| p * 1e-3).collect()
    }

    /// The frame whose time is nearest.
    pub fn nearest(frames: &[Self], time: f64) -> Option<&Self> {
        frames.iter().min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
    }
}

/// A run's record: the observation and how it came about.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recorded<O> {
    /// Outcome of the run.
    pub outcome: Outcome,
    /// Hash of the final state's bits in particle-identity order: the same on any machine and thread count.
    pub state_hash: String,
    /// Flow particles.
    pub particles: usize,
    /// Time steps taken.
    pub steps: u64,
    /// Simulated time `[s]`.
    pub simulated_time: f64,
    /// Wall time of the simulation `[s]`.
    pub wall_seconds: f64,
    /// Threads that the run's loops used.
    pub threads: usize,
    /// Snapshots in time order, last one the final (or last good) state.
    pub frames: Vec<Frame>,
    /// The state in which a run that diverged was found to have done so.
    pub first_bad: Option<Frame>,
    /// Data that the case measured.
    pub data: O,
}

impl<O> Recorded<O> {
    /// The same record with other data.
    pub fn map<P>(self, change: impl FnOnce(O) -> P) -> Recorded<P> {
        Recorded {
            outcome: self.outcome,
            state_hash: self.state_hash,
            particles: self.particles,
            steps: self.steps,
            simulated_time: self.simulated_time,
            wall_seconds: self.wall_seconds,
            threads: self.threads,
            frames: self.frames,
            first_bad: self.first_bad,
            data: change(self.data),
        }
    }
}

/// Hash of a state's bytes: 32 hexadecimal digits of its SHA-256.
pub fn state_hash(bytes: &[u8]) -> String {
    use sha2::Digest;
    sha2::Sha256::digest(bytes).iter().take(16).map(|byte| format!("{byte:02x}")).collect()
}
