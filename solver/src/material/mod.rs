//! Every law of both models, each once: a function of rate, pressure or load, with all its constants as parameters.

pub mod dilatancy;
pub mod drag;
pub mod equation_of_state;
pub mod pore_liquid;
pub mod rheology;
pub mod suspension_viscosity;
pub mod turbulence;
