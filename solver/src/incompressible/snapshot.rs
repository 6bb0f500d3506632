//! A copy of both phases in the order of the scene.

use super::Phase;
use super::state::SedimentParticles;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// One phase; every array has the shape `[free particles]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseSnapshot<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Pressures `[Pa]`.
    pub pressure: Vec<f64>,
    /// Σ V W over that of relaxed particles at their reference density `[-]`.
    pub concentration: Vec<f64>,
    /// Masses `[kg]`, per metre of width in 2-D.
    pub mass: Vec<f64>,
}

/// Both phases.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct IncompressibleSnapshot<const D: usize> {
    /// Time `[s]`.
    pub time: f64,
    /// The fluid.
    pub fluid: PhaseSnapshot<D>,
    /// The sediment, empty where there is none.
    pub sediment: PhaseSnapshot<D>,
    /// Force of the fluid on every sediment particle in the last step `[N]`, per metre of width in 2-D.
    pub drag: Vec<Vector<D>>,
}

impl<const D: usize> PhaseSnapshot<D> {
    pub(super) fn of(phase: &Phase<D>) -> Self {
        Self {
            position: phase.position.clone(),
            velocity: phase.velocity.clone(),
            pressure: phase.pressure.clone(),
            concentration: phase.concentration.clone(),
            mass: phase.mass.clone(),
        }
    }

    /// Pressure 0 and concentration 1 for grains of columns, which have no values of their own.
    pub(super) fn of_sediment(sediment: &SedimentParticles<'_, D>) -> Self {
        let SedimentParticles { position, velocity, mass, of_phase } = *sediment;
        let all = |value: f64| vec![value; position.len()];
        let own = |(pressure, concentration): (&[f64], &[f64])| (pressure.to_vec(), concentration.to_vec());
        let (pressure, concentration) = of_phase.map_or_else(|| (all(0.0), all(1.0)), own);
        let (position, velocity, mass) = (position.to_vec(), velocity.to_vec(), mass.to_vec());
        Self { position, velocity, pressure, concentration, mass }
    }
}

impl<const D: usize> IncompressibleSnapshot<D> {
    /// The state's bits, little endian, in a fixed order: equal bytes mean equal states to the last bit.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let phases = [&self.fluid, &self.sediment];
        let vectors = phases.iter().flat_map(|phase| phase.position.iter().chain(&phase.velocity));
        let scalars = phases.iter().flat_map(|phase| phase.pressure.iter().copied());
        std::iter::once(self.time)
            .chain(vectors.flat_map(|v| v.iter().copied()))
            .chain(scalars)
            .flat_map(f64::to_le_bytes)
            .collect()
    }
}
