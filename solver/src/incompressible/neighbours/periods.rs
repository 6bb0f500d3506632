//! Separations by the shortest way, where an axis has a period.

use crate::domain::{AxisBoundary, Domain};
use crate::lanes::algebra::dot;
use crate::lanes::{LANES, LaneIndices, Lanes, Real, gather_vectors};
use crate::vector::Vector;

/// The separation of two particles by the shortest way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Periods<const D: usize> {
    length: Vector<D>,
    inverse: Vector<D>,
}

impl<const D: usize> Periods<D> {
    pub(crate) fn of(domain: &Domain<D>) -> Self {
        let length = Vector::from_fn(|axis, _| match domain.axes[axis] {
            AxisBoundary::Periodic { lower, upper } => upper - lower,
            AxisBoundary::Open | AxisBoundary::Mirror { .. } => 0.0,
        });
        Self { length, inverse: length.map(|l| if l > 0.0 { 1.0 / l } else { 0.0 }) }
    }

    /// Whether an axis has a period.
    #[inline(always)]
    pub(crate) fn has(&self, axis: usize) -> bool {
        self.length[axis] > 0.0
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
    pub(crate) fn separation(&self, target: &Vector<D>, source: &Vector<D>) -> Vector<D> {
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
