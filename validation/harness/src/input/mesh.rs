//! Meshes of triangles from STL files, text or binary.
//!
//! A coordinate of single precision is read as the shortest decimal number that it stands for: 0.1 and not
//! 0.10000000149011612, so that a case file that repeats the mesh is readable and gives the same triangles.

use super::reading::read_bytes;
use std::io::Cursor;
use std::path::Path;

/// Three corners `[m]`, seen against the clock by who stands where the normal points to.
pub(crate) type Triangle = [[f64; 3]; 3];

/// Largest file of a mesh `[bytes]`.
const MOST_BYTES: u64 = 1 << 29;
/// Most triangles of a mesh: what a case file that repeats them may hold, even if no two share a corner.
pub(crate) const MOST_TRIANGLES: usize = 1_100_000;
/// Bytes of a binary file before its triangles, and of each of them.
const HEADER: usize = 84;
const RECORD: usize = 50;
/// Coordinates smaller than this are rounding: what fields in metres may not hold `[m]`.
const NOTHING: f64 = 1e-9;
/// Height of a triangle over its longest edge below which it has no side `[-]`.
const THINNEST: f64 = 1e-6;

/// A mesh as it was read.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mesh {
    pub(crate) triangles: Vec<Triangle>,
    /// Triangles without an area, which were left out.
    pub(crate) left_out: usize,
}

/// Reason why a file gives no mesh; each completes "FILE …".
#[derive(Debug, thiserror::Error)]
pub(crate) enum MeshError {
    /// It cannot be read.
    #[error("cannot be read ({0})")]
    Unreadable(std::io::Error),
    /// It is no STL, or damaged.
    #[error("is not a valid STL file ({0})")]
    Malformed(std::io::Error),
    /// Text that continues after its solid.
    #[error("contains several solids")]
    SeveralSolids,
    /// A coordinate that is no number.
    #[error("has a coordinate that is not finite in triangle {0}")]
    NotFinite(usize),
    /// Nothing with an area.
    #[error("has no triangle with an area ({0} without)")]
    Empty(usize),
    /// More than are taken.
    #[error("has more than {MOST_TRIANGLES} triangles")]
    TooMany,
}

impl MeshError {
    /// Instruction to the user for this fault.
    pub(crate) fn remedy(&self) -> &'static str {
        match self {
            Self::Unreadable(_) => "check the path, which is relative to this file, and its permissions",
            Self::Malformed(_) => "export the mesh again as STL",
            Self::SeveralSolids => "write each to a separate file, or all as one solid",
            Self::NotFinite(_) => "repair or export the mesh again",
            Self::Empty(_) => "export a surface with triangles",
            Self::TooMany => "simplify the mesh; triangles smaller than the particle spacing have no effect",
        }
    }
}

/// The triangles of a file.
pub(crate) fn read_mesh(path: &Path) -> Result<Mesh, MeshError> {
    mesh_of(read_bytes(path, MOST_BYTES).map_err(MeshError::Unreadable)?)
}

fn mesh_of(mut bytes: Vec<u8>) -> Result<Mesh, MeshError> {
    if bytes.starts_with(b"SOLID") {
        bytes.make_ascii_lowercase();
    }
    prepare(&mut bytes)?;
    let mut cursor = Cursor::new(bytes);
    let reader = stl_io::create_stl_reader(&mut cursor).map_err(MeshError::Malformed)?;
    let mut mesh = Mesh { triangles: Vec::new(), left_out: 0 };
    for (index, triangle) in reader.enumerate() {
        if index >= MOST_TRIANGLES {
            return Err(MeshError::TooMany);
        }
        let corners = triangle.map_err(MeshError::Malformed)?.vertices.map(|vertex| vertex.0.map(decimal));
        if !corners.iter().flatten().all(|coordinate| coordinate.is_finite()) {
            return Err(MeshError::NotFinite(index));
        }
        if has_area(&corners) {
            mesh.triangles.push(corners);
        } else {
            mesh.left_out += 1;
        }
    }
    if mesh.triangles.is_empty() { Err(MeshError::Empty(mesh.left_out)) } else { Ok(mesh) }
}

/// Makes a file one that the reader takes for what it is.
fn prepare(bytes: &mut Vec<u8>) -> Result<(), MeshError> {
    let announced = bytes.get(HEADER - 4..HEADER).and_then(|count| count.try_into().ok()).map_or(0, u32::from_le_bytes);
    let is_text = bytes.starts_with(b"solid") && bytes.len() != HEADER + RECORD * announced as usize;
    if !is_text {
        // some programs begin the head of a binary file like text
        if let Some(first) = bytes.first_mut() {
            *first = b' ';
        }
        return Ok(());
    }
    // a solid need not have a name
    if matches!(bytes.get(5), Some(b'\n' | b'\r')) {
        bytes.insert(5, b' ');
    }
    let ends = bytes.split(|&byte| byte == b'\n').filter(|line| line.trim_ascii().starts_with(b"endsolid"));
    if ends.count() > 1 { Err(MeshError::SeveralSolids) } else { Ok(()) }
}

