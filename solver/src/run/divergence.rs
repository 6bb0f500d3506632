//! Divergence of a run: particle, place, time and quantity. A frame: each model fills it with its own
//! quantities and the rules that they broke.

use crate::vector::Vector;

/// The particle of what is not a particle's.
pub(crate) const NO_PARTICLE: u32 = u32::MAX;

/// A run that has left the range in which its model makes sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "diverged at t = {time:.6} s (step {step}): the {quantity}{} is {value:.4e} {unit}{rule}",
    self.subject()
)]
pub struct Divergence<const D: usize> {
    /// Time `[s]`.
    pub time: f64,
    /// Step.
    pub step: u64,
    /// Identity of the particle.
    pub particle: u32,
    /// Position `[m]`.
    pub position: Vector<D>,
    /// Name of the quantity that left its range.
    pub quantity: &'static str,
    /// Value, in its unit.
    pub value: f64,
    /// Unit, or what is counted.
    pub unit: &'static str,
    /// The rule that it broke, as it follows the value in the message: with the comma or the space that joins them.
    pub rule: String,
}

impl<const D: usize> Divergence<D> {
    fn subject(&self) -> String {
        if self.particle == NO_PARTICLE {
            return String::new();
        }
        let coordinates: Vec<String> = self.position.iter().map(|x| format!("{x:.4e}")).collect();
        format!(" of particle {} at ({}) m", self.particle, coordinates.join(", "))
    }
}
