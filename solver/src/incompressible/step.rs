//! One step: pairs, surface, gradients, laws, implicit velocities of both phases, pressure and motion, shifting.

use super::columns::relax_fluctuation;
use super::passes::pair_rows::{Friction, MiddleViscosity, fill_rows};
use super::passes::shifting::find_shifts;
use super::passes::surroundings::{Gradients, find_surroundings};
use super::projection::Flux;
use super::velocity_solve::VelocityRows;
use super::{Bed, Continuity, Failure, Phases, ProjectionNumerics, State, Turbulence};
use crate::run::Divergence;

/// Takes a step of at most the time step of the numerics.
pub(super) fn step<const D: usize>(state: &mut State<D>) -> Result<(), Divergence<D>> {
    advance(state).map_err(|failure| state.divergence(failure))
}

fn advance<const D: usize>(state: &mut State<D>) -> Result<(), Failure> {
    let numerics = state.scene.numerics;
    let time_step = numerics.time_step.min(numerics.courant * state.scene.fluid.spacing / state.largest_speed());
    state.last_step = time_step;
    state.search.search_if_due(&state.scene.domain, &mut state.phases, &mut state.exchange);
    measure(state);
    if let Some(columns) = &mut state.columns {
        let (fluid, mean) = (&state.phases.fluid, &state.viscosities.mean_gradient);
        columns.gather(&mut state.scene, fluid, if mean.is_empty() { &fluid.velocity_gradient } else { mean })?;
    }
    state.viscosities.find(&state.scene, &state.phases, time_step);
    fill_fluid_rows(state, time_step);
    find_drag(state)?;
    predict_velocities(state, time_step)?;
    advance_columns(state, time_step)?;
    project(state, time_step)?;
    shift(state, &numerics, time_step);
    state.wrap();
    state.time += time_step;
    state.steps += 1;
    Ok(())
}

/// Measures the pairs of both phases and those between them.
pub(crate) fn measure<const D: usize>(state: &mut State<D>) {
    let State { scene, phases, exchange, search, .. } = state;
    let gradients = if scene.fluid.turbulence == Turbulence::Laminar { Gradients::Skip } else { Gradients::Find };
    find_surroundings(&mut phases.fluid, &search.periods, &scene.numerics, scene.fluid.bed, gradients);
    if let Some(sediment) = &mut phases.sediment {
        // its bed is made of pairs
        find_surroundings(sediment, &search.periods, &scene.numerics, Bed::Slip, Gradients::Find);
        exchange.measure(&phases.fluid, sediment, &search.periods);
    }
}

/// Rows of the fluid's pressure and of its friction.
fn fill_fluid_rows<const D: usize>(state: &mut State<D>, time_step: f64) {
    let State { scene, phases, search, viscosities, system, projection, .. } = state;
    let water = &scene.fluid;
    let layer = scene.solid_fraction.stratification().filter(|_| water.turbulence == Turbulence::Stratified);
    let middle = layer.map(|layer| MiddleViscosity {
        layer,
        rate: &viscosities.fluid_rate,
        density: water.density,
        kinematic_viscosity: water.kinematic_viscosity,
    });
    let friction = Friction { viscosity: &viscosities.fluid, middle, time_step };
    let rows = (projection.fluid.rows(&phases.fluid), system.fluid_rows(&phases.fluid));
    fill_rows(&mut phases.fluid, &search.periods, &scene.numerics, rows.0, Some((friction, rows.1)));
}

/// Slip and drag of every grain, stopping where the law ends.
fn find_drag<const D: usize>(state: &mut State<D>) -> Result<(), Failure> {
    let Phases { fluid, sediment: Some(sediment) } = &state.phases else { return Ok(()) };
    let Some(material) = &state.scene.sediment else { return Ok(()) };
    state.exchange.find_mean_factors(fluid, sediment, &state.scene, material)
}

/// Implicit velocities under gravity, friction, drag and, for a mixture, the pressure of the last step.
fn predict_velocities<const D: usize>(state: &mut State<D>, time_step: f64) -> Result<(), Failure> {
    let State { scene, phases, exchange, search, viscosities, columns, system, projection, .. } = state;
    let (columns, periods) = (columns.as_ref().map(|columns| &columns.drag), &search.periods);
    VelocityRows { scene, phases, exchange, periods, viscosities, columns, time_step }.assemble(system);
    if scene.numerics.continuity == Continuity::Mixture {
        projection.mixture.push_by_last_pressure(system, time_step);
    }
    system.solve(&scene.numerics)
}

/// The grains of columns by the drag that the fluid has felt, and the fluid's fluctuation among all grains.
fn advance_columns<const D: usize>(state: &mut State<D>, time_step: f64) -> Result<(), Failure> {
    let State { scene, phases, columns, system, .. } = state;
    if let (Some(columns), Some(material)) = (columns.as_mut(), &scene.sediment) {
        // rows of a failure are the grains
        let first = phases.fluid.len();
        let of_grain = |failure: Failure| Failure { row: first + failure.row, ..failure };
        columns.advance(material, &system.velocity, time_step).map_err(of_grain)?;
    }
    let mean = |position: &_| columns.as_ref().map_or(0.0, |columns| columns.mean_fluid_lift(position));
    relax_fluctuation(scene, &phases.fluid, &mut system.velocity, mean, time_step);
    Ok(())
}

/// Velocities without divergence, of each phase or of their mixture, and the motion with them.
fn project<const D: usize>(state: &mut State<D>, time_step: f64) -> Result<(), Failure> {
    let State { scene, phases, exchange, viscosities, search, columns, system, projection, .. } = state;
    let periods = &search.periods;
    match scene.numerics.continuity {
        Continuity::Fluid => {
            projection.project_phases(scene, phases, &system.velocity, periods, time_step)?;
            if let Some(columns) = columns {
                columns.press(&phases.fluid, &viscosities.voidage, &system.velocity);
            }
            Ok(())
        }
        Continuity::Mixture => {
            let flux = Flux { scene, exchange, voidage: &viscosities.voidage, periods, time_step };
            projection.mixture.project(&flux, &mut projection.fluid, phases, &mut system.velocity)
        }
    }
}

/// Shifts the fluid's particles into the gaps between them.
fn shift<const D: usize>(state: &mut State<D>, numerics: &ProjectionNumerics, time_step: f64) {
    if numerics.shifting <= 0.0 {
        return;
    }
    state.search.search_if_due(&state.scene.domain, &mut state.phases, &mut state.exchange);
    let fluid = &mut state.phases.fluid;
    find_shifts(fluid, &state.search.periods, numerics, time_step, &mut state.shifts);
    for (particle, &shift) in state.shifts.iter().enumerate() {
        fluid.displace(particle, shift);
    }
}