/// The shortest decimal number that single precision tells from its neighbours; 0 where a program left rounding.
fn decimal(coordinate: f32) -> f64 {
    let number: f64 = coordinate.to_string().parse().unwrap_or(f64::NAN);
    if number.abs() < NOTHING { 0.0 } else { number }
}

fn has_area([a, b, c]: &Triangle) -> bool {
    let edge = |from: &[f64; 3], to: &[f64; 3]| nalgebra::Vector3::from(*to) - nalgebra::Vector3::from(*from);
    let (ab, ac, bc) = (edge(a, b), edge(a, c), edge(b, c));
    let longest = ab.norm_squared().max(ac.norm_squared()).max(bc.norm_squared());
    ab.cross(&ac).norm() > THINNEST * longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TEXT: &str = "solid ramp\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 0.1 0 0\n   vertex 0 0.2 0\n  \
                        endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   \
                        vertex 2 0 0\n  endloop\n endfacet\nendsolid ramp\n";

    fn binary() -> Vec<u8> {
        let triangle = |z: f32| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0, 0.0, 1.0]),
            vertices: [[0.0, 0.0, z], [0.1, 0.0, z], [0.0, 0.2, z]].map(stl_io::Vertex::new),
        };
        let mut bytes = Vec::new();
        stl_io::write_stl(&mut bytes, [triangle(0.0), triangle(0.3)].iter()).expect("written");
        bytes
    }

    fn refused(bytes: &[u8]) -> String {
        mesh_of(bytes.to_vec()).expect_err("refused").to_string()
    }

    #[test]
    fn text_and_binary_files_are_read_and_what_has_no_area_is_counted() {
        let first = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0]];
        let mesh = mesh_of(TEXT.into()).expect("a mesh");
        assert_eq!((mesh.triangles, mesh.left_out), (vec![first], 1));
        assert_eq!(mesh_of(TEXT.replace("solid ramp", "solid").into()).expect("without a name").left_out, 1);
        let mut bytes = binary();
        assert_eq!(mesh_of(bytes.clone()).expect("a mesh").triangles[0], first);
        let rounded = TEXT.replacen("vertex 0 0 0", "vertex -0 4.4e-17 -1e-12", 1);
        assert_eq!(mesh_of(rounded.into()).expect("a mesh").triangles[0], first);
        bytes[..5].copy_from_slice(b"solid");
        assert_eq!(mesh_of(bytes).expect("binary all the same").triangles.len(), 2);
    }

    #[test]
    fn defect_of_a_file_is_named() {
        assert_eq!(refused(&binary()[..150]), "is not a valid STL file (failed to fill whole buffer)");
        assert_eq!(refused(&TEXT.as_bytes()[..78]), "is not a valid STL file (EOF while expecting vertex)");
        for other in [&b" \n"[..], b"# Blender\nv 0 0 0\n", b"<!DOCTYPE html>", b"NCOLS 10\nNROWS 10\n"] {
            assert!(refused(other).starts_with("is not a valid STL file ("), "{}", refused(other));
        }
        assert_eq!(mesh_of(TEXT.to_uppercase().into()).expect("capitals").left_out, 1);
        assert_eq!(refused(b"solid nothing\nendsolid nothing\n"), "has no triangle with an area (0 without)");
        assert_eq!(refused(TEXT.repeat(2).as_bytes()), "contains several solids");
        let mut bytes = binary();
        bytes[HEADER + RECORD + 12..HEADER + RECORD + 16].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(refused(&bytes), "has a coordinate that is not finite in triangle 1");
        let mut bytes = vec![0; HEADER + RECORD * (MOST_TRIANGLES + 1)];
        bytes[HEADER - 4..HEADER].copy_from_slice(&(MOST_TRIANGLES as u32 + 1).to_le_bytes());
        assert_eq!(refused(&bytes), "has more than 1100000 triangles");
        let gone = read_mesh(Path::new("no/such.stl")).expect_err("no file").to_string();
        assert_eq!(gone, "cannot be read (No such file or directory (os error 2))");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn damaged_files_are_read_or_refused(
            text in any::<bool>(),
            changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
            length in any::<prop::sample::Index>(),
            cut in any::<bool>(),
        ) {
            let mut bytes = if text { TEXT.as_bytes().to_vec() } else { binary() };
            for (place, value) in changes {
                let place = place.index(bytes.len());
                bytes[place] = value;
            }
            if cut {
                bytes.truncate(length.index(bytes.len() + 1));
            }
            if let Ok(mesh) = mesh_of(bytes) {
                prop_assert!(!mesh.triangles.is_empty() && mesh.triangles.len() + mesh.left_out <= 2);
            }
        }
    }
}
