//! One step: pairs, surface, gradients, laws, implicit velocities of both phases, pressure and motion, shifting.

use super::boundary::find_surface;
use super::divergence::Failure;
use super::numerics::{Continuity, PairLaw, ProjectionNumerics};
use super::passes::granular_pressure::{Dilating, average_fraction};
use super::passes::shifting::find_shifts;
use super::passes::velocity_gradients::find_velocity_gradients;
use super::phase::Phases;
use super::projection::Flux;
use super::scene::SolidFraction;
use super::state::State;
use super::velocity_solve::VelocityRows;
use crate::run::Divergence;

/// Takes a step of at most the time step of the numerics.
pub(super) fn step<const D: usize>(state: &mut State<D>) -> Result<(), Divergence<D>> {
    advance(state).map_err(|failure| state.divergence(failure))
}

fn advance<const D: usize>(state: &mut State<D>) -> Result<(), Failure> {
    let numerics = state.scene.numerics;
    let time_step = numerics.time_step.min(numerics.courant * state.scene.fluid.spacing / state.phases.largest_speed());
    state.last_step = time_step;
    state.search.measure(&state.scene.domain, &mut state.phases, &mut state.exchange);
    for phase in state.phases.all_mut() {
        find_surface(phase, &numerics);
        find_velocity_gradients(phase, numerics.largest_correction);
    }
    let dilating = state.scene.sediment.as_ref().and_then(Dilating::of);
    average_rates(state, dilating.is_some(), time_step);
    find_granular_pressure(state, dilating);
    state.viscosities.find(&state.scene, &state.phases);
    find_drag(state)?;
    predict_velocities(state, dilating, time_step)?;
    project(state, time_step)?;
    shift(state, &numerics, time_step);
    state.phases.wrap(&state.scene.domain);
    state.time += time_step;
    state.steps += 1;
    Ok(())
}

/// Averaged velocity gradients of the sediment, for what depends on them.
fn average_rates<const D: usize>(state: &mut State<D>, dilating: bool, time_step: f64) {
    let numerics = &state.scene.numerics;
    if let (true, Some(sediment)) = (dilating || numerics.pair_law == PairLaw::AveragedPairRate, &state.phases.sediment)
    {
        state.rates.update(sediment, time_step, numerics.rate_averaging_time);
    }
}

/// Solid fraction, its mean along the bed, and the pressure of grains that dilate.
fn find_granular_pressure<const D: usize>(state: &mut State<D>, dilating: Option<Dilating>) {
    let (Some(Dilating { law, fixed_filling }), Some(sediment)) = (dilating, &mut state.phases.sediment) else {
        return;
    };
    let (numerics, area) = (state.scene.numerics, state.scene.bed_area());
    state.granular.find_solid_fraction(sediment, fixed_filling, numerics.least_fraction);
    if let SolidFraction::Averaged(layer) = &mut state.scene.solid_fraction {
        average_fraction(sediment, fixed_filling, numerics.fraction_spread, area, layer);
    }
    if let Some(layer) = state.scene.solid_fraction.stratification() {
        state.granular.find_pressures(sediment, &state.rates, &law, layer);
    }
}

/// Slip and drag of every grain, stopping where the law ends.
fn find_drag<const D: usize>(state: &mut State<D>) -> Result<(), Failure> {
    let Phases { fluid, sediment: Some(sediment) } = &state.phases else { return Ok(()) };
    let Some(material) = &state.scene.sediment else { return Ok(()) };
    state.exchange.find_mean_factors(fluid, sediment, &state.scene, material)
}

/// Implicit velocities under gravity, friction, drag, the pressure of the grains and, for a mixture, that of the last step.
fn predict_velocities<const D: usize>(
    state: &mut State<D>,
    dilating: Option<Dilating>,
    time_step: f64,
) -> Result<(), Failure> {
    let State { scene, phases, exchange, viscosities, rates, system, granular, projection, .. } = state;
    VelocityRows { scene, phases, exchange, viscosities, rates, time_step }.assemble(system);
    if let (Some(Dilating { fixed_filling, .. }), Some(sediment)) = (dilating, &phases.sediment) {
        for particle in 0..sediment.len() {
            let force = granular.force(sediment, particle, fixed_filling);
            system.momentum[phases.fluid.len() + particle] += force * time_step;
        }
    }
    if scene.numerics.continuity == Continuity::Mixture {
        projection.mixture.push_by_last_pressure(system, time_step);
    }
    system.solve(&scene.numerics)
}

/// Velocities without divergence, of each phase or of their mixture, and the motion with them.
fn project<const D: usize>(state: &mut State<D>, time_step: f64) -> Result<(), Failure> {
    let State { scene, phases, exchange, viscosities, search, system, projection, .. } = state;
    let periods = &search.periods;
    match scene.numerics.continuity {
        Continuity::Fluid => projection.project_phases(scene, phases, &system.velocity, periods, time_step),
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
