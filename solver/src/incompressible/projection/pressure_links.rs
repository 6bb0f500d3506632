//! The pairs of the pressure Poisson equation with their coefficients, and the passes of A and s D G over them.

use super::super::passes::pressure_rows::LinkChunk;
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, gather, gather_vectors};
use crate::linear::LaneRows;
use crate::vector::Vector;

/// A pair of two free particles.
#[derive(Debug, Clone, Copy)]
pub struct Link<const D: usize> {
    /// The other particle.
    pub source: u32,
    /// g_ab `[1/m]`.
    pub gradient: Vector<D>,
    /// Coefficient of A, 2 V (−F) `[1/m²]`.
    pub(crate) laplacian: f64,
}

/// D u of some rows: written to `out`, or s times it taken away from there.
pub(crate) struct Divergence<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) u: &'a [Vector<D>],
    pub(crate) first: usize,
    pub(crate) out: &'a mut [f64],
    /// s.
    pub(crate) taken: Option<f64>,
}

impl<const D: usize> LanePass for Divergence<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (group, out) in self.out.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut sum = V::splat(0.0);
            for (sources, link) in self.links.group(first) {
                let other = gather_vectors::<V, D>(self.u, &sources);
                for axis in 0..D {
                    sum = sum + V::widen(V::Single::load(&link.gradient[axis])) * other[axis];
                }
            }
            let sum = sum.to_array();
            for (lane, out) in out.iter_mut().enumerate() {
                let divergence = sum[lane] - self.own[first + lane].dot(&self.u[first + lane]);
                match self.taken {
                    None => *out = divergence,
                    Some(share) => *out -= share * divergence,
                }
            }
        }
    }
}

/// G P of some rows, with A P where it is asked for.
pub(crate) struct Gradient<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) p: &'a [f64],
    pub(crate) first: usize,
    pub(crate) gradient: &'a mut [Vector<D>],
    /// Diagonal of A, and A P of these rows.
    pub(crate) compact: Option<(&'a [f64], &'a mut [f64])>,
}

impl<const D: usize> LanePass for Gradient<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        for (group, gradient) in self.gradient.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut compact = V::splat(0.0);
            let mut sums = [V::splat(0.0); D];
            for (sources, link) in self.links.group(first) {
                let other: V = gather(self.p, &sources);
                if self.compact.is_some() {
                    compact = compact + V::widen(V::Single::load(&link.laplacian)) * other;
                }
                for axis in 0..D {
                    sums[axis] = sums[axis] + V::widen(V::Single::load(&link.gradient[axis])) * other;
                }
            }
            if let Some((diagonal, product)) = &mut self.compact {
                let compact = compact.to_array();
                for (lane, product) in product[group * LANES..].iter_mut().enumerate().take(LANES) {
                    *product = diagonal[first + lane] * self.p[first + lane] - compact[lane];
                }
            }
            for axis in 0..D {
                let sums = sums[axis].to_array();
                for (lane, gradient) in gradient.iter_mut().enumerate() {
                    gradient[axis] = self.own[first + lane][axis] * self.p[first + lane] + sums[lane];
                }
            }
        }
    }
}
