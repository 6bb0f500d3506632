//! Initial states and measurements that several cases share: the sites of a lattice, displacements from them, a weight
//! above them, and the walls around them; fronts and the ledger of energies.

mod bulk;
pub mod energy_ledger;
mod filling;
pub mod front;
mod lattice;
pub mod rules;

pub use bagnold_solver::weakly_compressible::walls::wall::rows as wall_rows;
pub use bulk::Bulk;
pub use filling::{displaced, displaced_flow, hydrostatic_pressure};
pub use lattice::Lattice;

use bagnold_solver::weakly_compressible::numerics::Numerics;

/// Acoustic bound of the time step `[s]` at a spacing `[m]` and a speed of sound `[m/s]`, for estimates before a run.
pub fn acoustic_step(numerics: &Numerics, spacing: f64, sound_speed: f64) -> f64 {
    numerics.acoustic_courant * numerics.smoothing_ratio * spacing / sound_speed
}
