//! A simulation as it is kept between two programs: all that its next step follows from, and that the scene does not say.
//!
//! The candidates of the pairs are kept, because sums run in their order, and what has moved since they were searched; so
//! are the means of the velocity gradients, the pressures, the last change of the velocities and the last push of a mixture's
//! pressure, from which the solves of the next step start. Everything else a step makes anew before it reads it.

use super::columns::{Columns, Saved};
use super::neighbours::{Layers, SavedList, SavedPairs};
use super::{IncompressibleScene, IncompressibleSimulation, Phase, SolverCost, State};
use crate::run::{ContinueError, ForeignState};
use crate::vector::{Tensor, Vector};
use serde::{Deserialize, Serialize};

/// A simulation between two steps, for a file; made by [`IncompressibleSimulation::save`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SavedIncompressible<const D: usize> {
    fluid: SavedPhase<D>,
    sediment: Option<SavedPhase<D>>,
    exchange: Option<(SavedPairs, SavedPairs)>,
    grains: Option<Saved<D>>,
    layers: Layers<D>,
    mean_gradient: Vec<Tensor<D>>,
    change: Vec<Vector<D>>,
    push: Vec<Vector<D>>,
    cost: SolverCost,
    /// Iterations of the mixture's equation among those of the fluid's.
    mixture_iterations: u64,
    time: f64,
    steps: u64,
    last_step: f64,
}

/// One phase.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedPhase<const D: usize> {
    position: Vec<Vector<D>>,
    velocity: Vec<Vector<D>>,
    pressure: Vec<f64>,
    travel: Vec<Vector<D>>,
    free: SavedList,
    walls: SavedList,
}

impl<const D: usize> SavedPhase<D> {
    fn of(phase: &Phase<D>) -> Self {
        Self {
            position: phase.position.clone(),
            velocity: phase.velocity.clone(),
            pressure: phase.pressure.clone(),
            travel: phase.travel.clone(),
            free: phase.free.save(),
            walls: phase.walls.save(),
        }
    }

    fn restore(self, phase: &mut Phase<D>) -> Result<(), ForeignState> {
        let count = phase.len();
        let lengths = [self.position.len(), self.velocity.len(), self.pressure.len(), self.travel.len()];
        for length in lengths {
            ForeignState::check("particles of a phase", length, count)?;
        }
        phase.free.restore(self.free, count, count)?;
        phase.walls.restore(self.walls, count, phase.wall.len())?;
        (phase.position, phase.velocity) = (self.position, self.velocity);
        (phase.pressure, phase.travel) = (self.pressure, self.travel);
        Ok(())
    }
}

impl<const D: usize> IncompressibleSimulation<D> {
    /// The simulation as it stands, to be written and continued.
    #[must_use]
    pub fn save(&self) -> SavedIncompressible<D> {
        let State { phases, exchange, columns, search, viscosities, system, projection, .. } = &self.state;
        SavedIncompressible {
            fluid: SavedPhase::of(&phases.fluid),
            sediment: phases.sediment.as_ref().map(SavedPhase::of),
            exchange: phases.sediment.as_ref().map(|_| exchange.save()),
            grains: columns.as_ref().map(Columns::save),
            layers: search.layers.clone(),
            mean_gradient: viscosities.mean_gradient.clone(),
            change: system.change.clone(),
            push: projection.mixture.push.clone(),
            cost: self.cost(),
            mixture_iterations: projection.mixture.solver.iterations,
            time: self.state.time,
            steps: self.state.steps,
            last_step: self.state.last_step,
        }
    }
}

impl<const D: usize> State<D> {
    /// Restores a saved state of the same scene.
    pub(super) fn restore(&mut self, saved: SavedIncompressible<D>) -> Result<(), ForeignState> {
        let State { phases, exchange, columns, search, viscosities, system, projection, .. } = self;
        let particles: usize = phases.all().map(Phase::len).sum();
        ForeignState::check("sediments", saved.sediment.iter().count(), phases.sediment.iter().count())?;
        ForeignState::check("exchanges", saved.exchange.iter().count(), phases.sediment.iter().count())?;
        ForeignState::check("sets of columns", saved.grains.iter().count(), columns.iter().count())?;
        saved.fluid.restore(&mut phases.fluid)?;
        if let (Some(sediment), Some(of_sediment), Some(pairs)) = (&mut phases.sediment, saved.sediment, saved.exchange)
        {
            of_sediment.restore(sediment)?;
            exchange.restore(pairs, phases.fluid.len(), sediment)?;
        }
        if let (Some(columns), Some(grains)) = (columns, saved.grains) {
            columns.restore(grains)?;
        }
        search.restore(saved.layers, particles, saved.cost.searches)?;
        viscosities.restore(saved.mean_gradient)?;
        // empty before the first step, and without a mixture
        for rows in [saved.change.len(), saved.push.len()].into_iter().filter(|rows| *rows > 0) {
            ForeignState::check("rows of velocities", rows, particles)?;
        }
        (system.change, system.solver.iterations) = (saved.change, saved.cost.velocity_iterations);
        let of_fluid = saved.cost.fluid_pressure_iterations.saturating_sub(saved.mixture_iterations);
        projection.fluid.solver.iterations = of_fluid;
        projection.sediment.solver.iterations = saved.cost.sediment_pressure_iterations;
        (projection.mixture.push, projection.mixture.solver.iterations) = (saved.push, saved.mixture_iterations);
        (self.time, self.steps, self.last_step) = (saved.time, saved.steps, saved.last_step);
        Ok(())
    }
}

impl IncompressibleSimulation<2> {
    /// A saved simulation, to be continued bit by bit as if it had never been interrupted. `scene` is the one that it was
    /// begun with; of its free particles only the number counts.
    ///
    /// # Errors
    /// A scene that breaks a rule, a state that is not one of this scene.
    pub fn continued(scene: IncompressibleScene<2>, saved: SavedIncompressible<2>) -> Result<Self, ContinueError> {
        ContinueError::check_time(saved.time)?;
        let mut state = State::of(scene)?;
        state.restore(saved)?;
        Ok(Self { state })
    }
}
