//! Continuity (3)(7) as it is stepped (24), with the density–pressure coupling (27).
//!
//! The divergence in (7) is not corrected: the trace of the corrected gradient makes the layer shrink or blow up.
//!
//! The kernel of a grain bounds its density where grains bear no tension. Continuity gives (7) of every pair that
//! parts, weighted with the neighbour's volume m/ρ: grains that leave their neighbours one after another grow thinner
//! each time, and thinner neighbours count for more, so that in a spray ahead of a front ρ fell to a hundredth and each
//! grain weighed on the others with the volume of a hundred. But smoothed by the kernel a grain alone has the density
//! m W(0), 1/4 of ρ0 in the plane and 1/8 in space with h = 1.5 Δ, and with others near it has more. So ρ ≥ m W(0), or
//! V W(0) ≤ 1: no volume fills the kernel more than once. There the pressure is zero, in free flight and until the
//! grain has come together again with others, so that the bound does no work, moves nothing and loses no mass. What
//! lands from it is not pressed together either: in a full neighbourhood of volumes Δ^D, Σ V W = 1 − W(0) Δ^D without
//! itself, so that ρ comes to m W(0) exp(1 − W(0) Δ^D), 0.53 ρ0 in the plane and 0.30 ρ0 in space. A bound at ρ0 would
//! be another matter: what parts and meets again would be under pressure before it touches.

use crate::lanes::Real;

/// −∇·v `[1/s]`: the trace of the uncorrected gradient Σ V (v_b − v_a) ⊗ ∇W is ∇·v of (7).
#[inline(always)]
pub fn compression<R: Real, const D: usize>(gradient: &[[R; D]; D]) -> R {
    let mut compression = -gradient[0][0];
    for i in 1..D {
        compression = compression - gradient[i][i];
    }
    compression
}

/// ρ `[kg/m³]` after a time step `[s]`, (24) with (27): `coupling` is the pair sum of (27) `[Pa/m²]`, `strength` its σ
/// `[-]`. ρ has no floor near ρ0: it would open voids.
#[inline(always)]
#[must_use]
pub fn advanced<R: Real>(density: R, compression: R, coupling: R, strength: f64, time_step: f64) -> R {
    density + R::splat(time_step) * density * compression + R::splat(time_step * time_step * strength) * coupling
}

/// ρ `[kg/m³]` of a particle of a mass `[kg]`, no less than the m W(0) of a particle alone; `peak` is W(0) `[1/m^D]`, or 0 where
/// nothing is held. What was thinner in `previous` is not made denser than it was. NaN stays NaN.
#[inline(always)]
#[must_use]
pub fn held<R: Real>(density: R, previous: R, mass: R, peak: f64) -> R {
    (R::splat(peak) * mass).min(previous).max(density)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Kernel, KernelShape};

    /// Σ Δ^D W over a lattice without the site itself.
    fn full_neighbourhood<const D: usize>(kernel: &Kernel<D>) -> f64 {
        let mut sum = 0.0;
        for site in 0..7_i32.pow(D as u32) {
            let (mut rest, mut square) = (site, 0.0);
            for _ in 0..D {
                square += f64::from(rest % 7 - 3).powi(2);
                rest /= 7;
            }
            sum += if square > 0.0 { kernel.value_at(square.sqrt()) } else { 0.0 };
        }
        sum
    }

    fn lands_without_pressure<const D: usize>() {
        for shape in [KernelShape::WendlandC2, KernelShape::CubicSpline] {
            for smoothing_ratio in [1.3, 1.5] {
                let kernel = Kernel::<D>::new(shape, smoothing_ratio);
                let alone = kernel.value_at(0.0);
                let relative = held(1e-3, 1.0, 1.0, alone) * libm::exp(full_neighbourhood(&kernel));
                assert!(relative > alone && relative < 0.7, "{shape:?} in {D} dimensions: {relative}");
            }
        }
    }

    #[test]
    fn landing_grains_are_not_compressed() {
        lands_without_pressure::<2>();
        lands_without_pressure::<3>();
    }

    #[test]
    fn only_what_is_thinner_than_a_particle_alone_is_held() {
        assert_eq!(held(0.3, 1.0, 1.0, 0.25), 0.3);
        assert_eq!(held(0.2, 1.0, 1.0, 0.25), 0.25);
        assert_eq!(held(0.2, 1.0, 1.0, 0.0), 0.2);
        // a body that starts thinner
        assert_eq!((held(0.1, 0.15, 1.0, 0.25), held(0.2, 0.15, 1.0, 0.25)), (0.15, 0.2));
        assert!(held(f64::NAN, 1.0, 1.0, 0.25).is_nan() && held(f64::NAN, f64::NAN, 1.0, 0.25).is_nan());
    }
}
