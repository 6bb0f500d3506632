//! A drawing surface in fractional pixels over plotters' SVG backend.

use super::error::{Drawn, FigureError};
use super::font::{FAMILY, FAMILY_WITH_FALLBACK, LINE_HEIGHT, plain_width, width};
use super::format::FigureFormat;
use super::script::{Run, SMALLER, runs};
use plotters::backend::DrawingBackend;
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle};

/// plotters rounds to whole units. The drawing has this many units a pixel and is shown scaled down,
/// which keeps curves smooth and lattices of particles regular.
pub(super) const UNITS_PER_PIXEL: f64 = 4.0;

/// No coordinate is larger `[px]`: far outside any sheet and far inside plotters' integers.
const FARTHEST: f64 = 1e6;

/// A point on the sheet `[px]`, y downwards.
pub(super) type Point = (f64, f64);

/// A rectangle on the sheet `[px]`, y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rectangle {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn contains(&self, (x, y): Point) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }

    /// The rectangle grown by `by` on every side.
    pub(super) fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }
}

/// Colour, opacity and width of a stroke or fill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ink {
    pub(super) colour: RGBColor,
    pub(super) opacity: f64,
    /// Stroke width `[px]`; ignored by fills.
    pub(super) width: f64,
}

impl Ink {
    pub(super) const fn solid(colour: RGBColor, width: f64) -> Self {
        Self { colour, opacity: 1.0, width }
    }

    fn style(self) -> ShapeStyle {
        ShapeStyle {
            color: self.colour.mix(self.opacity),
            filled: false,
            stroke_width: (self.width * UNITS_PER_PIXEL).round().max(1.0) as u32,
        }
    }
}

/// Typesetting of a text.
#[derive(Clone, Copy)]
pub(super) struct TextSpec {
    /// Font size `[px]`.
    pub(super) em: f64,
    pub(super) weight: FontStyle,
    pub(super) horizontal: HPos,
    pub(super) vertical: VPos,
    pub(super) colour: RGBColor,
    pub(super) direction: Direction,
}

/// Reading direction of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Rightwards,
    Upwards,
}

/// The sheet being drawn.
pub(super) struct Canvas<'a> {
    backend: SVGBackend<'a>,
}

impl<'a> Canvas<'a> {
    /// A white sheet of `width` × `height` pixels that is written into `text`.
    pub(super) fn new(text: &'a mut String, width: f64, height: f64) -> Result<Self, FigureError> {
        let size = ((width * UNITS_PER_PIXEL) as u32, (height * UNITS_PER_PIXEL) as u32);
        let mut canvas = Self { backend: SVGBackend::with_string(text, size) };
        let sheet = Rectangle { left: 0.0, top: 0.0, right: width, bottom: height };
        canvas.fill_rectangle(&sheet, Ink::solid(plotters::style::WHITE, 0.0))?;
        Ok(canvas)
    }

    /// Finishes the drawing.
    pub(super) fn finish(mut self) -> Drawn {
        self.backend.present().map_err(draw_error)
    }

    pub(super) fn line(&mut self, from: Point, to: Point, ink: Ink) -> Drawn {
        self.backend.draw_line(units(from), units(to), &ink.style()).map_err(draw_error)
    }

    pub(super) fn polyline(&mut self, points: &[Point], ink: Ink) -> Drawn {
        if points.len() < 2 {
            return Ok(());
        }
        self.backend.draw_path(points.iter().map(|&point| units(point)), &ink.style()).map_err(draw_error)
    }

    pub(super) fn polygon(&mut self, points: &[Point], ink: Ink) -> Drawn {
        if points.len() < 3 {
            return Ok(());
        }
        self.backend.fill_polygon(points.iter().map(|&point| units(point)), &ink.style()).map_err(draw_error)
    }

    pub(super) fn fill_rectangle(&mut self, rectangle: &Rectangle, ink: Ink) -> Drawn {
        let upper_left = units((rectangle.left, rectangle.top));
        let lower_right = units((rectangle.right, rectangle.bottom));
        self.backend.draw_rect(upper_left, lower_right, &ink.style(), true).map_err(draw_error)
    }

