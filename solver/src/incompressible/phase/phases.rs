//! Both phases, and the rows that their free particles have in the velocity system.

use super::Phase;
use crate::domain::Domain;

/// The fluid and the sediment, if there is one.
#[derive(Debug)]
pub struct Phases<const D: usize> {
    /// The fluid.
    pub fluid: Phase<D>,
    /// The sediment, where there is one.
    pub sediment: Option<Phase<D>>,
}

impl<const D: usize> Phases<D> {
    pub(crate) fn all(&self) -> impl Iterator<Item = &Phase<D>> + Clone {
        std::iter::once(&self.fluid).chain(&self.sediment)
    }

    /// Every phase.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Phase<D>> {
        std::iter::once(&mut self.fluid).chain(&mut self.sediment)
    }

    /// Puts all particles back into their periods.
    pub fn wrap(&mut self, domain: &Domain<D>) {
        for phase in self.all_mut() {
            for position in &mut phase.position {
                domain.wrap(position);
            }
        }
    }

    /// Largest speed of any particle `[m/s]`.
    pub(crate) fn largest_speed(&self) -> f64 {
        let velocities = self.all().flat_map(|phase| &phase.velocity);
        velocities.fold(0.0_f64, |most, velocity| most.max(velocity.norm_squared())).sqrt()
    }
}
