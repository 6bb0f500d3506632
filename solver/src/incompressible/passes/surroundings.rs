//! The first pass over the pairs of a phase: what lies around every particle.
//!
//! It measures F of every pair, which the rows of both systems are made of, and sums concentration, moment, the walls and
//! the corrected velocity gradient.

use super::super::boundary::{AT_SURFACE, Surface, WallMirror};
use super::super::neighbours::{Across, LaneList};
use super::super::phase::{WallSums, records};
use super::super::{Bed, LEAST_GROUPS, Periods, Phase, ProjectionNumerics, height_axis};
use crate::kernel::Kernel;
use crate::lanes::algebra::dot;
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, Real};
use crate::parallel::prelude::*;
use crate::vector::Tensor;

/// Quads of a record: position and velocity.
const fn quads(dimensions: usize) -> usize {
    (2 * dimensions).div_ceil(4)
}

/// Whether velocity gradients are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Gradients {
    /// For a law that reads the shear rate.
    Find,
    /// No law does.
    Skip,
}

/// Measures the pairs of a phase at its present positions.
pub(crate) fn find_surroundings<const D: usize>(
    phase: &mut Phase<D>,
    periods: &Periods<D>,
    numerics: &ProjectionNumerics,
    bed: Bed,
    gradients: Gradients,
) {
    let surface = Surface::of(phase, numerics);
    let mirror = WallMirror::of(bed, phase.spacing, numerics);
    let Phase { position, velocity, wall, records, wall_records, free, weight, active, .. } = phase;
    records::pack(records, quads(D), position, |a, behind| behind[..D].copy_from_slice(velocity[a].as_slice()));
    // walls stand still, but a saved phase comes without their records
    records::pack(wall_records, quads(D), wall, |_, _| {});
    let groups = position.len().div_ceil(LANES);
    weight.resize(groups * free.stride, [0.0; LANES]);
    active.resize(groups, 0);
    let around = Around {
        free,
        walls: &phase.walls,
        records,
        wall_records,
        periods,
        kernel: &phase.kernel,
        volume: phase.lattice_volume,
        lattice_gradient: phase.lattice.gradient,
        largest_correction: numerics.largest_correction,
        surface,
        mirror,
        gradients,
    };
    let (chunks, rows) = (LEAST_GROUPS * free.stride, LEAST_GROUPS * LANES);
    let lists = (weight.par_chunks_mut(chunks), active.par_chunks_mut(LEAST_GROUPS));
    let (concentration, deficit) = (phase.concentration.par_chunks_mut(rows), phase.deficit.par_chunks_mut(rows));
    let scalars = (concentration, deficit, phase.at_surface.par_chunks_mut(rows), phase.moment.par_chunks_mut(rows));
    let tensors = (phase.anisotropy.par_chunks_mut(rows), phase.velocity_gradient.par_chunks_mut(rows));
    (lists, scalars, tensors, phase.wall_sums.par_chunks_mut(rows)).enumerate().for_each(
        |(task, ((weight, active), scalars, (anisotropy, velocity_gradient), walls))| {
            let (concentration, deficit, at_surface, moment) = scalars;
            let first = task * LEAST_GROUPS;
            let out = Sums {
                first,
                stride: free.stride,
                weight,
                active,
                concentration,
                at_surface,
                deficit,
                moment,
                anisotropy,
                walls,
                velocity_gradient,
            };
            free.set.run(Task { around: &around, out });
        },
    );
}

/// Inputs of the pass over the surroundings of particles.
struct Around<'a, const D: usize> {
    free: &'a LaneList<D>,
    walls: &'a LaneList<D>,
    records: &'a [[f64; 4]],
    wall_records: &'a [[f64; 4]],
    periods: &'a Periods<D>,
    kernel: &'a Kernel<D>,
    volume: f64,
    lattice_gradient: f64,
    largest_correction: f64,
    surface: Surface,
    mirror: WallMirror,
    gradients: Gradients,
}

