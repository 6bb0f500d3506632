//! Share β of the kernel correction in the forces of a liquid: all of it where particles move together, none at rest.
//!
//! Uncorrected forces derive from an energy of the particles' places. A liquid comes to rest with them, but they resist every
//! rearrangement: a vortex with 20 particles over its side decays 1.6 times too fast. Corrected forces do not, but their work is not
//! answered by the density: a tank at rest stirs itself. So E = I + β (M⁻¹ − I) with
//!
//! β = clamp((Ma − min(2 Ma_γ, 0.006) − 2·10⁻⁴)/(4·10⁻⁴), 0, 1),
//!
//! Ma the root mean square of the velocity about its mean over the speed of sound, and Ma_γ that of γ̇ Δ. Where velocities differ from
//! particle to particle, in a tank that stirs itself, Ma_γ is 0.48 to 0.75 Ma; in waves of 15 rows 0.3. Above a Mach number of 0.007
//! no tank stirs itself. The share is the same in a moving frame.
//!
//! A stiff liquid stirs itself as one body, and needs no correction: its viscous stress s is large against what uncorrected forces add,
//! 0.02 ρ c Δ γ̇ in a vortex. β counts by clamp(2 − 2 |s|/(ρ c Δ γ̇), 0, 1) of root mean squares. Not in the paper.

/// Ma_γ of disorder counts this often `[-]`.
const DISORDER: f64 = 2.0;
/// Largest Mach number that disorder reaches by itself, with a margin of two `[-]`.
const MOST_DISORDER: f64 = 0.006;
/// Mach numbers of the common motion between which the share rises from 0 to 1 `[-]`.
const RISE: (f64, f64) = (2e-4, 6e-4);

/// β `[-]` from the root mean squares of the velocity about its mean and of γ̇ Δ, both over the speed of sound `[-]`.
#[must_use]
pub fn correction_share(speed: f64, shear: f64) -> f64 {
    let common = speed - (DISORDER * shear).min(MOST_DISORDER);
    ((common - RISE.0) / (RISE.1 - RISE.0)).clamp(0.0, 1.0)
}

/// Part of β `[-]` that the viscous stress leaves, from the root mean squares of |s|/(ρ c²) and of γ̇ Δ/c `[-]`.
#[must_use]
pub fn fluidity(stress: f64, shear: f64) -> f64 {
    if stress > 0.0 { (2.0 - 2.0 * stress / shear.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn disorder_has_no_share_and_flow_has_all_of_it() {
        // (Ma, Ma_γ): tanks at rest square, L-shaped and turned by 17°
        for (speed, shear) in [(7e-5, 5.3e-5), (8e-4, 4.2e-4), (2.4e-3, 1.15e-3), (3.2e-3, 1.65e-3), (0.0, 0.0)] {
            assert_eq!(correction_share(speed, shear), 0.0, "{speed}");
        }
        // a wave of 15 rows, a vortex of 20 particles, a cavity of 20
        for (speed, shear) in [(2.4e-3, 6.2e-4), (0.05, 0.024), (0.02, 0.014)] {
            assert_eq!(correction_share(speed, shear), 1.0, "{speed}");
        }
        assert!((correction_share(1e-3, 3e-4) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_stiff_liquid_has_none() {
        assert_eq!([fluidity(0.0, 0.0), fluidity(0.02, 1.0), fluidity(0.5, 1.0)], [1.0; 3]);
        assert_eq!([fluidity(1.0, 1.0), fluidity(1e4, 1.0), fluidity(1e-9, 0.0)], [0.0; 3]);
        assert_eq!(fluidity(0.75, 1.0), 0.5);
    }
}
