//! The figures' own SVG → areas and lines. The drawing of [`super::canvas`] holds eight kinds of elements with a few attributes
//! each, which are read here one by one; an element or attribute of another kind is an error and not a gap in the picture.

use super::error::{Drawn, FigureError};
use super::glyphs;
use plotters::style::FontStyle;
use roxmltree::{Document, Node};
use tiny_skia::{Path, PathBuilder, Point, Rect, Transform};

/// Pen and fill of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paint {
    /// Red, green and blue.
    pub(super) colour: [u8; 3],
    /// Opacity `[-]`.
    pub(super) opacity: f32,
}

/// Receiver of the elements of a drawing, in units of the drawing, y downwards.
pub(super) trait Surface {
    /// The inside of a path.
    fn fill(&mut self, area: &Path, paint: Paint);
    /// A path as a line of a width.
    fn stroke(&mut self, line: &Path, width: f32, paint: Paint);
    /// Discs of a radius.
    fn dots(&mut self, centres: &[Point], radius: f32, paint: Paint) {
        let mut discs = PathBuilder::new();
        centres.iter().for_each(|centre| discs.push_circle(centre.x, centre.y, radius));
        if let Some(discs) = discs.finish() {
            self.fill(&discs, paint);
        }
    }
}

/// Width and height of a drawing in its own units.
pub(super) fn size(svg: &Document<'_>) -> Result<(f32, f32), FigureError> {
    match numbers(attribute(svg.root_element(), "viewBox")?)?[..] {
        [_, _, width, height] => Ok((width, height)),
        _ => Err(FigureError::Svg("a view box of four numbers is missing".into())),
    }
}

/// Reads a drawing's text.
pub(super) fn parse(svg: &str) -> Result<Document<'_>, FigureError> {
    Document::parse(svg).map_err(|error| FigureError::Svg(error.to_string()))
}

/// Draws every element, in order.
pub(super) fn draw(svg: &Document<'_>, surface: &mut impl Surface) -> Drawn {
    svg.root_element().children().filter(Node::is_element).try_for_each(|node| element(node, surface))
}

fn element(node: Node<'_, '_>, surface: &mut impl Surface) -> Drawn {
    match node.tag_name().name() {
        "rect" => {
            let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| number(node, name));
            // a rectangle without an area is none
            if let Some(area) = Rect::from_xywh(x?, y?, width?, height?) {
                surface.fill(&PathBuilder::from_rect(area), paint(node, "fill")?);
            }
        }
        "circle" => {
            let [x, y, radius] = ["cx", "cy", "r"].map(|name| number(node, name));
            if let Some(disc) = PathBuilder::from_circle(x?, y?, radius?) {
                surface.fill(&disc, paint(node, "fill")?);
            }
        }
        "polygon" => {
            if let Some(area) = polyline(node, true)? {
                surface.fill(&area, paint(node, "fill")?);
            }
        }
        "polyline" => {
            if let Some(line) = polyline(node, false)? {
                surface.stroke(&line, number(node, "stroke-width")?, paint(node, "stroke")?);
            }
        }
        "line" => {
            let [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(|name| number(node, name));
            let mut line = PathBuilder::new();
            line.move_to(x1?, y1?);
            line.line_to(x2?, y2?);
            if let Some(line) = line.finish() {
                surface.stroke(&line, number(node, "stroke-width")?, paint(node, "stroke")?);
            }
        }
        "path" => {
            let centres = dots(attribute(node, "d")?)?;
            surface.dots(&centres, number(node, "stroke-width")? / 2.0, paint(node, "stroke")?);
        }
        "text" => text(node, surface)?,
        other => return Err(FigureError::Svg(format!("an element `{other}` that no figure has"))),
    }
    Ok(())
}

