//! Incompressible flow of a fluid, alone or with a sediment that exchanges momentum with it by drag: model B.
//!
//! Reading order: [`scene`](IncompressibleScene), [`numerics`](ProjectionNumerics), then `step`, one step on a page, and
//! from there `neighbours` and `phase` (who is near whom), `boundary` (surface and bed), `passes` (loops and what they
//! store) with the formulas of a pair in `terms`, `velocity_solve` (implicit velocities) and `projection` (pressure and
//! motion). Laws stand in [`material`](crate::material): a sediment's law is any
//! [`Rheology`](crate::material::rheology::Rheology), at the load on its grains and the rate of a particle or pair.
//! Equation numbers are those of Kazemi et al., "Two-phase flow modelling of bed-load transport using a
//! Lagrangian–Lagrangian model".
//!
//! The bed lies normal to the last axis. Both phases are sets of particles of constant volume that may overlap in
//! space. Within a phase, a pair's force is one coefficient times a difference of velocities, or a sum of pressures
//! along the line between the two: equal and opposite, so that momentum closes to rounding.

mod boundary;
pub(crate) mod columns;
mod divergence;
pub(crate) mod neighbours;
mod numerics;
pub(crate) mod passes;
pub(crate) mod phase;
pub(crate) mod projection;
mod saved;
mod scene;
mod simulation;
mod snapshot;
pub(crate) mod state;
pub(crate) mod step;
mod stratification;
mod terms;
mod velocity_solve;

pub use columns::DrivenGrains;
pub(crate) use divergence::Failure;
pub(crate) use neighbours::{LEAST_GROUPS, LEAST_TASK, Periods};
pub(crate) use numerics::MOST_ITERATIONS;
pub use numerics::{
    ColumnNumerics, Continuity, DragSlip, MeanFlux, PairLaw, PressureSource, ProjectionNumerics, SurfaceTreatment,
};
pub(crate) use phase::{Phase, Phases};
pub use saved::SavedIncompressible;
pub(crate) use scene::height_axis;
pub use scene::{
    Bed, DragForm, Fluid, IncompressibleScene, ParticleSet, Sediment, SedimentLoad, SedimentPressure, SolidFraction,
    Turbulence,
};
pub use simulation::{IncompressibleSimulation, SolverCost};
pub use snapshot::{IncompressibleSnapshot, PhaseSnapshot};
pub(crate) use state::State;
pub use stratification::{Strata, Stratification};
