//! Data that the passes hand on to each other and reuse from step to step.

use super::records::Records;
use crate::lanes::LANES;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::{BLOCK, EnergyLedger};

/// Weights of all pairs, packed copies of what a loop reads of a neighbour, and buffers.
#[derive(Debug, Default)]
pub struct PairData<const D: usize> {
    /// V_b F of every pair `[1/m²]`, chunk by chunk as in the neighbour list: made by the first pass of a step, used by
    /// the others, so that a step takes one square root a pair. Without meaning where pairs are in single precision.
    pub(crate) weights: Vec<[f64; LANES]>,
    /// Smallest eigenvalue of every particle's moment matrix `[-]`, where a field vanishes at the free surface: made by the first
    /// pass, used by continuity. Elsewhere a value per block without meaning.
    pub(super) eigenvalues: Vec<f64>,
    /// Neighbour records of the pass that runs, where pairs are in single precision.
    pub(super) single: Records<f32>,
    /// Neighbour records of the geometry pass.
    pub(crate) geometry: Records,
    /// Neighbour records of the momentum pass.
    pub(super) momentum: Records,
    /// Neighbour records of the continuity pass.
    pub(super) continuity: Records,
    /// Pressure and stress of the walls until they are stored, shape `[wall]`.
    pub(super) wall_stress: Vec<(f64, Tensor<D>)>,
    /// Contributions of a step to the energy ledger, block by block of particles.
    pub(crate) energy: Vec<EnergyLedger>,
    /// Velocities of the walls until they are stored, and those that continuity takes of a liquid, shape `[wall]`.
    pub(super) wall_velocity: Vec<(Vector<D>, Vector<D>)>,
}

impl<const D: usize> PairData<D> {
    /// Room for the ledger of every block of flow particles.
    pub(crate) fn open_ledger(&mut self, flow: usize) {
        self.energy.resize(flow.div_ceil(BLOCK), EnergyLedger::default());
    }

    /// Moves what the blocks have added to the ledger into a sum, in their order.
    pub(crate) fn close_ledger(&mut self, sum: &mut EnergyLedger) {
        for block in &mut self.energy {
            sum.add(std::mem::take(block));
        }
    }
}