impl<const D: usize> Around<'_, D> {
    #[inline(always)]
    fn reach_squared<V: Lanes>(&self) -> V {
        V::splat(self.kernel.support() * self.kernel.support())
    }

    /// W, and F as it is stored and as it is summed, of the k-th candidates of eight particles at a squared distance `[m²]`.
    /// Both are of single precision, and the same seen from both sides of a pair.
    #[inline(always)]
    fn measure<V: Lanes>(&self, k: usize, candidates: V, square: V) -> (V, V::Single, V) {
        // padding stands behind the candidates of a lane
        let (place, candidates) = (V::Single::splat(k as f64), candidates.narrow());
        let square = square.narrow();
        let value = self.kernel.value(square).where_less(place, candidates);
        let weight = self.kernel.gradient_weight(square, V::Single::splat(1.0)).where_less(place, candidates);
        (V::widen(value), weight, V::widen(weight))
    }
}

/// Outputs of the pass over the surroundings of particles, from a first group on.
struct Sums<'a, const D: usize> {
    first: usize,
    stride: usize,
    weight: &'a mut [[f32; LANES]],
    active: &'a mut [u32],
    concentration: &'a mut [f64],
    at_surface: &'a mut [bool],
    deficit: &'a mut [f64],
    moment: &'a mut [f64],
    anisotropy: &'a mut [Tensor<D>],
    walls: &'a mut [WallSums],
    velocity_gradient: &'a mut [Tensor<D>],
}

struct Task<'a, 'b, const D: usize> {
    around: &'a Around<'b, D>,
    out: Sums<'a, D>,
}

impl<const D: usize> LanePass for Task<'_, '_, D> {
    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        for group in 0..self.out.active.len() {
            match self.around.gradients {
                Gradients::Find => self.group::<V, true>(group),
                Gradients::Skip => self.group::<V, false>(group),
            }
        }
    }
}

/// Σ W, Σ F r², Σ F r rᵀ and the sums that are the walls' alone, of eight particles.
struct LaneSums<V, const D: usize> {
    value: V,
    squares: V,
    arms: [[V; D]; D],
    weight: V,
    arm: V,
    mirrored: V,
}

impl<const D: usize> Task<'_, '_, D> {
    #[inline(always)]
    fn group<V: Lanes, const GRADIENTS: bool>(&mut self, group: usize) {
        let around = self.around;
        let global = self.out.first + group;
        let zero = V::splat(0.0);
        let own = records::of_group::<V>(around.records, quads(D), global, around.free.targets);
        let across = around.periods.across(&own[..D], around.kernel.support());
        let mut sums = LaneSums {
            value: around.kernel.value(zero),
            squares: zero,
            arms: [[zero; D]; D],
            weight: zero,
            arm: zero,
            mirrored: zero,
        };
        let mut differences = [[zero; D]; D];
        let (candidates, reach_squared) = (around.free.counts::<V>(global), around.reach_squared());
        let weights = &mut self.out.weight[group * self.out.stride..(group + 1) * self.out.stride];
        let mut active = 0;
        for (k, chunk) in around.free.group(global).enumerate() {
            let other = records::load::<V>(around.records, quads(D), &chunk);
            let separation = separation(&own, &other, around.periods, across);
            let square = dot(&separation, &separation);
            if square.less_mask(reach_squared) == 0 {
                weights[k] = [0.0; LANES];
                continue;
            }
            active = k + 1;
            let (value, single, weight) = around.measure(k, candidates, square);
            sums.value = sums.value + value;
            weights[k] = single.to_array();
            sums.squares = sums.squares + weight * square;
            for j in 0..D {
                let weighted = weight * separation[j];
                add_arms(&mut sums.arms, j, weighted, &separation);
                if GRADIENTS {
                    for i in 0..D {
                        differences[i][j] = differences[i][j] + weighted * (own[D + i] - other[D + i]);
                    }
                }
            }
        }
        self.out.active[group] = active as u32;
        if GRADIENTS {
            self.store_gradients(group, &sums.arms, &differences);
        }
        self.add_walls(global, &own, across, &mut sums);
        self.store(group, &sums);
    }

