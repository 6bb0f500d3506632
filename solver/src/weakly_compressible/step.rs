//! One time step of model A, readable on a page.

use crate::parallel::prelude::*;
use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{DENSITY_RANGE, Quantity};
use crate::weakly_compressible::memory;
use crate::weakly_compressible::passes::{continuity, geometry, side_walls, wall_stress, wall_velocity};
use crate::weakly_compressible::{BLOCK, GradientUse, State};

impl<const D: usize> State<D> {
    /// Symplectic Euler: forces at (x, v)ⁿ → vⁿ⁺¹ → ρⁿ⁺¹, sⁿ⁺¹ → xⁿ⁺¹.
    pub(crate) fn advance(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        self.update_pressure();
        self.extend_stress_to_walls();
        self.find_accelerations(time_step)?;
        self.enclosure.book_wall_forces(&self.model, &self.particles, &self.pairs, time_step);
        self.update_velocity(time_step)?;
        self.enclosure.press(&mut self.particles, &self.images, (self.time, time_step));
        self.touch_facets(time_step, self.model.contact_friction)?;
        self.rub_on_side_walls(time_step);
        self.extend_velocity_to_walls();
        self.update_density_and_stress(time_step)?;
        self.update_position(time_step);
        Ok(())
    }

    /// Velocity gradient and stress of the initial state, without advancing it.
    pub(crate) fn prime(&mut self) -> Result<(), Divergence<D>> {
        self.update_pressure();
        self.extend_stress_to_walls();
        geometry::run(&self.model, &mut self.particles, &mut self.pairs);
        let (velocity, frame) = (&self.particles.velocity, self.enclosure.frame);
        self.largest_speed = velocity.iter().fold(0.0, |most, v| v.norm().max(most));
        let flow = &velocity[..self.particles.flow_count()];
        self.relative_speed = flow.iter().fold(0.0, |most, v| (v - frame).norm().max(most));
        self.extend_velocity_to_walls();
        self.update_density_and_stress(0.0)
    }

    fn update_pressure(&mut self) {
        let (model, particles) = (&self.model, &mut self.particles);
        let flow = particles.flow_count();
        let (field, memory) = (particles.field.as_deref(), particles.memory.as_deref());
        (&mut particles.pressure[..flow], &mut particles.volume[..flow], &particles.density[..flow], &particles.mass)
            .enumerate()
            .with_min_len(4096)
            .for_each(|(index, (pressure, volume, density, mass))| {
                *pressure = model.pressure(*density, &memory::kept(field, memory, index));
                *volume = mass / density;
            });
    }

    /// Pressure and stress of wall particles by those of the flow.
    fn extend_stress_to_walls(&mut self) {
        self.images.copy_scalars(&mut self.particles.pressure);
        self.images.copy_scalars(&mut self.particles.volume);
        self.images.copy_scalars(&mut self.particles.density);
        self.images.copy_tensors(&mut self.particles.stress);
        wall_stress::run(&self.model, &mut self.particles, &mut self.pairs);
        self.images.copy_scalars(&mut self.particles.pressure);
    }

    /// Stops particles that approach a facet wall.
    ///
    /// # Errors
    /// A particle that has passed one.
    fn touch_facets(&mut self, time_step: f64, friction: f64) -> Result<(), Divergence<D>> {
        let Self { enclosure, model, particles, pairs, time, search, .. } = self;
        let times = (*time, time_step);
        let surroundings = (&*model, &search.domain);
        let touched = enclosure.touch(surroundings, particles, &mut pairs.energy, friction, times);
        let Some((fastest, passed)) = touched else {
            return Ok(());
        };
        self.pairs.close_ledger(&mut self.energy);
        self.largest_speed = self.largest_speed.max(fastest);
        passed.map_or(Ok(()), |passed| Err(self.diverged(passed)))
    }

    /// Lets side walls retard the flow. They come last, as what they take depends on where everything else leads to.
    fn rub_on_side_walls(&mut self, time_step: f64) {
        let Some(walls) = self.side_walls else { return };
        let blocks = self.particles.flow_count().div_ceil(BLOCK);
        self.pairs.open_ledger(self.particles.flow_count());
        self.side_wall_blocks.resize(blocks, Vector::zeros());
        let (gravity, energy, impulses) = (&self.model.gravity, &mut self.pairs.energy, &mut self.side_wall_blocks);
        side_walls::run(walls, gravity, time_step, &mut self.particles, energy, impulses);
        self.side_wall_impulse = impulses.iter().fold(self.side_wall_impulse, |sum, block| sum + block);
        self.pairs.close_ledger(&mut self.energy);
    }

    /// Velocity of wall particles by that of the flow; images take the flow's velocity and field.
    fn extend_velocity_to_walls(&mut self) {
        self.images.copy_vectors(&mut self.particles.velocity);
        wall_velocity::run(&self.model, &mut self.particles, &mut self.pairs);
        self.images.copy_vectors(&mut self.particles.velocity);
        self.images.copy_wall_vectors(&mut self.particles.walls.sliding_velocity);
        if let Some(field) = &mut self.particles.field {
            self.images.copy_scalars(field);
        }
        if let Some(memory) = &mut self.particles.memory {
            self.images.copy_scalars(memory);
        }
    }

    fn update_density_and_stress(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let extremes = continuity::run(&self.model, &mut self.particles, &mut self.pairs, time_step);
        self.pairs.close_ledger(&mut self.energy);
        self.diffusivity = match self.model.gradient_use() {
            GradientUse::None => self.particles.viscosity[0] / self.model.equation_of_state.reference_density,
            _ => extremes.diffusivity,
        };
        match extremes.bad_density {
            Some(bad) => {
                let density = self.model.equation_of_state.reference_density;
                let limits = (DENSITY_RANGE.0 * density, DENSITY_RANGE.1 * density);
                Err(self.divergence(bad, Quantity::Density { limits }, self.particles.density[bad]))
            }
            None => Ok(()),
        }
    }

    /// Moves the walls that travel; returns the speed of the fastest `[m/s]`.
    fn move_walls(&mut self, time_step: f64) -> f64 {
        if self.walls.iter().all(|wall| wall.travel <= 0.0) {
            return 0.0;
        }
        let mut fastest = 0.0_f64;
        for (wall, displacement) in self.walls.iter_mut().zip(&mut self.wall_displacements) {
            fastest = fastest.max(if wall.travel > 0.0 { wall.velocity.norm() } else { 0.0 });
            *displacement = wall.advance(time_step);
        }
        let walls = &self.walls;
        self.particles.move_walls(0, &self.wall_displacements, |wall, _| walls[wall].velocity);
        self.images.copy_wall_vectors(&mut self.particles.walls.velocity);
        fastest
    }

    fn update_position(&mut self, time_step: f64) {
        let flow = self.particles.flow_count();
        let particles = &mut self.particles;
        (&mut particles.position[..flow], &particles.velocity[..flow])
            .with_min_len(4096)
            .for_each(|(position, velocity): (&mut Vector<D>, &Vector<D>)| *position += velocity * time_step);
        let end = self.time + time_step;
        let surroundings = (&self.images, &self.search.domain);
        let fastest_facet = self.enclosure.advance(&mut self.particles, surroundings, (end, time_step));
        let fastest_wall = self.move_walls(time_step).max(fastest_facet);
        self.images.copy_positions(&mut self.particles.position);
        self.displacement += time_step * self.largest_speed.max(fastest_wall);
        self.time += time_step;
        self.steps += 1;
    }
}
