//! Separations by the shortest way, where an axis has a period.

use crate::domain::{AxisBoundary, Domain};
use crate::lanes::algebra::dot;
use crate::lanes::{LANES, LaneIndices, Lanes, Real, gather_vectors};
use crate::vector::Vector;

/// The separation of two particles by the shortest way.
#[derive(Debug, Clone, Copy)]
pub struct Periods<const D: usize> {
    lower: Vector<D>,
    length: Vector<D>,
    inverse: Vector<D>,
}

/// Least distance of eight particles from the end of a period with all pairs within it, over the reach `[-]`: within
/// a step others may have left the period by a part of a spacing, and come back at its end.
const ROOM: f64 = 1.5;

/// Whether eight particles have pairs across the end of a period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// None within the distance that was asked for: separations are differences of positions as they stand.
    None,
    /// Some may.
    Some,
}

impl<const D: usize> Periods<D> {
    /// The periods of a domain.
    pub fn of(domain: &Domain<D>) -> Self {
        let (mut lower, mut length) = (Vector::zeros(), Vector::zeros());
        for (axis, boundary) in domain.axes.iter().enumerate() {
            if let AxisBoundary::Periodic { lower: low, upper } = *boundary {
                (lower[axis], length[axis]) = (low, upper - low);
            }
        }
        Self { lower, length, inverse: length.map(|l| if l > 0.0 { 1.0 / l } else { 0.0 }) }
    }

    /// Whether an axis has a period.
    #[inline(always)]
    pub(crate) fn has(&self, axis: usize) -> bool {
        self.length[axis] > 0.0
    }

    /// Whether one of eight particles lies so near to the end of a period that it may have a pair across it that is shorter than
    /// `reach` `[m]`. If none does, such a pair is longer, by the shortest way as well as by the way that leaves the period.
    #[inline(always)]
    pub fn across<V: Lanes>(&self, positions: &[V], reach: f64) -> Across {
        let (mut mask, range) = (0, ROOM * reach);
        for axis in 0..D {
            if self.has(axis) {
                let along = positions[axis] - V::splat(self.lower[axis]);
                mask |= along.less_mask(V::splat(range)) | V::splat(self.length[axis] - range).less_mask(along);
            }
        }
        if mask == 0 { Across::None } else { Across::Some }
    }

    /// The same as [`Periods::shortest`] where it is known whether pairs lie across the end of a period.
    #[inline(always)]
    pub fn shortest_if<V: Real>(&self, across: Across, separation: [V; D]) -> [V; D] {
        match across {
            Across::None => separation,
            Across::Some => self.shortest(separation),
        }
    }

    /// The separation `[m]` of the nearest images of two particles that lie in the same period.
    #[inline(always)]
    pub(crate) fn shortest<V: Real>(&self, mut separation: [V; D]) -> [V; D] {
        let one = V::splat(1.0);
        for axis in 0..D {
            if !self.has(axis) {
                continue;
            }
            let turns = separation[axis] * V::splat(self.inverse[axis]);
            let whole = one.where_less(V::splat(0.5), turns) - one.where_less(turns, V::splat(-0.5));
            separation[axis] = separation[axis] - whole * V::splat(self.length[axis]);
        }
        separation
    }

    /// x_a − x_b `[m]` of the nearest images.
    #[inline(always)]
    pub fn separation(&self, target: &Vector<D>, source: &Vector<D>) -> Vector<D> {
        Vector::from(self.shortest::<f64>((target - source).into()))
    }

    /// |x_a − x_b|² `[m²]` of the nearest images.
    #[inline(always)]
    pub(crate) fn distance_squared(&self, target: &Vector<D>, source: &Vector<D>) -> f64 {
        dot_of(&self.shortest((target - source).into()))
    }

    /// x_a − x_b `[m]` of the nearest images and |x_a − x_b|² `[m²]` for eight sources.
    #[inline(always)]
    pub(crate) fn separations<V: Lanes>(
        &self,
        target: &Vector<D>,
        sources: &[Vector<D>],
        candidates: &[u32; LANES],
    ) -> ([V; D], V) {
        let mut separation = gather_vectors::<V, D>(sources, &LaneIndices::new(candidates, sources.len()));
        for axis in 0..D {
            separation[axis] = V::splat(target[axis]) - separation[axis];
        }
        let separation = self.shortest(separation);
        (separation, dot_of(&separation))
    }
}

#[inline(always)]
fn dot_of<V: Real, const D: usize>(separation: &[V; D]) -> V {
    dot(separation, separation)
}
