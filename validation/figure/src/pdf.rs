//! The figures' own SVG → one page of PDF: paths and their colours, letters as outlines.

use super::elements::{self, Paint, Surface};
use super::error::FigureError;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::fmt::Write as _;
use std::io::Write as _;
use tiny_skia::{Path, PathSegment, Point};

/// The page of a drawing whose unit has a length `[pt]`; the same drawing gives the same bytes.
///
/// # Errors
/// A text that is no drawing of this package.
pub(super) fn page(svg: &str, unit: f64) -> Result<Vec<u8>, FigureError> {
    let document = elements::parse(svg)?;
    let (width, height) = elements::size(&document)?;
    let (width, height) = (f64::from(width) * unit, f64::from(height) * unit);
    // y upwards, round joins
    let mut content =
        Content { text: format!("{unit:.6} 0 0 -{unit:.6} 0 {height:.3} cm 1 j\n"), opacities: Vec::new() };
    elements::draw(&document, &mut content)?;
    let packed = packed(content.text.as_bytes()).map_err(|error| FigureError::Draw(error.to_string()))?;
    let states = content.opacities.iter().fold(String::new(), |all, percent| {
        let share = f64::from(*percent) / 100.0;
        format!("{all}/g{percent} << /ca {share} /CA {share} >> ")
    });
    let page = format!(
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.3} {height:.3}] /Contents 4 0 R /Resources << /ExtGState << {states}>> >> >>"
    );
    Ok(file(&[
        b"<< /Type /Catalog /Pages 2 0 R >>".to_vec(),
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_vec(),
        page.into_bytes(),
        [format!("<< /Length {} /Filter /FlateDecode >>\nstream\n", packed.len()).as_bytes(), &packed, b"\nendstream"]
            .concat(),
    ]))
}

/// Deflated bytes; the best compression takes five times as long for one per cent less.
pub(super) fn packed(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(5));
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// Objects 1, 2, … with the table of their places.
fn file(objects: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n".to_vec();
    let mut table = format!("xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1);
    for (place, object) in objects.iter().enumerate() {
        table += &format!("{:010} 00000 n \n", bytes.len());
        bytes.extend(format!("{} 0 obj\n", place + 1).into_bytes());
        bytes.extend(object);
        bytes.extend(b"\nendobj\n");
    }
    let end = format!("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n", objects.len() + 1, bytes.len());
    bytes.extend(table.into_bytes());
    bytes.extend(end.into_bytes());
    bytes
}

/// The operators of the page.
struct Content {
    text: String,
    /// Opacities that were used, in per cent.
    opacities: Vec<u32>,
}

impl Content {
    /// Sets opacity and colour of what follows.
    fn set(&mut self, paint: Paint, colour: &str) {
        let percent = (100.0 * paint.opacity).round() as u32;
        if !self.opacities.contains(&percent) {
            self.opacities.push(percent);
        }
        let [red, green, blue] = paint.colour.map(|channel| f64::from(channel) / 255.0);
        // writing to a string cannot fail
        let _ = writeln!(self.text, "/g{percent} gs {red:.3} {green:.3} {blue:.3} {colour}");
    }

    fn add(&mut self, path: &Path, operator: &str) {
        let mut at = Point::zero();
        let mut write = |points: &[Point], operator: &str| {
            for point in points {
                let _ = write!(self.text, "{} {} ", short(point.x), short(point.y));
            }
            let _ = writeln!(self.text, "{operator}");
        };
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(to) => write(&[to], "m"),
                PathSegment::LineTo(to) => write(&[to], "l"),
                PathSegment::QuadTo(bend, to) => {
                    // the same curve of third degree
                    let third =
                        |end: Point| Point::from_xy(end.x + (bend.x - end.x) / 1.5, end.y + (bend.y - end.y) / 1.5);
                    write(&[third(at), third(to), to], "c");
                }
                PathSegment::CubicTo(first, second, to) => write(&[first, second, to], "c"),
                PathSegment::Close => write(&[], "h"),
            }
            if let PathSegment::MoveTo(to)
            | PathSegment::LineTo(to)
            | PathSegment::QuadTo(_, to)
            | PathSegment::CubicTo(_, _, to) = segment
            {
                at = to;
            }
        }
        let _ = writeln!(self.text, "{operator}");
    }
}

/// A coordinate to a tenth of a unit.
fn short(value: f32) -> f32 {
    (10.0 * value).round() / 10.0
}

impl Surface for Content {
    fn fill(&mut self, area: &Path, paint: Paint) {
        self.set(paint, "rg");
        self.add(area, "f");
    }

    fn stroke(&mut self, line: &Path, width: f32, paint: Paint) {
        self.set(paint, &format!("RG {width} w"));
        self.add(line, "S");
    }

    /// Lines without a length and with round ends.
    fn dots(&mut self, centres: &[Point], radius: f32, paint: Paint) {
        self.set(paint, &format!("RG {} w 1 J", 2.0 * radius));
        for centre in centres {
            let (x, y) = (short(centre.x), short(centre.y));
            let _ = writeln!(self.text, "{x} {y} m {x} {y} l");
        }
        self.text.push_str("S 0 J\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn a_page_has_the_paths_in_their_colours_at_its_size() {
        let svg = "<svg viewBox=\"0 0 80 40\"><polygon opacity=\"0.25\" fill=\"#FF0000\" points=\"0,0 40,0 0,40 \"/>\
                   <line stroke=\"#000000\" stroke-width=\"8\" x1=\"0\" y1=\"20\" x2=\"80\" y2=\"20.04\"/></svg>";
        let pdf = page(svg, 0.5).expect("a page");
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-1.4") && text.ends_with("%%EOF\n"));
        assert!(text.contains("/MediaBox [0 0 40.000 20.000]") && text.contains("/g25 << /ca 0.25"), "{text}");
        // the table names the byte at which each object begins
        let place = text.rfind("startxref\n").expect("a place");
        let number = text[place + 10..].lines().next().and_then(|line| line.parse::<usize>().ok()).expect("a number");
        assert!(pdf[number..].starts_with(b"xref\n0 5\n"));
        let start = pdf.windows(7).position(|bytes| bytes == b"stream\n").expect("a stream") + 7;
        let mut content = String::new();
        flate2::read::ZlibDecoder::new(&pdf[start..]).read_to_string(&mut content).expect("packed text");
        for part in
            ["0.500000 0 0 -0.500000 0 20.000 cm", "/g25 gs 1.000 0.000 0.000 rg\n0 0 m\n40 0 l\n0 40 l\nh\nf\n"]
        {
            assert!(content.contains(part), "{part} is not in {content}");
        }
        assert!(content.ends_with("/g100 gs 0.000 0.000 0.000 RG 8 w\n0 20 m\n80 20 l\nS\n"), "{content}");
    }
}
