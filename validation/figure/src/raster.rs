//! The figures' own SVG → pixels.

use super::canvas::UNITS_PER_PIXEL;
use super::elements::{self, Paint, Surface};
use super::error::FigureError;
use super::pdf::packed;
use flate2::Crc;
use std::collections::HashMap;
use tiny_skia::{FillRule, LineCap, LineJoin, Path, Pixmap, PremultipliedColorU8, Stroke, Transform};

/// The pixels of a drawing at `scale` times its own size.
///
/// # Errors
/// A text that is no drawing of this package, or no memory for its pixels.
pub(super) fn pixels(svg: &str, scale: f32) -> Result<Pixmap, FigureError> {
    let document = elements::parse(svg)?;
    let (width, height) = elements::size(&document)?;
    let scale = scale / UNITS_PER_PIXEL as f32;
    // what is a whole number but for rounding stays one; a row that the sheet covers in part is left out
    let pixels = |length: f32| (length * scale + 1e-3) as u32;
    let pixmap = Pixmap::new(pixels(width), pixels(height));
    let mut sheet = Sheet {
        pixels: pixmap.ok_or_else(|| FigureError::Raster(format!("no memory for {width} × {height} units")))?,
        view: Transform::from_scale(scale, scale),
    };
    elements::draw(&document, &mut sheet)?;
    Ok(sheet.pixels)
}

/// Colours of a palette, at most.
const PALETTE: usize = 256;

type Colour = [u8; 3];

/// Pixels of an opaque sheet as a PNG without filters, which packs even colours best: by a palette where that has all colours, else
/// in three channels.
pub(super) fn png(sheet: &Pixmap) -> Result<Vec<u8>, FigureError> {
    let colour = |pixel: &PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
    // five bits a channel: a difference in smoothed edges alone
    let coarse = |pixel: &PremultipliedColorU8| colour(pixel).map(|channel| channel & 0xf8 | channel >> 5);
    let by_palette = indexed(sheet.pixels().iter().map(colour));
    let by_palette = by_palette.or_else(|| indexed(sheet.pixels().iter().map(coarse)));
    let (kind, palette, bytes) = match by_palette {
        Some((palette, indices)) => (3, palette, indices),
        None => (2, Vec::new(), sheet.pixels().iter().flat_map(colour).collect()),
    };
    let (width, height) = (sheet.width(), sheet.height());
    // each row begins with its filter: none
    let rows: Vec<Vec<u8>> = bytes.chunks(bytes.len() / height as usize).map(|row| [&[0], row].concat()).collect();
    let packed = packed(&rows.concat()).map_err(|error| FigureError::Raster(error.to_string()))?;
    let head = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, kind, 0, 0, 0]].concat();
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let chunks = [(b"IHDR", head), (b"PLTE", palette.concat()), (b"IDAT", packed), (b"IEND", Vec::new())];
    for (name, data) in chunks.iter().filter(|(name, data)| *name != b"PLTE" || !data.is_empty()) {
        let mut sum = Crc::new();
        sum.update(*name);
        sum.update(data);
        file.extend((data.len() as u32).to_be_bytes());
        file.extend([&name[..], data, &sum.sum().to_be_bytes()].concat());
    }
    Ok(file)
}

/// The colours of pixels in the order in which they come, and the place of each pixel's among them; none for too many colours.
fn indexed(pixels: impl Iterator<Item = Colour>) -> Option<(Vec<Colour>, Vec<u8>)> {
    let (mut places, mut palette, mut indices) = (HashMap::new(), Vec::new(), Vec::new());
    // most pixels have the colour of the one before
    let mut last = None;
    for colour in pixels {
        let known = last.filter(|(same, _)| *same == colour).map(|(_, place)| place);
        let place = known.unwrap_or_else(|| *places.entry(colour).or_insert(palette.len()));
        if place == PALETTE {
            return None;
        }
        if place == palette.len() {
            palette.push(colour);
        }
        last = Some((colour, place));
        indices.push(place as u8);
    }
    Some((palette, indices))
}

struct Sheet {
    pixels: Pixmap,
    /// From units of the drawing to pixels.
    view: Transform,
}

impl Surface for Sheet {
    fn fill(&mut self, area: &Path, paint: Paint) {
        self.pixels.fill_path(area, &ink(paint), FillRule::Winding, self.view, None);
    }

    fn stroke(&mut self, line: &Path, width: f32, paint: Paint) {
        let stroke = Stroke { width, line_cap: LineCap::Butt, line_join: LineJoin::Round, ..Stroke::default() };
        self.pixels.stroke_path(line, &ink(paint), &stroke, self.view, None);
    }
}

