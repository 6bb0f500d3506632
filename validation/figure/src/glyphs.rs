//! Text as outlines of the embedded font.

use super::error::FigureError;
use super::truetype::{ContourPoint, Font};
use plotters::style::FontStyle;
use std::sync::LazyLock;
use tiny_skia::{Path, PathBuilder};

static REGULAR: LazyLock<Option<Font>> = LazyLock::new(|| Font::new(dejavu::sans::regular()));
static BOLD: LazyLock<Option<Font>> = LazyLock::new(|| Font::new(dejavu::sans::bold()));

/// Parts of a glyph may have parts to this depth.
const DEPTH: u8 = 4;

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

    pub(super) fn font(self) -> Result<&'static Font, FigureError> {
        let (font, style) = match self {
            Self::Regular => (&REGULAR, "regular"),
            Self::Bold => (&BOLD, "bold"),
        };
        font.as_ref().ok_or(FigureError::Font { style })
    }
}

/// The glyphs of a text with the place where each begins, and the width of all, in units of the font.
pub(super) fn line(text: &str, font: &Font) -> (Vec<(u16, i32)>, i32) {
    let mut glyphs: Vec<(u16, i32)> = Vec::new();
    let mut pen = 0;
    for letter in text.chars() {
        let glyph = font.glyph(letter);
        pen += glyphs.last().map_or(0, |&(before, _)| font.kerning(before, glyph));
        glyphs.push((glyph, pen));
        pen += font.advance(glyph);
    }
    (glyphs, pen)
}

/// The outline of a text of `size` units an em with its base line's start at the origin, y downwards, and its width; nothing
/// for a text without ink.
pub(super) fn outline(text: &str, size: f32, weight: Weight) -> Result<Option<(Path, f32)>, FigureError> {
    let font = weight.font()?;
    let scale = size / f32::from(font.units_per_em);
    let (glyphs, width) = line(text, font);
    let mut path = PathBuilder::new();
    for (glyph, pen) in glyphs {
        for contour in font.contours(glyph, DEPTH).unwrap_or_default() {
            add(&mut path, &contour, |(x, y)| (scale * (pen as f32 + x), -scale * y));
        }
    }
    Ok(path.finish().map(|path| (path, scale * width as f32)))
}

/// Adds a closed contour of quadratic curves: a point that it does not pass through bends it, and between two of them it passes
/// through their middle.
pub(super) fn add(path: &mut PathBuilder, contour: &[ContourPoint], place: impl Fn((f32, f32)) -> (f32, f32)) {
    let at = |point: &ContourPoint| (point.x, point.y);
    let middle = |one: (f32, f32), other: (f32, f32)| (0.5 * (one.0 + other.0), 0.5 * (one.1 + other.1));
    let (next, start) = match (contour.iter().position(|point| point.is_on), contour) {
        (Some(on), _) => (on + 1, at(&contour[on])),
        (None, [first, .., last]) => (0, middle(at(first), at(last))),
        _ => return,
    };
    path.move_to(place(start).0, place(start).1);
    let mut bend: Option<(f32, f32)> = None;
    let mut go = |bend: Option<(f32, f32)>, to: (f32, f32)| match (bend.map(&place), place(to)) {
        (Some((x1, y1)), (x, y)) => path.quad_to(x1, y1, x, y),
        (None, (x, y)) => path.line_to(x, y),
    };
    for point in contour[next..].iter().chain(&contour[..next]) {
        match bend {
            Some(before) if !point.is_on => go(bend, middle(before, at(point))),
            _ if point.is_on => go(bend, at(point)),
            _ => {}
        }
        bend = (!point.is_on).then_some(at(point));
    }
    if bend.is_some() {
        go(bend, start);
    }
    path.close();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_as_wide_as_its_letters_and_as_high_as_its_capitals() {
        let (path, width) = outline("HH", 100.0, Weight::Regular).expect("font").expect("ink");
        let bounds = path.bounds();
        // of DejaVu Sans: capitals of 0.729 em, H of 0.752 em with 0.098 em before its stem
        assert!((bounds.top() + 72.9).abs() < 0.1 && bounds.bottom().abs() < 0.1, "{bounds:?}");
        assert!((width - 150.4).abs() < 0.1 && (bounds.left() - 9.8).abs() < 0.1, "{width} {bounds:?}");
        let (_, bold) = outline("HH", 100.0, Weight::Bold).expect("font").expect("ink");
        assert!(bold > width);
    }

    #[test]
    fn letters_of_formulas_are_in_the_font_and_blanks_have_no_ink() {
        for letter in "−√⁻°²ηφτμδγρθ∞∫→⅔₀′βΔŪ…".chars() {
            assert_ne!(Weight::Regular.font().expect("font").glyph(letter), 0, "{letter}");
            assert!(outline(&letter.to_string(), 10.0, Weight::Regular).expect("font").is_some(), "{letter}");
        }
        assert_eq!(outline("  ", 10.0, Weight::Regular).expect("font"), None);
    }
}
