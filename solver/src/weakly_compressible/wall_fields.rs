//! Fields of wall particles alone, and marks of images behind a mirror: arrays that leave the flow out.

use crate::lanes::{LANES, LaneIndices, Lanes, gather};
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::Images;
use serde::{Deserialize, Serialize};

/// Arrays of the wall particles, then of all images (zero for those of the flow) and the sentinel, shape
/// `[wall + images + 1]`: the entry of the particle at a storage index stands at that index less the flow's particles.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct WallFields<const D: usize> {
    /// Normals of the walls into the flow `[-]`.
    pub normal: Vec<Vector<D>>,
    /// Depths behind their surface `[m]`.
    pub depth: Vec<f64>,
    /// Velocities of the walls themselves `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Displacements per angle of the surface of walls that turn `[m]`, zero of others: levers of forces about the axis.
    pub(crate) lever: Vec<Vector<D>>,
    /// Velocity gradients of walls that turn `[1/s]`, zero of others.
    pub(crate) spin: Vec<Tensor<D>>,
    /// Velocities of walls as the continuity of a sliding liquid takes them `[m/s]`.
    pub(crate) sliding_velocity: Vec<Vector<D>>,
    /// 1 on particles of smooth walls, 0 elsewhere `[-]`.
    pub smoothness: Vec<f64>,
}

impl<const D: usize> WallFields<D> {
    /// Adds a wall particle.
    pub(crate) fn push(&mut self, normal: Vector<D>, depth: f64, velocity: Vector<D>, is_smooth: bool) {
        self.normal.push(normal);
        self.depth.push(depth);
        self.velocity.push(velocity);
        self.sliding_velocity.push(Vector::zeros());
        self.lever.push(Vector::zeros());
        self.spin.push(Tensor::zeros());
        self.smoothness.push(if is_smooth { 1.0 } else { 0.0 });
    }

    /// Makes room for the images behind a number of wall particles, and fills in those of walls.
    pub(crate) fn append_images(&mut self, images: &Images<D>, walls: usize) {
        let total = walls + images.len() + 1;
        let Self { normal, depth, velocity, lever, spin, sliding_velocity, smoothness } = self;
        for vectors in [normal, velocity, lever, sliding_velocity] {
            resize(vectors, walls, total, Vector::zeros());
            images.copy_wall_vectors(vectors);
        }
        resize(spin, walls, total, Tensor::zeros());
        images.copy_wall_tensors(spin);
        for scalars in [depth, smoothness] {
            resize(scalars, walls, total, 0.0);
            images.copy_wall_scalars(scalars);
        }
    }

    /// Whether every array has this length.
    pub(crate) fn are_as_long_as(&self, length: usize) -> bool {
        let Self { normal, depth, velocity, lever, spin, sliding_velocity, smoothness } = self;
        let vectors = [normal, velocity, lever, sliding_velocity].map(Vec::len);
        vectors.into_iter().chain([spin.len(), depth.len(), smoothness.len()]).all(|found| found == length)
    }
}

/// Makes an array as long as all particles, keeping the first `real` values, with zeros behind them. Some head room is left, so
/// that a slowly changing number of images does not allocate.
pub(super) fn resize<T: Clone>(array: &mut Vec<T>, real: usize, total: usize, zero: T) {
    array.truncate(real);
    if array.capacity() < total {
        array.reserve_exact(total + total / 8 + 64 - array.len());
    }
    array.resize(total, zero);
}

/// 1 in the lanes of images behind a mirror, 0 elsewhere `[-]`. `mirrored` has a zero for all real particles, then the images
/// and the sentinel.
#[inline(always)]
pub(crate) fn mirrored_lanes<V: Lanes>(mirrored: &[f64], real: usize, indices: &LaneIndices<'_>) -> V {
    let mut places = [0; LANES];
    for lane in 0..LANES {
        places[lane] = (indices.raw()[lane] + 1).saturating_sub(real as u32);
    }
    gather(mirrored, &LaneIndices::new(&places, mirrored.len()))
}
