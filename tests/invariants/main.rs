//! What must hold in every run, whatever the case: balances, symmetries, determinism, exact messages.

mod artificial_viscosity;
mod density_coupling;
mod determinism;
mod energy_ledger;
mod fields;
mod frames;
mod free_fall;
mod incompressible;
mod inlets;
mod meshes;
mod momentum_balance;
mod neighbour_list;
mod nonlocal_layers;
mod open_law;
mod pair_precision;
mod patches;
mod restart;
mod scene_errors;
mod shells;
mod stopping;
mod supports;
mod surface_operators;
mod symmetries;
mod two_phases;
mod viscous_step;
mod walls;
