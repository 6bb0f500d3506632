//! Solid fraction over the height above the bed, and the overburden and mixing length that follow from it: the
//! volume-fraction form of the equations.
//!
//! φ(z) is given, one for the whole of a flat bed, or that of the columns of grains that dilate, between whose middles it
//! changes along straight lines.
//! - overburden p′ = ∫_z φ (ρ_s − ρ_f) g cosθ dz `[Pa]`
//! - room R = ∫ (1 − φ/φ_max) dz from the base, never below 0, and the roughness r of grains that rest, for the mixing
//!   length l = κ √(1 − z/h) (R + r) `[m]`

use crate::material::suspension_viscosity::SuspensionViscosity;
use crate::material::turbulence::{GrainRoughness, StratifiedMixingLength};
use crate::vector::Vector;

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
    /// Viscosity of the suspension: what it exceeds the fluid's by resists the strain of the grains.
    pub suspension_viscosity: SuspensionViscosity,
    /// Roughness of grains that rest.
    pub grain_roughness: GrainRoughness,
    /// Grain diameter `[m]`.
    pub grain_diameter: f64,
}

/// Columns of equal width next to each other along the bed, around a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnRow {
    pub(super) count: usize,
    /// Width of each `[m]`.
    pub width: f64,
    /// Middle of the first `[m]`.
    pub(super) left: f64,
}

impl ColumnRow {
    /// The columns whose middles a place along the bed `[m]` lies between, with their weights `[-]`.
    #[inline]
    pub(super) fn weights(&self, along: f64) -> [(usize, f64); 2] {
        if self.count == 1 {
            return [(0, 1.0), (0, 0.0)];
        }
        let count = self.count as f64;
        let place = (along - self.left) / self.width;
        // most places lie within the period, and a remainder takes long
        let place = if place >= 0.0 && place < count { place } else { place.rem_euclid(count) };
        let lower = (place as usize).min(self.count - 1);
        let part = place - lower as f64;
        [(lower, 1.0 - part), ((lower + 1) % self.count, part)]
    }
}

/// The strata and their integrals, of one column or of several.
#[derive(Debug, Clone, PartialEq)]
pub struct Stratification {
    strata: Strata,
    row: ColumnRow,
    overburden: Vec<f64>,
    pub(super) mixing_length: Vec<f64>,
}

/// Values of the stratification at a height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stratum {
    /// φ `[-]`.
    pub(super) solid_fraction: f64,
    /// p′ `[Pa]`.
    pub(super) overburden: f64,
    /// l `[m]`.
    pub(super) mixing_length: f64,
    /// Viscosity that the grains' strain adds over that of clear fluid `[-]`.
    pub(super) added_viscosity: f64,
}

impl Stratification {
    /// Strata with their integrals, the same all along the bed.
    #[must_use]
    pub fn of(strata: Strata) -> Self {
        Self::of_columns(strata, ColumnRow { count: 1, width: 1.0, left: 0.0 })
    }

    /// Empty strata like others for each of a row of columns, from a base up in intervals `[m]`.
    pub(super) fn on_columns(like: &Strata, row: ColumnRow, base: f64, interval: f64, intervals: usize) -> Self {
        let solid_fraction = vec![0.0; row.count * intervals];
        Self::of_columns(Strata { base, interval, solid_fraction, ..like.clone() }, row)
    }

    fn of_columns(strata: Strata, row: ColumnRow) -> Self {
        let count = strata.solid_fraction.len();
        let mut new = Self { strata, row, overburden: vec![0.0; count], mixing_length: vec![0.0; count] };
        new.integrate();
        new
    }

    /// Strata over which the integrals are taken; φ column by column.
    #[must_use]
    pub fn strata(&self) -> &Strata {
        &self.strata
    }

    /// Changes φ and renews the integrals.
    pub(super) fn renew(&mut self, change: impl FnOnce(&mut [f64])) {
        change(&mut self.strata.solid_fraction);
        self.integrate();
    }

    /// Intervals of a column.
    fn intervals(&self) -> usize {
        self.strata.solid_fraction.len() / self.row.count
    }

