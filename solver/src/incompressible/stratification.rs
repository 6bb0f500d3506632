//! How much of the space the grains take, over the height above the bed, and what follows from it: the volume-fraction
//! form of the equations.
//!
//! φ(z) is given, or the mean along the bed of what the sediment particles carry; so it serves flat beds.
//! - overburden p′ = ∫_z φ (ρ_s − ρ_f) g cosθ dz `[Pa]`
//! - room ∫ (1 − φ/φ_max) dz from the base, never below 0, for the mixing length l = κ √(1 − z/h) × room `[m]`

use crate::material::turbulence::VON_KARMAN;

/// φ over equal intervals of height, and its integrals at their centres.
#[derive(Debug, Clone, PartialEq)]
pub struct Stratification {
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
    /// Level of the bed and depth of the flow above it `[m]`.
    pub bed_level: f64,
    /// Depth of the flow above the bed `[m]`.
    pub depth: f64,
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
}

impl Stratification {
    /// A stratification with its integrals.
    #[must_use]
    pub fn new(
        base: f64,
        interval: f64,
        solid_fraction: Vec<f64>,
        packing: f64,
        buoyant_weight: f64,
        bed_level: f64,
        depth: f64,
    ) -> Self {
        let count = solid_fraction.len();
        let (overburden, mixing_length) = (vec![0.0; count], vec![0.0; count]);
        let mut new = Self {
            base,
            interval,
            solid_fraction,
            packing,
            buoyant_weight,
            bed_level,
            depth,
            overburden,
            mixing_length,
        };
        new.integrate();
        new
    }

    /// Renews the integrals after φ has changed.
    pub(super) fn integrate(&mut self) {
        let mut load = 0.0;
        for (fraction, overburden) in self.solid_fraction.iter().zip(&mut self.overburden).rev() {
            let own = fraction * self.buoyant_weight * self.interval;
            *overburden = load + 0.5 * own;
            load += own;
        }
        // φ of particles scatters about φ_max in a bed: what one interval has too much the next has too little
        let mut room = 0.0_f64;
        for (place, fraction) in self.solid_fraction.iter().enumerate() {
            let height = self.base + (place as f64 + 0.5) * self.interval - self.bed_level;
            let own = (1.0 - fraction / self.packing) * self.interval;
            let root = (1.0 - height / self.depth).max(0.0).sqrt();
            self.mixing_length[place] = VON_KARMAN * root * (room + 0.5 * own).max(0.0);
            room = (room + own).max(0.0);
        }
    }

    /// Values at a height `[m]`, by straight lines between the intervals' centres.
    #[inline]
    pub(super) fn at(&self, height: f64) -> Stratum {
        let last = self.solid_fraction.len() - 1;
        let place = ((height - self.base) / self.interval - 0.5).clamp(0.0, last as f64);
        let lower = (place as usize).min(last.saturating_sub(1));
        let (share, upper) = (place - lower as f64, (lower + 1).min(last));
        let line = |values: &[f64]| values[lower] + share * (values[upper] - values[lower]);
        Stratum {
            solid_fraction: line(&self.solid_fraction).min(self.packing),
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
        let layer = Stratification::new(-0.016, 2.5e-4, fraction, 0.6, 1600.0 * 9.81, 0.0, 0.046);
        assert!((layer.at(-0.010).overburden - 0.6 * 15_696.0 * 0.010).abs() < 1e-9);
        assert_eq!(layer.at(0.010).overburden, 0.0);
        assert_eq!(layer.at(-0.010).mixing_length, 0.0);
        // above the bed the room is the height
        let expected = 0.41 * 0.023 * 0.5_f64.sqrt();
        assert!((layer.at(0.023).mixing_length / expected - 1.0).abs() < 1e-4);
    }
}
