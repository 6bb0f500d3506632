//! Files that VTK and meshio wrote (`tests/foreign/vtk/`), whose values are exact in every type.

use super::PointArrays;
use std::path::{Path, PathBuf};

pub(super) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/foreign/vtk")
}

/// All files that can be read, in the order of their names.
pub(super) fn readable() -> Vec<(PathBuf, Vec<u8>)> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder())
        .expect("the folder of files")
        .map(|entry| entry.expect("an entry").path())
        .filter(|file| {
            file.extension().is_some_and(|ending| ["vtu", "vtp", "vtk"].iter().any(|known| ending == *known))
        })
        .filter(|file| !file.to_string_lossy().contains("-lz"))
        .collect();
    files.sort();
    files.into_iter().map(|file| (file.clone(), std::fs::read(&file).expect("a file"))).collect()
}

/// Array value that `write.py` writes for a point.
fn expected(name: &str, index: usize) -> f64 {
    let number = index as f64;
    match name {
        "Points:0" => 0.5 * number,
        "Points:1" => (index % 7) as f64 - 3.0,
        "Points:2" => 0.0,
        "i1" | "i2" | "i4" | "i8" | "f4" | "f8" => number - 3.0,
        "u1" | "u2" | "u4" | "u8" => number + 3.0,
        "velocity:0" | "velocity [m/s]:0" => 0.25 * number,
        "velocity:1" | "velocity [m/s]:1" => -number,
        "velocity:2" | "velocity [m/s]:2" => (index % 3) as f64,
        _ => match name.rsplit_once(':').map(|(name, component)| (name, component.parse::<f64>())) {
            Some(("stress", Ok(component))) => 9.0 * number + component,
            Some(("normal", Ok(component))) => (3.0 * number + component) / 4.0,
            _ => panic!("an array `{name}` that nobody wrote"),
        },
    }
}

#[test]
fn files_of_vtk_and_meshio_have_the_values_that_were_written() {
    let files = readable();
    assert_eq!(files.len(), 31, "{files:?}");
    for (file, bytes) in files {
        let name = file.file_name().and_then(|name| name.to_str()).expect("a name").to_owned();
        let points = PointArrays::parse(&bytes, &file).unwrap_or_else(|error| panic!("{error}"));
        let is_large = name.contains("zlib") || name.contains("blocks");
        let count = if is_large { 36 } else { 7 };
        let arrays = match (is_large, name.starts_with("vtk") && name.ends_with(".vtk")) {
            (true, _) => 3 + 2 + 3,
            (false, false) => 3 + 10 + 3,
            (false, true) => 3 + 10 + 3 + 9 + 3,
        };
        assert_eq!(points.arrays.len(), arrays, "{name}: {:?}", points.arrays.keys());
        for (array, values) in &points.arrays {
            let written: Vec<f64> = (0..count).map(|index| expected(array, index)).collect();
            assert_eq!(values, &written, "{array} of {name}");
        }
    }
}

#[test]
fn other_compressors_are_refused_by_their_name_with_a_remedy() {
    for (name, compressor) in [("vtk-lz4.vtu", "vtkLZ4DataCompressor"), ("meshio-lzma.vtu", "vtkLZMADataCompressor")] {
        let bytes = std::fs::read(folder().join(name)).expect("a file");
        let message = PointArrays::parse(&bytes, Path::new(name)).expect_err("compressed").to_string();
        assert!(message.contains(&format!("compressed by {compressor}")), "{message}");
        assert!(message.contains("SetCompressorTypeToZLib()"), "{message}");
    }
}

/// A second piece of the same file appends its points.
#[test]
fn pieces_follow_each_other() {
    let file = folder().join("vtk-ascii.vtu");
    let text = std::fs::read_to_string(&file).expect("text");
    let (from, to) = (text.find("<Piece").expect("a piece"), text.find("</UnstructuredGrid>").expect("an end"));
    let twice = format!("{}{}{}", &text[..to], &text[from..to], &text[to..]);
    let points = PointArrays::parse(twice.as_bytes(), &file).expect("two pieces");
    let written: Vec<f64> = (0..7).chain(0..7).map(|index| expected("velocity [m/s]:1", index)).collect();
    assert_eq!(points.arrays["velocity [m/s]:1"], written);
}

/// A mark of the byte order before the document, as editors leave it, moves no offset of appended data.
#[test]
fn a_byte_order_mark_before_the_document_changes_nothing() {
    for name in ["vtk-ascii.vtu", "vtk-raw-64.vtu", "vtk-base64-zlib-32.vtu"] {
        let bytes = std::fs::read(folder().join(name)).expect("a file");
        let plain = PointArrays::parse(&bytes, Path::new(name)).expect("readable");
        let marked = [&b"\xef\xbb\xbf"[..], &bytes].concat();
        assert_eq!(PointArrays::parse(&marked, Path::new(name)).expect("readable"), plain, "{name}");
    }
}

#[test]
fn unsupported_vtk_is_refused_by_its_format() {
    let parallel = "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid/></VTKFile>";
    let blocks = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet/></VTKFile>";
    for (bytes, name, said) in [
        (&b"\x89HDF\r\n\x1a\n\0\0"[..], "a.vtkhdf", " of VTK: in HDF5"),
        (&b"\x89HDF\r\n\x1a\n\0\0"[..], "a.vtu", " of VTK: in HDF5"),
        (parallel.as_bytes(), "a.pvtu", " of VTK: in several files"),
        (blocks.as_bytes(), "a.vtm", " of VTK: a collection of grids, vtkMultiBlockDataSet"),
    ] {
        let message = PointArrays::parse(bytes, Path::new(name)).expect_err("refused").to_string();
        assert!(message.contains(said), "{message}");
    }
}
