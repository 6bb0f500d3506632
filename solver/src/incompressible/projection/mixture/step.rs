//! The mixture's part of a step: velocities without divergence, and without a mean flux where that is asked for.
//!
//! Both velocities may still share a mean that no pressure of the particles reaches where the domain is periodic: the
//! flux of the mixture. [`MeanFlux::Zero`] takes it out by a uniform pressure gradient, as the floor of a vessel does.
//! The drag is taken before the pressure is known, and hydrostatic pressure pushes light fluid more than heavy grains: in
//! a step that began without it the drag would see a slip that is wrong by Δt ∇p (1/ρ_f − 1/ρ_s), for ever. So the
//! implicit velocities begin with the push of the last step's pressure, which is taken back before the new one is sought.

use super::{Mixture, Operators};
use crate::incompressible::passes::drag_exchange::DragExchange;
use crate::incompressible::phase::LatticeSums;
use crate::incompressible::projection::{PressurePoisson, motion, residual};
use crate::incompressible::velocity_solve::VelocitySystem;
use crate::incompressible::{Failure, IncompressibleScene, MeanFlux, Periods, Phase, Phases};
use crate::vector::Vector;

/// Inputs of the mixture's flux in a step, besides its velocities.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flux<'a, const D: usize> {
    pub(crate) scene: &'a IncompressibleScene<D>,
    pub(crate) exchange: &'a DragExchange<D>,
    /// Part of the space that the fluid has at every fluid particle `[-]`.
    pub(crate) voidage: &'a [f64],
    pub(crate) periods: &'a Periods<D>,
    /// Δt `[s]`.
    pub(crate) time_step: f64,
}

impl<const D: usize> Mixture<D> {
    /// Begins the implicit velocities with the push of the last step's pressure.
    pub(crate) fn push_by_last_pressure(&mut self, system: &mut VelocitySystem<D>, time_step: f64) {
        let rows = system.velocity.len();
        self.push.resize(rows, Vector::zeros());
        for row in 0..rows {
            system.momentum[row] += self.push[row] * (system.inertia[row] * time_step);
        }
    }

    /// Makes the predicted flux of the mixture free of divergence and moves the particles of both phases.
    pub(crate) fn project(
        &mut self,
        flux: &Flux<'_, D>,
        poisson: &mut PressurePoisson<D>,
        phases: &mut Phases<D>,
        predicted: &mut [Vector<D>],
    ) -> Result<(), Failure> {
        let Flux { scene, exchange, voidage, time_step, .. } = *flux;
        let numerics = &scene.numerics;
        let Phases { fluid, sediment: Some(sediment) } = phases else { return Ok(()) };
        self.mean_gradient = None;
        self.find_grain_volumes(scene, sediment);
        for (velocity, push) in predicted.iter_mut().zip(&mut self.push) {
            *velocity -= *push * time_step;
            *push = *velocity;
        }
        self.take_mean_flux_out(flux, fluid, sediment, predicted);
        poisson.find_gauge(fluid, numerics.surface);
        let operators = Operators {
            poisson,
            exchange,
            voidage,
            lattice_gradient: LatticeSums::of(exchange.kernel(), sediment.spacing).gradient,
            fluid_volume: fluid.lattice_volume,
            stabilisation: numerics.stabilisation,
        };
        self.assemble(&operators, fluid, sediment);
        self.solve(&operators, fluid, (numerics, &scene.domain), predicted.split_at(fluid.len()), time_step)
            .map_err(|not_converged| residual(not_converged, numerics))?;
        let changes = self.fluid_change.iter().chain(&self.sediment_change);
        for (velocity, change) in predicted.iter_mut().zip(changes) {
            *velocity += change * time_step;
        }
        // what the pressure of the particles has left of it
        self.take_mean_flux_out(flux, fluid, sediment, predicted);
        for (push, velocity) in self.push.iter_mut().zip(&*predicted) {
            *push = (velocity - *push) / time_step;
        }
        let (free_fluid, largest) = (fluid.len(), fluid.spacing);
        for (row, &velocity) in predicted.iter().enumerate() {
            motion::check(row, velocity, time_step, largest).map_err(Failure::displacement)?;
            let (phase, particle) =
                if row < free_fluid { (&mut *fluid, row) } else { (&mut *sediment, row - free_fluid) };
            phase.velocity[particle] = velocity;
            phase.displace(particle, velocity * time_step);
        }
        Ok(())
    }

    /// Volume of the grains in every sediment particle; fixed ones have the given solid fraction.
    fn find_grain_volumes(&mut self, scene: &IncompressibleScene<D>, sediment: &Phase<D>) {
        let layer = scene.solid_fraction.stratification();
        let fixed = |place: &Vector<D>| layer.map_or(0.0, |layer| layer.solid_fraction_at(place));
        self.grain_volume.clear();
        self.grain_volume.extend(sediment.mass.iter().map(|mass| mass / sediment.density));
        self.grain_volume.extend(sediment.wall.iter().map(|place| fixed(place) * sediment.lattice_volume));
    }

    /// Takes the mean flux of the mixture along periods out of the predicted velocities.
    fn take_mean_flux_out(
        &mut self,
        flux: &Flux<'_, D>,
        fluid: &Phase<D>,
        sediment: &Phase<D>,
        predicted: &mut [Vector<D>],
    ) {
        if flux.scene.numerics.mean_flux == MeanFlux::Free {
            return;
        }
        let time_step = flux.time_step;
        let (mut sum, mut mobility) = (Vector::zeros(), 0.0);
        let volumes = flux.voidage.iter().map(|voidage| voidage * fluid.lattice_volume);
        let volumes = volumes.chain(self.grain_volume.iter().take(sediment.len()).copied());
        let density = |row: usize| if row < fluid.len() { fluid.density } else { sediment.density };
        for (row, (velocity, volume)) in predicted.iter().zip(volumes).enumerate() {
            sum += velocity * volume;
            mobility += volume / density(row);
        }
        let along = Vector::from_fn(|axis, _| if flux.periods.has(axis) { sum[axis] } else { 0.0 });
        let gradient = along / (mobility * time_step);
        *self.mean_gradient.get_or_insert_with(Vector::zeros) += gradient;
        for (row, velocity) in predicted.iter_mut().enumerate() {
            *velocity -= gradient * (time_step / density(row));
        }
    }
}
