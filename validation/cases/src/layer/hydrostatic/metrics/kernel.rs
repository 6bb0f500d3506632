//! The kernel itself: what every pair sum of the layer rests on. A layer at rest forgives a kernel that is 2 % too large,
//! because its corrections divide by what the kernel gives.

use super::{KERNEL_INTEGRAL_ERROR, KERNEL_MOMENT_ERROR};
use crate::metric::{Limit, Metric, Variant};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::weakly_compressible::Numerics;
use std::f64::consts::PI;

/// Cells of the midpoint rule over the support.
const CELLS: usize = 20_000;

/// A sum over the support in shells of the dimension, for h = 1 `[-]`.
fn integral<const D: usize>(shape: KernelShape, value: impl Fn(&Kernel<D>, f64) -> f64) -> f64 {
    let kernel = Kernel::<D>::new(shape, 1.0);
    let width = kernel.support() / CELLS as f64;
    let shell = |r: f64| if D == 2 { 2.0 * PI * r } else { 4.0 * PI * r * r };
    (0..CELLS).map(|cell| (cell as f64 + 0.5) * width).map(|r| shell(r) * value(&kernel, r) * width).sum()
}

/// Integral and moment of a kernel in the plane and in space, each of which is one.
fn sums<const D: usize>(shape: KernelShape) -> [f64; 2] {
    [
        integral::<D>(shape, Kernel::value_at),
        integral::<D>(shape, |kernel, r| -kernel.gradient_factor_at(r) * r * r / D as f64),
    ]
}

pub(super) fn all(numerics: &Numerics) -> Vec<Metric> {
    let name = match numerics.kernel {
        KernelShape::CubicSpline => "cubic_spline",
        KernelShape::WendlandC2 => "wendland_c2",
    };
    let of_dimension = |dimension: usize, [value, moment]: [f64; 2]| {
        let variant = Variant::of("kernel", name).and("dimension", dimension);
        let unity = |quantity: crate::metric::Quantity, sum: f64, source: &str| {
            quantity
                .of(&variant, 100.0 * (sum - 1.0))
                .exactly(0.0, source)
                .gated(
                    Limit::Within(-1e-6, 1e-6),
                    "1e-6 %: expected error of the midpoint rule with 20 000 cells; the identity is exact",
                )
                .with_snapshot_tolerance(0.0, 1e-6)
        };
        [
            unity(KERNEL_INTEGRAL_ERROR, value, "∫ W dV = 1: a sum over neighbours is a mean"),
            unity(KERNEL_MOMENT_ERROR, moment, "−∫ F r²/D dV = 1: the gradient of a linear field is its slope"),
        ]
    };
    let planar = of_dimension(2, sums::<2>(numerics.kernel));
    planar.into_iter().chain(of_dimension(3, sums::<3>(numerics.kernel))).collect()
}
