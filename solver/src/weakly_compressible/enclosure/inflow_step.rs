//! Inlets in a step: rows that have reached their openings become particles of the flow.

use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::Quantity;
use crate::weakly_compressible::enclosure::inlet::{BLOCKED, FedRow};
use crate::weakly_compressible::energy::energy_of;
use crate::weakly_compressible::memory;
use crate::weakly_compressible::particles::Arriving;
use crate::weakly_compressible::scene::MOST_PARTICLES;
use crate::weakly_compressible::state::State;

impl<const D: usize> State<D> {
    /// Sets free the rows that have reached their openings; whether there were any, so that neighbours have to be searched.
    ///
    /// # Errors
    /// A row that the material before its opening does not give way to.
    pub(crate) fn feed(&mut self) -> Result<bool, Divergence<D>> {
        let mut fed = false;
        for inlet in 0..self.surroundings.inlets.len() {
            loop {
                let rows = self.surroundings.books.arrivals.inlets[inlet].rows;
                let beyond = self.surroundings.inlets[inlet].beyond(self.time, rows);
                if beyond < 0.0 {
                    break;
                }
                self.free_row(inlet, beyond)?;
                fed = true;
            }
        }
        Ok(fed)
    }

    /// Sets the first row of an inlet free, whose middle is so far beyond the opening `[m]`, and puts one behind the others.
    fn free_row(&mut self, inlet: usize, beyond: f64) -> Result<(), Divergence<D>> {
        self.particles.keep_real();
        let (flow, count) = (self.particles.flow_count(), self.surroundings.inlets[inlet].cells.len());
        let first = flow + self.surroundings.first_particles[inlet];
        self.check_way(inlet, first..first + count)?;
        let first_identity = self.surroundings.next_identity();
        let opening = &self.surroundings.inlets[inlet];
        let velocity = opening.direction() * opening.speed(self.time);
        let particle = |offset: usize| Arriving {
            position: opening.cells[offset] + opening.direction() * beyond,
            velocity,
            density: self.model.equation_of_state.density(self.particles.pressure[first + offset]),
            stress: self.particles.stress[first + offset],
            mass: opening.particle_mass(),
            identity: first_identity + offset as u32,
            viscosity: self.model.rheology.viscosity(0.0, 0.0),
            artificial_viscosity: self.initial_artificial_viscosity(),
            field: self.model.field.map_or(0.0, |field| field.initial),
            memory: memory::initial(self.model.rheology.memories()).unwrap_or_default(),
        };
        let arriving: Vec<Arriving<D>> = (0..count).map(particle).collect();
        self.particles.insert(&arriving);
        self.book_row(
            inlet,
            flow..flow + count,
            FedRow { inlet: inlet as u32, first: first_identity, time: self.time, beyond },
        );
        self.step_back(inlet);
        self.largest_speed = self.largest_speed.max(velocity.norm());
        Ok(())
    }

    /// What a row brings.
    fn book_row(&mut self, inlet: usize, row: std::ops::Range<usize>, free: FedRow) {
        let particles = &self.particles;
        let arrivals = &mut self.surroundings.books.arrivals;
        let fed = &mut arrivals.inlets[inlet];
        fed.rows += 1;
        fed.particles += row.len() as u64;
        for index in row {
            fed.mass += particles.mass[index];
            fed.mass_times_time += particles.mass[index] * self.time;
            fed.momentum += particles.velocity[index] * particles.mass[index];
            fed.energy += energy_of(particles, index, &self.model);
        }
        arrivals.rows.push(free);
    }

    /// Moves the rows of an inlet back by the one that has become free.
    fn step_back(&mut self, inlet: usize) {
        let shell = self.surroundings.first_inlet() + inlet;
        let place = self.surroundings.place(shell, self.time);
        let way = place - self.surroundings.displacements[shell];
        self.surroundings.displacements[shell] = place;
        let velocity = self.surroundings.velocity(shell, self.time);
        self.particles.move_walls(self.walls.len() + shell, &[way], |_| velocity);
    }

    /// Refuses a row that would be pressed into material that does not give way, or that is one too many.
    fn check_way(&self, inlet: usize, row: std::ops::Range<usize>) -> Result<(), Divergence<D>> {
        let pressures = &self.particles.pressure[row.clone()];
        let limit = BLOCKED * self.model.equation_of_state.bulk_modulus;
        let mean = pressures.iter().sum::<f64>() / row.len() as f64;
        let name = &self.surroundings.inlets[inlet].name;
        let refused = |quantity: Quantity, value: f64, rule: String| {
            let worst = row.clone().fold(row.start, |worst, index| {
                if self.particles.pressure[index] > self.particles.pressure[worst] { index } else { worst }
            });
            let mut divergence = self.divergence(worst, quantity, value);
            divergence.particle = self.surroundings.next_identity();
            divergence.rule = rule;
            Err(divergence)
        };
        if mean.is_nan() || mean > limit {
            let rule = format!(
                ", above the {limit:.4e} Pa that compress the material by a tenth: the inlet `{name}` is blocked, since the material \
                 before it does not give way"
            );
            return refused(Quantity::InflowPressure, mean, rule);
        }
        let all = self.particles.real_count() + row.len();
        if all > MOST_PARTICLES {
            let rule = format!(", and the inlet `{name}` adds some: more than the neighbour list can address");
            return refused(Quantity::Particles, self.particles.real_count() as f64, rule);
        }
        Ok(())
    }

    /// Where a particle is first, and when: one that an inlet has fed a row behind its opening, from where it moved with its
    /// row `[m]`, and the time at which it became free `[s]`. None for those of the start.
    pub(crate) fn entry(&self, identity: u32) -> Option<(Vector<D>, f64)> {
        let row = self.surroundings.books.arrivals.row_of(identity)?;
        let inlet = &self.surroundings.inlets[row.inlet as usize];
        let cell = inlet.cells.get((identity - row.first) as usize)?;
        Some((cell + inlet.direction() * (row.beyond - inlet.depth), row.time))
    }
}
