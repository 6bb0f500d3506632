//! Colours that colour-blind readers can tell apart, marker shapes, and the colour map of fields.

use plotters::style::RGBColor;

/// Text and references.
pub(super) const BLACK: RGBColor = RGBColor(0, 0, 0);
/// Axes and tick labels.
pub(super) const AXIS: RGBColor = RGBColor(60, 60, 60);
/// Grid lines.
pub(super) const GRID: RGBColor = RGBColor(226, 226, 226);
/// Bands and particles without a value.
pub(super) const GREY: RGBColor = RGBColor(120, 120, 120);

/// The palette of Okabe and Ito (2008), strongest contrasts first. Black is kept for references;
/// its yellow, too faint for a thin line on white, is replaced by a brown-grey.
const SLOTS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),   // blue
    RGBColor(213, 94, 0),    // vermillion
    RGBColor(0, 158, 115),   // bluish green
    RGBColor(204, 121, 167), // reddish purple
    RGBColor(230, 159, 0),   // orange
    RGBColor(86, 180, 233),  // sky blue
    RGBColor(118, 106, 98),  // brown-grey
];

/// The colour of a slot; after the palette's end come its darker shades, then it repeats.
pub(super) fn colour(slot: usize) -> RGBColor {
    let RGBColor(red, green, blue) = SLOTS[slot % SLOTS.len()];
    let shade = |channel: u8| if slot / SLOTS.len() % 2 == 1 { (u16::from(channel) * 11 / 20) as u8 } else { channel };
    RGBColor(shade(red), shade(green), shade(blue))
}

/// Corners of marker shapes in their radius, none for a disc, so that a black and white print keeps the series apart. They have
/// sizes that look equal, not sizes that are equal.
const SHAPES: [&[(f64, f64)]; 5] = [
    &[],
    &[(-0.88, -0.88), (0.88, -0.88), (0.88, 0.88), (-0.88, 0.88)],
    &[(0.0, -1.25), (1.1, 0.75), (-1.1, 0.75)],
    &[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)],
    &[(0.0, 1.25), (1.1, -0.75), (-1.1, -0.75)],
];

/// The marker of a slot. Five shapes against fourteen colours: the pairs repeat only after 70 slots.
pub(super) fn shape(slot: usize) -> &'static [(f64, f64)] {
    SHAPES[slot % SHAPES.len()]
}

/// A colour map: ten equidistant samples, perceptually uniform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ColourMap(&'static [RGBColor; 10]);

/// Viridis (van der Walt and Smith 2015), the colour map of a single field.
pub(super) const FIRST: ColourMap = ColourMap(&VIRIDIS);
/// Inferno (the same authors), for a second field beside it: no hue is in both except the yellow end.
pub(super) const SECOND: ColourMap = ColourMap(&INFERNO);

const VIRIDIS: [RGBColor; 10] = [
    RGBColor(0x44, 0x01, 0x54),
    RGBColor(0x48, 0x28, 0x78),
    RGBColor(0x3e, 0x4a, 0x89),
    RGBColor(0x31, 0x68, 0x8e),
    RGBColor(0x26, 0x82, 0x8e),
    RGBColor(0x1f, 0x9e, 0x89),
    RGBColor(0x35, 0xb7, 0x79),
    RGBColor(0x6d, 0xcd, 0x59),
    RGBColor(0xb4, 0xde, 0x2c),
    RGBColor(0xfd, 0xe7, 0x25),
];

const INFERNO: [RGBColor; 10] = [
    RGBColor(0x00, 0x00, 0x04),
    RGBColor(0x1b, 0x0c, 0x42),
    RGBColor(0x4b, 0x0c, 0x6b),
    RGBColor(0x78, 0x1c, 0x6d),
    RGBColor(0xa5, 0x2c, 0x60),
    RGBColor(0xcf, 0x44, 0x46),
    RGBColor(0xed, 0x69, 0x25),
    RGBColor(0xfb, 0x9a, 0x06),
    RGBColor(0xf7, 0xd0, 0x3c),
    RGBColor(0xfc, 0xff, 0xa4),
];

impl ColourMap {
    /// The colour at `fraction` of the map; outside 0 … 1 its ends, grey for NaN.
    pub(super) fn at(self, fraction: f64) -> RGBColor {
        if fraction.is_nan() {
            return GREY;
        }
        let samples = self.0;
        let last = samples.len() - 1;
        let place = fraction.clamp(0.0, 1.0) * last as f64;
        let below = (place.floor() as usize).min(last - 1);
        let weight = place - below as f64;
        let RGBColor(red, green, blue) = samples[below];
        let RGBColor(next_red, next_green, next_blue) = samples[below + 1];
        let mix = |a: u8, b: u8| (f64::from(a) + weight * (f64::from(b) - f64::from(a))).round() as u8;
        RGBColor(mix(red, next_red), mix(green, next_green), mix(blue, next_blue))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_maps_brighten_monotonically_and_survive_anything() {
        let brightness =
            |RGBColor(r, g, b): RGBColor| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        for (map, samples) in [(FIRST, VIRIDIS), (SECOND, INFERNO)] {
            let mut previous = -1.0;
            for step in 0..=100 {
                let now = brightness(map.at(f64::from(step) / 100.0));
                assert!(now >= previous - 0.6, "step {step}");
                previous = now;
            }
            assert_eq!(map.at(f64::NAN), GREY);
            assert_eq!(map.at(f64::INFINITY), samples[9]);
            assert_eq!(map.at(-3.0), samples[0]);
        }
    }

    #[test]
    fn slots_repeat_without_clashing_pairs() {
        for slot in 1..70 {
            assert!(colour(slot) != colour(0) || shape(slot) != shape(0));
        }
        assert_eq!((colour(70), shape(70)), (colour(0), shape(0)));
    }
}
