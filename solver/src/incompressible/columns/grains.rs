//! The grains as particles: they carry mass and momentum from step to step, and nothing else.

use super::super::{Failure, Sediment};
use crate::domain::Domain;
use crate::vector::Vector;

/// Free particles of dilating sediment; arrays have the shape `[particles]`.
#[derive(Debug)]
pub struct Grains<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Masses `[kg]`, per metre of width in 2-D.
    pub(crate) mass: Vec<f64>,
    /// Spacing `[m]`.
    spacing: f64,
}

impl<const D: usize> Grains<D> {
    pub(crate) fn of(sediment: &Sediment<D>) -> Self {
        let full = sediment.density * sediment.spacing.powi(D as i32);
        Self {
            position: sediment.particles.position.clone(),
            velocity: sediment.particles.velocity.clone(),
            mass: sediment.filling.iter().map(|filling| full * filling).collect(),
            spacing: sediment.spacing,
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Puts all particles back into their periods.
    pub(crate) fn wrap(&mut self, domain: &Domain<D>) {
        for position in &mut self.position {
            domain.wrap(position);
        }
    }

    /// Largest speed of a particle `[m/s]`.
    pub(crate) fn largest_speed(&self) -> f64 {
        self.velocity.iter().fold(0.0_f64, |most, velocity| most.max(velocity.norm_squared())).sqrt()
    }

    /// Moves a particle.
    ///
    /// # Errors
    /// A way longer than its spacing, or no number.
    #[inline]
    pub(crate) fn displace(&mut self, particle: usize, way: Vector<D>) -> Result<(), Failure> {
        let length = way.norm();
        if length.is_nan() || length > self.spacing {
            return Err(Failure::displacement((particle, length / self.spacing)));
        }
        self.position[particle] += way;
        Ok(())
    }
}
