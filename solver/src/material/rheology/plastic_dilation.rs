//! Plastic flow that changes the volume: a dilation that vanishes along a line over the plastic shear strain κ.
//!
//! With the sine β of the dilation angle the plastic volume strain rate is ε̇_v = β(κ) κ̇ (Taylor 1948; Rowe 1962 for sand, whose dilation
//! ends as it comes to its critical density):
//!
//! β = β_p max(0, 1 − κ/κ_d), e(κ) = ∫ β dκ = β_p c (1 − c/2κ_d), c = min(κ, κ_d),
//!
//! and without κ_d β = β_p for ever, e = β_p κ. e is the logarithm of the volume over that before any plastic flow, at equal pressure. It is a function
//! of κ alone: who has κ needs no other field.

use crate::lanes::Real;

/// Dilation of plastic flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlasticDilation {
    /// β_p `[-]`.
    pub(super) peak: f64,
    /// κ_d `[-]`, infinite for a dilation that does not vanish.
    pub(super) strain: f64,
}

impl PlasticDilation {
    /// β `[-]`, the volume strain for each shear strain, at a plastic shear strain `[-]`.
    pub(super) fn ratio(self, strain: f64) -> f64 {
        self.peak * (1.0 - strain / self.strain).max(0.0)
    }

    /// e `[-]`, the plastic volume strain of a plastic shear strain `[-]`.
    #[inline(always)]
    pub(super) fn volume_strain<R: Real>(self, strain: R) -> R {
        let dilated = strain.min(R::splat(self.strain));
        R::splat(self.peak) * dilated * (R::splat(1.0) - dilated / R::splat(2.0 * self.strain))
    }

    /// The largest e `[-]`.
    pub(super) fn largest_volume_strain(self) -> f64 {
        0.5 * self.peak * self.strain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_volume_strain_is_the_integral_of_the_ratio() {
        for strain in [0.1, 0.35, f64::INFINITY] {
            let dilation = PlasticDilation { peak: 0.3, strain };
            let (mut sum, width) = (0.0, 1.0 / 1024.0);
            for slice in 0..512 {
                // the middle is exact except across the kink
                sum += width * dilation.ratio((f64::from(slice) + 0.5) * width);
                let found = dilation.volume_strain(f64::from(slice + 1) * width);
                assert!((found - sum).abs() < 0.3 * width * width / strain + 1e-15, "{found} for {sum}");
            }
            let largest = dilation.largest_volume_strain();
            assert!(sum <= largest && (strain > 0.5 || (dilation.volume_strain(0.5) - largest).abs() < 1e-16));
        }
    }
}
