//! How much of the space the grains take, over the height above the bed, and what follows from it: the volume-fraction
//! form of the equations.
//!
//! φ(z) is given, or the mean along the bed of what the sediment particles carry; so it serves flat beds.
//! - overburden p′ = ∫_z φ (ρ_s − ρ_f) g cosθ dz `[Pa]`
//! - room ∫ (1 − φ/φ_max) dz from the base, never below 0, for the mixing length l = κ √(1 − z/h) × room `[m]`

use crate::material::suspension_viscosity::SuspensionViscosity;
use crate::material::turbulence::StratifiedMixingLength;

/// φ over equal intervals of height, and what its integrals need.
#[derive(Debug, Clone, PartialEq)]
pub struct Strata {
    /// Height of the lowest interval's lower end `[m]`.
    pub base: f64,
    /// Length of an interval `[m]`.
    pub interval: f64,
    /// φ of every interval `[-]`; averaged from particles it may exceed φ_max here and there.
    pub solid_fraction: Vec<f64>,
    /// φ_max `[-]`: no eddy where the grains are packed as densely as this.
    pub packing: f64,
    /// (ρ_s − ρ_f) g cosθ `[Pa/m]`.
    pub buoyant_weight: f64,
    /// Level of the bed `[m]`.
    pub bed_level: f64,
    /// Depth of the flow above the bed `[m]`.
    pub depth: f64,
    /// What the grains add to the fluid's viscosity.
    pub suspension_viscosity: SuspensionViscosity,
}

/// The strata and their integrals.
#[derive(Debug, Clone, PartialEq)]
pub struct Stratification {
    strata: Strata,
    overburden: Vec<f64>,
    mixing_length: Vec<f64>,
}

/// What the stratification is at a height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stratum {
    /// φ `[-]`.
    pub(super) solid_fraction: f64,
    /// p′ `[Pa]`.
    pub(super) overburden: f64,
    /// l `[m]`.
    pub(super) mixing_length: f64,
    /// Viscosity of the fluid over that of clear fluid `[-]`.
    pub(super) relative_viscosity: f64,
}

impl Stratification {
    /// Strata with their integrals.
    #[must_use]
    pub fn of(strata: Strata) -> Self {
        let count = strata.solid_fraction.len();
        let mut new = Self { strata, overburden: vec![0.0; count], mixing_length: vec![0.0; count] };
        new.integrate();
        new
    }

    /// What the integrals are of.
    #[must_use]
    pub fn strata(&self) -> &Strata {
        &self.strata
    }

    /// Changes φ and renews the integrals.
    pub(super) fn renew(&mut self, change: impl FnOnce(&mut Strata)) {
        change(&mut self.strata);
        self.integrate();
    }

    fn integrate(&mut self) {
        let Self { strata, overburden, mixing_length } = self;
        let mut load = 0.0;
        for (fraction, overburden) in strata.solid_fraction.iter().zip(overburden).rev() {
            let own = fraction * strata.buoyant_weight * strata.interval;
            *overburden = load + 0.5 * own;
            load += own;
        }
        let law = StratifiedMixingLength { packing: strata.packing, depth: strata.depth };
        // φ of particles scatters about φ_max in a bed: what one interval has too much the next has too little
        let mut room = 0.0_f64;
        for (place, (fraction, length)) in strata.solid_fraction.iter().zip(mixing_length).enumerate() {
            let height = strata.base + (place as f64 + 0.5) * strata.interval - strata.bed_level;
            let own = law.room(*fraction, strata.interval);
            *length = law.length(height, room + 0.5 * own);
            room = (room + own).max(0.0);
        }
    }

    /// Values at a height `[m]`, by straight lines between the intervals' centres.
    #[inline]
    pub(super) fn at(&self, height: f64) -> Stratum {
        let last = self.strata.solid_fraction.len() - 1;
        let place = ((height - self.strata.base) / self.strata.interval - 0.5).clamp(0.0, last as f64);
        let lower = (place as usize).min(last.saturating_sub(1));
        let (part, upper) = (place - lower as f64, (lower + 1).min(last));
        let line = |values: &[f64]| values[lower] + part * (values[upper] - values[lower]);
        let solid_fraction = line(&self.strata.solid_fraction).min(self.strata.packing);
        Stratum {
            solid_fraction,
            relative_viscosity: self.strata.suspension_viscosity.relative(solid_fraction),
            overburden: line(&self.overburden),
            mixing_length: line(&self.mixing_length),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_a_packed_bed_under_clear_water() {
        // 16 mm of φ = 0.6 and 46 mm of water, a quarter of a millimetre each
        let fraction: Vec<f64> = (0..248).map(|k| if k < 64 { 0.6 } else { 0.0 }).collect();
        let layer = Stratification::of(Strata {
            base: -0.016,
            interval: 2.5e-4,
            solid_fraction: fraction,
            packing: 0.6,
            buoyant_weight: 1600.0 * 9.81,
            bed_level: 0.0,
            depth: 0.046,
            suspension_viscosity: SuspensionViscosity::default(),
        });
        assert!((layer.at(-0.010).overburden - 0.6 * 15_696.0 * 0.010).abs() < 1e-9);
        assert_eq!(layer.at(0.010).overburden, 0.0);
        assert_eq!(layer.at(-0.010).mixing_length, 0.0);
        // above the bed the room is the height
        let expected = 0.41 * 0.023 * 0.5_f64.sqrt();
        assert!((layer.at(0.023).mixing_length / expected - 1.0).abs() < 1e-4);
    }
}
