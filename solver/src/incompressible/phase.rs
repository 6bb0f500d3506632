//! One phase: free particles, the wall particles below them, and what a step knows of both.

use super::grid::Grid;
use super::numerics::ProjectionNumerics;
use super::pairs::{LEAST_TASK, Pair, Pairs, Periods, Sources};
use super::scene::ParticleSet;
use crate::domain::Domain;
use crate::kernel::{Kernel, KernelShape};
use crate::vector::{Tensor, Vector};
use rayon::prelude::*;

/// Mean deficit around a particle whose inverse makes it one beside the surface `[-]`.
const NEARNESS_GAIN: f64 = 8.0;

/// Norm of a correction beyond which the neighbours of a particle do not tell its velocity gradient `[-]`.
const LARGEST_CORRECTION: f64 = 30.0;

/// Axis that is normal to the bed in `D` dimensions.
pub(crate) const fn height_axis(dimensions: usize) -> usize {
    dimensions - 1
}

/// Sums of an undisturbed lattice, by which the discrete operators are divided.
#[derive(Debug, Clone, Copy)]
pub(super) struct LatticeSums {
    /// Σ V W, the particle itself included `[-]`.
    pub(super) concentration: f64,
    /// Σ V (−F) x² `[-]`: the gradient of a linear field along an axis.
    pub(super) gradient: f64,
    /// Σ (−F) `[1/m^(D+2)]`: the diagonal of a Laplacian.
    pub(super) diagonal: f64,
}

impl LatticeSums {
    pub(super) fn of<const D: usize>(kernel: &Kernel<D>, spacing: f64) -> Self {
        let reach = (kernel.support() / spacing).ceil() as i32;
        let width = (2 * reach + 1) as usize;
        let volume = spacing.powi(D as i32);
        let mut sums = Self { concentration: 0.0, gradient: 0.0, diagonal: 0.0 };
        for code in 0..width.pow(D as u32) {
            let mut rest = code;
            let offset = Vector::<D>::from_fn(|_, _| {
                let place = (rest % width) as i32 - reach;
                rest /= width;
                f64::from(place) * spacing
            });
            let square = offset.norm_squared();
            sums.concentration += volume * kernel.value(square);
            if square > 0.0 {
                let weight = -kernel.gradient_weight(square, volume) * offset[0] * offset[0];
                sums.gradient += weight;
                sums.diagonal -= kernel.gradient_weight(square, 1.0);
            }
        }
        sums
    }
}

/// State and measures of one phase; arrays have the shape `[free particles]` unless said otherwise.
#[derive(Debug)]
pub(super) struct Phase<const D: usize> {
    pub(super) position: Vec<Vector<D>>,
    pub(super) velocity: Vec<Vector<D>>,
    /// Masses `[kg]`.
    pub(super) mass: Vec<f64>,
    /// Volumes that the particles stand for in sums `[m^D]`.
    pub(super) volume: Vec<f64>,
    pub(super) pressure: Vec<f64>,
    /// Fixed particles `[wall particles]`.
    pub(super) wall: Vec<Vector<D>>,
    /// Volume of a particle on the lattice `[m^D]`.
    pub(super) lattice_volume: f64,
    pub(super) spacing: f64,
    /// Density of the phase's material `[kg/m³]`.
    pub(super) density: f64,
    pub(super) kernel: Kernel<D>,
    pub(super) lattice: LatticeSums,
    pub(super) free_pairs: Pairs<D>,
    pub(super) wall_pairs: Pairs<D>,
    /// Σ V W over that of the lattice `[-]`.
    pub(super) concentration: Vec<f64>,
    pub(super) at_surface: Vec<bool>,
    /// What a particle lacks of neighbours, from 0 inside to 1 at the surface `[-]`; a smooth form of (31), because
    /// particles that change sides in steps shake the column.
    pub(super) deficit: Vec<f64>,
    /// 1 at the surface and beside it, 0 inside `[-]`.
    pub(super) nearness: Vec<f64>,
    /// Σ V (−F) r²/D `[-]`: the sum of gradients that would be 1 in a continuum; the lattice's at the surface.
    pub(super) moment: Vec<f64>,
    /// ∇u, corrected, over free particles `[1/s]`.
    pub(super) velocity_gradient: Vec<Tensor<D>>,
    /// Way since the last search `[m]`.
    pub(super) travel: Vec<Vector<D>>,
    grid: Grid<D>,
}

