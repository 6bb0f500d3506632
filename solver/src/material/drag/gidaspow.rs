//! Gidaspow (1994): Ergun below a voidage of 0.8, Wen–Yu from there on.
//!
//! The two do not meet: at ε = 0.8 Ergun's K is 1.15 times that of Wen–Yu without slip and 3.67 times at high Reynolds numbers.

use super::{Suspension, ergun, wen_yu};

/// Voidage ε `[-]` below which grains are a bed.
const BED_VOIDAGE: f64 = 0.8;

/// K `[kg/(m³ s)]`.
#[inline]
pub(super) fn exchange_coefficient(suspension: &Suspension) -> f64 {
    if suspension.voidage() < BED_VOIDAGE {
        ergun::exchange_coefficient(suspension)
    } else {
        wen_yu::exchange_coefficient(suspension)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(solid_fraction: f64, slip: f64) -> Suspension {
        Suspension { solid_fraction, slip, grain_diameter: 1e-3, fluid_density: 1000.0, kinematic_viscosity: 1e-6 }
    }

    #[test]
    fn changes_the_law_at_its_voidage() {
        let (bed, loose) = (at(0.2 + 1e-12, 0.1), at(0.2, 0.1));
        assert_eq!(exchange_coefficient(&bed), ergun::exchange_coefficient(&bed));
        assert_eq!(exchange_coefficient(&loose), wen_yu::exchange_coefficient(&loose));
    }

    #[test]
    fn jumps_at_its_voidage_as_stated() {
        let jump = |slip| exchange_coefficient(&at(0.2 + 1e-12, slip)) / exchange_coefficient(&at(0.2, slip));
        // (150 · 0.04/0.8)/(18 · 0.2 · 0.8^−2.65) = 7.5/6.5026, (1.75 · 0.2)/(0.75 · 0.44 · 0.2 · 0.8^−1.65) = 0.35/0.095379
        assert!((jump(0.0) - 1.1534).abs() < 1e-3, "{}", jump(0.0));
        assert!((jump(1e6) - 3.6696).abs() < 1e-3, "{}", jump(1e6));
    }
}
