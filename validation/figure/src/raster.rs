//! Drawing → pixels.

use super::drawing::{Drawing, UNITS_PER_PIXEL};
use super::error::FigureError;
use super::shapes::{InkedShape, SheetShape};
use tiny_skia::{FillRule, LineJoin, Paint, Pixmap, Stroke, Transform};

impl Drawing {
    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// No memory for its pixels.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.pixels(self.format.scale as f32)?.encode_png().map_err(|error| FigureError::Raster(error.to_string()))
    }

    /// The pixels at `scale` times its own size.
    pub(super) fn pixels(&self, scale: f32) -> Result<Pixmap, FigureError> {
        let scale = scale / UNITS_PER_PIXEL as f32;
        // what is a whole number but for rounding stays one
        let length = |units: i32| (units as f32 * scale - 1e-3).ceil() as u32;
        let (width, height) = self.size;
        let pixels = Pixmap::new(length(width), length(height));
        let mut pixels =
            pixels.ok_or_else(|| FigureError::Raster(format!("no memory for {width} × {height} units")))?;
        let view = Transform::from_scale(scale, scale);
        for InkedShape { shape, colour: [red, green, blue], opacity } in &self.shapes {
            let Some(path) = shape.path() else { continue };
            let mut ink = Paint::default();
            ink.set_color_rgba8(*red, *green, *blue, (255.0 * opacity).round() as u8);
            if let SheetShape::Polyline { width, .. } = shape {
                let stroke = Stroke { width: *width as f32, line_join: LineJoin::Round, ..Stroke::default() };
                pixels.stroke_path(&path, &ink, &stroke, view, None);
            } else {
                pixels.fill_path(&path, &ink, FillRule::Winding, view, None);
            }
        }
        Ok(pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawing::{Direction, HorizontalAnchor, Ink, Rectangle, TextSpec, VerticalAnchor};
    use super::super::format::FigureFormat;
    use super::super::glyphs::Weight;
    use super::super::palette::BLACK;
    use super::*;
    use tiny_skia::PremultipliedColorU8;

    const RED: Ink = Ink { colour: [255, 0, 0], opacity: 1.0, width: 2.0 };

    /// A sheet of 20 × 10 pixels with what `draw` adds.
    fn drawn(draw: impl Fn(&mut Drawing)) -> Pixmap {
        let format = FigureFormat { sheet: 20.0, ..FigureFormat::SCREEN };
        let mut drawing = Drawing::new(format, 10.0);
        draw(&mut drawing);
        drawing.pixels(1.0).expect("memory")
    }

    fn colour(picture: &Pixmap, x: u32, y: u32) -> [u8; 4] {
        let of = |pixel: PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()];
        picture.pixel(x, y).map(of).expect("inside")
    }

    #[test]
    fn every_shape_stands_in_its_place_and_colour() {
        let rectangle = Rectangle { left: 2.0, top: 2.0, right: 6.0, bottom: 4.0 };
        let triangle = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)];
        let discs = [((5.0, 5.0), RED.colour), ((15.0, 3.0), RED.colour)];
        let check = |draw: &dyn Fn(&mut Drawing), inside: (u32, u32), outside: (u32, u32)| {
            let picture = drawn(draw);
            assert_eq!(colour(&picture, inside.0, inside.1), [255, 0, 0, 255], "{inside:?}");
            assert_eq!(colour(&picture, outside.0, outside.1), [255; 4], "{outside:?}");
        };
        check(&|sheet| sheet.fill_rectangle(&rectangle, RED), (3, 3), (8, 3));
        check(&|sheet| sheet.discs(1.5, discs), (15, 3), (10, 5));
        check(&|sheet| sheet.polygon(&triangle, RED), (1, 1), (9, 9));
        check(&|sheet| sheet.line((0.0, 5.0), (20.0, 5.0), RED), (10, 5), (10, 2));
        check(&|sheet| sheet.polyline(&[(5.0, 0.0), (5.0, 10.0)], RED), (5, 5), (1, 5));
    }

    #[test]
    fn opacity_mixes_with_what_lies_below() {
        let sheet = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)];
        let grey = Ink { colour: [0; 3], opacity: 0.25, width: 0.0 };
        let [red, .., alpha] = colour(&drawn(|drawing| drawing.polygon(&sheet, grey)), 5, 5);
        assert!((i32::from(red) - 191).abs() <= 1 && alpha == 255, "{red}");
    }

    #[test]
    fn a_turned_text_stands_upright_on_its_place() {
        let inked = |direction: Direction| -> (usize, usize) {
            let (horizontal, vertical) = (HorizontalAnchor::Centre, VerticalAnchor::Centre);
            let spec = TextSpec { em: 3.0, weight: Weight::Regular, horizontal, vertical, colour: BLACK, direction };
            let picture = drawn(|drawing| drawing.text("llllllll", (10.0, 5.0), spec));
            let dark = |x: u32, y: u32| colour(&picture, x, y)[0] < 195;
            (
                (0..20).filter(|&x| (0..10).any(|y| dark(x, y))).count(),
                (0..10).filter(|&y| (0..20).any(|x| dark(x, y))).count(),
            )
        };
        let (wide, high) = inked(Direction::Rightwards);
        let (narrow, tall) = inked(Direction::Upwards);
        assert!(wide > 5 && high <= 4 && narrow <= 4 && tall > 5, "{wide} {high} {narrow} {tall}");
    }
}
