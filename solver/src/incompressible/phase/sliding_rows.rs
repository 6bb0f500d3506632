//! Rows of particles that slide over each other.

use crate::kernel::Kernel;

/// Strips of the integral along a row; the rate below is then exact to 1e-5.
const STRIPS: u32 = 256;

/// Shear rate γ̇ of sliding rows over |u_ab|/r of their pairs, as a mean `[-]`: the pairs' viscosities
/// τ r/(rate |u_ab|) of a stress τ that does not depend on the rate then carry just τ.
///
/// It is Σ V (−F) |y| r/Σ V (−F) y² over the rows at |y| = 1, 2, … spacings, whose particles pass each other and so have all
/// places along the row. Over all directions the same quotient is ⟨|cosα|⟩/⟨cos²α⟩, 4/π in the plane and 3/2 in space, and
/// it tends to these with h; but of few rows, the own one sees no shear at all: for h = 1.2 spacings it is 1.175 in the plane.
pub(crate) fn rate_of_sliding_rows<const D: usize>(kernel: &Kernel<D>, spacing: f64) -> f64 {
    let support = kernel.support();
    let (mut of_stress, mut of_viscosity) = (0.0, 0.0);
    let mut height = spacing;
    while height < support {
        let end = (support * support - height * height).sqrt();
        for strip in 0..STRIPS {
            let along = end * (f64::from(strip) + 0.5) / f64::from(STRIPS);
            let square = height * height + along * along;
            // strips of a row, rings of a plane
            let width = end * along.powi(D as i32 - 2);
            let weight = -width * kernel.gradient_weight(square, 1.0);
            of_stress += weight * height * square.sqrt();
            of_viscosity += weight * height * height;
        }
        height += spacing;
    }
    of_stress / of_viscosity
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::KernelShape;
    use std::f64::consts::PI;

    fn rate<const D: usize>(smoothing_ratio: f64) -> f64 {
        rate_of_sliding_rows(&Kernel::<D>::new(KernelShape::CubicSpline, smoothing_ratio), 1.0)
    }

    #[test]
    fn many_rows_see_all_directions() {
        assert!((rate::<2>(12.0) / (4.0 / PI) - 1.0).abs() < 2e-3, "{}", rate::<2>(12.0));
        assert!((rate::<3>(12.0) / 1.5 - 1.0).abs() < 2e-3, "{}", rate::<3>(12.0));
    }

    /// The integral along a row by the angle between a pair and the row's normal, in many parts.
    #[test]
    fn the_integral_is_that_over_all_angles() {
        fn check<const D: usize>(smoothing_ratio: f64) {
            let kernel = Kernel::<D>::new(KernelShape::CubicSpline, smoothing_ratio);
            let (mut of_stress, mut of_viscosity) = (0.0, 0.0);
            for height in (1..3).map(f64::from).filter(|height| *height < kernel.support()) {
                let (end, parts) = ((height / kernel.support()).acos(), 4000);
                for part in 0..parts {
                    let angle = end * (f64::from(part) + 0.5) / f64::from(parts);
                    let (distance, along) = (height / angle.cos(), height * angle.tan());
                    let width = end * height / angle.cos().powi(2) * if D == 2 { 1.0 } else { along };
                    let weight = width * kernel.gradient_factor_at(distance);
                    of_stress += weight * height * distance;
                    of_viscosity += weight * height * height;
                }
            }
            let (found, expected) = (rate::<D>(smoothing_ratio), of_stress / of_viscosity);
            assert!((found / expected - 1.0).abs() < 2e-5, "{found} and {expected}");
        }
        for smoothing_ratio in [0.9, 1.2, 1.4] {
            check::<2>(smoothing_ratio);
            check::<3>(smoothing_ratio);
        }
    }

    /// Rows of particles one by one, displaced against each other in steps: what their pairs carry of a stress that does not
    /// depend on the rate, by the viscosity τ r/(rate |u_ab|) of each.
    #[test]
    fn rows_that_slide_carry_the_stress_of_the_law() {
        let kernel = Kernel::<2>::new(KernelShape::CubicSpline, 1.2);
        let rate = rate::<2>(1.2);
        let steps = 200;
        let (mut carried, mut moment) = (0.0, 0.0);
        for step in 0..steps {
            let phase = (f64::from(step) + 0.5) / f64::from(steps);
            for row in -3..=3_i32 {
                let offset = if row == 0 { 0.0 } else { phase };
                for place in -4..=4 {
                    let (x, y) = (f64::from(place) + offset, f64::from(row));
                    let square = x * x + y * y;
                    if square > 0.0 {
                        let weight = -kernel.gradient_weight(square, 1.0);
                        // η γ̇ y, times y, where γ̇ |y|/r is the pair's rate; the moment is that of the operator
                        carried += weight * square.sqrt() * y.abs() / rate;
                        moment += weight * 0.5 * square;
                    }
                }
            }
        }
        let share = carried / moment;
        assert!((share - 1.0).abs() < 5e-3, "{share}");
        // with the mean over all directions it would be 0.92
        assert!(share * rate / (4.0 / PI) < 0.93);
    }
}
