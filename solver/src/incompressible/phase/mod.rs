//! One phase: free particles, the wall particles below them, and what a step knows of both.

mod lattice_sums;
mod phases;
pub(crate) mod records;
mod sliding_rows;

pub use lattice_sums::LatticeSums;
pub(crate) use phases::Phases;

use super::neighbours::{Grid, LaneList, Places, Sources};
use super::{ParticleSet, Periods};
use crate::domain::Domain;
use crate::kernel::{Kernel, KernelShape};
use crate::lanes::LANES;
use crate::vector::{Tensor, Vector};

/// Sums over the wall particles around a free one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct WallSums {
    /// Σ F `[1/m^(D+2)]`.
    pub(crate) weight: f64,
    /// Σ F r·n `[1/m^(D+1)]`.
    pub(crate) arm: f64,
    /// Σ F (1 + d/z), where a wall particle at the depth d below a no-slip wall moves against its partner at the height z
    /// `[1/m^(D+2)]`.
    pub(crate) mirrored: f64,
}

/// State and measures of one phase; arrays have the shape `[free particles]` unless said otherwise.
#[derive(Debug)]
pub struct Phase<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Masses `[kg]`.
    pub mass: Vec<f64>,
    /// Pressures `[Pa]`.
    pub pressure: Vec<f64>,
    /// Fixed particles `[wall particles]`.
    pub wall: Vec<Vector<D>>,
    /// Volume of a particle on the lattice, which it stands for in sums `[m^D]`.
    pub lattice_volume: f64,
    pub(crate) spacing: f64,
    /// Density of the phase's material `[kg/m³]`.
    pub(crate) density: f64,
    /// Smoothing kernel of the phase.
    pub kernel: Kernel<D>,
    /// Sums of the lattice.
    pub lattice: LatticeSums,
    /// Shear rate of rows that slide over each other over that of their pairs, |u_ab|/r, as a mean `[-]`.
    pub(crate) sliding_rate: f64,
    /// Candidates among the free particles and among the walls.
    pub(crate) free: LaneList<D>,
    pub(crate) walls: LaneList<D>,
    /// F of the free candidates at the present positions, parallel to their list; 0 out of reach `[1/m^(D+2)]`.
    pub(crate) weight: Vec<[f32; LANES]>,
    /// Chunks of every group of eight up to its last pair within reach.
    pub(crate) active: Vec<u32>,
    pub(crate) wall_sums: Vec<WallSums>,
    /// Records of the passes over pairs, and those of the walls.
    pub(crate) records: Vec<[f64; 4]>,
    pub(crate) wall_records: Vec<[f64; 4]>,
    /// Σ V W over that of the lattice `[-]`.
    pub concentration: Vec<f64>,
    /// Whether a particle is at the surface.
    pub at_surface: Vec<bool>,
    /// Neighbour deficit of a particle, from 0 inside to 1 at the surface `[-]`; a smooth form of (31), because
    /// particles that change sides in steps shake the column. One half is (31).
    pub deficit: Vec<f64>,
    /// 1 at the surface and beside it, 0 inside `[-]`.
    pub(crate) nearness: Vec<f64>,
    /// Σ V (−F) r²/D `[-]`: the sum of gradients that would be 1 in a continuum; the lattice's at the surface.
    pub moment: Vec<f64>,
    /// δ = Σ V (−F) r rᵀ/M − 1 `[-]`: how far the neighbours lie otherwise than evenly all around; 0 at the surface.
    pub anisotropy: Vec<Tensor<D>>,
    /// Mean over the neighbours, times the share that gradients of pairs are rid of `[-]`.
    pub mean_anisotropy: Vec<Tensor<D>>,
    /// ∇u, corrected, over free particles `[1/s]`.
    pub velocity_gradient: Vec<Tensor<D>>,
    /// Displacement since the last search `[m]`.
    pub(crate) travel: Vec<Vector<D>>,
    grid: Grid<D>,
}