    fn integrate(&mut self) {
        let intervals = self.intervals();
        let Self { strata, overburden, mixing_length, .. } = self;
        let law = StratifiedMixingLength { packing: strata.packing, depth: strata.depth };
        let columns = strata.solid_fraction.chunks_exact(intervals);
        let integrals = overburden.chunks_exact_mut(intervals).zip(mixing_length.chunks_exact_mut(intervals));
        for (fraction, (overburden, mixing_length)) in columns.zip(integrals) {
            let mut load = 0.0;
            for (fraction, overburden) in fraction.iter().zip(overburden).rev() {
                let own = fraction * strata.buoyant_weight * strata.interval;
                *overburden = load + 0.5 * own;
                load += own;
            }
            // φ of particles scatters about φ_max in a bed: what one interval has too much the next has too little
            let (mut room, mut loosened) = (0.0_f64, 0.0);
            for (place, (fraction, length)) in fraction.iter().zip(mixing_length).enumerate() {
                let height = strata.base + (place as f64 + 0.5) * strata.interval - strata.bed_level;
                let own = law.room(*fraction, strata.interval);
                let own_loosened = strata.grain_roughness.loosened(fraction / strata.packing, strata.interval);
                let roughness = strata.grain_roughness.room(loosened + 0.5 * own_loosened, strata.grain_diameter);
                *length = law.length(height, room + 0.5 * own + roughness);
                room = (room + own).max(0.0);
                loosened += own_loosened;
            }
        }
    }

    /// Reads fields at a place `[m]`, by straight lines between the intervals' centres and the columns' middles.
    #[inline]
    fn reader<const D: usize>(&self, position: &Vector<D>) -> impl Fn(&[f64]) -> f64 {
        let intervals = self.intervals();
        // the last axis is normal to the bed
        let height = position[D - 1];
        let place = ((height - self.strata.base) / self.strata.interval - 0.5).clamp(0.0, (intervals - 1) as f64);
        let lower = (place as usize).min(intervals.saturating_sub(2));
        let (part, upper) = (place - lower as f64, (lower + 1).min(intervals - 1));
        let [(first, _), (second, share)] = self.row.weights(position[0]);
        let (first, second) = (first * intervals, second * intervals);
        move |values| {
            let line = |column: usize| {
                let (low, high) = (values[column + lower], values[column + upper]);
                low + part * (high - low)
            };
            let own = line(first);
            if share == 0.0 { own } else { own + share * (line(second) - own) }
        }
    }

    /// φ at a place `[-]`, at most φ_max.
    #[inline]
    pub(super) fn solid_fraction_at<const D: usize>(&self, position: &Vector<D>) -> f64 {
        self.reader(position)(&self.strata.solid_fraction).min(self.strata.packing)
    }

    /// φ `[-]` and the mixing length `[m]` at a place `[m]`.
    #[inline]
    pub(super) fn mixing_at<const D: usize>(&self, position: &Vector<D>) -> (f64, f64) {
        let line = self.reader(position);
        (line(&self.strata.solid_fraction).min(self.strata.packing), line(&self.mixing_length))
    }

    /// Values at a place `[m]`.
    #[inline]
    pub(super) fn at<const D: usize>(&self, position: &Vector<D>) -> Stratum {
        let line = self.reader(position);
        let solid_fraction = line(&self.strata.solid_fraction).min(self.strata.packing);
        Stratum {
            solid_fraction,
            added_viscosity: self.strata.suspension_viscosity.relative(solid_fraction) - 1.0,
            overburden: line(&self.overburden),
            mixing_length: line(&self.mixing_length),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 16 mm of φ = 0.6 and 46 mm of water, a quarter of a millimetre each.
    fn packed_bed(grain_roughness: GrainRoughness) -> Stratification {
        let fraction: Vec<f64> = (0..248).map(|k| if k < 64 { 0.6 } else { 0.0 }).collect();
        Stratification::of(Strata {
            base: -0.016,
            interval: 2.5e-4,
            solid_fraction: fraction,
            packing: 0.6,
            buoyant_weight: 1600.0 * 9.81,
            bed_level: 0.0,
            depth: 0.046,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness,
            grain_diameter: 5e-3,
        })
    }

    #[test]
    fn integrals_of_a_packed_bed_under_clear_water() {
        let layer = packed_bed(GrainRoughness { origin_depth: 0.0, ..GrainRoughness::default() });
        let layer = |z: f64| layer.at(&Vector::<2>::new(0.3, z));
        assert!((layer(-0.010).overburden - 0.6 * 15_696.0 * 0.010).abs() < 1e-9);
        assert_eq!(layer(0.010).overburden, 0.0);
        assert_eq!(layer(-0.010).mixing_length, 0.0);
        // above the bed the room is the height
        let expected = 0.41 * 0.023 * 0.5_f64.sqrt();
        assert!((layer(0.023).mixing_length / expected - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_bed_at_rest_is_a_rough_wall() {
        let layer = packed_bed(GrainRoughness::default());
        // l = κ √(1 − z/h) (z + 0.2 d)
        let length = layer.at(&Vector::<2>::new(0.0, 4.125e-3)).mixing_length;
        let expected = 0.41 * (1.0 - 4.125 / 46.0_f64).sqrt() * 5.125e-3;
        assert!((length / expected - 1.0).abs() < 1e-4, "{length} m");
    }
}