fn ink(Paint { colour: [red, green, blue], opacity }: Paint) -> tiny_skia::Paint<'static> {
    let mut ink = tiny_skia::Paint::default();
    ink.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    ink
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(elements: &str) -> Result<Pixmap, FigureError> {
        pixels(&format!("<svg width=\"20\" height=\"10\" viewBox=\"0 0 80 40\">{elements}</svg>"), 1.0)
    }

    fn colour(picture: &Pixmap, x: u32, y: u32) -> [u8; 4] {
        let of = |pixel: PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()];
        picture.pixel(x, y).map(of).expect("inside")
    }

    #[test]
    fn every_element_stands_in_its_place_and_colour() {
        let red = [255, 0, 0, 255];
        for (element, inside, outside) in [
            ("<rect x=\"8\" y=\"8\" width=\"16\" height=\"8\" fill=\"#FF0000\" stroke=\"none\"/>", (3, 3), (8, 3)),
            ("<circle cx=\"40\" cy=\"20\" r=\"12\" fill=\"#FF0000\"/>", (10, 5), (4, 5)),
            ("<polygon fill=\"#FF0000\" points=\"0,0 40,0 0,40 \"/>", (1, 1), (9, 9)),
            ("<line stroke=\"#FF0000\" stroke-width=\"8\" x1=\"0\" y1=\"20\" x2=\"80\" y2=\"20\"/>", (10, 5), (10, 2)),
            ("<polyline fill=\"none\" stroke=\"#FF0000\" stroke-width=\"8\" points=\"20,0 20,40 \"/>", (5, 5), (1, 5)),
            (
                "<path d=\"M20 20h0m40-8h0m0 8h0\" stroke=\"#FF0000\" stroke-width=\"12\" stroke-linecap=\"round\"/>",
                (15, 3),
                (10, 5),
            ),
        ] {
            let picture = drawn(element).expect(element);
            assert_eq!(colour(&picture, inside.0, inside.1), red, "{element}");
            assert_eq!(colour(&picture, outside.0, outside.1), [0; 4], "{element}");
        }
    }

    #[test]
    fn opacity_mixes_with_what_lies_below() {
        let white = "<rect x=\"0\" y=\"0\" width=\"80\" height=\"40\" fill=\"#FFFFFF\"/>";
        let grey = "<polygon opacity=\"0.25\" fill=\"#000000\" points=\"0,0 80,0 80,40 0,40 \"/>";
        let [red, .., alpha] = colour(&drawn(&format!("{white}{grey}")).expect("drawn"), 5, 5);
        assert!((i32::from(red) - 191).abs() <= 1 && alpha == 255, "{red}");
    }

    #[test]
    fn a_turned_text_stands_upright_on_its_place() {
        let text = |transform: &str| {
            format!(
                "<text x=\"40\" y=\"20\" dy=\"0.36em\" text-anchor=\"middle\" font-size=\"12\" fill=\"#000000\"{transform}>\nllllllll\n</text>"
            )
        };
        let inked = |picture: &Pixmap| -> (usize, usize) {
            let dark = |x: u32, y: u32| colour(picture, x, y)[3] > 60;
            (
                (0..20).filter(|&x| (0..10).any(|y| dark(x, y))).count(),
                (0..10).filter(|&y| (0..20).any(|x| dark(x, y))).count(),
            )
        };
        let (wide, high) = inked(&drawn(&text("")).expect("drawn"));
        let (narrow, tall) = inked(&drawn(&text(" transform=\"rotate(270, 40, 20)\"")).expect("drawn"));
        assert!(wide > 5 && high <= 4 && narrow <= 4 && tall > 5, "{wide} {high} {narrow} {tall}");
    }

    #[test]
    fn unknown_axis_is_refused() {
        for element in [
            "<ellipse rx=\"3\"/>",
            "<path d=\"M0 0L3 3\" stroke=\"#000000\" stroke-width=\"2\"/>",
            "<rect x=\"0\" y=\"0\" width=\"4\" height=\"4\" fill=\"red\"/>",
            "<text x=\"0\" y=\"0\" text-anchor=\"start\" font-size=\"9\" fill=\"#000000\" transform=\"skewX(3)\">a</text>",
            "<line stroke=\"#FF0000\" stroke-width=\"8\" x1=\"0\" y1=\"20\" x2=\"80\"/>",
        ] {
            assert!(matches!(drawn(element), Err(FigureError::Svg(_))), "{element}");
        }
    }
}
