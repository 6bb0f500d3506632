//! Motion of particles with their new velocities. The first that would move by more than a spacing is an error: its
//! index and its displacement in spacings.

use super::super::{Phase, PressureSource, height_axis};
use super::pressure_poisson::PressurePoisson;
use crate::linear::TASK_ROWS;
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// A particle and its displacement in spacings `[-]`.
pub(super) type TooFar = (usize, f64);

/// Refuses a velocity `[m/s]` that leads further than a spacing in a step.
#[inline(always)]
pub(super) fn check<const D: usize>(
    particle: usize,
    velocity: Vector<D>,
    time_step: f64,
    spacing: f64,
) -> Result<(), TooFar> {
    let length = velocity.norm() * time_step;
    if length.is_nan() || length > spacing {
        return Err((particle, length / spacing));
    }
    Ok(())
}

/// Moves particles with their predicted velocities.
pub(super) fn drift<const D: usize>(
    phase: &mut Phase<D>,
    predicted: &[Vector<D>],
    time_step: f64,
) -> Result<(), TooFar> {
    for (particle, &velocity) in predicted.iter().enumerate() {
        phase.velocity[particle] = velocity;
        check(particle, velocity, time_step, phase.spacing)?;
        phase.displace(particle, velocity * time_step);
    }
    Ok(())
}

/// Moves particles along the bed only.
pub(super) fn slide<const D: usize>(phase: &mut Phase<D>, predicted: &[Vector<D>], time_step: f64) {
    for (particle, &velocity) in predicted.iter().enumerate() {
        phase.velocity[particle] = velocity;
        phase.velocity[particle][height_axis(D)] = 0.0;
        phase.displace(particle, phase.velocity[particle] * time_step);
    }
}

/// Velocities free of divergence, and the motion with them.
///
/// The displacement is that of the new velocity. By the mean of old and new (9) still water keeps vibrating: its rms velocity
/// stays near 1 mm/s where it falls below 0.1 mm/s with the new one.
pub(super) fn correct<const D: usize>(
    phase: &mut Phase<D>,
    poisson: &mut PressurePoisson<D>,
    predicted: &[Vector<D>],
    source: PressureSource,
    time_step: f64,
) -> Result<(), TooFar> {
    let Phase { velocity, position, travel, mass, pressure, lattice_volume, spacing, .. } = phase;
    let gradient = poisson.find_gradient(pressure);
    let impulse = *lattice_volume * time_step;
    let moved = (velocity, position, travel, predicted, gradient, mass).enumerate();
    let too_far =
        moved.with_min_len(TASK_ROWS).map(|(particle, (velocity, position, travel, predicted, gradient, mass))| {
            let before = *velocity;
            *velocity = predicted - gradient * (impulse / *mass);
            let mean = match source {
                PressureSource::Divergence => *velocity,
                // the particles stand at their predicted places
                PressureSource::Density => (*velocity + before) * 0.5 - predicted,
            };
            *position += mean * time_step;
            *travel += mean * time_step;
            check(particle, *velocity, time_step, *spacing)
        });
    // of several the first
    let first = |one: Result<(), TooFar>, other: Result<(), TooFar>| match (one, other) {
        (Err(one), Err(other)) => Err(if other.0 < one.0 { other } else { one }),
        (one, other) => one.and(other),
    };
    too_far.reduce(|| Ok(()), first)
}
