//! From predicted velocities to those free of divergence, and the motion with them: a pressure for each phase, or one for
//! the mixture.

mod correction;
mod gauge;
pub(crate) mod mixture;
mod motion;
mod pressure_links;
mod pressure_poisson;

pub(super) use mixture::{Flux, Mixture};
pub use pressure_poisson::PressurePoisson;

use super::divergence::Quantity;
use super::passes::pair_rows::fill_rows;
use super::passes::surroundings::{Gradients, find_surroundings};
use super::{
    Bed, Failure, IncompressibleScene, Periods, Phase, Phases, PressureSource, ProjectionNumerics, SedimentPressure,
};
use crate::domain::Domain;
use crate::linear::NotConverged;
use crate::vector::Vector;
use correction::Correction;

/// The pressure Poisson equations of a run, reused from step to step.
#[derive(Debug, Default)]
pub struct Projection<const D: usize> {
    /// Pressure of the fluid.
    pub fluid: PressurePoisson<D>,
    pub(super) sediment: PressurePoisson<D>,
    /// Pressure of the mixture.
    pub mixture: Mixture<D>,
}

/// Inputs of the projection of one phase, besides the phase itself.
struct Prediction<'a, const D: usize> {
    velocity: &'a [Vector<D>],
    correction: Correction,
    numerics: &'a ProjectionNumerics,
    domain: &'a Domain<D>,
    periods: &'a Periods<D>,
    time_step: f64,
}

impl<const D: usize> Projection<D> {
    /// Makes the predicted velocities of each phase free of divergence and moves its particles.
    pub(super) fn project_phases(
        &mut self,
        scene: &IncompressibleScene<D>,
        phases: &mut Phases<D>,
        predicted: &[Vector<D>],
        periods: &Periods<D>,
        time_step: f64,
    ) -> Result<(), Failure> {
        let Phases { fluid, sediment } = phases;
        let (of_fluid, of_sediment) = predicted.split_at(fluid.len());
        let first = fluid.len();
        let (numerics, domain) = (&scene.numerics, &scene.domain);
        let prediction =
            |velocity, correction| Prediction { velocity, correction, numerics, domain, periods, time_step };
        project(fluid, &mut self.fluid, &prediction(of_fluid, Correction::Both))?;
        let (Some(sediment), Some(material)) = (sediment, &scene.sediment) else { return Ok(()) };
        let moved = match material.pressure {
            SedimentPressure::Incompressible => {
                let prediction = prediction(of_sediment, Correction::CompressionOnly);
                project(sediment, &mut self.sediment, &prediction)
            }
            SedimentPressure::AlongBed => {
                motion::slide(sediment, of_sediment, time_step);
                Ok(())
            }
            SedimentPressure::None | SedimentPressure::Dilatant { .. } => {
                motion::drift(sediment, of_sediment, time_step).map_err(Failure::displacement)
            }
        };
        moved.map_err(|failure| Failure { row: first + failure.row, ..failure })
    }
}

/// One phase; rows of a failure are its particles.
fn project<const D: usize>(
    phase: &mut Phase<D>,
    poisson: &mut PressurePoisson<D>,
    prediction: &Prediction<'_, D>,
) -> Result<(), Failure> {
    let &Prediction { velocity, correction, numerics, domain, periods, time_step } = prediction;
    // those of the fluid were filled with those of its friction
    let mut without_rows = correction == Correction::CompressionOnly;
    if numerics.pressure_source == PressureSource::Density {
        for (particle, velocity) in velocity.iter().enumerate() {
            phase.displace(particle, velocity * time_step);
        }
        // of the bed's friction, which was taken before, nothing is asked any more
        find_surroundings(phase, periods, numerics, Bed::Slip, Gradients::Skip);
        without_rows = true;
    }
    if without_rows {
        let rows = poisson.rows(phase);
        fill_rows(phase, periods, numerics, rows, None);
    }
    poisson.find_gauge(phase, numerics.surface);
    let solved = poisson.solve(phase, numerics, domain, velocity, correction, time_step);
    solved.map_err(|not_converged| residual(not_converged, numerics))?;
    motion::correct(phase, poisson, velocity, numerics.pressure_source, time_step).map_err(Failure::displacement)
}

/// A pressure Poisson equation that was not solved to its tolerance.
fn residual(NotConverged { row, residual }: NotConverged, numerics: &ProjectionNumerics) -> Failure {
    Failure { row, quantity: Quantity::PressureResidual, value: residual, limit: numerics.pressure_tolerance }
}
