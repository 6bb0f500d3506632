//! Periodic and mirror images: copies of real particles behind a boundary of the domain.
//!
//! A free-slip wall or symmetry plane is a mirror: normal components of vectors, and the off-diagonal
//! components of tensors that couple normal and tangent, change their sign.

use crate::domain::{AxisBoundary, Domain};
use crate::parallel::prelude::*;
use crate::vector::{Tensor, Vector};
use serde::{Deserialize, Serialize};

/// One image: x = sign ∘ x_source + shift.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Image<const D: usize> {
    source: u32,
    sign: Vector<D>,
    shift: Vector<D>,
}

impl<const D: usize> Image<D> {
    /// A tensor of its source, as the image has it.
    fn tensor(value: &Tensor<D>, image: &Self) -> Tensor<D> {
        let mut copy = *value;
        for i in 0..D {
            for j in 0..D {
                copy[(i, j)] *= image.sign[i] * image.sign[j];
            }
        }
        copy
    }
}

/// All images; image k stands at `first + k` in every array.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Images<const D: usize> {
    images: Vec<Image<D>>,
    first: usize,
    /// New images of every block of sources, while they are found.
    #[serde(skip)]
    counts: Vec<usize>,
}

/// Sources a task of the search for images.
const BLOCK: usize = 1024;
/// Images a task of the copies.
const COPIED: usize = 4096;

/// Sources of images along an axis: real particles, then images along the axes before.
#[derive(Clone, Copy)]
struct Sources<'a, const D: usize> {
    positions: &'a [Vector<D>],
    images: &'a [Image<D>],
    axis: usize,
    boundary: AxisBoundary,
    reach: f64,
}

impl<const D: usize> Sources<'_, D> {
    fn len(&self) -> usize {
        self.positions.len() + self.images.len()
    }

    /// Shows the images of a block of sources in their order.
    fn visit(&self, block: usize, mut show: impl FnMut(Image<D>)) {
        let (axis, reach) = (self.axis, self.reach);
        for index in block * BLOCK..(block * BLOCK + BLOCK).min(self.len()) {
            let image = match index.checked_sub(self.positions.len()) {
                None => Image { source: index as u32, sign: Vector::repeat(1.0), shift: Vector::zeros() },
                Some(image) => self.images[image],
            };
            let coordinate = image.sign[axis] * self.positions[image.source as usize][axis] + image.shift[axis];
            let mut add = |sign: f64, shift: f64| {
                let mut other = image;
                other.sign[axis] *= sign;
                other.shift[axis] = sign * other.shift[axis] + shift;
                show(other);
            };
            match self.boundary {
                AxisBoundary::Open => {}
                AxisBoundary::Periodic { lower, upper } => {
                    if coordinate < lower + reach {
                        add(1.0, upper - lower);
                    }
                    if coordinate > upper - reach {
                        add(1.0, lower - upper);
                    }
                }
                AxisBoundary::Mirror { lower, upper } => {
                    if let Some(plane) = lower
                        && coordinate < plane + reach
                    {
                        add(-1.0, 2.0 * plane);
                    }
                    if let Some(plane) = upper
                        && coordinate > plane - reach
                    {
                        add(-1.0, 2.0 * plane);
                    }
                }
            }
        }
    }
}

/// Writes the images of the blocks from `first` on, given the number of images in each block.
fn write<const D: usize>(sources: Sources<'_, D>, first: usize, counts: &[usize], out: &mut [Image<D>]) {
    if out.is_empty() {
        return;
    }
    if counts.len() > 4 {
        let (counts, later_counts) = counts.split_at(counts.len() / 2);
        let (out, later_out) = out.split_at_mut(counts.iter().sum());
        rayon::join(
            || write(sources, first, counts, out),
            || write(sources, first + counts.len(), later_counts, later_out),
        );
        return;
    }
    let mut slots = out.iter_mut();
    for block in first..first + counts.len() {
        sources.visit(block, |image| {
            if let Some(slot) = slots.next() {
                *slot = image;
            }
        });
    }
}

