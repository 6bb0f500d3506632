//! Particle snapshots that ParaView opens: a VTU file per frame and a PVD file per run with the times.

use crate::metric::Variant;
use crate::observation::Frame;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// VTK's number of a cell that is one point.
const VERTEX: u8 = 1;

/// Writes `<name>.pvd` and the folder `<name>` with its frames.
///
/// # Errors
/// Files that cannot be written.
pub fn write(folder: &Path, name: &str, frames: &[Frame]) -> io::Result<()> {
    std::fs::create_dir_all(folder.join(name))?;
    let mut written = Vec::new();
    for (number, frame) in frames.iter().enumerate() {
        let file = format!("{name}/frame_{number:04}.vtu");
        std::fs::write(folder.join(&file), vtu(frame))?;
        written.push((frame.time, file));
    }
    std::fs::write(folder.join(format!("{name}.pvd")), collection(&written))
}

/// The file that joins states, each with its time and its path.
pub(super) fn collection(states: &[(f64, String)]) -> String {
    let entry =
        |(time, file): &(f64, String)| format!("    <DataSet timestep=\"{time}\" file=\"{}\"/>\n", escape(file));
    let entries: String = states.iter().map(entry).collect();
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n{entries}  </Collection>\n</VTKFile>\n"
    )
}

/// A run's variant as a file name: `slope_angle=24,start=rest` is one, but empty is not.
pub(super) fn file_name(variant: &Variant) -> String {
    let safe = |letter: char| if letter.is_alphanumeric() || "=,.-+_".contains(letter) { letter } else { '_' };
    if variant.is_empty() { "run".to_owned() } else { variant.to_string().chars().map(safe).collect() }
}

pub(super) fn vtu(frame: &Frame) -> String {
    let count = frame.position.len();
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n",
    );
    array(&mut text, "Float64", "TimeValue", "NumberOfTuples=\"1\"", frame.time.to_le_bytes());
    text.push_str("</FieldData>\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\">\n<Points>");
    vectors(&mut text, "Points", &frame.position);
    text.push_str("</Points>\n<Cells>\n");
    array(&mut text, "Int64", "connectivity", "", (0..count as i64).flat_map(i64::to_le_bytes));
    array(&mut text, "Int64", "offsets", "", (1..=count as i64).flat_map(i64::to_le_bytes));
    array(&mut text, "UInt8", "types", "", std::iter::repeat_n(VERTEX, count));
    text.push_str("</Cells>\n<PointData>\n");
    for (name, unit, values) in &frame.scalars {
        array(&mut text, "Float64", &labelled(name, unit), "", values.iter().flat_map(|value| value.to_le_bytes()));
    }
    for (name, unit, values) in &frame.vectors {
        vectors(&mut text, &labelled(name, unit), values);
    }
    text.push_str("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn vectors(text: &mut String, name: &str, values: &[[f64; 3]]) {
    let bytes = values.iter().flatten().flat_map(|value| value.to_le_bytes());
    array(text, "Float64", name, "NumberOfComponents=\"3\"", bytes);
}

/// Binary, because VTK's text reader stops at the first NaN.
fn array(text: &mut String, kind: &str, name: &str, attributes: &str, bytes: impl IntoIterator<Item = u8>) {
    let mut data = vec![0; 8];
    data.extend(bytes);
    let length = data.len() as u64 - 8;
    data[..8].copy_from_slice(&length.to_le_bytes());
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{}\" {attributes} format=\"binary\">{}</DataArray>",
        escape(name),
        STANDARD.encode(&data)
    );
}

fn labelled(name: &str, unit: &str) -> String {
    format!("{name} [{unit}]")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use roxmltree::Document;

    fn frame() -> Frame {
        Frame {
            time: 0.5,
            position: vec![[0.0, 1.0, 0.0], [2.0, 3.0, 0.0]],
            scalars: vec![("pressure".to_owned(), "Pa".to_owned(), vec![1.0, f64::NAN])],
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), vec![[1.0, 0.0, 0.0]; 2])],
        }
    }

    #[test]
    fn a_frame_is_well_formed_and_complete() {
        let text = vtu(&frame());
        let document = Document::parse(&text).expect("well-formed XML");
        let arrays: Vec<(String, usize)> = document
            .descendants()
            .filter(|node| node.has_tag_name("DataArray"))
            .map(|node| {
                let digits = node.text().unwrap_or_default();
                let padding = digits.matches('=').count();
                (node.attribute("Name").unwrap_or_default().to_owned(), digits.len() / 4 * 3 - padding - 8)
            })
            .collect();
        let expected = [
            ("TimeValue", 8),
            ("Points", 48),
            ("connectivity", 16),
            ("offsets", 16),
            ("types", 2),
            ("pressure [Pa]", 16),
            ("velocity [m/s]", 48),
        ];
        assert_eq!(arrays, expected.map(|(name, bytes)| (name.to_owned(), bytes)));
        let piece = document.descendants().find(|node| node.has_tag_name("Piece")).expect("a piece");
        assert_eq!((piece.attribute("NumberOfPoints"), piece.attribute("NumberOfCells")), (Some("2"), Some("2")));
    }

    #[test]
    fn the_collection_names_every_frame_with_its_time() {
        let folder = tempfile::tempdir().expect("temporary folder");
        write(folder.path(), &file_name(&Variant::of("slope_angle", 24).and("start", "a/b")), &[frame(), frame()])
            .expect("writable");
        let text = std::fs::read_to_string(folder.path().join("slope_angle=24,start=a_b.pvd")).expect("written");
        let document = Document::parse(&text).expect("well-formed XML");
        let sets: Vec<_> = document.descendants().filter(|node| node.has_tag_name("DataSet")).collect();
        assert_eq!(sets.len(), 2);
        for set in sets {
            assert_eq!(set.attribute("timestep"), Some("0.5"));
            assert!(folder.path().join(set.attribute("file").unwrap_or_default()).is_file());
        }
        assert_eq!(file_name(&Variant::default()), "run");
    }
}