impl<const D: usize> Phase<D> {
    pub(crate) fn new(
        particles: &ParticleSet<D>,
        wall: &[Vector<D>],
        spacing: f64,
        density: f64,
        smoothing_ratio: f64,
    ) -> Self {
        let count = particles.position.len();
        let kernel = Kernel::new(KernelShape::CubicSpline, smoothing_ratio * spacing);
        let lattice_volume = spacing.powi(D as i32);
        Self {
            position: particles.position.clone(),
            velocity: particles.velocity.clone(),
            mass: vec![density * lattice_volume; count],
            pressure: vec![0.0; count],
            wall: wall.to_vec(),
            lattice_volume,
            spacing,
            density,
            lattice: LatticeSums::of(&kernel, spacing),
            sliding_rate: sliding_rows::rate_of_sliding_rows(&kernel, spacing),
            kernel,
            free: LaneList::new(),
            walls: LaneList::new(),
            weight: Vec::new(),
            active: Vec::new(),
            wall_sums: vec![WallSums::default(); count],
            records: Vec::new(),
            wall_records: Vec::new(),
            concentration: vec![1.0; count],
            at_surface: vec![false; count],
            moment: vec![1.0; count],
            anisotropy: vec![Tensor::zeros(); count],
            mean_anisotropy: vec![Tensor::zeros(); count],
            deficit: vec![0.0; count],
            nearness: vec![0.0; count],
            velocity_gradient: vec![Tensor::zeros(); count],
            travel: vec![Vector::zeros(); count],
            grid: Grid::new(),
        }
    }

    /// The same phase with masses of a given filling of each particle `[-]`.
    pub(crate) fn filled(mut self, filling: &[f64]) -> Self {
        for (mass, filling) in self.mass.iter_mut().zip(filling) {
            *mass *= filling;
        }
        self
    }

    /// Free particles.
    #[expect(clippy::len_without_is_empty, reason = "a phase has particles")]
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Finds the candidates of the pairs within the phase.
    pub fn search(&mut self, domain: &Domain<D>, periods: &Periods<D>, skin: f64) {
        let reach = self.kernel.support();
        self.grid.sort(&self.position, domain, reach + skin);
        self.free.search(&self.position, &self.position, Sources::Same, &self.grid, periods, reach, skin);
        self.grid.sort(&self.wall, domain, reach + skin);
        self.walls.search(&self.position, &self.wall, Sources::Other, &self.grid, periods, reach, skin);
        self.travel.fill(Vector::zeros());
    }

    /// The free particles within reach of one at the positions that were last measured: index, x_a − x_b of the nearest
    /// images `[m]` and F `[1/m^(D+2)]`.
    #[inline(always)]
    pub fn free_pairs(&self, a: usize, periods: &Periods<D>) -> impl Iterator<Item = (usize, Vector<D>, f64)> {
        let (first, lane) = (a / LANES * self.free.stride, a % LANES);
        let candidates = self.free.of(a).zip(&self.weight[first..]);
        let near = candidates.filter(move |(_, weight)| weight[lane] < 0.0);
        near.map(move |(b, weight)| {
            (b, periods.separation(&self.position[a], &self.position[b]), f64::from(weight[lane]))
        })
    }

    /// The wall particles within reach of a free one, likewise.
    #[inline(always)]
    pub fn wall_pairs(&self, a: usize, periods: &Periods<D>) -> impl Iterator<Item = (usize, Vector<D>, f64)> {
        self.walls.of(a).filter_map(move |b| {
            let separation = periods.separation(&self.position[a], &self.wall[b]);
            let weight = self.kernel.gradient_weight(separation.norm_squared(), 1.0);
            (weight < 0.0).then_some((b, separation, weight))
        })
    }

    /// Positions and displacements of the particles, to judge whether a search is due.
    pub(crate) fn places(&self) -> Places<'_, D> {
        Places { free: &self.position, fixed: &self.wall, travel: &self.travel }
    }

    /// Moves a particle.
    #[inline(always)]
    pub fn displace(&mut self, particle: usize, by: Vector<D>) {
        self.position[particle] += by;
        self.travel[particle] += by;
    }
}
