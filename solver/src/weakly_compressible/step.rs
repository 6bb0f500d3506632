//! One time step of model A, readable on a page.

use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::boundary::contact;
use crate::weakly_compressible::divergence::{DENSITY_RANGE, LARGEST_MACH_NUMBER, Quantity};
use crate::weakly_compressible::energy::VelocityStep;
use crate::weakly_compressible::model::GradientUse;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::numerics::{Contact, MomentumOperator, ViscousStep};
use crate::weakly_compressible::passes::{continuity, geometry, momentum, pairwise, wall_stress, wall_velocity};
use crate::weakly_compressible::state::State;
use crate::weakly_compressible::viscous_solve::{MOST_ITERATIONS, NotConverged, ViscousSolve};
use rayon::prelude::*;

impl<const D: usize> State<D> {
    /// Symplectic Euler: forces at (x, v)ⁿ → vⁿ⁺¹ → ρⁿ⁺¹, sⁿ⁺¹ → xⁿ⁺¹.
    pub(crate) fn advance(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        self.update_pressure();
        self.images.copy_scalars(&mut self.particles.pressure);
        self.images.copy_scalars(&mut self.particles.volume);
        self.images.copy_scalars(&mut self.particles.density);
        self.images.copy_tensors(&mut self.particles.stress);
        wall_stress::run(&self.model, &mut self.particles, &mut self.pairs);
        self.images.copy_scalars(&mut self.particles.pressure);
        match self.model.numerics.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence | MomentumOperator::ByLaw => {
                geometry::run(&self.model, &mut self.particles, &mut self.pairs);
                self.images.copy_vectors(&mut self.particles.pressure_gradient);
                self.images.copy_tensors(&mut self.particles.corrected_stress);
                self.images.copy_tensors(&mut self.particles.velocity_gradient);
                self.images.copy_scalars(&mut self.particles.artificial_viscosity);
                momentum::run(&self.model, &mut self.particles, &mut self.pairs);
                if self.model.numerics.viscous_step == ViscousStep::Implicit {
                    self.accelerate_by_viscosity(time_step)?;
                }
            }
            MomentumOperator::Pairwise | MomentumOperator::PairwiseCorrected => {
                if self.model.gradient_use() != GradientUse::None {
                    geometry::run(&self.model, &mut self.particles, &mut self.pairs);
                    self.images.copy_vectors(&mut self.particles.pressure_gradient);
                }
                self.images.copy_scalars(&mut self.particles.viscosity);
                self.images.copy_scalars(&mut self.particles.artificial_viscosity);
                pairwise::run(&self.model, &mut self.particles, &mut self.pairs);
            }
        }
        self.book_shells(time_step);
        self.update_velocity(time_step)?;
        self.touch_shells(time_step, self.model.contact_friction)?;
        self.update_density_and_stress(time_step)?;
        self.update_position(time_step);
        Ok(())
    }

    /// Velocity gradient and stress of the initial state, without advancing it.
    pub(crate) fn prime(&mut self) -> Result<(), Divergence<D>> {
        self.update_pressure();
        self.images.copy_scalars(&mut self.particles.pressure);
        self.images.copy_scalars(&mut self.particles.volume);
        wall_stress::run(&self.model, &mut self.particles, &mut self.pairs);
        self.images.copy_scalars(&mut self.particles.pressure);
        geometry::run(&self.model, &mut self.particles, &mut self.pairs);
        self.largest_speed = self.particles.velocity.iter().fold(0.0_f64, |most, v| most.max(v.norm()));
        self.update_density_and_stress(0.0)
    }

    fn update_pressure(&mut self) {
        let flow = self.particles.flow_count();
        let equation_of_state = self.model.equation_of_state;
        let particles = &mut self.particles;
        (&mut particles.pressure[..flow], &mut particles.volume[..flow], &particles.density[..flow], &particles.mass)
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(pressure, volume, density, mass)| {
                *pressure = equation_of_state.pressure(*density);
                *volume = mass / density;
            });
    }

    /// Accelerations that answer to the viscosity at the new velocity.
    fn accelerate_by_viscosity(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let solve = ViscousSolve { model: &self.model, pairs: &self.pairs, time_step };
        match solve.run(&mut self.particles, &self.images, &mut self.viscous) {
            Ok(()) => {
                self.energy.viscous -= self.viscous.work();
                Ok(())
            }
            Err(NotConverged { worst }) => {
                let tolerance = self.model.numerics.viscous_tolerance;
                let quantity = Quantity::ViscousResidual { tolerance, most_iterations: MOST_ITERATIONS };
                Err(self.divergence(worst, quantity, self.viscous.residual()))
            }
        }
    }

    fn update_velocity(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let flow = self.particles.flow_count();
        let largest_speed = LARGEST_MACH_NUMBER * self.model.equation_of_state.sound_speed();
        let limit = largest_speed.powi(2);
        let range = match self.model.numerics.contact {
            Contact::HalfSpacing => 0.5 * self.model.spacing,
            Contact::None => f64::NEG_INFINITY,
        };
        let (walls, friction) = (&self.walls, self.model.contact_friction);
        self.pairs.open_ledger(flow);
        let (particles, gravity) = (&mut self.particles, &self.model.gravity);
        let (acceleration, support) = (&particles.acceleration, &particles.support);
        let (position, mass) = (&particles.position[..flow], &particles.mass);
        let (by_walls, by_damping) = (&particles.by_walls, &particles.by_damping);
        let by_wall_control = &particles.by_wall_control;
        let (largest, bad) = (
            particles.velocity[..flow].par_chunks_mut(BLOCK),
            particles.support_impulse.par_chunks_mut(BLOCK),
            &mut self.pairs.energy,
        )
            .into_par_iter()
            .with_min_len(16)
            .enumerate()
            .map(|(block, (velocities, support_impulses, energy))| {
                let mut extremes = (0.0_f64, usize::MAX);
                for (offset, (velocity, support_impulse)) in velocities.iter_mut().zip(support_impulses).enumerate() {
                    let index = block * BLOCK + offset;
                    let before = *velocity;
                    let after = before + acceleration[index] * time_step;
                    let contact = contact::impulse(walls, &position[index], &after, range, friction);
                    *velocity = after + contact;
                    *support_impulse += (support[index] * time_step + contact) * mass[index];
                    VelocityStep {
                        mass: mass[index],
                        time_step,
                        gravity,
                        before,
                        after,
                        contact,
                        by_walls: &by_walls[index],
                        by_damping: &by_damping[index],
                        by_wall_control: &by_wall_control[index],
                    }
                    .add_to(energy);
                    let square = velocity.norm_squared();
                    // written so that a NaN is bad
                    extremes =
                        (extremes.0.max(square), extremes.1.min(if square <= limit { usize::MAX } else { index }));
                }
                extremes
            })
            .reduce(|| (0.0, usize::MAX), |a, b| (a.0.max(b.0), a.1.min(b.1)));
        self.pairs.close_ledger(&mut self.energy);
        self.largest_speed = largest.sqrt();
        if bad != usize::MAX {
            let speed = self.particles.velocity[bad].norm();
            return Err(self.divergence(bad, Quantity::Speed { limit: largest_speed }, speed));
        }
        Ok(())
    }

    fn update_density_and_stress(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        self.images.copy_vectors(&mut self.particles.velocity);
        wall_velocity::run(&self.model, &mut self.particles, &mut self.pairs);
        self.images.copy_vectors(&mut self.particles.velocity);
        self.images.copy_vectors(&mut self.particles.sliding_velocity);
        let extremes = continuity::run(&self.model, &mut self.particles, &mut self.pairs, time_step);
        self.pairs.close_ledger(&mut self.energy);
        self.kinematic_viscosity = match self.model.gradient_use() {
            GradientUse::None => self.particles.viscosity[0] / self.model.equation_of_state.reference_density,
            _ => extremes.kinematic_viscosity,
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
        self.particles.move_walls(0, &self.wall_displacements, |wall| walls[wall].velocity);
        self.images.copy_vectors(&mut self.particles.wall_velocity);
        fastest
    }

    fn update_position(&mut self, time_step: f64) {
        let flow = self.particles.flow_count();
        let particles = &mut self.particles;
        (&mut particles.position[..flow], &particles.velocity[..flow])
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(position, velocity): (&mut Vector<D>, &Vector<D>)| *position += velocity * time_step);
        let fastest_wall = self.move_walls(time_step).max(self.move_shells(time_step));
        self.images.copy_positions(&mut self.particles.position);
        self.displacement += time_step * self.largest_speed.max(fastest_wall);
        self.time += time_step;
        self.steps += 1;
    }
}
