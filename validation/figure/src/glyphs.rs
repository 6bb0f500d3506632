//! Text as outlines of the embedded font.

use super::error::FigureError;
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, Point};
use std::sync::LazyLock;
use tiny_skia::{Path, PathBuilder};

static REGULAR: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(dejavu::sans::regular()).ok());
static BOLD: LazyLock<Option<FontRef<'static>>> = LazyLock::new(|| FontRef::try_from_slice(dejavu::sans::bold()).ok());

/// The outline of a text of `size` units an em with its base line's start at the origin, y downwards, and its width; nothing
/// for a text without ink.
pub(super) fn outline(text: &str, size: f32, is_bold: bool) -> Result<Option<(Path, f32)>, FigureError> {
    let (font, style) = if is_bold { (&BOLD, "bold") } else { (&REGULAR, "regular") };
    let font = font.as_ref().ok_or(FigureError::Font { style })?;
    let scale = size / font.units_per_em().ok_or(FigureError::Font { style })?;
    let mut path = PathBuilder::new();
    let mut pen = 0.0;
    let mut before: Option<GlyphId> = None;
    for letter in text.chars() {
        let glyph = font.glyph_id(letter);
        if let Some(before) = before {
            pen += scale * font.kern_unscaled(before, glyph);
        }
        let curves = font.outline(glyph).map(|outline| outline.curves).unwrap_or_default();
        add(&mut path, &curves, |point| (pen + scale * point.x, -scale * point.y));
        pen += scale * font.h_advance_unscaled(glyph);
        before = Some(glyph);
    }
    Ok(path.finish().map(|path| (path, pen)))
}

/// Adds closed curves, of which each begins where the one before ends or begins a new contour.
fn add(path: &mut PathBuilder, curves: &[OutlineCurve], place: impl Fn(Point) -> (f32, f32)) {
    let mut end: Option<Point> = None;
    for curve in curves {
        let (from, to) = match curve {
            OutlineCurve::Line(from, to) => (*from, *to),
            OutlineCurve::Quad(from, _, to) => (*from, *to),
            OutlineCurve::Cubic(from, _, _, to) => (*from, *to),
        };
        if end != Some(from) {
            if end.is_some() {
                path.close();
            }
            let (x, y) = place(from);
            path.move_to(x, y);
        }
        let (x, y) = place(to);
        match curve {
            OutlineCurve::Line(..) => path.line_to(x, y),
            OutlineCurve::Quad(_, bend, _) => {
                let (x1, y1) = place(*bend);
                path.quad_to(x1, y1, x, y);
            }
            OutlineCurve::Cubic(_, first, second, _) => {
                let ((x1, y1), (x2, y2)) = (place(*first), place(*second));
                path.cubic_to(x1, y1, x2, y2, x, y);
            }
        }
        end = Some(to);
    }
    if end.is_some() {
        path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_as_wide_as_its_letters_and_as_high_as_its_capitals() {
        let (path, width) = outline("HH", 100.0, false).expect("font").expect("ink");
        let bounds = path.bounds();
        // of DejaVu Sans: capitals of 0.729 em, H of 0.752 em with 0.098 em before its stem
        assert!((bounds.top() + 72.9).abs() < 0.1 && bounds.bottom().abs() < 0.1, "{bounds:?}");
        assert!((width - 150.4).abs() < 0.1 && (bounds.left() - 9.8).abs() < 0.1, "{width} {bounds:?}");
        let (_, bold) = outline("HH", 100.0, true).expect("font").expect("ink");
        assert!(bold > width);
    }

    #[test]
    fn letters_of_formulas_are_in_the_font_and_blanks_have_no_ink() {
        for letter in "−√⁻°²ηφτμδγρθ∞∫→⅔₀′βΔŪ…".chars() {
            assert_ne!(REGULAR.as_ref().expect("font").glyph_id(letter), GlyphId(0), "{letter}");
            assert!(outline(&letter.to_string(), 10.0, false).expect("font").is_some(), "{letter}");
        }
        assert_eq!(outline("  ", 10.0, false).expect("font"), None);
    }
}
