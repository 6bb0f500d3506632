//! Drawing → one page of PDF: paths and their colours, letters as outlines.

use super::drawing::{Drawing, UNITS_PER_PIXEL};
use super::shapes::SheetShape;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write as _;
use tiny_skia::{Path, PathSegment, Point};

impl Drawing {
    /// The bytes of a PDF file of one page.
    #[must_use]
    pub fn pdf(&self) -> Vec<u8> {
        let unit = self.format.point_size() / UNITS_PER_PIXEL;
        let (width, height) = (f64::from(self.size.0) * unit, f64::from(self.size.1) * unit);
        // y upwards, round joins
        let mut content = format!("{unit:.6} 0 0 -{unit:.6} 0 {height:.3} cm 1 j\n");
        // opacities that were used, in per cent
        let mut opacities: Vec<u32> = Vec::new();
        for inked in &self.shapes {
            let Some(path) = inked.shape.path() else { continue };
            let percent = (100.0 * inked.opacity).round() as u32;
            if !opacities.contains(&percent) {
                opacities.push(percent);
            }
            let [red, green, blue] = inked.colour.map(|channel| f64::from(channel) / 255.0);
            let (colour, width, operator) = match inked.shape {
                SheetShape::Polyline { width, .. } => ("RG", format!(" {width} w"), "S"),
                _ => ("rg", String::new(), "f"),
            };
            content += &format!("/g{percent} gs {red:.3} {green:.3} {blue:.3} {colour}{width}\n");
            add(&mut content, &path);
            content += operator;
            content.push('\n');
        }
        let packed = packed(content.as_bytes()).expect("a vector takes any bytes");
        let states = opacities.iter().fold(String::new(), |all, percent| {
            let share = f64::from(*percent) / 100.0;
            format!("{all}/g{percent} << /ca {share} /CA {share} >> ")
        });
        let page = format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.3} {height:.3}] /Contents 4 0 R /Resources << /ExtGState << {states}>> >> >>"
        );
        file(&[
            b"<< /Type /Catalog /Pages 2 0 R >>".to_vec(),
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_vec(),
            page.into_bytes(),
            [
                format!("<< /Length {} /Filter /FlateDecode >>\nstream\n", packed.len()).as_bytes(),
                &packed,
                b"\nendstream",
            ]
            .concat(),
        ])
    }
}

fn packed(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
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

/// Adds the operators of a path.
fn add(text: &mut String, path: &Path) {
    let mut at = Point::zero();
    let mut write = |points: &[Point], operator: &str| {
        for point in points {
            *text += &format!("{} {} ", short(point.x), short(point.y));
        }
        *text += operator;
        text.push('\n');
    };
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(to) => write(&[to], "m"),
            PathSegment::LineTo(to) => write(&[to], "l"),
            PathSegment::QuadTo(bend, to) => {
                // the same curve of third degree
                let third = |end: Point| Point::from_xy(end.x + (bend.x - end.x) / 1.5, end.y + (bend.y - end.y) / 1.5);
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
}

/// A coordinate to a tenth of a unit.
fn short(value: f32) -> f32 {
    (10.0 * value).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::super::drawing::Ink;
    use super::super::format::FigureFormat;
    use super::*;
    use std::io::Read;

    #[test]
    fn a_page_has_the_paths_in_their_colours_at_its_size() {
        let red = Ink { colour: [255, 0, 0], opacity: 0.25, width: 0.0 };
        let mut drawing = Drawing::new(FigureFormat { sheet: 20.0, ..FigureFormat::SCREEN }, 10.0);
        drawing.polygon(&[(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)], red);
        drawing.line((0.0, 5.0), (20.0, 5.0), Ink::solid([0; 3], 2.0));
        let pdf = drawing.pdf();
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-1.4") && text.ends_with("%%EOF\n"));
        assert!(text.contains("/MediaBox [0 0 7.500 3.750]") && text.contains("/g25 << /ca 0.25"), "{text}");
        // the table names the byte at which each object begins
        let place = text.rfind("startxref\n").expect("a place");
        let number = text[place + 10..].lines().next().and_then(|line| line.parse::<usize>().ok()).expect("a number");
        assert!(pdf[number..].starts_with(b"xref\n0 5\n"));
        let start = pdf.windows(7).position(|bytes| bytes == b"stream\n").expect("a stream") + 7;
        let mut content = String::new();
        flate2::read::ZlibDecoder::new(&pdf[start..]).read_to_string(&mut content).expect("packed text");
        for part in ["0.093750 0 0 -0.093750 0 3.750 cm", "/g25 gs 1.000 0.000 0.000 rg\n0 0 m\n40 0 l\n0 40 l\nh\nf\n"]
        {
            assert!(content.contains(part), "{part} is not in {content}");
        }
        assert!(content.ends_with("/g100 gs 0.000 0.000 0.000 RG 8 w\n0 20 m\n80 20 l\nS\n"), "{content}");
    }
}
