//! The formulas of one physical idea each, for eight pairs or eight particles at once. A term knows neither particles nor
//! lists nor laws: a pass gives it numbers.

pub mod artificial_stress;
pub mod artificial_viscosity;
pub mod common_motion;
pub mod continuity;
pub mod density_coupling;
pub mod field_diffusion;
pub mod hourglass;
pub mod kernel_correction;
pub mod no_slip;
pub mod pair_distance;
pub mod pair_viscosity;
pub mod pressure_force;
pub mod side_walls;
pub mod stress_diffusion;
pub mod stress_divergence;
pub mod wall_extrapolation;
pub mod wall_slip;
