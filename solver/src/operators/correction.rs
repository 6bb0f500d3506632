//! Kernel corrections from the moment matrix M = −Σ V_b F r⊗r, which tends to the identity inside the flow.

use crate::vector::Tensor;

/// Smallest eigenvalue of M at which gradients use L = M⁻¹ in full `[-]`.
const FULL_GRADIENT: f64 = 0.3;
/// Smallest eigenvalue of M below which gradients use the identity `[-]`.
const NO_GRADIENT: f64 = 0.1;
/// Smallest eigenvalue of M below which forces use the identity `[-]`.
const NO_FORCE: f64 = 0.6;
/// Width of the blend of the force correction `[-]`.
const FORCE_BLEND: f64 = 0.2;

/// L of (9) for gradients and E for forces, both shape `[D, D]` `[-]`.
///
/// L = M⁻¹ blends linearly to the identity as the smallest eigenvalue λ of M falls from 0.3 to 0.1 (the paper has no
/// fall-back, and (9) is singular for an isolated particle). E = w M⁻¹ + (1 − w) I, w = clamp((λ − 0.6)/0.2, 0, 1):
/// forces are corrected only where the neighbourhood is nearly full, so that a free surface stays a free surface.
#[inline(always)]
#[must_use]
pub fn corrections<const D: usize>(moment: &Tensor<D>) -> (Tensor<D>, Tensor<D>) {
    let smallest = smallest_eigenvalue(moment);
    let identity = Tensor::<D>::identity();
    let gradient_weight = ((smallest - NO_GRADIENT) / (FULL_GRADIENT - NO_GRADIENT)).clamp(0.0, 1.0);
    if gradient_weight == 0.0 || gradient_weight.is_nan() {
        return (identity, identity);
    }
    let inverse = inverse(moment);
    let force_weight = ((smallest - NO_FORCE) / FORCE_BLEND).clamp(0.0, 1.0);
    (
        inverse * gradient_weight + identity * (1.0 - gradient_weight),
        inverse * force_weight + identity * (1.0 - force_weight),
    )
}

/// Smallest eigenvalue of a symmetric tensor; exact in 2-D, in 3-D by the trigonometric solution.
#[inline(always)]
fn smallest_eigenvalue<const D: usize>(m: &Tensor<D>) -> f64 {
    let mean = m.trace() / D as f64;
    if D == 2 {
        let half_difference = 0.5 * (m[(0, 0)] - m[(1, 1)]);
        return mean - (half_difference * half_difference + m[(0, 1)] * m[(0, 1)]).sqrt();
    }
    let mut deviator = *m;
    for i in 0..D {
        deviator[(i, i)] -= mean;
    }
    let scale = (crate::vector::double_contraction(&deviator, &deviator) / 6.0).sqrt();
    if scale < 1e-14 * mean.abs() {
        return mean;
    }
    let half_determinant = 0.5 * determinant_3(&deviator) / (scale * scale * scale);
    let angle = libm::acos(half_determinant.clamp(-1.0, 1.0)) / 3.0;
    mean + 2.0 * scale * libm::cos(angle + 2.0 * std::f64::consts::PI / 3.0)
}

#[inline(always)]
fn determinant_3<const D: usize>(m: &Tensor<D>) -> f64 {
    m[(0, 0)] * (m[(1, 1)] * m[(2, 2)] - m[(1, 2)] * m[(2, 1)])
        - m[(0, 1)] * (m[(1, 0)] * m[(2, 2)] - m[(1, 2)] * m[(2, 0)])
        + m[(0, 2)] * (m[(1, 0)] * m[(2, 1)] - m[(1, 1)] * m[(2, 0)])
}

/// Inverse by cofactors; called only where the smallest eigenvalue is well above zero.
#[inline(always)]
fn inverse<const D: usize>(m: &Tensor<D>) -> Tensor<D> {
    if D == 2 {
        let scale = 1.0 / (m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]);
        return Tensor::from_fn(|i, j| if i == j { m[(1 - i, 1 - i)] * scale } else { -m[(i, j)] * scale });
    }
    let scale = 1.0 / determinant_3(m);
    Tensor::from_fn(|i, j| {
        let (a, b) = ((j + 1) % 3, (j + 2) % 3);
        let (c, d) = ((i + 1) % 3, (i + 2) % 3);
        (m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]) * scale
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_neighbourhood_is_inverted() {
        let m2 = Tensor::<2>::new(1.02, 0.03, 0.03, 0.97);
        let m3 = Tensor::<3>::new(1.1, 0.05, -0.02, 0.05, 0.95, 0.01, -0.02, 0.01, 1.0);
        assert!((corrections(&m2).0 * m2 - Tensor::identity()).norm() < 1e-14);
        assert!((corrections(&m3).0 * m3 - Tensor::identity()).norm() < 1e-14);
        assert!((corrections(&m3).1 * m3 - Tensor::identity()).norm() < 1e-14);
    }

    #[test]
    fn eigenvalues_agree_with_nalgebra() {
        let m = Tensor::<3>::new(0.8, 0.2, -0.1, 0.2, 0.5, 0.05, -0.1, 0.05, 0.7);
        let expected = m.symmetric_eigen().eigenvalues.min();
        assert!((smallest_eigenvalue(&m) - expected).abs() < 1e-12);
        let m = Tensor::<2>::new(0.8, 0.2, 0.2, 0.5);
        assert!((smallest_eigenvalue(&m) - m.symmetric_eigen().eigenvalues.min()).abs() < 1e-14);
    }

    #[test]
    fn an_isolated_particle_falls_back_to_the_identity() {
        let (gradient, force) = corrections(&Tensor::<2>::zeros());
        assert_eq!(gradient, Tensor::<2>::identity());
        assert_eq!(force, Tensor::<2>::identity());
        // a flat cluster: no information across
        let (gradient, _) = corrections(&Tensor::<2>::new(1.0, 0.0, 0.0, 0.05));
        assert_eq!(gradient, Tensor::<2>::identity());
    }

    #[test]
    fn forces_are_corrected_only_in_nearly_full_neighbourhoods() {
        let half = Tensor::<2>::new(1.0, 0.0, 0.0, 0.5);
        let (gradient, force) = corrections(&half);
        assert!((gradient[(1, 1)] - 2.0).abs() < 1e-14);
        assert_eq!(force, Tensor::<2>::identity());
    }
}