    #[inline(always)]
    fn add_walls<V: Lanes>(
        &self,
        global: usize,
        own: &[V; records::FIELDS],
        across: Across,
        sums: &mut LaneSums<V, D>,
    ) {
        let around = self.around;
        let normal = height_axis(D);
        let candidates = around.walls.counts::<V>(global);
        let height = around.mirror.height(own[normal]);
        for (k, chunk) in around.walls.group(global).enumerate() {
            let other = records::load::<V>(around.wall_records, quads(D), &chunk);
            let separation = separation(own, &other, around.periods, across);
            let square = dot(&separation, &separation);
            let (value, _, weight) = around.measure(k, candidates, square);
            sums.value = sums.value + value;
            sums.squares = sums.squares + weight * square;
            for j in 0..D {
                add_arms(&mut sums.arms, j, weight * separation[j], &separation);
            }
            sums.weight = sums.weight + weight;
            sums.arm = sums.arm + weight * separation[normal];
            sums.mirrored = sums.mirrored + weight * around.mirror.factor(separation[normal], height);
        }
    }

    #[inline(always)]
    fn store<V: Lanes>(&mut self, group: usize, sums: &LaneSums<V, D>) {
        let around = self.around;
        let (concentration, deficit) = around.surface.find(sums.value);
        let at_surface = V::splat(AT_SURFACE);
        let moment = V::splat(-around.volume / D as f64) * sums.squares;
        let moment = V::splat(around.lattice_gradient).if_less(at_surface, deficit, moment);
        let (concentration, deficit, moment) = (concentration.to_array(), deficit.to_array(), moment.to_array());
        let (arms, squares) = (read(&sums.arms), sums.squares.to_array());
        let (weight, arm, mirrored) = (sums.weight.to_array(), sums.arm.to_array(), sums.mirrored.to_array());
        let first = group * LANES;
        for lane in 0..LANES.min(self.out.moment.len() - first) {
            let a = first + lane;
            self.out.concentration[a] = concentration[lane];
            self.out.deficit[a] = deficit[lane];
            self.out.at_surface[a] = deficit[lane] > AT_SURFACE;
            self.out.moment[a] = moment[lane];
            // where neighbours are missing the moments are those of the surface
            let present = 1.0 - deficit[lane];
            self.out.anisotropy[a] = if present > 0.0 {
                let even = D as f64 / squares[lane];
                (Tensor::from_fn(|i, j| arms[i][j][lane] * even) - Tensor::identity()) * present
            } else {
                Tensor::zeros()
            };
            self.out.walls[a] = WallSums { weight: weight[lane], arm: arm[lane], mirrored: mirrored[lane] };
        }
    }

    /// ∇u of every particle by the corrected difference over free ones; none where the norm of the correction exceeds its
    /// bound: a loose particle has too few neighbours to tell a gradient.
    #[inline(always)]
    fn store_gradients<V: Lanes>(&mut self, group: usize, moments: &[[V; D]; D], differences: &[[V; D]; D]) {
        let (of_moments, of_differences) = (read(moments), read(differences));
        let first = group * LANES;
        for lane in 0..LANES.min(self.out.moment.len() - first) {
            let read =
                |sums: &[[[f64; LANES]; D]; D]| Tensor::<D>::from_fn(|i, j| sums[i][j][lane] * -self.around.volume);
            self.out.velocity_gradient[first + lane] = match read(&of_moments).try_inverse() {
                Some(inverse) if inverse.norm() < self.around.largest_correction => read(&of_differences) * inverse,
                _ => Tensor::zeros(),
            };
        }
    }
}

/// Adds F r_j r of eight pairs to column j, from their F r_j; the column is that of the row, too.
#[inline(always)]
fn add_arms<V: Lanes, const D: usize>(arms: &mut [[V; D]; D], j: usize, weighted: V, separation: &[V; D]) {
    for i in 0..D {
        arms[i][j] = arms[i][j] + weighted * separation[i];
    }
}

/// Eight tensors, component by component.
#[inline(always)]
fn read<V: Lanes, const D: usize>(sums: &[[V; D]; D]) -> [[[f64; LANES]; D]; D] {
    let mut read = [[[0.0; LANES]; D]; D];
    for i in 0..D {
        for j in 0..D {
            read[i][j] = sums[i][j].to_array();
        }
    }
    read
}

/// x_a − x_b `[m]` of the nearest images of eight pairs of records.
#[inline(always)]
pub(super) fn separation<V: Lanes, const D: usize>(
    own: &[V; records::FIELDS],
    other: &[V; records::FIELDS],
    periods: &Periods<D>,
    across: Across,
) -> [V; D] {
    let mut separation = [V::splat(0.0); D];
    for axis in 0..D {
        separation[axis] = own[axis] - other[axis];
    }
    periods.shortest_if(across, separation)
}
