//! The part of an axis that is shown, and its map onto pixels.

use super::{Axis, Scale};

/// Values beyond this are treated as missing: their differences would overflow.
const LARGEST: f64 = 1e150;

/// A closed interval with lower < upper, both finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Range {
    /// The interval of the axis: its own limits if they make sense, else the data with a small margin.
    /// The second value tells whether there was anything to show.
    pub(super) fn fit(axis: &Axis, scale: Scale, data: impl Iterator<Item = f64>) -> (Self, bool) {
        let mut extent: Option<(f64, f64)> = None;
        for value in data.filter(|&value| drawable(value, scale)) {
            extent = Some(extent.map_or((value, value), |(lower, upper)| (lower.min(value), upper.max(value))));
        }
        if let Some((lower, upper)) = axis.limits
            && drawable(lower, scale)
            && drawable(upper, scale)
            && !same(lower, upper)
        {
            return (Self { lower: lower.min(upper), upper: lower.max(upper) }, extent.is_some());
        }
        match (extent, scale) {
            (None, Scale::Linear) => (Self { lower: 0.0, upper: 1.0 }, false),
            (None, Scale::Logarithmic) => (Self { lower: 1.0, upper: 10.0 }, false),
            (Some((lower, upper)), Scale::Linear) => (padded(lower, upper, 0.04), true),
            (Some((lower, upper)), Scale::Logarithmic) => {
                let exponents = padded(lower.log10(), upper.log10(), 0.06);
                (Self { lower: 10f64.powf(exponents.lower), upper: 10f64.powf(exponents.upper) }, true)
            }
        }
    }

    /// The interval of a colour scale: no margin.
    pub(super) fn of_colours(limits: Option<(f64, f64)>, values: &[f64]) -> Self {
        let axis = Axis { label: String::new(), scale: Scale::Linear, limits, ratio: None };
        let (range, _) = Self::fit(&axis, Scale::Linear, values.iter().copied());
        if limits.is_some_and(|(lower, upper)| range.lower == lower.min(upper) && range.upper == lower.max(upper)) {
            return range;
        }
        let finite = || values.iter().copied().filter(|&value| drawable(value, Scale::Linear));
        let (lower, upper) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
        if lower < upper && !same(lower, upper) { Self { lower, upper } } else { range }
    }
}

/// Whether `value` has a place on an axis.
pub(super) fn drawable(value: f64, scale: Scale) -> bool {
    match scale {
        Scale::Linear => value.abs() <= LARGEST,
        Scale::Logarithmic => (1.0 / LARGEST..=LARGEST).contains(&value),
    }
}

/// Whether two values are one value up to rounding.
fn same(lower: f64, upper: f64) -> bool {
    (upper - lower).abs() <= 1e-12 * lower.abs().max(upper.abs()).max(f64::MIN_POSITIVE)
}

fn padded(lower: f64, upper: f64, fraction: f64) -> Range {
    if same(lower, upper) {
        let half = if lower == 0.0 { 1.0 } else { 0.1 * lower.abs() };
        return Range { lower: lower - half, upper: upper + half };
    }
    let margin = fraction * (upper - lower);
    Range { lower: lower - margin, upper: upper + margin }
}

/// The map from values to pixels of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mapping {
    pub(super) range: Range,
    pub(super) scale: Scale,
    /// Pixel of the range's lower end.
    pub(super) start: f64,
    /// Pixel of the range's upper end.
    pub(super) end: f64,
}

impl Mapping {
    /// Pixel position of `value`; `None` for a value outside the domain of the axis.
    pub(super) fn pixel(&self, value: f64) -> Option<f64> {
        if !drawable(value, self.scale) {
            return None;
        }
        let Range { lower, upper } = self.range;
        let fraction = match self.scale {
            Scale::Linear => (value - lower) / (upper - lower),
            Scale::Logarithmic => (value / lower).log10() / (upper / lower).log10(),
        };
        // Far outside the sheet is as good as anywhere outside, and keeps the arithmetic of clipping sane.
        Some((self.start + fraction * (self.end - self.start)).clamp(-1e5, 1e5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(values: &[f64], scale: Scale, limits: Option<(f64, f64)>) -> (Range, bool) {
        let axis = Axis { label: String::new(), scale, limits, ratio: None };
        Range::fit(&axis, scale, values.iter().copied())
    }

    #[test]
    fn degenerate_data_give_a_range_with_an_extent() {
        let nothing = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300];
        for values in [&nothing[..], &[][..], &[0.0][..], &[3.0, 3.0][..], &[1.0, 1.0 + 1e-16][..], &[-2.0][..]] {
            for scale in [Scale::Linear, Scale::Logarithmic] {
                for limits in [None, Some((f64::NAN, 1.0)), Some((2.0, 2.0)), Some((0.0, 0.0))] {
                    let (range, _) = fit(values, scale, limits);
                    assert!(range.lower < range.upper, "{values:?} {scale:?} {range:?}");
                    assert!(range.lower.is_finite() && range.upper.is_finite());
                }
            }
        }
        assert!(!fit(&nothing, Scale::Linear, None).1);
        assert!(fit(&[1.0], Scale::Linear, None).1);
        assert!(!fit(&[-1.0], Scale::Logarithmic, None).1, "a negative value has no place on a log axis");
    }

    #[test]
    fn own_limits_win_and_are_ordered() {
        assert_eq!(fit(&[5.0], Scale::Linear, Some((2.0, -1.0))).0, Range { lower: -1.0, upper: 2.0 });
    }

    #[test]
    fn mapping_hits_both_ends() {
        let range = Range { lower: 0.01, upper: 100.0 };
        let mapping = Mapping { range, scale: Scale::Logarithmic, start: 100.0, end: 500.0 };
        assert_eq!(mapping.pixel(1.0).map(f64::round), Some(300.0));
        assert_eq!(mapping.pixel(0.0), None);
        assert_eq!(mapping.pixel(f64::NAN), None);
    }
}