impl<const D: usize> Phase<D> {
    pub(super) fn new(
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
            volume: vec![lattice_volume; count],
            pressure: vec![0.0; count],
            wall: wall.to_vec(),
            lattice_volume,
            spacing,
            density,
            lattice: LatticeSums::of(&kernel, spacing),
            kernel,
            free_pairs: Pairs::new(),
            wall_pairs: Pairs::new(),
            concentration: vec![1.0; count],
            at_surface: vec![false; count],
            moment: vec![1.0; count],
            deficit: vec![0.0; count],
            nearness: vec![0.0; count],
            velocity_gradient: vec![Tensor::zeros(); count],
            travel: vec![Vector::zeros(); count],
            grid: Grid::new(),
        }
    }

    /// The same phase with masses of a given filling of each particle `[-]`.
    pub(super) fn filled(mut self, filling: &[f64]) -> Self {
        for (mass, filling) in self.mass.iter_mut().zip(filling) {
            *mass *= filling;
        }
        self
    }

    pub(super) fn len(&self) -> usize {
        self.position.len()
    }

    /// Finds the candidates of the pairs within the phase.
    pub(super) fn search(&mut self, domain: &Domain<D>, periods: &Periods<D>, skin: f64) {
        let radius = self.kernel.support() + skin;
        self.grid.sort(&self.position, domain, radius);
        self.free_pairs.search(&self.position, &self.position, Sources::Same, &self.grid, periods, radius);
        self.grid.sort(&self.wall, domain, radius);
        self.wall_pairs.search(&self.position, &self.wall, Sources::Other, &self.grid, periods, radius);
        self.travel.fill(Vector::zeros());
    }

    /// Measures the pairs within the phase.
    pub(super) fn measure(&mut self, periods: &Periods<D>) {
        self.free_pairs.measure(&self.position, &self.position, periods, &self.kernel);
        self.wall_pairs.measure(&self.position, &self.wall, periods, &self.kernel);
    }

    /// Concentration of the particles, which of them lie at the surface (31), and how near it the others are.
    pub(super) fn find_surface(&mut self, numerics: &ProjectionNumerics) {
        let Self { free_pairs, wall_pairs, kernel, lattice, lattice_volume, .. } = self;
        let (volume, own, threshold) = (*lattice_volume, kernel.value(0.0), numerics.surface_threshold);
        let scale = volume / (lattice.concentration * numerics.reference_concentration);
        (&mut self.concentration, &mut self.at_surface, &mut self.deficit, &mut self.moment)
            .into_par_iter()
            .enumerate()
            .with_min_len(LEAST_TASK)
            .for_each(|(a, (concentration, at_surface, deficit, moment))| {
                let (mut value, mut arms) = (own, 0.0);
                for pair in free_pairs.of(a).iter().chain(wall_pairs.of(a)) {
                    value += pair.value;
                    arms -= pair.gradient * pair.separation.norm_squared();
                }
                *concentration = scale * value;
                *at_surface = *concentration < threshold;
                *deficit = ((1.0 - *concentration) / (1.0 - threshold) - 0.5).clamp(0.0, 1.0);
                *moment = if *at_surface { lattice.gradient } else { volume * arms / D as f64 };
            });
        let deficit = &self.deficit;
        self.nearness.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, nearness)| {
            let sum = |sum, pair: &Pair<D>| sum + pair.value * deficit[pair.source as usize];
            let mean = volume * free_pairs.of(a).iter().fold(own * deficit[a], sum);
            *nearness = (NEARNESS_GAIN * mean).min(1.0);
        });
    }

    /// Velocity gradients by the corrected difference over free particles.
    pub(super) fn find_velocity_gradients(&mut self) {
        let Self { free_pairs, velocity, lattice_volume, .. } = self;
        let volume = *lattice_volume;
        self.velocity_gradient.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, gradient)| {
            let mut moments = Tensor::<D>::zeros();
            let mut differences = Tensor::<D>::zeros();
            for pair in free_pairs.of(a) {
                let weighted = pair.separation * (-volume * pair.gradient);
                moments += weighted * pair.separation.transpose();
                differences += (velocity[a] - velocity[pair.source as usize]) * weighted.transpose();
            }
            // a loose particle has too few neighbours to tell a gradient
            *gradient = match moments.try_inverse() {
                Some(inverse) if inverse.norm() < LARGEST_CORRECTION => differences * inverse,
                _ => Tensor::zeros(),
            };
        });
    }

    /// Moves a particle.
    #[inline(always)]
    pub(super) fn displace(&mut self, particle: usize, way: Vector<D>) {
        self.position[particle] += way;
        self.travel[particle] += way;
    }
}
