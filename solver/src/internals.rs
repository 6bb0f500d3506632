//! For the tests of this package alone: parts of private modules, and arrays of particles that the interface does not show.

/// Internals of the weakly compressible model.
pub mod weakly_compressible {
    pub use crate::weakly_compressible::model::Model;
    pub use crate::weakly_compressible::state::State;
    pub use crate::weakly_compressible::viscous_solve::{
        MOST_ITERATIONS, NotConverged, ViscousSolve, ViscousSystem, lane,
    };
    pub use crate::weakly_compressible::wall_fields::WallFields;

    use crate::vector::Vector;
    use crate::weakly_compressible::energy;
    use crate::weakly_compressible::particles::Particles;
    use crate::weakly_compressible::simulation::Simulation;

    /// State of a simulation.
    pub fn state<const D: usize>(simulation: &mut Simulation<D>) -> &mut State<D> {
        &mut simulation.state
    }

    /// State alone.
    pub fn into_state<const D: usize>(simulation: Simulation<D>) -> State<D> {
        simulation.state
    }

    /// Accelerations `[m/s²]`, shape `[flow]`.
    pub fn accelerations<const D: usize>(particles: &mut Particles<D>) -> &mut [Vector<D>] {
        &mut particles.acceleration
    }

    /// Apparent viscosities `[Pa·s]`.
    pub fn viscosities<const D: usize>(particles: &Particles<D>) -> &[f64] {
        &particles.viscosity
    }

    /// Fields of wall particles.
    pub fn walls<const D: usize>(particles: &Particles<D>) -> &WallFields<D> {
        &particles.walls
    }

    /// Makes all walls smooth.
    pub fn smooth_walls<const D: usize>(particles: &mut Particles<D>) {
        particles.walls.smoothness.fill(1.0);
    }

    /// Coefficients and residual of an implicit step `[s]`.
    pub fn viscous_system<const D: usize>(state: &State<D>, time_step: f64) -> ViscousSystem<D> {
        let solve = ViscousSolve { model: &state.model, pairs: &state.pairs, time_step };
        let mut system = ViscousSystem::new();
        system.resize(&state.particles, state.model.list.region);
        solve.prepare(&state.particles, &mut system);
        system.copy_stresses(&state.images);
        solve.residual_of_start(&state.particles, &mut system);
        system
    }

    /// Energy of a particle with a storage index `[J]`.
    pub fn energy_of<const D: usize>(state: &State<D>, index: usize) -> f64 {
        energy::energy_of(&state.particles, index, &state.model)
    }
}

/// Internals of the incompressible model.
pub mod incompressible {
    pub use crate::incompressible::columns::Grains;
    pub use crate::incompressible::neighbours::{Across, Grid, LaneList, Pairs, Periods, Sources};
    pub use crate::incompressible::phase::{LatticeSums, Phase};
    pub use crate::incompressible::projection::PressurePoisson;
    pub use crate::incompressible::projection::mixture::{Mixture, Operators};
    pub use crate::incompressible::state::State;

    use crate::incompressible::passes::pair_rows::fill_rows;
    use crate::incompressible::{IncompressibleSimulation, step};

    /// Room for a search: cells, and candidates in lanes and in pairs.
    pub fn search_room<const D: usize>() -> (Grid<D>, LaneList<D>, Pairs<D>) {
        (Grid::new(), LaneList::new(), Pairs::new())
    }

    /// Removes the pressure of a mixture from a state and returns it.
    pub fn take_mixture(state: &mut State<2>) -> Mixture<2> {
        std::mem::take(&mut state.projection.mixture)
    }

    /// State of a simulation.
    pub fn state(simulation: &IncompressibleSimulation<2>) -> &State<2> {
        &simulation.state
    }

    /// Mutable state of a simulation.
    pub fn state_mut(simulation: &mut IncompressibleSimulation<2>) -> &mut State<2> {
        &mut simulation.state
    }

    /// Measures all pairs.
    pub fn measure(state: &mut State<2>) {
        step::measure(state);
    }

    /// Measures all pairs, after a search if one is due.
    pub fn search_and_measure(state: &mut State<2>) {
        state.search.search_if_due(&state.scene.domain, &mut state.phases, &mut state.exchange);
        step::measure(state);
    }

    /// Rows of the fluid's pressure at the present positions.
    pub fn fill_pressure_rows(state: &mut State<2>, poisson: &mut PressurePoisson<2>) {
        let rows = poisson.rows(&state.phases.fluid);
        fill_rows(&mut state.phases.fluid, &state.search.periods, &state.scene.numerics, rows, None);
    }

    /// These rows, and what fixes the level of the pressure.
    pub fn pressure_operator(state: &mut State<2>) -> PressurePoisson<2> {
        let mut poisson = PressurePoisson::default();
        fill_pressure_rows(state, &mut poisson);
        poisson.find_gauge(&state.phases.fluid, state.scene.numerics.surface);
        poisson
    }
}
