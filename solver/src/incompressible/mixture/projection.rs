//! The mixture's part of a step: velocities without divergence, and without a mean flux where that is asked for.
//!
//! Both velocities may still share a mean that no pressure of the particles reaches where the domain is periodic: the
//! flux of the mixture. [`MeanFlux::Zero`] takes it out by a uniform pressure gradient, as the floor of a vessel does.
//! The drag is taken before the pressure is known, and hydrostatic pressure pushes light fluid more than heavy grains: in
//! a step that began without it the drag would see a slip that is wrong by Δt ∇p (1/ρ_f − 1/ρ_s), for ever. So the
//! implicit velocities begin with the push of the last step's pressure, which is taken back before the new one is sought.

use super::Operators;
use crate::incompressible::numerics::MeanFlux;
use crate::incompressible::phase::{LatticeSums, height_axis};
use crate::incompressible::simulation::IncompressibleSimulation;
use crate::linear::NotConverged;
use crate::run::divergence::{Divergence, Quantity};
use crate::vector::Vector;

impl<const D: usize> IncompressibleSimulation<D> {
    /// Uniform pressure gradient that has taken the mixture's mean flux out in the last step `[Pa/m]`.
    #[must_use]
    pub fn mean_pressure_gradient(&self) -> Vector<D> {
        self.mixture.mean_gradient
    }

    /// Begins the implicit velocities with the push of the last step's pressure.
    pub(in crate::incompressible) fn push_by_last_pressure(&mut self, time_step: f64) {
        let rows = self.system.velocity.len();
        self.mixture.push.resize(rows, Vector::zeros());
        for row in 0..rows {
            self.system.momentum[row] += self.mixture.push[row] * (self.system.inertia[row] * time_step);
        }
    }

    /// Makes the predicted flux of the mixture free of divergence and moves the particles of both phases.
    pub(in crate::incompressible) fn project_mixture(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let numerics = self.scene.numerics;
        self.mixture.mean_gradient = Vector::zeros();
        self.find_grain_volumes();
        for (velocity, push) in self.system.velocity.iter_mut().zip(&mut self.mixture.push) {
            *velocity -= *push * time_step;
            *push = *velocity;
        }
        self.take_mean_flux_out(time_step);
        let Some(sediment) = &mut self.sediment else { return Ok(()) };
        let free_fluid = self.fluid.len();
        self.fluid_poisson.assemble(&self.fluid, &numerics);
        let kernel = self.exchange.kernel();
        let operators = Operators {
            poisson: &self.fluid_poisson,
            exchange: &self.exchange,
            share: &self.fluid_share,
            lattice_gradient: LatticeSums::of(kernel, sediment.spacing).gradient,
            fluid_volume: self.fluid.lattice_volume,
            stabilisation: numerics.stabilisation,
        };
        self.mixture.assemble(&operators, &self.fluid, sediment);
        let predicted = self.system.velocity.split_at(free_fluid);
        if let Err(NotConverged { row, residual }) =
            self.mixture.solve(&operators, &mut self.fluid, &numerics, predicted, time_step)
        {
            return Err(self.divergence(row, Quantity::PressureResidual, residual, (0.0, numerics.pressure_tolerance)));
        }
        let changes = self.mixture.fluid_change.iter().chain(&self.mixture.sediment_change);
        for (velocity, change) in self.system.velocity.iter_mut().zip(changes) {
            *velocity += change * time_step;
        }
        // what the pressure of the particles has left of it
        self.take_mean_flux_out(time_step);
        let Some(sediment) = &mut self.sediment else { return Ok(()) };
        for (push, velocity) in self.mixture.push.iter_mut().zip(&self.system.velocity) {
            *push = (velocity - *push) / time_step;
        }
        let largest = self.fluid.spacing;
        for (row, &velocity) in self.system.velocity.iter().enumerate() {
            let way = velocity.norm() * time_step;
            if way.is_nan() || way > largest {
                return Err(self.divergence(row, Quantity::Displacement, way / largest, (0.0, 1.0)));
            }
            let (phase, particle) =
                if row < free_fluid { (&mut self.fluid, row) } else { (&mut *sediment, row - free_fluid) };
            phase.velocity[particle] = velocity;
            phase.displace(particle, velocity * time_step);
        }
        Ok(())
    }

    /// Volume of the grains in every sediment particle; fixed ones have the given solid fraction.
    fn find_grain_volumes(&mut self) {
        let Some(sediment) = &self.sediment else { return };
        let layer = self.scene.solid_fraction.stratification();
        let normal = height_axis(D);
        let fixed = |place: &Vector<D>| layer.map_or(0.0, |layer| layer.at(place[normal]).solid_fraction);
        let volumes = &mut self.mixture.grain_volume;
        volumes.clear();
        volumes.extend(sediment.mass.iter().map(|mass| mass / sediment.density));
        volumes.extend(sediment.wall.iter().map(|place| fixed(place) * sediment.lattice_volume));
    }

    /// Takes the mean flux of the mixture along periods out of the predicted velocities.
    fn take_mean_flux_out(&mut self, time_step: f64) {
        let Some(sediment) = &self.sediment else { return };
        if self.scene.numerics.mean_flux == MeanFlux::Free {
            return;
        }
        let free_fluid = self.fluid.len();
        let (mut flux, mut mobility) = (Vector::zeros(), 0.0);
        let volumes = self.fluid_share.iter().map(|share| share * self.fluid.lattice_volume);
        let volumes = volumes.chain(self.mixture.grain_volume.iter().take(sediment.len()).copied());
        let density = |row: usize| if row < free_fluid { self.fluid.density } else { sediment.density };
        for (row, (velocity, volume)) in self.system.velocity.iter().zip(volumes).enumerate() {
            flux += velocity * volume;
            mobility += volume / density(row);
        }
        let gradient =
            Vector::from_fn(|axis, _| if self.periods.has(axis) { flux[axis] } else { 0.0 }) / (mobility * time_step);
        self.mixture.mean_gradient += gradient;
        for (row, velocity) in self.system.velocity.iter_mut().enumerate() {
            *velocity -= gradient * (time_step / density(row));
        }
    }
}
