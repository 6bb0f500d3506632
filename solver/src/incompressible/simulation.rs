//! An incompressible simulation as others see it: how it is set up, run and read.

use super::step::step;
use super::{IncompressibleScene, IncompressibleSnapshot, PhaseSnapshot, State};
use crate::run::observed_run::{self, Stepping};
use crate::run::{Divergence, Observer, RunProgress, SceneError, StopReason, Watching};
use crate::vector::Vector;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// A running simulation of a fluid, alone or with sediment.
#[derive(Debug)]
pub struct IncompressibleSimulation<const D: usize> {
    pub(crate) state: State<D>,
}

/// Cost of a run: iterations of its linear solves, and searches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SolverCost {
    /// Iterations of the implicit velocities.
    pub velocity_iterations: u64,
    /// Iterations of the fluid's or the mixture's pressure Poisson equation.
    pub fluid_pressure_iterations: u64,
    /// Iterations of the sediment's pressure Poisson equation.
    pub sediment_pressure_iterations: u64,
    /// Searches of candidate pairs.
    pub searches: u64,
}

/// The plane: not generic, so that the loops are compiled here and not in every crate that takes a step.
impl IncompressibleSimulation<2> {
    /// Sets up a simulation.
    ///
    /// # Errors
    /// A scene that breaks a rule.
    pub fn new(scene: IncompressibleScene<2>) -> Result<Self, SceneError> {
        Ok(Self { state: State::of(scene)? })
    }

    /// Takes one step of at most the time step of the numerics.
    ///
    /// # Errors
    /// The divergence: a particle that would move by more than its spacing, a solve that does not converge, a Reynolds
    /// number that the drag law does not cover.
    pub fn step(&mut self) -> Result<(), Divergence<2>> {
        step(&mut self.state)
    }

    /// Runs until `end` `[s]`, calling `observe` at the start, then at the first step after every multiple of
    /// `interval` `[s]`, and at the end. The observer ends the run with [`ControlFlow::Break`].
    pub fn run(&mut self, end: f64, interval: f64, observe: impl FnMut(&Self) -> ControlFlow<()>) -> StopReason<2> {
        self.follow(&mut RunProgress::new(end, interval), &mut Watching(observe))
    }

    /// Runs along a course, from its start or from where the simulation that is continued was saved.
    pub fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> StopReason<2> {
        observed_run::run(self, course, observer)
    }

    /// Force of walls and fixed grains on the fluid and the sediment in the last step `[N]`, per metre of width in 2-D:
    /// friction and drag, without what the walls' pressure gives.
    #[must_use]
    pub fn holding_force(&self) -> Vector<2> {
        let system = &self.state.system;
        let mut impulse = Vector::zeros();
        for ((velocity, sum), inertia) in system.velocity.iter().zip(&system.of_constant).zip(&system.inertia) {
            impulse -= velocity * (sum - inertia);
        }
        let time_step = self.state.last_step;
        if let Some(columns) = &self.state.columns {
            // what moves with grains is an exchange; what holds is the held grains
            for (velocity, hold) in system.velocity.iter().zip(&columns.drag.hold) {
                impulse[0] += velocity[0] * hold * time_step;
            }
            impulse[0] += columns.holding_force(time_step) * time_step;
        }
        impulse / time_step
    }

    /// Force of the fluid on every free sediment particle in the last step `[N]`, per metre of width in 2-D.
    #[must_use]
    pub fn drag(&self) -> Vec<Vector<2>> {
        if let Some(columns) = &self.state.columns {
            return columns.drag_forces(self.state.last_step).collect();
        }
        let system = &self.state.system;
        let free_fluid = self.state.phases.fluid.len();
        let rows = free_fluid..system.beside.rows;
        let of_row = |row: usize| {
            let from_fluid = system.beside.row(row).filter(|(partner, _)| (*partner as usize) < free_fluid);
            let force = |sum, (partner, coefficient): (u32, f64)| {
                sum + (system.velocity[partner as usize] - system.velocity[row]) * coefficient
            };
            from_fluid.fold(Vector::zeros(), force) / self.state.last_step
        };
        rows.map(of_row).collect()
    }

    /// A copy of the state in the order of the scene.
    #[must_use]
    pub fn snapshot(&self) -> IncompressibleSnapshot<2> {
        IncompressibleSnapshot {
            time: self.state.time,
            fluid: PhaseSnapshot::of(&self.state.phases.fluid),
            sediment: PhaseSnapshot::of_sediment(&self.state.sediment()),
            drag: self.drag(),
        }
    }
}

impl Stepping<2> for IncompressibleSimulation<2> {
    fn now(&self) -> f64 {
        self.state.time
    }

    fn steps_taken(&self) -> u64 {
        self.state.steps
    }

    fn next_step(&self) -> f64 {
        self.state.last_step
    }

    fn take_one(&mut self) -> Result<(), Divergence<2>> {
        self.step()
    }
}

impl<const D: usize> IncompressibleSimulation<D> {
    /// Time `[s]`.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Iterations and searches of the run so far.
    #[must_use]
    pub fn cost(&self) -> SolverCost {
        let State { system, projection, search, .. } = &self.state;
        SolverCost {
            velocity_iterations: system.solver.iterations,
            fluid_pressure_iterations: projection.fluid.solver.iterations + projection.mixture.solver.iterations,
            sediment_pressure_iterations: projection.sediment.solver.iterations,
            searches: search.searches,
        }
    }

    /// Free particles of both phases.
    #[must_use]
    pub fn free_particles(&self) -> usize {
        self.state.phases.fluid.len() + self.state.sediment().position.len()
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &IncompressibleScene<D> {
        &self.state.scene
    }

    /// Positions `[m]` and velocities `[m/s]` of the fluid, shape `[particles]`.
    #[must_use]
    pub fn fluid(&self) -> (&[Vector<D>], &[Vector<D>]) {
        (&self.state.phases.fluid.position, &self.state.phases.fluid.velocity)
    }

    /// Pressures of the fluid `[Pa]`.
    #[must_use]
    pub fn fluid_pressure(&self) -> &[f64] {
        &self.state.phases.fluid.pressure
    }

    /// Positions `[m]` and velocities `[m/s]` of the free sediment, shape `[particles]`; empty without sediment.
    #[must_use]
    pub fn sediment(&self) -> (&[Vector<D>], &[Vector<D>]) {
        let sediment = self.state.sediment();
        (sediment.position, sediment.velocity)
    }

    /// Part of the space that the fluid had at every fluid particle in the last step `[-]`.
    #[must_use]
    pub fn voidage(&self) -> &[f64] {
        &self.state.viscosities.voidage
    }

    /// Masses of the fluid `[kg]`, per metre of width in 2-D.
    #[must_use]
    pub fn fluid_masses(&self) -> &[f64] {
        &self.state.phases.fluid.mass
    }

    /// Masses of the free sediment `[kg]`, per metre of width in 2-D.
    #[must_use]
    pub fn sediment_masses(&self) -> &[f64] {
        self.state.sediment().mass
    }

    /// Uniform pressure gradient that has taken the mixture's mean flux out in the last step `[Pa/m]`.
    #[must_use]
    pub fn mean_pressure_gradient(&self) -> Vector<D> {
        self.state.projection.mixture.mean_gradient.unwrap_or_else(Vector::zeros)
    }
}
