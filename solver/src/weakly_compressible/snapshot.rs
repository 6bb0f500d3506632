//! A copy of the flow's state in the order of the scene, for observation, comparison and the last good state.

use crate::material::rheology::field::Memory;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::energy::EnergyAccount;
use crate::weakly_compressible::{Model, Particles};
use serde::{Deserialize, Serialize};

/// Plain state; every array has the shape `[flow particles]`, ordered by identity.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Snapshot<const D: usize> {
    /// Time `[s]`.
    pub time: f64,
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Velocity gradients `[1/s]`.
    pub velocity_gradient: Vec<Tensor<D>>,
    /// Deviatoric stresses `[Pa]`.
    pub stress: Vec<Tensor<D>>,
    /// Densities `[kg/m³]`.
    pub density: Vec<f64>,
    /// Pressures `[Pa]`, from the densities, and from the field of a law that dilates.
    pub pressure: Vec<f64>,
    /// Masses `[kg]`.
    pub mass: Vec<f64>,
    /// Field of the law for each particle, in its own unit; empty for a law without a field.
    pub field: Vec<f64>,
    /// Memory of the law beside its field, in the order in which the law declares it; empty for a law without a memory.
    pub memory: Vec<Memory<f64>>,
    /// Impulses that walls, mirror planes and contacts have given each particle since the start `[kg m/s]`; with the
    /// single divergence only.
    pub support_impulse: Vec<Vector<D>>,
    /// Energies and where they came from; with the single divergence only.
    pub energy: Option<EnergyAccount>,
}

impl<const D: usize> Snapshot<D> {
    pub(crate) fn new(time: f64, particles: &Particles<D>, model: &Model<D>, energy: Option<EnergyAccount>) -> Self {
        let order = particles.by_identity();
        fn pick<T: Copy>(array: &[T], order: &[usize]) -> Vec<T> {
            order.iter().map(|&index| array[index]).collect()
        }
        Self {
            time,
            position: pick(&particles.position, &order),
            velocity: pick(&particles.velocity, &order),
            velocity_gradient: pick(&particles.velocity_gradient, &order),
            stress: pick(&particles.stress, &order),
            pressure: order
                .iter()
                .map(|&index| model.pressure(particles.density[index], &particles.kept(index)))
                .collect(),
            density: pick(&particles.density, &order),
            mass: pick(&particles.mass, &order),
            field: particles.field.as_ref().map_or_else(Vec::new, |field| pick(field, &order)),
            memory: particles.memory.as_ref().map_or_else(Vec::new, |memory| pick(memory, &order)),
            support_impulse: pick(&particles.support_impulse, &order),
            energy,
        }
    }

    /// The state's bits, little endian, in a fixed order: equal bytes mean equal states to the last bit.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let vectors = self.position.iter().chain(&self.velocity).flat_map(|v| v.iter().copied());
        let tensors = self.stress.iter().flat_map(|t| t.iter().copied());
        std::iter::once(self.time)
            .chain(vectors)
            .chain(tensors)
            .chain(self.density.iter().copied())
            .chain(self.field.iter().copied())
            .chain(self.memory.iter().flatten().copied())
            .flat_map(f64::to_le_bytes)
            .collect()
    }
}