impl<const D: usize> Images<D> {
    /// Whether all are images of the first `real` particles and stand behind them.
    pub(crate) fn belong_to(&self, real: usize) -> bool {
        self.first == real && self.images.iter().all(|image| (image.source as usize) < real)
    }

    pub(crate) fn len(&self) -> usize {
        self.images.len()
    }

    /// The real particle behind image `k`.
    pub(crate) fn source(&self, k: usize) -> usize {
        self.images[k].source as usize
    }

    /// Finds the images of the real particles at `positions` within `reach` `[m]` of a boundary, axis by axis,
    /// so that corners get the images of images.
    pub(crate) fn rebuild(&mut self, domain: &Domain<D>, positions: &[Vector<D>], reach: f64) {
        self.first = positions.len();
        self.images.clear();
        for (axis, boundary) in domain.axes.iter().enumerate() {
            if *boundary == AxisBoundary::Open {
                continue;
            }
            let before = self.images.len();
            let boundary = *boundary;
            let sources = Sources { positions, images: &self.images, axis, boundary, reach };
            // as many are counted block by block as are then written
            let blocks = sources.len().div_ceil(BLOCK);
            self.counts.resize(blocks, 0);
            let counts = self.counts.par_iter_mut().enumerate().with_min_len(4);
            counts.for_each(|(block, count)| {
                *count = 0;
                sources.visit(block, |_| *count += 1);
            });
            let added = self.counts.iter().sum::<usize>();
            let total = before + added;
            if self.images.capacity() < total {
                // some head room, so that a slowly changing number of images does not allocate
                self.images.reserve_exact(total + total / 8 + 64 - before);
            }
            let none = Image { source: 0, sign: Vector::repeat(1.0), shift: Vector::zeros() };
            self.images.resize(total, none);
            let (images, added) = self.images.split_at_mut(before);
            write(Sources { positions, images, axis, boundary, reach }, 0, &self.counts, added);
        }
    }

    /// 1 for images with a change of sign, that is behind a mirror, 0 for others.
    pub(crate) fn mark_mirrored(&self, field: &mut [f64]) {
        for (slot, image) in field.iter_mut().zip(&self.images) {
            *slot = if image.sign.min() < 0.0 { 1.0 } else { 0.0 };
        }
    }

    pub(crate) fn copy_positions(&self, field: &mut [Vector<D>]) {
        self.copy(field, |value, image| image.sign.component_mul(value) + image.shift);
    }

    pub(crate) fn copy_vectors(&self, field: &mut [Vector<D>]) {
        self.copy(field, |value, image| image.sign.component_mul(value));
    }

    /// Copies to the images values that a mirror leaves unchanged, such as numbers and a law's memory.
    pub(crate) fn copy_scalars<T: Copy + Send + Sync>(&self, field: &mut [T]) {
        self.copy(field, |value, _| *value);
    }

    pub(crate) fn copy_tensors(&self, field: &mut [Tensor<D>]) {
        self.copy(field, Image::tensor);
    }

    /// Fills in the images of wall particles in an array that leaves out the flow: walls, images and sentinel.
    pub(crate) fn copy_wall_vectors(&self, field: &mut [Vector<D>]) {
        self.copy_of_walls(field, |value, image| image.sign.component_mul(value));
    }

    pub(crate) fn copy_wall_tensors(&self, field: &mut [Tensor<D>]) {
        self.copy_of_walls(field, Image::tensor);
    }

    pub(crate) fn copy_wall_scalars(&self, field: &mut [f64]) {
        self.copy_of_walls(field, |value, _| *value);
    }

    fn copy_of_walls<T: Copy>(&self, field: &mut [T], map: impl Fn(&T, &Image<D>) -> T) {
        let walls = field.len() - self.images.len() - 1;
        let flow = self.first - walls;
        let (walls, images) = field.split_at_mut(walls);
        for (slot, image) in images.iter_mut().zip(&self.images) {
            if let Some(wall) = (image.source as usize).checked_sub(flow) {
                *slot = map(&walls[wall], image);
            }
        }
    }

