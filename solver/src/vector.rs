//! The dimension-generic vector and tensor types and the few operations that the whole solver shares.

use nalgebra::{SMatrix, SVector};

/// A point or vector in `D` dimensions, shape `[D]`.
pub type Vector<const D: usize> = SVector<f64, D>;

/// A second-order tensor in `D` dimensions, shape `[D, D]`; a velocity gradient has `[i][j] = ∂v_i/∂x_j`.
pub type Tensor<const D: usize> = SMatrix<f64, D, D>;

/// Strain-rate tensor ε = ½(∇v + ∇vᵀ) `[1/s]` of a velocity gradient `[1/s]`.
#[inline(always)]
#[must_use]
pub fn strain_rate<const D: usize>(velocity_gradient: &Tensor<D>) -> Tensor<D> {
    (velocity_gradient + velocity_gradient.transpose()) * 0.5
}

/// Deviator ε′ = ε − tr(ε)/D · I, in the units of the argument.
///
/// With D = 2 this keeps plane strain without carrying an out-of-plane component.
#[inline(always)]
#[must_use]
pub fn deviator<const D: usize>(tensor: &Tensor<D>) -> Tensor<D> {
    let mean = tensor.trace() / D as f64;
    let mut deviator = *tensor;
    for i in 0..D {
        deviator[(i, i)] -= mean;
    }
    deviator
}

/// Double contraction A:B = Σ A_ij B_ij.
#[inline(always)]
#[must_use]
pub fn double_contraction<const D: usize>(a: &Tensor<D>, b: &Tensor<D>) -> f64 {
    let mut sum = 0.0;
    for i in 0..D {
        for j in 0..D {
            sum += a[(i, j)] * b[(i, j)];
        }
    }
    sum
}

/// Shear rate |γ̇| = √(2 ε′:ε′) `[1/s]` of a velocity gradient `[1/s]`; simple shear u(y) gives |du/dy|.
#[inline(always)]
#[must_use]
pub fn shear_rate<const D: usize>(velocity_gradient: &Tensor<D>) -> f64 {
    let rate = deviator(&strain_rate(velocity_gradient));
    (2.0 * double_contraction(&rate, &rate)).sqrt()
}

/// Equivalent shear stress τ = √(½ s:s) `[Pa]` of a deviatoric stress `[Pa]`.
#[inline(always)]
#[must_use]
pub fn equivalent_shear_stress<const D: usize>(deviatoric_stress: &Tensor<D>) -> f64 {
    (0.5 * double_contraction(deviatoric_stress, deviatoric_stress)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_shear_has_the_shear_rate_of_its_profile() {
        let mut gradient = Tensor::<3>::zeros();
        gradient[(0, 1)] = 7.0;
        assert!((shear_rate(&gradient) - 7.0).abs() < 1e-14);
    }

    #[test]
    fn a_deviator_has_no_trace() {
        let tensor = Tensor::<2>::new(3.0, 1.0, 2.0, -9.0);
        assert!(deviator(&tensor).trace().abs() < 1e-15);
    }

    #[test]
    fn rigid_rotation_has_no_shear_rate() {
        let gradient = Tensor::<2>::new(0.0, -4.0, 4.0, 0.0);
        assert!(shear_rate(&gradient) == 0.0);
    }
}