fn text(node: Node<'_, '_>, surface: &mut impl Surface) -> Drawn {
    let (x, y, size) = (number(node, "x")?, number(node, "y")?, number(node, "font-size")?);
    let shift = node.attribute("dy").map_or(Some(0.0), |shift| shift.strip_suffix("em")?.parse::<f32>().ok());
    let shift = shift.ok_or_else(|| FigureError::Svg("a text shifted by other than `em`".into()))? * size;
    let share = match attribute(node, "text-anchor")? {
        "start" => 0.0,
        "middle" => 0.5,
        _ => 1.0,
    };
    let weight = if node.attribute("font-weight") == Some("bold") { FontStyle::Bold } else { FontStyle::Normal };
    let Some((outline, width)) =
        glyphs::outline(node.text().unwrap_or_default().trim_matches(['\n', ' ']), size, weight)?
    else {
        return Ok(());
    };
    let turned = match node.attribute("transform") {
        None => Transform::identity(),
        Some(text) => rotation(text).ok_or_else(|| FigureError::Svg(format!("a transform `{text}`")))?,
    };
    let placed = turned.pre_concat(Transform::from_translate(x - share * width, y + shift));
    if let Some(outline) = outline.transform(placed) {
        surface.fill(&outline, paint(node, "fill")?);
    }
    Ok(())
}

/// `rotate(degrees, x, y)`.
fn rotation(text: &str) -> Option<Transform> {
    let inner = text.strip_prefix("rotate(")?.strip_suffix(')')?;
    match numbers(inner).ok()?[..] {
        [degrees, x, y] => Some(Transform::from_rotate_at(degrees, x, y)),
        _ => None,
    }
}

fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Result<&'a str, FigureError> {
    node.attribute(name).ok_or_else(|| FigureError::Svg(format!("a {} without `{name}`", node.tag_name().name())))
}

fn number(node: Node<'_, '_>, name: &str) -> Result<f32, FigureError> {
    let text = attribute(node, name)?;
    text.parse().map_err(|_| FigureError::Svg(format!("`{name}` is {text}, no number")))
}

/// Numbers separated by commas or spaces.
fn numbers(text: &str) -> Result<Vec<f32>, FigureError> {
    let parts = text.split([',', ' ', '\n']).filter(|part| !part.is_empty());
    parts.map(|part| part.parse().map_err(|_| FigureError::Svg(format!("{part} is no number")))).collect()
}

/// The colour `#RRGGBB` of an attribute, with the element's opacity.
fn paint(node: Node<'_, '_>, name: &str) -> Result<Paint, FigureError> {
    let text = attribute(node, name)?;
    let channel = |at: usize| text.get(at..at + 2).and_then(|digits| u8::from_str_radix(digits, 16).ok());
    let (Some(red), Some(green), Some(blue), true) = (channel(1), channel(3), channel(5), text.starts_with('#')) else {
        return Err(FigureError::Svg(format!("a colour `{text}`")));
    };
    let opacity = if node.has_attribute("opacity") { number(node, "opacity")? } else { 1.0 };
    Ok(Paint { colour: [red, green, blue], opacity })
}

fn polyline(node: Node<'_, '_>, closed: bool) -> Result<Option<Path>, FigureError> {
    let mut path = PathBuilder::new();
    for (index, point) in numbers(attribute(node, "points")?)?.chunks_exact(2).enumerate() {
        if index == 0 { path.move_to(point[0], point[1]) } else { path.line_to(point[0], point[1]) }
    }
    if closed {
        path.close();
    }
    Ok(path.finish())
}

/// Places of the dots that a round pen makes of `M x y h0 m dx dy h0 …`.
fn dots(steps: &str) -> Result<Vec<Point>, FigureError> {
    let wrong =
        || FigureError::Svg(format!("a path of other than dots, `{}`", steps.chars().take(40).collect::<String>()));
    let rest = steps.strip_prefix('M').ok_or_else(wrong)?;
    let (mut centres, mut x, mut y) = (Vec::new(), 0.0, 0.0);
    for step in rest.split('m') {
        let step = step.strip_suffix("h0").ok_or_else(wrong)?;
        // the sign of the second number may stand for the gap before it
        let gap = step.char_indices().skip(1).find(|(_, letter)| matches!(letter, ' ' | '-'));
        let (right, down) = step.split_at(gap.ok_or_else(wrong)?.0);
        x += right.parse::<f32>().map_err(|_| wrong())?;
        y += down.trim_start().parse::<f32>().map_err(|_| wrong())?;
        centres.push(Point::from_xy(x, y));
    }
    Ok(centres)
}
