//! Smoothing kernels W(r, h) with compact support 2h.
//!
//! The pair sums use W itself and the factor F = (1/r) dW/dr, so that ∇_aW_ab = F r_ab needs no division by r.

mod cubic_spline;
mod wendland;

use crate::lanes::Real;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shape of the kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum KernelShape {
    /// Cubic B-spline, the papers' kernel.
    CubicSpline,
    /// Wendland C2, free of the pairing instability.
    WendlandC2,
}

/// A kernel with its smoothing length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kernel<const D: usize> {
    pub(crate) shape: KernelShape,
    smoothing_length: f64,
    inverse_smoothing_length: f64,
    value_scale: f64,
    gradient_scale: f64,
}

/// Support radius in smoothing lengths `[-]`.
pub const SUPPORT: f64 = 2.0;

impl<const D: usize> Kernel<D> {
    /// A kernel of the given shape with smoothing length h `[m]`; D is 2 or 3.
    #[must_use]
    pub fn new(shape: KernelShape, smoothing_length: f64) -> Self {
        let normalisation = match shape {
            KernelShape::CubicSpline => cubic_spline::normalisation(D),
            KernelShape::WendlandC2 => wendland::normalisation(D),
        };
        let value_scale = normalisation / smoothing_length.powi(D as i32);
        Self {
            shape,
            smoothing_length,
            inverse_smoothing_length: 1.0 / smoothing_length,
            value_scale,
            gradient_scale: value_scale / (smoothing_length * smoothing_length),
        }
    }

    /// Smoothing length h `[m]`.
    #[must_use]
    pub fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    /// Support radius 2h `[m]`.
    #[must_use]
    pub fn support(&self) -> f64 {
        SUPPORT * self.smoothing_length
    }

    /// W `[1/m^D]` at the squared distance r² `[m²]`; exactly zero from 2h on.
    #[inline(always)]
    #[must_use]
    pub fn value<V: Real>(&self, distance_squared: V) -> V {
        let q = distance_squared.sqrt() * V::splat(self.inverse_smoothing_length);
        let shape = match self.shape {
            KernelShape::CubicSpline => cubic_spline::value(q),
            KernelShape::WendlandC2 => wendland::value(q),
        };
        shape * V::splat(self.value_scale)
    }

    /// V F with F = (1/r) dW/dr `[1/m²]` at the squared distance r² `[m²]` of a neighbour with the volume V `[m^D]`;
    /// never positive, exactly zero from 2h on.
    #[inline(always)]
    #[must_use]
    pub fn gradient_weight<V: Real>(&self, distance_squared: V, volume: V) -> V {
        // the scale goes to the volume, which does not wait for the square root
        let scaled = volume * V::splat(self.gradient_scale);
        let distance = distance_squared.sqrt();
        let inverse = self.inverse_smoothing_length;
        match self.shape {
            KernelShape::CubicSpline => cubic_spline::gradient_factor(distance * V::splat(inverse)) * scaled,
            KernelShape::WendlandC2 => wendland::gradient_weight(distance * V::splat(0.5 * inverse), scaled),
        }
    }

    /// W `[1/m^D]` at a distance `[m]`, one value.
    #[must_use]
    pub fn value_at(&self, distance: f64) -> f64 {
        self.value(distance * distance)
    }

    /// F = (1/r) dW/dr `[1/m^(D+2)]` at a distance `[m]`, one value.
    #[must_use]
    pub fn gradient_factor_at(&self, distance: f64) -> f64 {
        self.gradient_weight(distance * distance, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const SHAPES: [KernelShape; 2] = [KernelShape::CubicSpline, KernelShape::WendlandC2];

    fn integral<const D: usize>(kernel: &Kernel<D>) -> f64 {
        let n = 20_000;
        let dr = kernel.support() / n as f64;
        let shell = |r: f64| if D == 2 { 2.0 * PI * r } else { 4.0 * PI * r * r };
        (0..n).map(|k| (k as f64 + 0.5) * dr).map(|r| shell(r) * kernel.value_at(r) * dr).sum()
    }

    #[test]
    fn the_integral_over_the_support_is_one() {
        for shape in SHAPES {
            assert!((integral(&Kernel::<2>::new(shape, 0.37)) - 1.0).abs() < 1e-6);
            assert!((integral(&Kernel::<3>::new(shape, 2.1)) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_gradient_factor_is_the_derivative_over_r() {
        for shape in SHAPES {
            let kernel = Kernel::<2>::new(shape, 0.8);
            for k in 1..40 {
                let r = 0.04 * k as f64 + 0.003;
                let step = 1e-6;
                let derivative = (kernel.value_at(r + step) - kernel.value_at(r - step)) / (2.0 * step);
                assert!((derivative - kernel.gradient_factor_at(r) * r).abs() < 1e-7, "{shape:?} at {r}");
            }
        }
    }

    #[test]
    fn the_support_ends_at_two_smoothing_lengths() {
        for shape in SHAPES {
            let kernel = Kernel::<3>::new(shape, 1.5);
            assert!(kernel.value_at(2.999) > 0.0 && kernel.gradient_factor_at(2.99) < 0.0);
            for r in [3.0, 3.5, 1e6] {
                assert_eq!((kernel.value_at(r), kernel.gradient_factor_at(r)), (0.0, 0.0));
            }
        }
    }

    #[test]
    fn the_origin_is_finite() {
        // W(0) of the cubic spline in the plane is 10/(7πh²), of Wendland C2 7/(4πh²)
        let h = 0.5;
        assert!(
            (Kernel::<2>::new(KernelShape::CubicSpline, h).value_at(0.0) - 10.0 / (7.0 * PI * h * h)).abs() < 1e-14
        );
        assert!((Kernel::<2>::new(KernelShape::WendlandC2, h).value_at(0.0) - 7.0 / (4.0 * PI * h * h)).abs() < 1e-14);
        for shape in SHAPES {
            assert!(Kernel::<2>::new(shape, h).gradient_factor_at(0.0).is_finite());
        }
    }
}
