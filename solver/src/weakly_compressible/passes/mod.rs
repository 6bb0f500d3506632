//! Loops over groups of eight particles and their neighbours. A pass owns what it reads of a neighbour (its records),
//! the loop and the order of its sums; what it sums up are the formulas of `terms`. Only passes and the step call the
//! law.

pub(crate) mod continuity;
mod exchange;
mod field_diffusion;
mod flow_partner;
pub(crate) mod geometry;
pub(crate) mod layout;
pub(crate) mod momentum;
mod new_state;
mod pair_data;
mod pair_weights;
pub(crate) mod pairwise;
mod pore_pressure;
mod precision;
pub(crate) mod records;
pub(crate) mod shell_impulse;
pub(crate) mod side_walls;
mod stress_ratio;
mod wall_partner;
pub(crate) mod wall_stress;
pub(crate) mod wall_velocity;

pub(crate) use pair_data::PairData;
