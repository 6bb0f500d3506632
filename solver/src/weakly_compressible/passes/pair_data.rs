//! What the passes hand on to each other and reuse from step to step.

use super::records::Records;
use super::{continuity, geometry, momentum};
use crate::lanes::LANES;
use crate::vector::{Tensor, Vector};

/// Weights of all pairs, packed copies of what a loop reads of a neighbour, and buffers.
#[derive(Debug)]
pub(crate) struct PairData<const D: usize> {
    /// V_b F of every pair `[1/m²]`, chunk by chunk as in the neighbour list: made by the first pass of a step, used by
    /// the others, so that a step takes one square root a pair.
    pub(crate) weights: Vec<[f64; LANES]>,
    /// What the geometry pass reads of a neighbour.
    pub(crate) geometry: Records,
    /// What the momentum pass reads of a neighbour.
    pub(super) momentum: Records,
    /// What the continuity pass reads of a neighbour.
    pub(super) continuity: Records,
    /// Pressure and stress of the walls until they are stored, shape `[wall]`.
    pub(super) wall_stress: Vec<(f64, Tensor<D>)>,
    /// Velocities of the walls until they are stored, shape `[wall]`.
    pub(super) wall_velocity: Vec<Vector<D>>,
}

impl<const D: usize> PairData<D> {
    pub(crate) fn new() -> Self {
        Self {
            weights: Vec::new(),
            geometry: Records::new(geometry::values(D)),
            momentum: Records::new(momentum::values(D)),
            continuity: Records::new(continuity::values(D)),
            wall_stress: Vec::new(),
            wall_velocity: Vec::new(),
        }
    }
}
