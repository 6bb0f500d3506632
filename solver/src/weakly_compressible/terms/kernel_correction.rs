//! Kernel corrections from the moment matrix M = −Σ V_b F r⊗r, which tends to the identity inside the flow.

use crate::lanes::{LANES, Lanes};
use crate::vector::Tensor;

/// Smallest eigenvalue of M at which gradients use L = M⁻¹ in full `[-]`.
const FULL_GRADIENT: f64 = 0.3;
/// Smallest eigenvalue of M below which gradients use the identity `[-]`.
const NO_GRADIENT: f64 = 0.1;
/// Smallest eigenvalue of M below which forces use the identity `[-]`.
const NO_FORCE: f64 = 0.6;
/// Width of the blend of the force correction `[-]`.
const FORCE_BLEND: f64 = 0.2;

/// Above which both blends are 1, by more than rounding `[-]`.
const NO_BLEND: f64 = NO_FORCE + FORCE_BLEND + 1e-9;

/// L of (9) for gradients and E for forces, both shape `[D, D]` `[-]`, lane by lane.
///
/// L = M⁻¹ blends linearly to the identity as the smallest eigenvalue λ of M falls from 0.3 to 0.1 (the paper has no
/// fall-back, and (9) is singular for an isolated particle). E = w M⁻¹ + (1 − w) I, w = clamp((λ − 0.6)/0.2, 0, 1):
/// forces are corrected only where the neighbourhood is nearly full, so that a free surface stays a free surface.
#[inline(always)]
#[must_use]
pub fn corrections<V: Lanes, const D: usize>(moment: &[[V; D]; D]) -> ([[V; D]; D], [[V; D]; D]) {
    let (for_gradients, for_forces, _) = corrections_and_eigenvalue(moment, NO_BLEND);
    (for_gradients, for_forces)
}

/// The same and λ, which is exact up to a limit and some bound from below that lies above the limit elsewhere `[-]`.
#[inline(always)]
#[must_use]
pub fn corrections_and_eigenvalue<V: Lanes, const D: usize>(
    moment: &[[V; D]; D],
    exact_up_to: f64,
) -> ([[V; D]; D], [[V; D]; D], V) {
    let smallest = smallest_eigenvalue(moment, exact_up_to.max(NO_BLEND));
    let inverse = inverse(moment);
    let for_gradients = blended(&inverse, ramp(smallest, NO_GRADIENT, FULL_GRADIENT - NO_GRADIENT), smallest);
    let for_forces = blended(&inverse, ramp(smallest, NO_FORCE, FORCE_BLEND), smallest);
    (for_gradients, for_forces, smallest)
}

/// clamp((value − from)/width, 0, 1).
#[inline(always)]
fn ramp<V: Lanes>(value: V, from: f64, width: f64) -> V {
    ((value - V::splat(from)) * V::splat(1.0 / width)).max(V::splat(0.0)).min(V::splat(1.0))
}

/// w M⁻¹ + (1 − w) I; the identity where M is too flat to be inverted, or not a number.
#[inline(always)]
fn blended<V: Lanes, const D: usize>(inverse: &[[V; D]; D], share: V, smallest: V) -> [[V; D]; D] {
    let mut lanes = *inverse;
    for i in 0..D {
        for j in 0..D {
            let part = (inverse[i][j] * share).where_less(V::splat(NO_GRADIENT), smallest);
            lanes[i][j] = if i == j { part + (V::splat(1.0) - share) } else { part };
        }
    }
    lanes
}

/// Smallest eigenvalue of a symmetric tensor; exact in 2-D, in 3-D by the trigonometric solution, or where all its
/// Gershgorin discs lie above a limit, a bound of it from below: the value is of no meaning there.
#[inline(always)]
fn smallest_eigenvalue<V: Lanes, const D: usize>(m: &[[V; D]; D], exact_up_to: f64) -> V {
    if D == 2 {
        let half_difference = V::splat(0.5) * (m[0][0] - m[1][1]);
        let mean = V::splat(0.5) * (m[0][0] + m[1][1]);
        return mean - (half_difference * half_difference + m[0][1] * m[0][1]).sqrt();
    }
    let bound = gershgorin_bound(m).to_array();
    let mut components = [[[0.0; LANES]; D]; D];
    for i in 0..D {
        for j in 0..D {
            components[i][j] = m[i][j].to_array();
        }
    }
    let mut smallest = [0.0; LANES];
    for lane in 0..LANES {
        if bound[lane] > exact_up_to {
            smallest[lane] = bound[lane];
            continue;
        }
        let mut matrix = Tensor::<D>::zeros();
        for i in 0..D {
            for j in 0..D {
                matrix[(i, j)] = components[i][j][lane];
            }
        }
        smallest[lane] = smallest_eigenvalue_in_space(&matrix);
    }
    V::load(&smallest)
}

