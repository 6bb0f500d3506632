//! Range in which the layer has a solution, and range in which that is one of bed load.
//!
//! **A bed that slides.** What drags at the base of a bed of depth H under water of depth h is ρ_f g sinθ [h + H (1 +
//! (s − 1) φ_max)], what holds it at most μ_s φ_max (s − 1) ρ_f g cosθ H. Where the first is greater, the grains move down to
//! their base, and the transport is that of a bed of this depth and no other: such a layer is refused. On slopes above
//! μ_s φ_max (s − 1)/(1 + (s − 1) φ_max) no depth helps.
//!
//! **Bed load.** Within a range of grains, depths and Shields numbers the transport lies within a factor of 2 of the
//! formula's ([`Stream::outside_bed_load`]): grains finer than a millimetre of sand are dragged through a viscous sublayer
//! and creep where those of experiments leap, and near the onset every formula depends on its threshold.

use super::{Closures, Stream};
use crate::one_dimension::LayerError;
use std::ops::RangeInclusive;

/// Grain diameters D* = d ((s − 1) g/ν²)^⅓ `[-]`: 1 to 8 mm of sand in water.
pub const DIMENSIONLESS_DIAMETERS: RangeInclusive<f64> = 25.0..=205.0;

/// Shields numbers `[-]`.
pub const SHIELDS_NUMBERS: RangeInclusive<f64> = 0.1..=0.8;

/// Depths of the water over the grain diameter `[-]`.
pub const RELATIVE_DEPTHS: RangeInclusive<f64> = 9.0..=100.0;

/// A quantity of a stream outside the range in which the layer is one of bed load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideBedLoad {
    /// Name of the quantity.
    pub quantity: &'static str,
    /// Value `[-]`.
    pub value: f64,
    /// Least value `[-]`.
    pub least: f64,
    /// Largest value `[-]`.
    pub most: f64,
}

impl Stream {
    /// Dimensionless grain diameter D* = d ((s − 1) g/ν²)^⅓ `[-]`.
    pub fn dimensionless_diameter(&self) -> f64 {
        let viscosity = self.kinematic_viscosity;
        let buoyant = (self.grain_density / self.fluid_density - 1.0) * self.gravity;
        self.grain_diameter * libm::cbrt(buoyant / (viscosity * viscosity))
    }

    /// The first quantity for which the layer is not one of bed load, if any.
    pub fn outside_bed_load(&self) -> Option<OutsideBedLoad> {
        let quantities = [
            ("dimensionless grain diameter", self.dimensionless_diameter(), DIMENSIONLESS_DIAMETERS),
            ("Shields number", self.shields_number(), SHIELDS_NUMBERS),
            ("depth over grain diameter", self.flow_depth / self.grain_diameter, RELATIVE_DEPTHS),
        ];
        let found = quantities.into_iter().find(|(_, value, ends)| !ends.contains(value));
        found.map(|(quantity, value, ends)| OutsideBedLoad { quantity, value, least: *ends.start(), most: *ends.end() })
    }

    /// Slope tanθ from which on this bed slides on its base, or where its grains are held `[-]`.
    pub fn sliding_slope(&self, closures: &Closures) -> f64 {
        let free = self.bed_depth - self.held_depth;
        let excess = closures.largest_fraction * (self.grain_density / self.fluid_density - 1.0);
        closures.static_friction * excess * free / (self.flow_depth + free * (1.0 + excess))
    }

    /// Refuses a bed that slides on its base.
    ///
    /// # Errors
    /// If it does, with the depth that would hold.
    pub(super) fn check_sliding(&self, closures: &Closures) -> Result<(), LayerError> {
        let limit = self.sliding_slope(closures);
        if self.slope < limit {
            return Ok(());
        }
        let excess = closures.largest_fraction * (self.grain_density / self.fluid_density - 1.0);
        let held = closures.static_friction * excess - self.slope * (1.0 + excess);
        let remedy = if held > 0.0 {
            let free = self.slope * self.flow_depth / held;
            format!("deepen the bed to more than {:.4} m, or choose a gentler slope", free + self.held_depth)
        } else {
            "choose a gentler slope, on which a bed of these grains is stable".to_owned()
        };
        Err(LayerError::BedSlides { slope: self.slope, limit, remedy })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::stream;
    use super::*;

    #[test]
    fn the_three_slopes_are_bed_load() {
        for slope in [0.02, 0.03, 0.05] {
            assert_eq!(stream(slope).outside_bed_load(), None);
        }
        let quantity = |stream: Stream| stream.outside_bed_load().map(|outside| outside.quantity);
        assert_eq!(quantity(Stream { grain_diameter: 5e-4, ..stream(0.02) }), Some("dimensionless grain diameter"));
        assert_eq!(quantity(stream(0.01)), Some("Shields number"));
        assert_eq!(quantity(Stream { flow_depth: 0.03, ..stream(0.05) }), Some("depth over grain diameter"));
    }

    #[test]
    fn a_deep_bed_slides_at_its_own_slope() {
        let deep = Stream { bed_depth: 1e6, ..stream(0.02) };
        let expected = 0.35 * 0.96 / 1.96;
        assert!((deep.sliding_slope(&Closures::default()) / expected - 1.0).abs() < 1e-6);
    }
}
