//! Shapes of a drawing, and their outlines.

use super::glyphs::{Weight, outline};
use super::palette::Colour;
use tiny_skia::{Path, PathBuilder, Rect, Transform};

/// Whole units keep files short; a quarter of a pixel keeps curves smooth and lattices of particles regular.
pub(super) const UNITS_PER_PIXEL: f64 = 4.0;

/// A point of the sheet in units, y downwards.
pub(super) type UnitPoint = (i32, i32);

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

/// A shape with its ink.
pub(super) struct InkedShape {
    pub(super) shape: SheetShape,
    pub(super) colour: Colour,
    pub(super) opacity: f64,
}

/// Shapes in units of the sheet; all but a polyline are filled.
pub(super) enum SheetShape {
    Rectangle { corner: UnitPoint, size: UnitPoint },
    Polygon(Vec<UnitPoint>),
    Polyline { width: u32, points: Vec<UnitPoint> },
    Discs { radius: u32, centres: Vec<UnitPoint> },
    Text { text: String, place: UnitPoint, spec: TextSpec },
}

impl SheetShape {
    pub(super) fn has_radius(&self, wanted: u32) -> bool {
        matches!(self, Self::Discs { radius, .. } if *radius == wanted)
    }

    /// The outline; none of a shape without an extent.
    pub(super) fn path(&self) -> Option<Path> {
        let at = |&(x, y): &UnitPoint| (x as f32, y as f32);
        let mut path = PathBuilder::new();
        match self {
            Self::Rectangle { corner, size } => {
                let ((x, y), (width, height)) = (at(corner), at(size));
                path.push_rect(Rect::from_xywh(x, y, width, height)?);
            }
            Self::Polygon(points) | Self::Polyline { points, .. } => {
                for (index, (x, y)) in points.iter().map(at).enumerate() {
                    if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
                }
                if matches!(self, Self::Polygon(_)) {
                    path.close();
                }
            }
            Self::Discs { radius, centres } => {
                centres.iter().map(at).for_each(|(x, y)| path.push_circle(x, y, *radius as f32));
            }
            Self::Text { text, place, spec } => {
                let ((x, y), size) = (at(place), (spec.em * UNITS_PER_PIXEL) as f32);
                let (outline, width) = outline(text.trim_matches(' '), size, spec.weight)?;
                let turned = match spec.direction {
                    Direction::Rightwards => Transform::identity(),
                    Direction::Upwards => Transform::from_rotate_at(270.0, x, y),
                };
                let before = spec.horizontal.share() as f32 * width;
                let below = spec.vertical.depth() as f32 * size;
                return outline.transform(turned.pre_translate(x - before, y + below));
            }
        }
        path.finish()
    }
}
