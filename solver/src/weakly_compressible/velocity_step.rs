//! Velocities in a step: the kick, the contact with walls, and the work of both.

use crate::run::Divergence;
use crate::weakly_compressible::boundary::contact;
use crate::weakly_compressible::divergence::{LARGEST_MACH_NUMBER, Quantity};
use crate::weakly_compressible::energy::VelocityStep;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::numerics::Contact;
use crate::weakly_compressible::state::State;
use rayon::prelude::*;

impl<const D: usize> State<D> {
    /// New velocities, with what walls stop and what each force has worked.
    ///
    /// # Errors
    /// A particle faster than the model allows.
    pub(crate) fn update_velocity(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
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
}
