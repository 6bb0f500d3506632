//! One step: implicit velocities of both phases, a pressure Poisson equation for each, correction, motion, shifting.

use super::granular_pressure::{Dilatancy, GranularPressure};
use super::numerics::{Continuity, PairLaw, PressureSource};
use super::phase::{Phase, height_axis};
use super::pressure_poisson::{Correction, PressurePoisson};
use super::scene::{SedimentPressure, SolidFraction};
use super::shifting::find_shifts;
use super::simulation::IncompressibleSimulation;
use crate::linear::{Criterion, NotConverged};
use crate::run::divergence::{Divergence, Quantity};
use crate::vector::Vector;

/// Iterations after which a solve is given up.
pub(crate) const MOST_ITERATIONS: usize = 2000;

impl<const D: usize> IncompressibleSimulation<D> {
    pub(super) fn take_step(&mut self) -> Result<(), Divergence<D>> {
        let numerics = self.scene.numerics;
        let courant_step = numerics.courant * self.scene.fluid.spacing / self.largest_speed();
        let time_step = numerics.time_step.min(courant_step);
        self.last_step = time_step;
        self.measure();
        for phase in std::iter::once(&mut self.fluid).chain(&mut self.sediment) {
            phase.find_surface(&numerics);
            phase.find_velocity_gradients();
        }
        self.average_sediment_gradients(time_step);
        self.find_granular_pressure();
        self.find_viscosities();
        self.find_drag()?;
        self.assemble_velocities(time_step);
        self.add_granular_forces(time_step);
        if numerics.continuity == Continuity::Mixture {
            self.push_by_last_pressure(time_step);
        }
        let criterion = Criterion { tolerance: numerics.velocity_tolerance, most_iterations: MOST_ITERATIONS };
        self.system.solve(criterion).map_err(|failed| {
            let NotConverged { row, residual } = failed;
            self.divergence(row, Quantity::VelocityResidual, residual, (0.0, numerics.velocity_tolerance))
        })?;
        match numerics.continuity {
            Continuity::Fluid => self.project(time_step)?,
            Continuity::Mixture => self.project_mixture(time_step)?,
        }
        if numerics.shifting > 0.0 {
            self.search_if_due();
            find_shifts(&self.fluid, &self.periods, numerics.shifting, time_step, &mut self.shifts);
            for (particle, &shift) in self.shifts.iter().enumerate() {
                self.fluid.displace(particle, shift);
            }
        }
        for phase in std::iter::once(&mut self.fluid).chain(&mut self.sediment) {
            for position in &mut phase.position {
                self.scene.domain.wrap(position);
            }
        }
        self.time += time_step;
        self.steps += 1;
        Ok(())
    }

    /// Slip and drag of every grain, stopping where the law ends.
    fn find_drag(&mut self) -> Result<(), Divergence<D>> {
        let (Some(sediment), Some(material)) = (&self.sediment, &self.scene.sediment) else { return Ok(()) };
        self.exchange.find_mean_factors(&self.fluid, sediment, &self.scene, material);
        let (reynolds, grain) = self.exchange.largest_reynolds;
        let range = material.drag.reynolds_range();
        if range.contains(&reynolds) {
            return Ok(());
        }
        Err(self.divergence(self.fluid.len() + grain, Quantity::Reynolds, reynolds, (*range.start(), *range.end())))
    }

    /// Averaged velocity gradients of the sediment, for what depends on them.
    fn average_sediment_gradients(&mut self, time_step: f64) {
        let wanted = self.scene.numerics.pair_law == PairLaw::AveragedPairRate || self.dilatancy().is_some();
        if let (true, Some(sediment)) = (wanted, &self.sediment) {
            self.sediment_rates.update(sediment, time_step);
        }
    }

    /// Solid fraction, its mean along the bed, and the pressure of grains that dilate.
    fn find_granular_pressure(&mut self) {
        let Some(dilatancy) = self.dilatancy() else { return };
        let area = self.scene.bed_area();
        let Some(sediment) = &mut self.sediment else { return };
        self.granular.find_solid_fraction(sediment, &dilatancy);
        if let SolidFraction::Averaged(layer) = &mut self.scene.solid_fraction {
            GranularPressure::average(sediment, &dilatancy, area, layer);
        }
        if let Some(layer) = self.scene.solid_fraction.stratification() {
            self.granular.find_pressures(sediment, &self.sediment_rates, &dilatancy, layer);
        }
    }

    fn add_granular_forces(&mut self, time_step: f64) {
        let (Some(dilatancy), Some(sediment)) = (self.dilatancy(), &self.sediment) else { return };
        let first = self.fluid.len();
        for particle in 0..sediment.len() {
            self.system.momentum[first + particle] += self.granular.force(sediment, particle, &dilatancy) * time_step;
        }
    }

