//! The rows of a phase's pressure Poisson equation, as the pass over its pairs fills them.

use crate::lanes::LANES;
use crate::linear::Coefficients;
use crate::vector::Vector;

/// Eight links, one a lane.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct LinkChunk<const D: usize> {
    pub(crate) gradient: [[f32; LANES]; D],
    pub(crate) laplacian: [f32; LANES],
}

impl<const D: usize> Coefficients for LinkChunk<D> {
    type Entry = (Vector<D>, f64);
    const ZERO: Self = Self { gradient: [[0.0; LANES]; D], laplacian: [0.0; LANES] };

    #[inline(always)]
    fn entry(&self, lane: usize) -> (Vector<D>, f64) {
        (Vector::from_fn(|axis, _| f64::from(self.gradient[axis][lane])), f64::from(self.laplacian[lane]))
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, (gradient, laplacian): (Vector<D>, f64)) {
        for axis in 0..D {
            self.gradient[axis][lane] = gradient[axis] as f32;
        }
        self.laplacian[lane] = laplacian as f32;
    }
}

/// Rows of the pressure: links, their chunks in every group, Σ_b g_ab with the walls', the diagonal, and what it has beyond its
/// links.
pub(crate) struct PressureRows<'a, const D: usize> {
    pub(crate) links: &'a mut [LinkChunk<D>],
    pub(crate) width: &'a mut [u32],
    pub(crate) own: &'a mut [Vector<D>],
    pub(crate) diagonal: &'a mut [f64],
    pub(crate) held: &'a mut [f64],
}