    /// Place, source and sign of every image.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &Vector<D>)> {
        let first = self.first;
        self.images.iter().enumerate().map(move |(k, image)| (first + k, image.source as usize, &image.sign))
    }

    fn copy<T: Copy + Send + Sync>(&self, field: &mut [T], map: impl Fn(&T, &Image<D>) -> T + Sync) {
        let (real, images) = field.split_at_mut(self.first);
        let slots = (images.par_chunks_mut(COPIED), self.images.par_chunks(COPIED)).into_items();
        slots.for_each(|(slots, images)| {
            for (slot, image) in slots.iter_mut().zip(images) {
                *slot = map(&real[image.source as usize], image);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_of_two_mirrors_has_three_images() {
        let domain = Domain::<2> { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }; 2] };
        let mut images = Images::default();
        let mut positions = vec![Vector::<2>::new(0.1, 0.2)];
        images.rebuild(&domain, &positions, 0.5);
        positions.resize(1 + images.len(), Vector::zeros());
        images.copy_positions(&mut positions);
        let expected = [[-0.1, 0.2], [0.1, -0.2], [-0.1, -0.2]];
        assert_eq!(images.len(), 3);
        for place in expected {
            assert!(positions[1..].iter().any(|p| (p - Vector::from(place)).norm() < 1e-15), "{place:?}");
        }
        let mut stress = vec![Tensor::<2>::new(1.0, 2.0, 2.0, 3.0); 4];
        images.copy_tensors(&mut stress);
        assert_eq!(stress[1], Tensor::<2>::new(1.0, -2.0, -2.0, 3.0));
        assert_eq!(stress[3], Tensor::<2>::new(1.0, 2.0, 2.0, 3.0));
    }

    #[test]
    fn a_particle_behind_a_mirror_becomes_its_image() {
        let upper = AxisBoundary::Mirror { lower: None, upper: Some(2.0) };
        let domain = Domain::<2> { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, upper] };
        let (mut position, mut velocity) = (Vector::<2>::new(-0.1, 1.0), Vector::<2>::new(-3.0, 5.0));
        let (mut gradient, mut stress) = (Tensor::<2>::new(1.0, 2.0, 3.0, 4.0), Tensor::<2>::new(1.0, 2.0, 2.0, -1.0));
        domain.reflect(&mut position, &mut velocity, &mut gradient, &mut stress);
        assert_eq!((position, velocity), (Vector::<2>::new(0.1, 1.0), Vector::<2>::new(3.0, 5.0)));
        assert_eq!(
            (gradient, stress),
            (Tensor::<2>::new(1.0, -2.0, -3.0, 4.0), Tensor::<2>::new(1.0, -2.0, -2.0, -1.0))
        );
        position[1] = 2.3;
        domain.reflect(&mut position, &mut velocity, &mut gradient, &mut stress);
        assert!((position[1] - 1.7).abs() < 1e-15 && velocity[1] == -5.0 && stress[(0, 1)] == 2.0);
        let before = (position, velocity);
        domain.reflect(&mut position, &mut velocity, &mut gradient, &mut stress);
        assert_eq!((position, velocity), before, "in front of both planes nothing happens");
    }

    #[test]
    fn periodic_images_stand_one_period_away() {
        let axes = [AxisBoundary::Periodic { lower: -1.0, upper: 2.0 }, AxisBoundary::Open];
        let domain = Domain::<2> { axes };
        let mut positions = vec![Vector::<2>::new(-0.9, 5.0), Vector::<2>::new(1.95, 4.0), Vector::<2>::new(0.5, 4.0)];
        let mut images = Images::default();
        images.rebuild(&domain, &positions, 0.2);
        positions.resize(3 + images.len(), Vector::zeros());
        images.copy_positions(&mut positions);
        assert_eq!(images.len(), 2);
        assert!((positions[3] - Vector::<2>::new(2.1, 5.0)).norm() < 1e-14);
        assert!((positions[4] - Vector::<2>::new(-1.05, 4.0)).norm() < 1e-14);
        let mut far = Vector::<2>::new(-7.5, 1.0);
        domain.wrap(&mut far);
        assert!((far[0] - 1.5).abs() < 1e-14);
    }
}
