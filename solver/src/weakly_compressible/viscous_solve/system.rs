//! Storage of a solve: coefficients and vectors in groups of eight particles, as the neighbour list has them, and
//! records of the neighbours for the pair loops.

use super::lane;
use crate::lanes::LANES;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::passes::records::Records;
use crate::weakly_compressible::{BLOCK, Images, Particles};

/// Groups per block of the parallel loops.
pub(super) const GROUPS: usize = BLOCK / LANES;

/// A vector of eight particles.
pub(super) type LaneVector<const D: usize> = [[f64; LANES]; D];

/// Coefficients of eight particles.
#[derive(Debug, Clone, Copy)]
pub struct Coefficients<const D: usize> {
    /// Σ_b w r + (1 − ½ χ) Σ_w w β r `[1/m]`, the factor of the particle's own velocity in its gradient.
    pub(super) closure: LaneVector<D>,
    /// L `[-]`.
    pub(super) correction: [LaneVector<D>; D],
    /// 2 η `[Pa·s]`.
    pub(super) twice_viscosity: [f64; LANES],
    /// Masses `[kg]`; 1 where there is no particle.
    pub(super) mass: [f64; LANES],
    /// 1 − ½ χ, with the share χ of the viscosity that holds to a wall by the velocity `[-]`.
    pub(super) shared: [f64; LANES],
    /// 2 η of what holds to a wall by the velocity, less what the first line has of it `[Pa·s]`.
    pub(super) hold: [f64; LANES],
    /// Mass and the resistance of the walls, Δt V Σ_w (−w) 2 η β min(β, 2) (n·L r)/(n·r) `[kg]`.
    pub(super) inertia: [f64; LANES],
    /// Δt V `[s m^D]`.
    pub(super) impulse_volume: [f64; LANES],
    /// Reciprocal of the diagonal of M + Δt K `[1/kg]`.
    pub inverse_diagonal: [f64; LANES],
}

/// The vectors of the iteration for eight particles.
#[derive(Debug, Clone, Copy)]
pub struct Unknowns<const D: usize> {
    /// δ `[m/s]`.
    pub increment: LaneVector<D>,
    /// Residual `[kg m/s]`.
    pub residual: LaneVector<D>,
    /// Search direction `[m/s]`.
    pub direction: LaneVector<D>,
    /// (M + Δt K) times the direction `[kg m/s]`.
    pub product: LaneVector<D>,
}

/// Sums over a block of [`BLOCK`] particles: each lane adds up its particles, then the lanes are added in order, and
/// last the blocks, so that the bits depend neither on the threads nor on the instruction set.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BlockSums {
    /// Σ r²/m `[kg m²/s²]`.
    pub(super) residual: f64,
    /// r·D⁻¹r.
    pub(super) descent: f64,
    /// p·(M + Δt K)p.
    pub(super) curvature: f64,
}

/// Buffers of the solve, reused from step to step, and its counts.
#[derive(Debug)]
pub struct ViscousSystem<const D: usize> {
    /// Coefficients of all groups.
    pub coefficients: Vec<Coefficients<D>>,
    /// Vectors of all groups.
    pub unknowns: Vec<Unknowns<D>>,
    /// w r of every flow pair `[1/m]`, chunk by chunk as in the neighbour list.
    pub(super) pair_vectors: Vec<LaneVector<D>>,
    /// Velocity, or search direction, of every particle.
    pub(super) velocities: Records,
    /// s L of every flow particle and image; before the iteration √(η/V) L, for the diagonal.
    pub(super) stresses: Records,
    pub(super) sums: Vec<BlockSums>,
    /// Iterations of all solves.
    pub iterations: u64,
    /// Relative residual of the solve that failed `[-]`.
    pub residual: f64,
    /// Work of the last solve `[J]`: that of the viscous forces beside those of the explicit step.
    pub(crate) work: f64,
}

impl<const D: usize> ViscousSystem<D> {
    pub(crate) fn new() -> Self {
        Self {
            coefficients: Vec::new(),
            unknowns: Vec::new(),
            pair_vectors: Vec::new(),
            velocities: Records::new(D),
            stresses: Records::new(D * D),
            sums: Vec::new(),
            iterations: 0,
            residual: 0.0,
            work: 0.0,
        }
    }

    /// Room for the particles and for neighbour lists with `region` chunks a block.
    pub(crate) fn resize(&mut self, particles: &Particles<D>, region: usize) {
        let (flow, all) = (particles.flow_count(), particles.position.len());
        let zero = [[0.0; LANES]; D];
        let coefficients = Coefficients {
            closure: zero,
            correction: [zero; D],
            twice_viscosity: [0.0; LANES],
            mass: [1.0; LANES],
            shared: [1.0; LANES],
            hold: [0.0; LANES],
            inertia: [1.0; LANES],
            impulse_volume: [0.0; LANES],
            inverse_diagonal: [1.0; LANES],
        };
        let unknowns = Unknowns { increment: zero, residual: zero, direction: zero, product: zero };
        self.coefficients.resize(flow.div_ceil(LANES), coefficients);
        self.unknowns.resize(flow.div_ceil(LANES), unknowns);
        self.sums.resize(flow.div_ceil(BLOCK), BlockSums::default());
        self.pair_vectors.resize(flow.div_ceil(BLOCK) * region, zero);
        for records in [&mut self.velocities, &mut self.stresses] {
            records.resize(all);
        }
    }

    /// Copies velocities to the images.
    pub(super) fn copy_velocities(&mut self, images: &Images<D>) {
        for (slot, source, sign) in images.entries() {
            self.velocities.copy_signed(slot, source, sign.as_slice());
        }
    }

    /// Copies stresses to the images.
    pub(crate) fn copy_stresses(&mut self, images: &Images<D>) {
        for (slot, source, sign) in images.entries() {
            // row by row as in a record; symmetric, so that nalgebra's order by columns is the same
            let signs: Tensor<D> = sign * sign.transpose();
            self.stresses.copy_signed(slot, source, signs.as_slice());
        }
    }

    /// A sum over all blocks, in order.
    pub(super) fn sum(&self, part: impl Fn(&BlockSums) -> f64) -> f64 {
        self.sums.iter().map(part).sum()
    }

    /// The particle with the largest residual acceleration, or the first whose is not a number.
    pub(super) fn worst(&self, flow: usize) -> usize {
        let mut worst = (0, 0.0);
        for index in 0..flow {
            let (group, k) = (index / LANES, index % LANES);
            let square = lane(&self.unknowns[group].residual, k).norm_squared();
            if square.is_nan() {
                return index;
            }
            let size = square / self.coefficients[group].mass[k];
            if size > worst.1 {
                worst = (index, size);
            }
        }
        worst.0
    }

    /// Writes δ/Δt, and keeps the work of what the solve has added to the explicit accelerations.
    pub(super) fn write_accelerations(&mut self, particles: &mut Particles<D>, time_step: f64) {
        self.work = 0.0;
        for (index, acceleration) in particles.acceleration.iter_mut().enumerate() {
            let increment = lane(&self.unknowns[index / LANES].increment, index % LANES);
            let mean_velocity = particles.velocity[index] + increment * 0.5;
            self.work += particles.mass[index] * mean_velocity.dot(&(increment - *acceleration * time_step));
            *acceleration = increment / time_step;
        }
    }

    /// Impulse that the last solve has left out `[kg m/s]`: the sum of its residuals, in the order of the particles in memory.
    pub(crate) fn left(&self, flow: usize) -> Vector<D> {
        (0..flow).map(|index| lane(&self.unknowns[index / LANES].residual, index % LANES)).sum()
    }
}
