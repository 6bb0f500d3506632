//! The one font of all figures. It is embedded, so that a figure looks the same on every machine.

use super::error::FigureError;
use super::script::{Run, SMALLER, runs};
use plotters::style::{FontDesc, FontFamily, FontStyle, register_font};
use std::sync::LazyLock;

/// Family name, as in the font's own name table and as browsers know it.
pub(super) const FAMILY: &str = "DejaVu Sans";

/// Font families with a fallback for browsers without DejaVu Sans; Verdana has the same widths.
pub(super) const FAMILY_WITH_FALLBACK: &str = "DejaVu Sans, Verdana, sans-serif";

/// plotters' text size is a line height, 1.24 times the em that it writes into the SVG.
pub(super) const LINE_HEIGHT: f64 = 1.24;

static REGISTERED: LazyLock<Result<(), &'static str>> = LazyLock::new(|| {
    register_font(FAMILY, FontStyle::Normal, dejavu::sans::regular()).map_err(|_| "regular")?;
    register_font(FAMILY, FontStyle::Bold, dejavu::sans::bold()).map_err(|_| "bold")
});

/// Thickness of the strokes of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    Regular,
    Bold,
}

impl Weight {
    pub(super) fn style(self) -> FontStyle {
        match self {
            Self::Regular => FontStyle::Normal,
            Self::Bold => FontStyle::Bold,
        }
    }
}

/// Makes the font known to plotters; cheap after the first call.
pub(super) fn register() -> Result<(), FigureError> {
    (*REGISTERED).map_err(|style| FigureError::Font { style })
}

/// Width of `text` set at `em` pixels, with its indices and exponents `[px]`; a rough estimate if the font is missing.
pub(super) fn width(text: &str, em: f64, weight: Weight) -> f64 {
    let of = |run: &Run<'_>| plain_width(run.text, if run.rise == 0.0 { em } else { SMALLER * em }, weight);
    runs(text).iter().map(of).sum()
}

/// Width of letters on one line `[px]`.
pub(super) fn plain_width(text: &str, em: f64, weight: Weight) -> f64 {
    // Measured large and scaled down: the library rounds to whole pixels.
    const MEASURED_EM: f64 = 400.0;
    let font = FontDesc::new(FontFamily::Name(FAMILY), MEASURED_EM, weight.style());
    match font.layout_box(text) {
        // The library measures with ascent + descent = size; DejaVu's are 1.164 em.
        Ok(((left, _), (right, _))) => f64::from(right - left) * 1.164 * em / MEASURED_EM,
        Err(_) => 0.6 * em * text.chars().count() as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_grows_with_text_and_em() {
        register().expect("embedded font");
        let short = width("u [m/s]", 24.0, Weight::Regular);
        let long = width("u [m/s] u [m/s]", 24.0, Weight::Regular);
        assert!(short > 60.0 && short < 120.0, "{short}");
        assert!(long > 2.0 * short);
        assert!((width("u [m/s]", 48.0, Weight::Regular) / short - 2.0).abs() < 0.01);
        assert!(width("u [m/s]", 24.0, Weight::Bold) > short);
    }
}