    pub(super) fn frame(&mut self, rectangle: &Rectangle, ink: Ink) -> Drawn {
        let Rectangle { left, top, right, bottom } = *rectangle;
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.polyline(&corners, ink)
    }

    /// A filled circle.
    pub(super) fn disc(&mut self, centre: Point, radius: f64, ink: Ink) -> Drawn {
        let radius = (radius * UNITS_PER_PIXEL).round().clamp(1.0, FARTHEST) as u32;
        self.backend.draw_circle(units(centre), radius, &ink.style(), true).map_err(draw_error)
    }

    /// A text with its indices and exponents, each of which is an element of its own.
    pub(super) fn text(&mut self, text: &str, at: Point, spec: TextSpec) -> Drawn {
        let runs = runs(text);
        if let [whole] = runs[..]
            && whole.rise == 0.0
        {
            return self.run(whole.text, at, spec);
        }
        let before = match spec.horizontal {
            HPos::Left => 0.0,
            HPos::Center => 0.5,
            HPos::Right => 1.0,
        };
        let mut along = -before * width(text, spec.em, spec.weight);
        for Run { text, rise } in runs {
            let own =
                TextSpec { em: if rise == 0.0 { spec.em } else { SMALLER * spec.em }, horizontal: HPos::Left, ..spec };
            // from where a smaller letter's anchor lies to that of the base
            let anchor = match spec.vertical {
                VPos::Top => 0.76,
                VPos::Center => 0.36,
                VPos::Bottom => 0.0,
            };
            let down = anchor * (spec.em - own.em) - rise * spec.em;
            let place = match spec.direction {
                Direction::Rightwards => (at.0 + along, at.1 + down),
                Direction::Upwards => (at.0 + down, at.1 - along),
            };
            // a blank at the beginning of an element would not be drawn
            self.run(&text.replace(' ', "\u{a0}"), place, own)?;
            along += plain_width(text, own.em, spec.weight);
        }
        Ok(())
    }

    /// Letters of one size on one line.
    fn run(&mut self, text: &str, at: Point, spec: TextSpec) -> Drawn {
        let size = spec.em * LINE_HEIGHT * UNITS_PER_PIXEL;
        let font = FontDesc::new(FontFamily::Name(FAMILY), size, spec.weight);
        let font = match spec.direction {
            Direction::Rightwards => font,
            Direction::Upwards => font.transform(FontTransform::Rotate270),
        };
        let style = TextStyle::from(font).color(&spec.colour).pos(Pos::new(spec.horizontal, spec.vertical));
        self.backend.draw_text(text, &style, units(at)).map_err(draw_error)
    }
}

/// Gives the finished SVG its size in pixels, round joins and a font fall-back, and drops default attributes.
pub(super) fn polish(drawn: &str, width: f64, height: f64, format: FigureFormat) -> String {
    let units_tag =
        format!("width=\"{}\" height=\"{}\"", (width * UNITS_PER_PIXEL) as u32, (height * UNITS_PER_PIXEL) as u32);
    let length = |pixels: f64| match format.paper {
        None => format!("{pixels:.0}"),
        Some(paper) => format!("{:.2}mm", pixels * paper / format.sheet),
    };
    let pixel_tag = format!("width=\"{}\" height=\"{}\" stroke-linejoin=\"round\"", length(width), length(height));
    drawn
        .replacen(&units_tag, &pixel_tag, 1)
        .replace(&format!("font-family=\"{FAMILY}\""), &format!("font-family=\"{FAMILY_WITH_FALLBACK}\""))
        // Half of DejaVu's cap height: plotters centres on the lower-case letters, which lifts numbers off their ticks.
        .replace(" dy=\"0.5ex\"", " dy=\"0.36em\"")
        .replace(" opacity=\"1\"", "")
        .replace(" stroke=\"none\" stroke-width=\"1\"", "")
}

fn units((x, y): Point) -> (i32, i32) {
    // A NaN becomes 0 in the cast; callers have filtered it long before.
    let unit = |value: f64| (value.clamp(-FARTHEST, FARTHEST) * UNITS_PER_PIXEL).round() as i32;
    (unit(x), unit(y))
}

fn draw_error(error: impl std::error::Error) -> FigureError {
    FigureError::Draw(error.to_string())
}
