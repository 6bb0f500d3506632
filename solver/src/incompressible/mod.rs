//! Incompressible flow of a fluid, alone or with a sediment that exchanges momentum with it by drag: model B.
//!
//! Reading order: [`scene`](IncompressibleScene), [`numerics`](ProjectionNumerics), then `step`, one step on a page, and
//! from there `pairs`, `closure`, `velocity_solve`, `pressure_poisson` and `shifting`. Equation numbers are those of
//! Kazemi et al., "Two-phase flow modelling of bed-load transport using a Lagrangian–Lagrangian model".
//!
//! The bed lies normal to the last axis. Both phases are sets of particles of constant volume that may overlap in
//! space. Within a phase, a pair's force is one coefficient times a difference of velocities, or a sum of pressures
//! along the line between the two: equal and opposite, so that momentum closes to rounding.

mod averaged_gradient;
mod closure;
mod drag_exchange;
mod granular_pressure;
mod grid;
mod layers;
mod mixture;
mod numerics;
mod pairs;
mod phase;
mod pressure_links;
mod pressure_poisson;
mod rows;
mod scene;
mod shifting;
mod simulation;
mod snapshot;
mod step;
mod stratification;
mod velocity_solve;

#[cfg(test)]
mod tests;

pub use numerics::{Continuity, DragSlip, MeanFlux, PairLaw, PressureSource, ProjectionNumerics, SurfaceTreatment};
pub use scene::{
    Bed, DragForm, Fluid, GranularFriction, IncompressibleScene, ParticleSet, Sediment, SedimentLaw, SedimentPressure,
    SedimentYield, SolidFraction, Turbulence,
};
pub use simulation::{IncompressibleSimulation, SolverCost};
pub use snapshot::{IncompressibleSnapshot, PhaseSnapshot};
pub(crate) use step::MOST_ITERATIONS;
pub use stratification::Stratification;
