//! The one font of all figures. It is embedded, so that a figure looks the same on every machine.

use super::glyphs::font;
use super::script::{Run, SMALLER, runs};
use plotters::style::FontStyle;

/// Family name, as in the font's own name table and as browsers know it.
pub(super) const FAMILY: &str = "DejaVu Sans";

/// Font families with a fallback for browsers without DejaVu Sans; Verdana has the same widths.
pub(super) const FAMILY_WITH_FALLBACK: &str = "DejaVu Sans, Verdana, sans-serif";

/// plotters' text size is a line height, 1.24 times the em that it writes into the SVG.
pub(super) const LINE_HEIGHT: f64 = 1.24;

/// Width of `text` set at `em` pixels, with its indices and exponents `[px]`; a rough estimate if the font is missing.
pub(super) fn width(text: &str, em: f64, weight: FontStyle) -> f64 {
    let of = |run: &Run<'_>| plain_width(run.text, if run.rise == 0.0 { em } else { SMALLER * em }, weight);
    runs(text).iter().map(of).sum()
}

/// Width of letters on one line `[px]`, in whole 400ths of a line's height.
pub(super) fn plain_width(text: &str, em: f64, weight: FontStyle) -> f64 {
    const PARTS: f64 = 400.0;
    match font(weight) {
        // DejaVu's line is 1.164 em
        Ok((font, _)) => (PARTS * f64::from(font.glyphs(text).1) / f64::from(font.line)).trunc() * 1.164 * em / PARTS,
        Err(_) => 0.6 * em * text.chars().count() as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_grows_with_text_and_em() {
        let short = width("u [m/s]", 24.0, FontStyle::Normal);
        let long = width("u [m/s] u [m/s]", 24.0, FontStyle::Normal);
        assert!(short > 60.0 && short < 120.0, "{short}");
        assert!(long > 2.0 * short);
        assert!((width("u [m/s]", 48.0, FontStyle::Normal) / short - 2.0).abs() < 0.01);
        assert!(width("u [m/s]", 24.0, FontStyle::Bold) > short);
    }
}