/// Bound of all eigenvalues of a symmetric tensor from below; not a number where an entry is none.
#[inline(always)]
fn gershgorin_bound<V: Lanes, const D: usize>(m: &[[V; D]; D]) -> V {
    let (mut bound, mut sum) = (V::splat(f64::INFINITY), V::splat(0.0));
    for i in 0..D {
        let mut disc = m[i][i];
        for j in 0..D {
            if i != j {
                disc = disc - m[i][j].max(-m[i][j]);
            }
        }
        (bound, sum) = (disc.min(bound), sum + disc);
    }
    bound + V::splat(0.0) * sum
}

fn smallest_eigenvalue_in_space<const D: usize>(m: &Tensor<D>) -> f64 {
    let mean = m.trace() / D as f64;
    let deviator = crate::vector::deviator(m);
    let scale = (crate::vector::double_contraction(&deviator, &deviator) / 6.0).sqrt();
    if scale < 1e-14 * mean.abs() {
        return mean;
    }
    let d = |i: usize, j: usize| deviator[(i, j)];
    let determinant = d(0, 0) * (d(1, 1) * d(2, 2) - d(1, 2) * d(2, 1))
        - d(0, 1) * (d(1, 0) * d(2, 2) - d(1, 2) * d(2, 0))
        + d(0, 2) * (d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0));
    let half_determinant = 0.5 * determinant / (scale * scale * scale);
    let angle = libm::acos(half_determinant.clamp(-1.0, 1.0)) / 3.0;
    mean + 2.0 * scale * libm::cos(angle + 2.0 * std::f64::consts::PI / 3.0)
}

/// Inverse by cofactors; infinite or not a number where there is none.
#[inline(always)]
fn inverse<V: Lanes, const D: usize>(m: &[[V; D]; D]) -> [[V; D]; D] {
    let mut lanes = *m;
    if D == 2 {
        let scale = V::splat(1.0) / (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
        for i in 0..D {
            for j in 0..D {
                lanes[i][j] = if i == j { m[1 - i][1 - i] * scale } else { -m[i][j] * scale };
            }
        }
        return lanes;
    }
    for i in 0..D {
        for j in 0..D {
            let (a, b) = ((j + 1) % 3, (j + 2) % 3);
            let (c, d) = ((i + 1) % 3, (i + 2) % 3);
            lanes[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    let scale = V::splat(1.0) / (m[0][0] * lanes[0][0] + m[0][1] * lanes[1][0] + m[0][2] * lanes[2][0]);
    for i in 0..D {
        for j in 0..D {
            lanes[i][j] = lanes[i][j] * scale;
        }
    }
    lanes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::algebra::{store, store_tensor, zero_tensor};
    use crate::lanes::{InstructionSet, LanePass};

    struct One<'a, const D: usize> {
        moment: &'a Tensor<D>,
        corrections: &'a mut [Tensor<D>; 2],
        eigenvalue: &'a mut f64,
    }

    impl<const D: usize> LanePass for One<'_, D> {
        #[inline(always)]
        fn run<V: Lanes>(self) {
            let mut moment = zero_tensor::<V, D>();
            for i in 0..D {
                for j in 0..D {
                    moment[i][j] = V::splat(self.moment[(i, j)]);
                }
            }
            let (gradient, force) = super::corrections(&moment);
            store_tensor(&gradient, &mut self.corrections[..1]);
            store_tensor(&force, &mut self.corrections[1..]);
            store(super::smallest_eigenvalue(&moment, NO_BLEND), std::slice::from_mut(self.eigenvalue));
        }
    }

    /// The corrections of one matrix and its smallest eigenvalue, through the lanes.
    fn through_lanes<const D: usize>(moment: &Tensor<D>) -> ([Tensor<D>; 2], f64) {
        let (mut corrections, mut eigenvalue) = ([Tensor::zeros(); 2], 0.0);
        let pass = One { moment, corrections: &mut corrections, eigenvalue: &mut eigenvalue };
        InstructionSet::best().run(pass);
        (corrections, eigenvalue)
    }

    fn corrections<const D: usize>(moment: &Tensor<D>) -> (Tensor<D>, Tensor<D>) {
        through_lanes(moment).0.into()
    }

    fn smallest_eigenvalue<const D: usize>(moment: &Tensor<D>) -> f64 {
        through_lanes(moment).1
    }

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
