//! The pairs of the pressure Poisson equation with their coefficients, and the passes of A and s D G over them.

use super::super::passes::pressure_rows::LinkChunk;
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::linear::LaneRows;
use crate::vector::Vector;

/// A pair of two free particles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link<const D: usize> {
    pub(crate) source: u32,
    /// g_ab `[1/m]`.
    pub(crate) gradient: Vector<D>,
    /// Coefficient of A, 2 V (−F) `[1/m²]`.
    pub(crate) laplacian: f64,
}

/// D u of some rows.
pub(crate) struct Divergence<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) velocity: &'a [Vector<D>],
    pub(crate) first: usize,
    pub(crate) divergence: &'a mut [f64],
}

impl<const D: usize> LanePass for Divergence<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (group, divergence) in self.divergence.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut sum = V::splat(0.0);
            for (sources, link) in self.links.group(first) {
                let velocity = gather_vectors::<V, D>(self.velocity, &sources);
                for axis in 0..D {
                    sum = sum + V::load_single(&link.gradient[axis]) * velocity[axis];
                }
            }
            let sum = sum.to_array();
            for (lane, divergence) in divergence.iter_mut().enumerate() {
                *divergence = sum[lane] - self.own[first + lane].dot(&self.velocity[first + lane]);
            }
        }
    }
}

/// G P of some rows.
pub(crate) struct Gradient<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) p: &'a [f64],
    pub(crate) first: usize,
    pub(crate) gradient: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Gradient<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (group, gradient) in self.gradient.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut sums = [V::splat(0.0); D];
            for (sources, link) in self.links.group(first) {
                let other: V = gather(self.p, &sources);
                for axis in 0..D {
                    sums[axis] = sums[axis] + V::load_single(&link.gradient[axis]) * other;
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

/// A P and G P of some rows.
pub(crate) struct FirstPass<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) diagonal: &'a [f64],
    pub(crate) p: &'a [f64],
    pub(crate) first: usize,
    pub(crate) product: &'a mut [f64],
    pub(crate) gradient: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for FirstPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let groups = self.product.chunks_mut(LANES).zip(self.gradient.chunks_mut(LANES));
        for (group, (product, gradient)) in groups.enumerate() {
            let first = self.first + group * LANES;
            let mut compact = V::splat(0.0);
            let mut sums = [V::splat(0.0); D];
            for (sources, link) in self.links.group(first) {
                let other: V = gather(self.p, &sources);
                compact = compact + V::load_single(&link.laplacian) * other;
                for axis in 0..D {
                    sums[axis] = sums[axis] + V::load_single(&link.gradient[axis]) * other;
                }
            }
            let compact = compact.to_array();
            for (lane, product) in product.iter_mut().enumerate() {
                *product = self.diagonal[first + lane] * self.p[first + lane] - compact[lane];
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

/// Takes s times the divergence of the gradients away from some rows of the product.
pub(crate) struct SecondPass<'a, const D: usize> {
    pub(crate) links: &'a LaneRows<LinkChunk<D>>,
    pub(crate) own: &'a [Vector<D>],
    pub(crate) gradient: &'a [Vector<D>],
    pub(crate) first: usize,
    pub(crate) product: &'a mut [f64],
    pub(crate) stabilisation: f64,
}

impl<const D: usize> LanePass for SecondPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (group, product) in self.product.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut sum = V::splat(0.0);
            for (sources, link) in self.links.group(first) {
                let gradient = gather_vectors::<V, D>(self.gradient, &sources);
                for axis in 0..D {
                    sum = sum + V::load_single(&link.gradient[axis]) * gradient[axis];
                }
            }
            let sum = sum.to_array();
            for (lane, product) in product.iter_mut().enumerate() {
                let own = self.own[first + lane].dot(&self.gradient[first + lane]);
                *product -= self.stabilisation * (sum[lane] - own);
            }
        }
    }
}
