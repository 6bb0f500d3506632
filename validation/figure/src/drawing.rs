//! A figure as shapes on a sheet, in whole units of a quarter of a pixel, from which SVG, PNG and PDF are written.

use super::Figure;
use super::font::{plain_width, width};
use super::format::FigureFormat;
use super::glyphs::Weight;
use super::palette::{Colour, WHITE};
use super::script::{Run, SMALLER, runs};
use super::shapes::{InkedShape, SheetShape, UnitPoint};
use std::collections::HashMap;

/// Whole units keep files short; a quarter of a pixel keeps curves smooth and lattices of particles regular.
pub(super) const UNITS_PER_PIXEL: f64 = 4.0;

/// No coordinate is larger `[px]`: far outside any sheet and far inside the integers of units.
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
    pub(super) colour: Colour,
    pub(super) opacity: f64,
    /// Stroke width `[px]`; ignored by fills.
    pub(super) width: f64,
}

impl Ink {
    pub(super) const fn solid(colour: Colour, width: f64) -> Self {
        Self { colour, opacity: 1.0, width }
    }
}

/// Typesetting of a text.
#[derive(Clone, Copy)]
pub(super) struct TextSpec {
    /// Font size `[px]`.
    pub(super) em: f64,
    pub(super) weight: Weight,
    pub(super) horizontal: HorizontalAnchor,
    pub(super) vertical: VerticalAnchor,
    pub(super) colour: Colour,
    pub(super) direction: Direction,
}

/// Part of a text that stands on its point, along the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HorizontalAnchor {
    Left,
    Centre,
    Right,
}

impl HorizontalAnchor {
    /// Share of the text before the point `[-]`.
    pub(super) fn share(self) -> f64 {
        match self {
            Self::Left => 0.0,
            Self::Centre => 0.5,
            Self::Right => 1.0,
        }
    }
}

/// Part of a text that stands on its point, across the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum VerticalAnchor {
    Top,
    Centre,
}

impl VerticalAnchor {
    /// Depth of the base line below the point over the em `[-]`; centred letters are capitals.
    pub(super) fn depth(self) -> f64 {
        match self {
            Self::Top => 0.76,
            Self::Centre => 0.36,
        }
    }
}

/// Reading direction of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Rightwards,
    Upwards,
}

/// A figure that is laid out for a format. The same data give the same bytes of every kind of file on any machine.
pub struct Drawing {
    pub(super) format: FigureFormat,
    /// Width and height of the sheet in units.
    pub(super) size: UnitPoint,
    pub(super) shapes: Vec<InkedShape>,
}

impl Drawing {
    /// Lays out a figure; odd data (empty, constant, NaN, infinite) draw an odd figure.
    #[must_use]
    pub fn of(figure: &Figure, format: FigureFormat) -> Self {
        super::sheet::draw(figure, format)
    }

    /// A white sheet of a height `[px]`.
    pub(super) fn new(format: FigureFormat, height: f64) -> Self {
        let sheet = Rectangle { left: 0.0, top: 0.0, right: format.sheet, bottom: height };
        let mut drawing = Self { format, size: units((sheet.right, sheet.bottom)), shapes: Vec::new() };
        drawing.fill_rectangle(&sheet, Ink::solid(WHITE, 0.0));
        drawing
    }

    fn add(&mut self, shape: SheetShape, ink: Ink) {
        self.shapes.push(InkedShape { shape, colour: ink.colour, opacity: ink.opacity });
    }

    pub(super) fn line(&mut self, from: Point, to: Point, ink: Ink) {
        self.polyline(&[from, to], ink);
    }

    pub(super) fn polyline(&mut self, points: &[Point], ink: Ink) {
        if points.len() >= 2 {
            let width = (ink.width * UNITS_PER_PIXEL).round().max(1.0) as u32;
            self.add(SheetShape::Polyline { width, points: points.iter().map(|&point| units(point)).collect() }, ink);
        }
    }

    pub(super) fn polygon(&mut self, points: &[Point], ink: Ink) {
        if points.len() >= 3 {
            self.add(SheetShape::Polygon(points.iter().map(|&point| units(point)).collect()), ink);
        }
    }

    pub(super) fn fill_rectangle(&mut self, rectangle: &Rectangle, ink: Ink) {
        let (corner, opposite) = (units((rectangle.left, rectangle.top)), units((rectangle.right, rectangle.bottom)));
        self.add(SheetShape::Rectangle { corner, size: (opposite.0 - corner.0, opposite.1 - corner.1) }, ink);
    }

    pub(super) fn frame(&mut self, rectangle: &Rectangle, ink: Ink) {
        let Rectangle { left, top, right, bottom } = *rectangle;
        self.polyline(&[(left, top), (right, top), (right, bottom), (left, bottom), (left, top)], ink);
    }

    /// Discs of one radius `[px]`: all of a colour are one shape, in the order in which the colours appear. In a file a particle
    /// then takes some ten bytes instead of fifty, and a browser meets a path for each colour instead of an element for each particle.
    pub(super) fn discs(&mut self, radius: f64, discs: impl IntoIterator<Item = (Point, Colour)>) {
        let radius = (radius * UNITS_PER_PIXEL).round().clamp(1.0, FARTHEST) as u32;
        // marks of one curve follow each other
        let before = self.shapes.iter().enumerate().next_back().filter(|(_, last)| last.shape.has_radius(radius));
        let mut places: HashMap<Colour, usize> = before.map(|(place, last)| (last.colour, place)).into_iter().collect();
        for (centre, colour) in discs {
            let place = *places.entry(colour).or_insert(self.shapes.len());
            if place == self.shapes.len() {
                self.add(SheetShape::Discs { radius, centres: Vec::new() }, Ink::solid(colour, 0.0));
            }
            if let SheetShape::Discs { centres, .. } = &mut self.shapes[place].shape {
                centres.push(units(centre));
            }
        }
    }

    /// A text with its indices and exponents, each of which is an element of its own.
    pub(super) fn text(&mut self, text: &str, at: Point, spec: TextSpec) {
        let runs = runs(text);
        if let [whole] = runs[..]
            && whole.rise == 0.0
        {
            return self.run(whole.text, at, spec);
        }
        let mut along = -spec.horizontal.share() * width(text, spec.em, spec.weight);
        for Run { text, rise } in runs {
            let own = TextSpec {
                em: if rise == 0.0 { spec.em } else { SMALLER * spec.em },
                horizontal: HorizontalAnchor::Left,
                ..spec
            };
            // from where a smaller letter's anchor lies to that of the base
            let down = spec.vertical.depth() * (spec.em - own.em) - rise * spec.em;
            let place = match spec.direction {
                Direction::Rightwards => (at.0 + along, at.1 + down),
                Direction::Upwards => (at.0 + down, at.1 - along),
            };
            // a blank at the beginning of an element would not be drawn
            self.run(&text.replace(' ', "\u{a0}"), place, own);
            along += plain_width(text, own.em, spec.weight);
        }
    }

    /// Letters of one size on one line.
    fn run(&mut self, text: &str, at: Point, spec: TextSpec) {
        let shape = SheetShape::Text { text: text.to_owned(), place: units(at), spec };
        self.add(shape, Ink::solid(spec.colour, 0.0));
    }
}

fn units((x, y): Point) -> UnitPoint {
    // A NaN becomes 0 in the cast; callers have filtered it long before.
    let unit = |value: f64| (value.clamp(-FARTHEST, FARTHEST) * UNITS_PER_PIXEL).round() as i32;
    (unit(x), unit(y))
}
