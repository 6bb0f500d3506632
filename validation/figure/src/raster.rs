//! The figures' own SVG → pixels. The drawing of [`super::canvas`] holds eight kinds of elements with a few attributes each,
//! which are drawn here one by one; an element or attribute of another kind is an error and not a gap in the picture.

use super::error::FigureError;
use super::glyphs;
use roxmltree::{Document, Node};
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, Transform};

/// The pixels of a drawing at `scale` times its own size.
///
/// # Errors
/// A text that is no drawing of this package, or no memory for its pixels.
pub(super) fn pixels(svg: &str, scale: f32) -> Result<Pixmap, FigureError> {
    let document = Document::parse(svg).map_err(|error| FigureError::Svg(error.to_string()))?;
    let root = document.root_element();
    let (width, height) = (number(root, "width")?, number(root, "height")?);
    let view = numbers(attribute(root, "viewBox")?)?;
    let [_, _, units, _] = view[..] else {
        return Err(FigureError::Svg("a view box of four numbers is missing".into()));
    };
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let mut sheet = Sheet {
        pixels: Pixmap::new(pixels(width), pixels(height))
            .ok_or_else(|| FigureError::Raster(format!("no memory for {width} × {height} pixels")))?,
        view: Transform::from_scale(width * scale / units, width * scale / units),
    };
    for node in root.children().filter(Node::is_element) {
        sheet.draw(node)?;
    }
    Ok(sheet.pixels)
}

struct Sheet {
    pixels: Pixmap,
    /// From units of the drawing to pixels.
    view: Transform,
}

impl Sheet {
    fn draw(&mut self, node: Node<'_, '_>) -> Result<(), FigureError> {
        match node.tag_name().name() {
            "rect" => {
                let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| number(node, name));
                // a rectangle without an area is none
                if let Some(area) = Rect::from_xywh(x?, y?, width?, height?) {
                    self.fill(&PathBuilder::from_rect(area), paint(node, "fill")?);
                }
            }
            "circle" => {
                let [x, y, radius] = ["cx", "cy", "r"].map(|name| number(node, name));
                if let Some(disc) = PathBuilder::from_circle(x?, y?, radius?) {
                    self.fill(&disc, paint(node, "fill")?);
                }
            }
            "polygon" => {
                if let Some(area) = polyline(node, true)? {
                    self.fill(&area, paint(node, "fill")?);
                }
            }
            "polyline" => {
                if let Some(line) = polyline(node, false)? {
                    self.stroke(&line, node)?;
                }
            }
            "line" => {
                let [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(|name| number(node, name));
                let mut line = PathBuilder::new();
                line.move_to(x1?, y1?);
                line.line_to(x2?, y2?);
                if let Some(line) = line.finish() {
                    self.stroke(&line, node)?;
                }
            }
            "path" => {
                if let Some(discs) = dots(attribute(node, "d")?, number(node, "stroke-width")? / 2.0)? {
                    self.fill(&discs, paint(node, "stroke")?);
                }
            }
            "text" => self.text(node)?,
            other => return Err(FigureError::Svg(format!("an element `{other}` that no figure has"))),
        }
        Ok(())
    }

    fn fill(&mut self, area: &Path, paint: Paint<'_>) {
        self.pixels.fill_path(area, &paint, FillRule::Winding, self.view, None);
    }

    fn stroke(&mut self, line: &Path, node: Node<'_, '_>) -> Result<(), FigureError> {
        let stroke = Stroke {
            width: number(node, "stroke-width")?,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.pixels.stroke_path(line, &paint(node, "stroke")?, &stroke, self.view, None);
        Ok(())
    }

    fn text(&mut self, node: Node<'_, '_>) -> Result<(), FigureError> {
        let (x, y, size) = (number(node, "x")?, number(node, "y")?, number(node, "font-size")?);
        let shift = node.attribute("dy").map_or(Some(0.0), |shift| shift.strip_suffix("em")?.parse::<f32>().ok());
        let shift = shift.ok_or_else(|| FigureError::Svg("a text shifted by other than `em`".into()))? * size;
        let share = match attribute(node, "text-anchor")? {
            "start" => 0.0,
            "middle" => 0.5,
            _ => 1.0,
        };
        let is_bold = node.attribute("font-weight") == Some("bold");
        let Some((outline, width)) = glyphs::outline(node.text().unwrap_or_default().trim(), size, is_bold)? else {
            return Ok(());
        };
        let turned = match node.attribute("transform") {
            None => Transform::identity(),
            Some(text) => rotation(text).ok_or_else(|| FigureError::Svg(format!("a transform `{text}`")))?,
        };
        let placed = turned.pre_concat(Transform::from_translate(x - share * width, y + shift));
        if let Some(outline) = outline.transform(placed) {
            self.fill(&outline, paint(node, "fill")?);
        }
        Ok(())
    }
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

/// Numbers parted by commas or spaces.
fn numbers(text: &str) -> Result<Vec<f32>, FigureError> {
    let parts = text.split([',', ' ', '\n']).filter(|part| !part.is_empty());
    parts.map(|part| part.parse().map_err(|_| FigureError::Svg(format!("{part} is no number")))).collect()
}

/// The colour `#RRGGBB` of an attribute, with the element's opacity.
fn paint(node: Node<'_, '_>, name: &str) -> Result<Paint<'static>, FigureError> {
    let text = attribute(node, name)?;
    let channel = |at: usize| text.get(at..at + 2).and_then(|digits| u8::from_str_radix(digits, 16).ok());
    let (Some(red), Some(green), Some(blue), true) = (channel(1), channel(3), channel(5), text.starts_with('#')) else {
        return Err(FigureError::Svg(format!("a colour `{text}`")));
    };
    let opacity = if node.has_attribute("opacity") { number(node, "opacity")? } else { 1.0 };
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    Ok(paint)
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

/// Discs for the dots that a round pen makes of `M x y h0 m dx dy h0 …`.
fn dots(steps: &str, radius: f32) -> Result<Option<Path>, FigureError> {
    let wrong =
        || FigureError::Svg(format!("a path of other than dots, `{}`", steps.chars().take(40).collect::<String>()));
    let rest = steps.strip_prefix('M').ok_or_else(wrong)?;
    let mut path = PathBuilder::new();
    let (mut x, mut y) = (0.0, 0.0);
    for step in rest.split('m') {
        let step = step.strip_suffix("h0").ok_or_else(wrong)?;
        // the sign of the second number may stand for the gap before it
        let gap = step.char_indices().skip(1).find(|(_, letter)| matches!(letter, ' ' | '-'));
        let (right, down) = step.split_at(gap.ok_or_else(wrong)?.0);
        x += right.parse::<f32>().map_err(|_| wrong())?;
        y += down.trim_start().parse::<f32>().map_err(|_| wrong())?;
        path.push_circle(x, y, radius);
    }
    Ok(path.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_skia::PremultipliedColorU8;

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
    fn what_no_figure_has_is_refused_and_not_left_out() {
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
