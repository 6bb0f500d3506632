//! A copy of both phases in the order of the scene.

use super::columns::Grains;
use super::phase::Phase;
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

    /// Grains of columns, which have neither a pressure nor a concentration of their own.
    pub(super) fn of_grains(grains: &Grains<D>) -> Self {
        Self {
            position: grains.position.clone(),
            velocity: grains.velocity.clone(),
            pressure: vec![0.0; grains.len()],
            concentration: vec![1.0; grains.len()],
            mass: grains.mass.clone(),
        }
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
