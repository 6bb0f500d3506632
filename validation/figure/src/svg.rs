//! Drawing → SVG.

use super::drawing::{Direction, Drawing, HorizontalAnchor, TextSpec, UNITS_PER_PIXEL};
use super::font::FAMILY;
use super::glyphs::Weight;
use super::palette::Colour;
use super::shapes::{InkedShape, SheetShape, UnitPoint};
use std::fmt::Write as _;

impl Drawing {
    /// The text of an SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        let length = |units: i32| match (f64::from(units) / UNITS_PER_PIXEL, self.format.paper) {
            (pixels, None) => format!("{pixels:.0}"),
            (pixels, Some(paper)) => format!("{:.2}mm", pixels * paper / self.format.sheet),
        };
        let (width, height) = self.size;
        let head = format!(
            "<svg width=\"{}\" height=\"{}\" fill=\"none\" stroke-linejoin=\"round\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n",
            length(width),
            length(height)
        );
        let shapes = self.shapes.iter().map(element);
        std::iter::once(head).chain(shapes).chain(["</svg>\n".to_owned()]).collect()
    }
}

fn element(InkedShape { shape, colour, opacity }: &InkedShape) -> String {
    let hex = hex(*colour);
    let opacity = if *opacity < 1.0 { format!(" opacity=\"{opacity}\"") } else { String::new() };
    match shape {
        SheetShape::Rectangle { corner: (x, y), size: (width, height) } => {
            format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{opacity} fill=\"{hex}\"/>\n")
        }
        SheetShape::Polygon(points) => {
            format!("<polygon{opacity} fill=\"{hex}\" points=\"{}\"/>\n", list(points))
        }
        SheetShape::Polyline { width, points } => {
            format!("<polyline{opacity} stroke=\"{hex}\" stroke-width=\"{width}\" points=\"{}\"/>\n", list(points))
        }
        SheetShape::Discs { radius, centres } => format!(
            "<path d=\"{}\" stroke=\"{hex}\" stroke-width=\"{}\" stroke-linecap=\"round\"/>\n",
            dots(centres),
            2 * radius
        ),
        SheetShape::Text { text, place, spec } => letters(text, *place, spec, &hex),
    }
}

fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

fn list(points: &[UnitPoint]) -> String {
    points.iter().map(|(x, y)| format!("{x},{y}")).collect::<Vec<_>>().join(" ")
}

/// Steps of a round pen that makes a dot at every point.
fn dots(points: &[UnitPoint]) -> String {
    let mut steps = String::new();
    let mut before: Option<UnitPoint> = None;
    for &(x, y) in points {
        let (mark, right, down) = before.map_or(('M', x, y), |before| ('m', x - before.0, y - before.1));
        let gap = if down < 0 && before.is_some() { "" } else { " " };
        write!(steps, "{mark}{right}{gap}{down}h0").expect("a string takes any text");
        before = Some((x, y));
    }
    steps
}

fn letters(text: &str, (x, y): UnitPoint, spec: &TextSpec, hex: &str) -> String {
    let anchor = match spec.horizontal {
        HorizontalAnchor::Left => "start",
        HorizontalAnchor::Centre => "middle",
        HorizontalAnchor::Right => "end",
    };
    let weight = if spec.weight == Weight::Bold { " font-weight=\"bold\"" } else { "" };
    let turned = match spec.direction {
        Direction::Rightwards => String::new(),
        Direction::Upwards => format!(" transform=\"rotate(270, {x}, {y})\""),
    };
    format!(
        "<text x=\"{x}\" y=\"{y}\" dy=\"{}em\" text-anchor=\"{anchor}\" font-family=\"{FAMILY}\" font-size=\"{}\" \
         fill=\"{hex}\"{weight}{turned}>\n{}\n</text>\n",
        spec.vertical.depth(),
        spec.em * UNITS_PER_PIXEL,
        escaped(text)
    )
}

fn escaped(text: &str) -> String {
    let signs = [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;"), ('\'', "&apos;")];
    signs.iter().fold(text.to_owned(), |text, (sign, name)| text.replace(*sign, name))
}
