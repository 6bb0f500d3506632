//! Model A: weakly compressible SPH of one material, with the stress carried by each particle.
//!
//! Reading order: [`scene`] and [`numerics`], then `step`, one symplectic Euler step on a page. A step calls `passes`, the
//! loops over neighbours, and what those sum up are [`terms`], the formulas of one physical idea each.

pub mod divergence;
pub mod enclosure;
pub mod energy;
mod forces;
mod initial_particles;
mod memory;
pub(crate) mod model;
pub mod neighbours;
pub mod numerics;
pub mod particles;
mod passes;
mod saved;
pub mod scene;
mod search;
pub mod simulation;
pub mod snapshot;
pub(crate) mod state;
mod step;
pub mod terms;
pub mod time_step;
mod velocity_step;
pub(crate) mod viscous_solve;
pub(crate) mod wall_fields;
pub mod walls;

pub(crate) use energy::EnergyLedger;
pub(crate) use model::{GradientUse, Model, PairDiffusion};
pub use neighbours::VerletList;
pub(crate) use neighbours::{BLOCK, NeighbourGroup};
pub use numerics::{MomentumOperator, Numerics, ViscositySwitch, ViscousStep};
pub use particles::Particles;
pub(crate) use passes::PairData;
pub use saved::SavedSimulation;
pub use scene::Scene;
pub use simulation::Simulation;
pub use snapshot::Snapshot;
pub(crate) use state::State;
pub use walls::{Images, SideWalls, Surface, Wall, WallTreatment};
