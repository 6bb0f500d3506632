//! Shapes of a drawing, and their outlines.

use super::drawing::{Direction, TextSpec, UNITS_PER_PIXEL};
use super::glyphs::outline;
use super::palette::Colour;
use tiny_skia::{Path, PathBuilder, Rect, Transform};

/// A point of the sheet in units, y downwards.
pub(super) type UnitPoint = (i32, i32);

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
