//! Artificial stress against the tensile instability of a material that holds together.
//!
//! Particles that pull at each other clump: where a principal stress is tensile, neighbours along it move apart in pairs, with no strain
//! that the velocity gradient could see, faster the closer they are (Swegle, Hicks & Attaway 1995). Monaghan (2000), J. Comput. Phys. 159, and
//! Gray, Monaghan & Swift (2001), Comput. Methods Appl. Mech. Eng. 190, push near pairs apart by the part ε f⁴ of the tension, with
//! f = W(r)/W(Δ) and ε = 0.3. Here the tension is the one along the pair, and its mean over a lattice stays as it was:
//!
//! t_ab → t_ab − ε (f⁴ − m) max(0, t_ab·r/r²) r, m = Σ F r² f⁴/Σ F r² over the lattice,
//!
//! with the traction t_ab = (σ_a E_a + σ_b E_b) r. Without m an even tension would carry a tenth less than its stress. Along the pair and
//! antisymmetric, so that momentum and angular momentum stay; nothing without tension. Not in the paper.

use crate::kernel::Kernel;
use crate::lanes::Real;

/// ε of Gray, Monaghan & Swift `[-]`.
const STRENGTH: f64 = 0.3;

/// Part of a pair's tension that is removed, for one kernel and spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArtificialStress {
    /// In the plane: the ratio of two values of a kernel is the same in space.
    kernel: Kernel<2>,
    /// 1/W(Δ) `[m²]`.
    inverse_value: f64,
    /// m `[-]`.
    mean: f64,
}

impl ArtificialStress {
    /// For a kernel at a particle spacing Δ `[m]`, in D dimensions.
    #[must_use]
    pub fn new<const D: usize>(kernel: &Kernel<D>, spacing: f64) -> Self {
        let plane = Kernel::<2>::new(kernel.shape, kernel.smoothing_length());
        let mut stress = Self { kernel: plane, inverse_value: 1.0 / plane.value_at(spacing), mean: 0.0 };
        let reach = (kernel.support() / spacing) as i32;
        let side = 2 * reach as usize + 1;
        let (mut near, mut all) = (0.0, 0.0);
        for site in 0..side.pow(D as u32) {
            let (mut rest, mut square) = (site, 0.0);
            for _ in 0..D {
                square += (f64::from((rest % side) as i32 - reach) * spacing).powi(2);
                rest /= side;
            }
            if square > 0.0 {
                let weight = kernel.gradient_weight(square, 1.0) * square;
                near += weight * stress.nearness(square);
                all += weight;
            }
        }
        stress.mean = near / all;
        stress
    }

    /// f⁴ `[-]` at a squared distance `[m²]`.
    #[inline(always)]
    fn nearness<V: Real>(&self, square: V) -> V {
        // in this order a number of single precision too
        let ratio = self.kernel.value(square) * V::splat(self.inverse_value);
        let squared = ratio * ratio;
        squared * squared
    }

    /// −ε (f⁴ − m) max(0, t·r/r²) `[Pa]`, the factor of r that a pair's traction gains: `square` is r² `[m²]`, `along` t·r/r² `[Pa]`.
    #[inline(always)]
    pub fn factor<V: Real>(&self, square: V, along: V) -> V {
        (V::splat(self.mean) - self.nearness(square)) * (V::splat(STRENGTH) * along.max(V::splat(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::KernelShape;

    const SPACING: f64 = 0.5;

    fn kernel<const D: usize>() -> Kernel<D> {
        Kernel::new(KernelShape::WendlandC2, 1.5 * SPACING)
    }

    #[test]
    fn near_pairs_under_tension_are_pushed_apart_and_no_others() {
        let stress = ArtificialStress::new(&kernel::<2>(), SPACING);
        let at = |distance: f64, along: f64| stress.factor(distance * distance, along);
        // F is negative: a traction against r pushes apart
        assert!(at(SPACING, 100.0) < 0.0 && at(0.9 * SPACING, 100.0) < at(SPACING, 100.0));
        assert_eq!((at(SPACING, -100.0), at(SPACING, 0.0)), (0.0, 0.0));
        // what near pairs lose the others gain
        assert!(at(2.0 * SPACING, 100.0) > 0.0);
        // f = 1 at the spacing
        assert!((at(SPACING, 100.0) - 30.0 * (stress.mean - 1.0)).abs() < 1e-12);
    }

    /// Σ F (factor) r² vanishes for a tension that is the same along all pairs.
    #[test]
    fn an_even_tension_of_a_lattice_stays() {
        fn left<const D: usize>() -> f64 {
            let (kernel, reach) = (kernel::<D>(), 3);
            let stress = ArtificialStress::new(&kernel, SPACING);
            let (mut sum, mut size) = (0.0, 0.0);
            for site in 0..7_usize.pow(D as u32) {
                let place: Vec<i32> = (0..D).map(|axis| (site / 7_usize.pow(axis as u32) % 7) as i32 - reach).collect();
                let square = place.iter().map(|&x| f64::from(x * x)).sum::<f64>() * SPACING * SPACING;
                if square > 0.0 {
                    let weight = kernel.gradient_factor_at(square.sqrt()) * square;
                    sum += weight * stress.factor(square, 100.0);
                    size += (weight * stress.factor(square, 100.0)).abs();
                }
            }
            (sum / size).abs()
        }
        assert!(left::<2>() < 1e-13 && left::<3>() < 1e-13, "{} {}", left::<2>(), left::<3>());
    }

    /// The stiffness of a lattice under tension along one axis against neighbours that move apart in pairs along it: negative without
    /// the term, which is the instability, positive with it.
    #[test]
    fn a_lattice_under_tension_resists_what_its_strain_does_not_see() {
        let kernel = kernel::<2>();
        let control = ArtificialStress::new(&kernel, SPACING);
        // force on the particle in the middle when every second column is displaced by `shift`
        let force = |shift: f64, controlled: bool| {
            let mut sum = 0.0;
            for i in -4_i32..=4 {
                for j in -4_i32..=4 {
                    let moved = if i % 2 == 0 { shift } else { -shift };
                    let r = [shift - (f64::from(i) * SPACING + moved), -f64::from(j) * SPACING];
                    let square = r[0] * r[0] + r[1] * r[1];
                    if (i, j) != (0, 0) {
                        // a stress of 1 along the first axis
                        let along = 2.0 * r[0] * r[0] / square;
                        let gain = if controlled { control.factor(square, along) } else { 0.0 };
                        sum += kernel.gradient_factor_at(square.sqrt()) * (2.0 + gain) * r[0];
                    }
                }
            }
            sum
        };
        let shift = 1e-4 * SPACING;
        assert!(force(shift, false) > 0.0, "{}", force(shift, false));
        assert!(force(shift, true) < 0.0, "{}", force(shift, true));
    }
}
