//! Inlets in a step: rows that have reached their openings become particles of the flow.

use super::boundary_state::BoundaryState;
use super::inlet::{BLOCKED, InflowRow};
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{InRange, OutOfRange, Quantity};
use crate::weakly_compressible::energy::energy_of;
use crate::weakly_compressible::memory;
use crate::weakly_compressible::neighbours::MOST_PARTICLES;
use crate::weakly_compressible::{Model, Particles};
use std::ops::Range;

impl<const D: usize> BoundaryState<D> {
    /// Sets free the rows that have reached their openings at a time `[s]`. Returns the largest speed of these rows `[m/s]`; none if there
    /// were none.
    ///
    /// # Errors
    /// A row that the material before its opening does not give way to.
    pub(crate) fn feed(&mut self, particles: &mut Particles<D>, model: &Model<D>, time: f64) -> InRange<Option<f64>> {
        let mut fastest: Option<f64> = None;
        for inlet in 0..self.inlets.len() {
            loop {
                let rows = self.books.inflow.inlets[inlet].rows;
                let beyond = self.inlets[inlet].beyond(time, rows);
                if beyond < 0.0 {
                    break;
                }
                let speed = self.free_row(inlet, particles, model, (time, beyond))?;
                fastest = Some(speed.max(fastest.unwrap_or(0.0)));
            }
        }
        Ok(fastest)
    }

    /// Sets the first row of an inlet free, whose middle is so far beyond the opening `[m]`, and puts one behind the others. Returns
    /// its speed `[m/s]`.
    fn free_row(
        &mut self,
        inlet: usize,
        particles: &mut Particles<D>,
        model: &Model<D>,
        (time, beyond): (f64, f64),
    ) -> InRange<f64> {
        particles.keep_real();
        let count = self.inlets[inlet].cells.len();
        let first = particles.flow_count() + self.first_particles[self.first_inlet() + inlet];
        self.check_way(inlet, particles, model, first..first + count)?;
        let free = InflowRow { inlet: inlet as u32, first: self.next_identity(), time, beyond };
        let opening = &self.inlets[inlet];
        let velocity = opening.direction() * opening.speed(time);
        let initial_memory = memory::initial(model.rheology.memories()).unwrap_or_default();
        let row = particles.insert(count);
        for (offset, index) in row.clone().enumerate() {
            // the wall particle in whose place it is set free
            let wall = first + count + offset;
            particles.position[index] = opening.cells[offset] + opening.direction() * beyond;
            particles.velocity[index] = velocity;
            particles.density[index] = model.equation_of_state.density(particles.pressure[wall]);
            particles.stress[index] = particles.stress[wall];
            particles.mass[index] = opening.particle_mass();
            particles.volume[index] = particles.mass[index] / particles.density[index];
            particles.identity[index] = free.first + offset as u32;
            particles.viscosity[index] = model.rheology.viscosity(0.0, 0.0);
            particles.artificial_viscosity[index] = model.initial_artificial_viscosity();
            if let (Some(field), Some(law)) = (&mut particles.field, model.field) {
                field[index] = law.initial;
            }
            if let Some(memory) = &mut particles.memory {
                memory[index] = initial_memory;
            }
        }
        self.book_row(particles, model, row, free);
        self.step_back(inlet, particles, time);
        Ok(velocity.norm())
    }

    /// Books a row that has become free.
    fn book_row(&mut self, particles: &Particles<D>, model: &Model<D>, row: Range<usize>, free: InflowRow) {
        let arrivals = &mut self.books.inflow;
        let fed = &mut arrivals.inlets[free.inlet as usize];
        fed.rows += 1;
        fed.particles += row.len() as u64;
        for index in row {
            fed.mass += particles.mass[index];
            fed.mass_times_time += particles.mass[index] * free.time;
            fed.momentum += particles.velocity[index] * particles.mass[index];
            fed.energy += energy_of(particles, index, model);
        }
        arrivals.rows.push(free);
    }

    /// Moves the rows of an inlet back by the one that has become free.
    fn step_back(&mut self, inlet: usize, particles: &mut Particles<D>, time: f64) {
        let wall = self.first_inlet() + inlet;
        let place = self.place(wall, time);
        let way = place - self.poses[wall].shift;
        self.poses[wall].shift = place;
        let velocity = self.velocity(wall, time);
        particles.move_walls(self.plane_walls + wall, &[way], |_, _| velocity);
    }

    /// Refuses a row that would be pressed into material that does not give way, or that is one too many.
    fn check_way(&self, inlet: usize, particles: &Particles<D>, model: &Model<D>, row: Range<usize>) -> InRange<()> {
        let pressure = &particles.pressure;
        let limit = BLOCKED * model.equation_of_state.bulk_modulus;
        let mean = pressure[row.clone()].iter().sum::<f64>() / row.len() as f64;
        let (count, name) = (particles.real_count(), self.inlets[inlet].name.clone());
        let (quantity, value) = if mean.is_nan() || mean > limit {
            (Quantity::InflowPressure { inlet: name, limit }, mean)
        } else if count + row.len() > MOST_PARTICLES {
            (Quantity::Particles { inlet: name }, count as f64)
        } else {
            return Ok(());
        };
        let index = row.clone().fold(row.start, |worst, k| if pressure[k] > pressure[worst] { k } else { worst });
        Err(OutOfRange { index, identity: self.next_identity(), quantity, value })
    }

    /// First place of a particle that an inlet has fed, a row behind its opening, from where it moved with its row `[m]`, and the
    /// time at which it became free `[s]`. None for those of the start.
    pub(crate) fn entry(&self, identity: u32) -> Option<(Vector<D>, f64)> {
        let row = self.books.inflow.row_of(identity)?;
        let inlet = &self.inlets[row.inlet as usize];
        let cell = inlet.cells.get((identity - row.first) as usize)?;
        Some((cell + inlet.direction() * (row.beyond - inlet.depth), row.time))
    }
}