    fn dilatancy(&self) -> Option<Dilatancy> {
        let material = self.scene.sediment.as_ref()?;
        match material.pressure {
            SedimentPressure::Dilatant { dilation, packing, fixed_filling } => {
                Some(Dilatancy { dilation, packing, grain_diameter: material.grain_diameter, fixed_filling })
            }
            SedimentPressure::Incompressible | SedimentPressure::None | SedimentPressure::AlongBed => None,
        }
    }

    /// Makes the predicted velocities of each phase free of divergence and moves its particles.
    fn project(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let free_fluid = self.fluid.len();
        for (first, is_fluid) in [(0, true), (free_fluid, false)] {
            let (phase, poisson, correction) = if is_fluid {
                (&mut self.fluid, &mut self.fluid_poisson, Correction::Both)
            } else {
                let (Some(sediment), Some(material)) = (&mut self.sediment, &self.scene.sediment) else { continue };
                match material.pressure {
                    SedimentPressure::Incompressible => {}
                    SedimentPressure::AlongBed => {
                        slide(sediment, &self.system.velocity[first..], time_step);
                        continue;
                    }
                    SedimentPressure::None | SedimentPressure::Dilatant { .. } => {
                        let moved = drift(sediment, &self.system.velocity[first..], time_step);
                        if let Err(particle) = moved {
                            let way = sediment.velocity[particle].norm() * time_step / sediment.spacing;
                            return Err(self.divergence(first + particle, Quantity::Displacement, way, (0.0, 1.0)));
                        }
                        continue;
                    }
                }
                (sediment, &mut self.sediment_poisson, Correction::CompressionOnly)
            };
            let predicted = &self.system.velocity[first..first + phase.len()];
            let numerics = self.scene.numerics;
            if numerics.pressure_source == PressureSource::Density {
                for (particle, velocity) in predicted.iter().enumerate() {
                    phase.displace(particle, velocity * time_step);
                }
                phase.measure(&self.periods);
                phase.find_surface(&numerics);
            }
            poisson.assemble(phase, &numerics);
            let solved = poisson.solve(phase, &numerics, predicted, correction, time_step);
            if let Err(NotConverged { row, residual }) = solved {
                let limits = (0.0, numerics.pressure_tolerance);
                return Err(self.divergence(first + row, Quantity::PressureResidual, residual, limits));
            }
            if let Err(particle) = correct(phase, poisson, predicted, numerics.pressure_source, time_step) {
                let way = phase.velocity[particle].norm() * time_step / phase.spacing;
                return Err(self.divergence(first + particle, Quantity::Displacement, way, (0.0, 1.0)));
            }
        }
        Ok(())
    }
}

/// Moves particles with their predicted velocities; the first that moves too far is an error.
fn drift<const D: usize>(phase: &mut Phase<D>, predicted: &[Vector<D>], time_step: f64) -> Result<(), usize> {
    for (particle, &velocity) in predicted.iter().enumerate() {
        phase.velocity[particle] = velocity;
        let way = velocity.norm() * time_step;
        if way.is_nan() || way > phase.spacing {
            return Err(particle);
        }
        phase.displace(particle, velocity * time_step);
    }
    Ok(())
}

/// Moves particles along the bed only.
fn slide<const D: usize>(phase: &mut Phase<D>, predicted: &[Vector<D>], time_step: f64) {
    for (particle, &velocity) in predicted.iter().enumerate() {
        phase.velocity[particle] = velocity;
        phase.velocity[particle][height_axis(D)] = 0.0;
        phase.displace(particle, phase.velocity[particle] * time_step);
    }
}

/// Velocities free of divergence, and the motion with them; the first particle that moves too far is an error.
///
/// The way is that of the new velocity. By the mean of old and new (9) still water keeps vibrating: its rms velocity
/// stays near 1 mm/s where it falls below 0.1 mm/s with the new one.
fn correct<const D: usize>(
    phase: &mut Phase<D>,
    poisson: &PressurePoisson<D>,
    predicted: &[Vector<D>],
    source: PressureSource,
    time_step: f64,
) -> Result<(), usize> {
    for particle in 0..phase.len() {
        let force = poisson.gradient(particle, &phase.pressure) * phase.lattice_volume;
        let velocity = predicted[particle] - force * (time_step / phase.mass[particle]);
        let before = phase.velocity[particle];
        phase.velocity[particle] = velocity;
        let way = velocity.norm() * time_step;
        if way.is_nan() || way > phase.spacing {
            return Err(particle);
        }
        let mean = match source {
            PressureSource::Divergence => velocity,
            // the particles stand at their predicted places
            PressureSource::Density => (velocity + before) * 0.5 - predicted[particle],
        };
        phase.displace(particle, mean * time_step);
    }
    Ok(())
}
