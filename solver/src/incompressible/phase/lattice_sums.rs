//! Sums over an undisturbed lattice.

use crate::kernel::Kernel;
use crate::vector::Vector;

/// Sums of an undisturbed lattice, by which the discrete operators are divided.
#[derive(Debug, Clone, Copy)]
pub struct LatticeSums {
    /// Σ V W, the particle itself included `[-]`.
    pub concentration: f64,
    /// Σ V (−F) x² `[-]`: the gradient of a linear field along an axis.
    pub gradient: f64,
    /// Σ (−F) `[1/m^(D+2)]`: the diagonal of a Laplacian.
    pub diagonal: f64,
}

impl LatticeSums {
    /// Sums of a lattice.
    pub fn of<const D: usize>(kernel: &Kernel<D>, spacing: f64) -> Self {
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
