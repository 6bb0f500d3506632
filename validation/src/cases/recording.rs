//! From a simulation that has ended to its record.

use crate::observe::{Frame, Outcome, Recorded, state_hash};
use bagnold_solver::simulation::{Simulation, StopReason};
use bagnold_solver::snapshot::Snapshot;
use bagnold_solver::vector::{Vector, equivalent_shear_stress, shear_rate};
use std::time::Instant;

/// How a run ended, and what it left on its way.
pub(super) struct Ending<const D: usize> {
    /// Why it ended.
    pub(super) reason: StopReason<D>,
    /// The state that was observed last.
    pub(super) last_good: Snapshot<D>,
    /// The criterion by which the observer stops a run, in words.
    pub(super) criterion: String,
    /// Whether a divergence is a result and not an error.
    pub(super) may_diverge: bool,
    /// Pictures on the way; the last state is added to them.
    pub(super) frames: Vec<Frame>,
    /// When the run was started.
    pub(super) started: Instant,
}

impl<const D: usize> Ending<D> {
    /// The record, with the data that `measure` takes from the last state: the last good one after a divergence.
    pub(super) fn record<O>(self, simulation: &Simulation<D>, measure: impl FnOnce(&Snapshot<D>) -> O) -> Recorded<O> {
        let (outcome, end) = match self.reason {
            StopReason::Finished => (Outcome::Finished, simulation.snapshot()),
            StopReason::Stopped => (Outcome::Stopped { criterion: self.criterion }, simulation.snapshot()),
            StopReason::Diverged(divergence) => {
                (Outcome::Diverged { message: divergence.to_string(), expected: self.may_diverge }, self.last_good)
            }
        };
        let mut frames = self.frames;
        frames.push(Frame::of_flow(&end));
        Recorded {
            outcome,
            state_hash: state_hash(&end.to_bytes()),
            particles: simulation.particles().flow_count(),
            steps: simulation.steps(),
            simulated_time: simulation.time(),
            wall_seconds: self.started.elapsed().as_secs_f64(),
            threads: rayon::current_num_threads(),
            frames,
            data: measure(&end),
        }
    }
}

impl Frame {
    /// A picture of the flow, in the plane or in space.
    pub(super) fn of_flow<const D: usize>(snapshot: &Snapshot<D>) -> Self {
        let flat = |v: &Vector<D>| [v[0], v[1], if D == 3 { v[2] } else { 0.0 }];
        Self {
            time: snapshot.time,
            position: snapshot.position.iter().map(flat).collect(),
            scalars: vec![
                ("pressure".to_owned(), "Pa".to_owned(), snapshot.pressure.clone()),
                ("density".to_owned(), "kg/m³".to_owned(), snapshot.density.clone()),
                ("shear_stress".to_owned(), "Pa".to_owned(), snapshot.stress.iter().map(|s| s[(0, 1)]).collect()),
                ("viscosity".to_owned(), "Pa·s".to_owned(), apparent_viscosities(snapshot)),
            ],
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), snapshot.velocity.iter().map(flat).collect())],
        }
    }
}

/// Shear rate below which an apparent viscosity is no longer told from that of a solid `[1/s]`.
const NO_SHEAR: f64 = 1e-6;

/// Apparent viscosity τ/|γ̇| `[Pa·s]` of every particle.
fn apparent_viscosities<const D: usize>(snapshot: &Snapshot<D>) -> Vec<f64> {
    let viscosity = |(stress, gradient)| equivalent_shear_stress(stress) / shear_rate(gradient).max(NO_SHEAR);
    snapshot.stress.iter().zip(&snapshot.velocity_gradient).map(viscosity).collect()
}
