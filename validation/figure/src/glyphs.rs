//! Text as outlines of the embedded font.

use super::error::FigureError;
use plotters::style::FontStyle;
use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::outline::{DrawSettings, OutlineGlyphCollection, OutlinePen};
use skrifa::raw::TableProvider;
use skrifa::raw::tables::kern::{Subtable0, SubtableKind};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::sync::LazyLock;
use tiny_skia::{Path, PathBuilder, Transform};

static REGULAR: LazyLock<Option<Font>> = LazyLock::new(|| Font::new(dejavu::sans::regular()));
static BOLD: LazyLock<Option<Font>> = LazyLock::new(|| Font::new(dejavu::sans::bold()));

/// Font file; lengths are in units of the font.
pub(super) struct Font {
    letters: Charmap<'static>,
    advances: GlyphMetrics<'static>,
    outlines: OutlineGlyphCollection<'static>,
    pairs: Subtable0<'static>,
    units_per_em: f32,
    /// Ascent minus descent.
    pub(super) line: f32,
}

impl Font {
    fn new(file: &'static [u8]) -> Option<Self> {
        let font = FontRef::new(file).ok()?;
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        let pairs = font.kern().ok()?.subtables().find_map(|table| match table.ok()?.kind().ok()? {
            SubtableKind::Format0(pairs) => Some(pairs),
            _ => None,
        });
        Some(Self {
            letters: font.charmap(),
            advances: font.glyph_metrics(Size::unscaled(), LocationRef::default()),
            outlines: font.outline_glyphs(),
            pairs: pairs?,
            units_per_em: f32::from(metrics.units_per_em),
            line: metrics.ascent - metrics.descent,
        })
    }

    /// The glyphs of a text with the place where each begins, and the width of all.
    pub(super) fn glyphs(&self, text: &str) -> (Vec<(GlyphId, f32)>, f32) {
        let mut glyphs: Vec<(GlyphId, f32)> = Vec::new();
        let mut pen = 0.0;
        for letter in text.chars() {
            // the first glyph, an empty box, stands for a letter that is not in the font
            let glyph = self.letters.map(letter).unwrap_or_default();
            let pair = glyphs.last().and_then(|&(before, _)| self.pairs.kerning(before, glyph));
            pen += pair.unwrap_or(0) as f32;
            glyphs.push((glyph, pen));
            pen += self.advances.advance_width(glyph).unwrap_or(0.0);
        }
        (glyphs, pen)
    }
}

/// Adds glyphs to a path, each from its own place on.
struct Pen {
    path: PathBuilder,
    place: f32,
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.place + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.place + x, y);
    }

    fn quad_to(&mut self, bend_x: f32, bend_y: f32, x: f32, y: f32) {
        self.path.quad_to(self.place + bend_x, bend_y, self.place + x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path.cubic_to(self.place + x1, y1, self.place + x2, y2, self.place + x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// The font of a style and its name, bold or regular.
pub(super) fn font(style: FontStyle) -> Result<(&'static Font, &'static str), FigureError> {
    let (font, style) = match style {
        FontStyle::Bold => (&BOLD, "bold"),
        _ => (&REGULAR, "regular"),
    };
    font.as_ref().map(|font| (font, style)).ok_or(FigureError::Font { style })
}

/// The outline of a text of `size` units an em with its base line's start at the origin, y downwards, and its width; nothing
/// for a text without ink.
pub(super) fn outline(text: &str, size: f32, weight: FontStyle) -> Result<Option<(Path, f32)>, FigureError> {
    let (font, style) = font(weight)?;
    let scale = size / font.units_per_em;
    let (glyphs, width) = font.glyphs(text);
    let mut pen = Pen { path: PathBuilder::new(), place: 0.0 };
    for (glyph, place) in glyphs {
        pen.place = place;
        if let Some(outline) = font.outlines.get(glyph) {
            let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
            outline.draw(settings, &mut pen).map_err(|_| FigureError::Font { style })?;
        }
    }
    let path = pen.path.finish().and_then(|path| path.transform(Transform::from_scale(scale, -scale)));
    Ok(path.map(|path| (path, scale * width)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_as_wide_as_its_letters_and_as_high_as_its_capitals() {
        let (path, width) = outline("HH", 100.0, FontStyle::Normal).expect("font").expect("ink");
        let bounds = path.bounds();
        // of DejaVu Sans: capitals of 0.729 em, H of 0.752 em with 0.098 em before its stem
        assert!((bounds.top() + 72.9).abs() < 0.1 && bounds.bottom().abs() < 0.1, "{bounds:?}");
        assert!((width - 150.4).abs() < 0.1 && (bounds.left() - 9.8).abs() < 0.1, "{width} {bounds:?}");
        let (_, bold) = outline("HH", 100.0, FontStyle::Bold).expect("font").expect("ink");
        assert!(bold > width);
    }

    #[test]
    fn pairs_of_letters_stand_closer_and_marks_are_above_their_letters() {
        // advance of A, and the pair A V, by another reader
        for (weight, advance, pair) in [(FontStyle::Normal, 1401.0, -131.0), (FontStyle::Bold, 1585.0, -139.0)] {
            let width = |text: &str| font(weight).expect("font").0.glyphs(text).1;
            assert_eq!((width("A"), width("AV") - width("A") - width("V")), (advance, pair));
            assert_eq!(width("VV"), 2.0 * width("V"));
            let top = |text: &str| outline(text, 1.0, weight).expect("font").expect("ink").0.bounds().top();
            assert!(top("é") < top("e") - 0.1 && top("Å") < top("A") - 0.1);
        }
    }

    #[test]
    fn damaged_fonts_are_refused_or_read() {
        for length in [0, 3, 11, 200, 5000, 300_000] {
            let _ = Font::new(&dejavu::sans::regular()[..length]);
        }
    }

    #[test]
    fn letters_of_formulas_are_in_the_font_and_blanks_have_no_ink() {
        for letter in "−√⁻°²ηφτμδγρθ∞∫→⅔₀′βΔŪ…".chars() {
            let (glyphs, _) = font(FontStyle::Normal).expect("font").0.glyphs(&letter.to_string());
            assert_ne!(glyphs[0].0, GlyphId::NOTDEF, "{letter}");
            assert!(outline(&letter.to_string(), 10.0, FontStyle::Normal).expect("font").is_some(), "{letter}");
        }
        assert_eq!(outline("  ", 10.0, FontStyle::Normal).expect("font"), None);
    }
}
