//! How a run diverges: which particle, where, when, which quantity.

use crate::vector::Vector;

/// The quantity that left its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Speed above three sound speeds, or not a number.
    Speed,
    /// Density below 0.02 or above 2 reference densities, or not a number.
    Density,
    /// More neighbours than a list row can hold.
    Neighbours,
    /// Residual of an implicit viscous step over its start; the particle is the one with the largest.
    ViscousResidual,
    /// Residual of the implicit velocities of an incompressible step over its right-hand side.
    VelocityResidual,
    /// Residual of the pressure Poisson equation over its right-hand side.
    PressureResidual,
    /// Way of a particle in one incompressible step, in spacings, or not a number.
    Displacement,
    /// Reynolds number of a grain outside the range of its drag law.
    Reynolds,
}

/// A run that has left the range in which its model makes sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "diverged at t = {time:.6} s (step {step}): the {} of particle {particle} at {} is {value:.4e} {}",
    self.name(), self.place(), self.rule()
)]
pub struct Divergence<const D: usize> {
    /// Time `[s]`.
    pub time: f64,
    /// Step.
    pub step: u64,
    /// Identity of the particle.
    pub particle: u32,
    /// Its position `[m]`.
    pub position: Vector<D>,
    /// The quantity.
    pub quantity: Quantity,
    /// Its value `[m/s]`, `[kg/m³]` or `[-]`.
    pub value: f64,
    /// The largest or smallest value allowed, in the same unit.
    pub limits: (f64, f64),
}

impl<const D: usize> Divergence<D> {
    fn name(&self) -> &'static str {
        match self.quantity {
            Quantity::Speed => "speed",
            Quantity::Density => "density",
            Quantity::Neighbours => "number of neighbours",
            Quantity::ViscousResidual => "viscous step",
            Quantity::VelocityResidual => "implicit velocity",
            Quantity::PressureResidual => "pressure Poisson equation",
            Quantity::Displacement => "way in one step",
            Quantity::Reynolds => "Reynolds number",
        }
    }

    fn place(&self) -> String {
        let coordinates: Vec<String> = self.position.iter().map(|x| format!("{x:.4e}")).collect();
        format!("({}) m", coordinates.join(", "))
    }

    fn rule(&self) -> String {
        let (lower, upper) = self.limits;
        match self.quantity {
            Quantity::Speed => format!("m/s, above the {upper:.4e} m/s (three sound speeds) that the model allows"),
            Quantity::Density => format!("kg/m³, outside the {lower:.4e} to {upper:.4e} kg/m³ that the model allows"),
            Quantity::ViscousResidual => format!(
                "(residual over its start) after at most {} iterations, above the {upper:.1e} of `viscous_tolerance`",
                crate::weakly_compressible::viscous_solve::MOST_ITERATIONS
            ),
            Quantity::VelocityResidual | Quantity::PressureResidual => format!(
                "(residual over its right-hand side) after at most {} iterations, above the tolerance of {upper:.1e}",
                crate::incompressible::MOST_ITERATIONS
            ),
            Quantity::Displacement => {
                "spacings, above the 1 that the model allows; the run needs a smaller time step, or \
                                       its choice of operators is unstable"
                    .to_owned()
            }
            Quantity::Reynolds => format!("of a grain, above the {upper:.4e} at which its drag law ends"),
            Quantity::Neighbours => format!("or more, above the {upper:.0} that a neighbour list row can hold"),
        }
    }
}
