//! Meshes that a case file names: their triangles are read with the file and are parameters like any others, so that a
//! run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use crate::input::{FieldError, MOST_TRIANGLES, Triangle, number_in, packed, read_mesh};
use crate::number::four_digits;
use crate::output::caution;
use bagnold_solver::parameter::LARGEST_LENGTH;
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::path::Path;
use toml::{Table, Value};

/// Most triangles that a case file lists by their numbers.
const MOST_LISTED: usize = 10_000;

/// Adds the triangles of the meshes that `walls` name by a path from the case file on. A wall that has triangles keeps
/// them: the name then says where they came from.
pub(in crate::case) fn read_beside(fields: &mut Table, path: &Path) -> Result<(), ParameterError> {
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut count = 0;
    let walls = fields.get_mut("walls").and_then(Value::as_array_mut);
    for (index, wall) in walls.into_iter().flatten().enumerate() {
        let Some(wall) =
            wall.as_table_mut().filter(|wall| !wall.contains_key("triangles") && !wall.contains_key("packed"))
        else {
            continue;
        };
        let Some(name) = wall.get("mesh").and_then(Value::as_str).filter(|name| !name.is_empty()) else { continue };
        let field = format!("walls[{index}].mesh");
        let refused = |defect: &str, remedy: &str| {
            ParameterError::field(&field, format!("\"{name}\" {defect}"), "", remedy).in_file(path)
        };
        let mesh = read_mesh(&beside.join(name)).map_err(|error| {
            ParameterError::field(&field, format!("\"{name}\" {error}"), "", error.remedy()).in_file(path)
        })?;
        count += mesh.triangles.len();
        if count > MOST_TRIANGLES {
            let defect = format!("has, with the meshes before it, more than {MOST_TRIANGLES} triangles");
            return Err(refused(&defect, "simplify the meshes"));
        }
        if mesh.left_out > 0 {
            caution(&format!("{name}: {} triangles without an area are left out", mesh.left_out));
        }
        let placed = Placement::of(wall).map_err(|error| error.within(&format!("walls[{index}]")).in_file(path))?;
        let triangles: Vec<Triangle> =
            mesh.triangles.iter().map(|corners| corners.map(|at| placed.place(at))).collect();
        let farthest = triangles.iter().flatten().flatten().fold(0.0_f64, |most, at| most.max(at.abs()));
        if farthest > LARGEST_LENGTH {
            let defect = format!("reaches {} m from the origin, beyond {LARGEST_LENGTH:e} m", four_digits(farthest));
            return Err(refused(&defect, "subtract a common offset from all coordinates in the file"));
        }
        let (key, value) = match triangles.len() {
            0..=MOST_LISTED => ("triangles", Value::try_from(&triangles)),
            _ => ("packed", Ok(Value::String(packed(&triangles)))),
        };
        let value = value.map_err(|_| {
            refused("cannot be repeated in a case file", "export it again from the program that made it")
        })?;
        wall.insert(key.to_owned(), value);
    }
    Ok(())
}

/// Units of the coordinates of a mesh, and their length `[m]`.
const UNITS: [(&str, f64); 4] = [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("in", 0.0254)];

/// Size, turn and place of a mesh in the scene.
struct Placement {
    scale: f64,
    rotation: Rotation3<f64>,
    shift: Vector3<f64>,
}

impl Placement {
    /// Placement that a wall gives. A number of another type is refused with the other fields.
    fn of(wall: &Table) -> Result<Self, FieldError> {
        let unit = wall.get("unit").and_then(Value::as_str).unwrap_or("m");
        let length = UNITS.iter().find(|(name, _)| *name == unit).map(|(_, length)| *length).ok_or_else(|| {
            let rule = "one of \"m\", \"cm\", \"mm\" or \"in\"";
            FieldError::new("unit", format!("\"{unit}\""), rule, "use `scale` for other units")
        })?;
        let vector = |key: &str| {
            let parts: Vec<f64> =
                wall.get(key).and_then(Value::as_array).into_iter().flatten().filter_map(number_in).collect();
            <[f64; 3]>::try_from(parts).map_or_else(|_| Vector3::zeros(), Vector3::from)
        };
        let [x, y, z] = <[f64; 3]>::from(vector("rotate")).map(f64::to_radians);
        let about = |axis, angle| Rotation3::from_matrix_unchecked(turn(axis, angle));
        Ok(Self {
            scale: length * wall.get("scale").and_then(number_in).unwrap_or(1.0),
            rotation: about(2, z) * about(1, y) * about(0, x),
            shift: vector("move"),
        })
    }

    /// Place of a corner of the mesh in the scene `[m]`; one that is neither moved nor turned keeps its digits.
    fn place(&self, corner: [f64; 3]) -> [f64; 3] {
        let turned = self.rotation * Vector3::from(corner.map(|coordinate| decimal(coordinate * self.scale)));
        (turned + self.shift).into()
    }
}

/// The shortest decimal number within twelve digits: 25 mm are 0.025 m.
fn decimal(length: f64) -> f64 {
    format!("{length:.11e}").parse().unwrap_or(length)
}

/// Matrix of a turn about an axis, without the mathematics of the platform.
fn turn(axis: usize, angle: f64) -> Matrix3<f64> {
    let (sine, cosine) = libm::sincos(angle);
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = Matrix3::identity();
    (matrix[(next, next)], matrix[(last, last)]) = (cosine, cosine);
    (matrix[(last, next)], matrix[(next, last)]) = (sine, -sine);
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, path: &Path) -> Result<Table, String> {
        let mut fields: Table = toml::from_str(text).expect("TOML");
        read_beside(&mut fields, path).map_err(|error| error.to_string())?;
        Ok(fields)
    }

    #[test]
    fn a_large_mesh_is_packed() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let triangle = |index: usize| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0, 0.0, 1.0]),
            vertices: [[index as f32, 0.0, 0.0], [index as f32 + 1.0, 0.0, 0.0], [index as f32 + 0.5, 1.0, 0.0]]
                .map(stl_io::Vertex::new),
        };
        let triangles: Vec<_> = (0..=MOST_LISTED).map(triangle).collect();
        let mut file = std::fs::File::create(folder.path().join("a.stl")).expect("writable");
        stl_io::write_stl(&mut file, triangles.iter()).expect("written");
        let fields = read("[[walls]]\nmesh = \"a.stl\"", &folder.path().join("case.toml")).expect("read");
        assert!(fields["walls"][0].get("triangles").is_none());
        let mesh: crate::input::PackedTriangles = fields["walls"][0]["packed"].clone().try_into().expect("triangles");
        assert_eq!(mesh.triangles()[MOST_LISTED], [[10_000.0, 0.0, 0.0], [10_001.0, 0.0, 0.0], [10_000.5, 1.0, 0.0]]);
        assert_eq!(mesh.bounds(), Some([[0.0; 3], [10_001.0, 1.0, 0.0]]));
        assert!((mesh.area() - 0.5 * triangles.len() as f64).abs() < 1e-6);
    }

    #[test]
    fn triangles_come_with_the_file_that_names_them() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let solid = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
        std::fs::write(folder.path().join("a.stl"), solid).expect("writable");
        let path = folder.path().join("case.toml");
        let fields = read("[[walls]]\nname = \"a\"\nmesh = \"a.stl\"\n[[walls]]\nname = \"b\"", &path).expect("read");
        let expected: Table = toml::from_str(
            "[[walls]]\nname = \"a\"\nmesh = \"a.stl\"\ntriangles = [[[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 1.0, 0.0]]]\n[[walls]]\nname = \"b\"",
        )
        .expect("TOML");
        assert_eq!(fields, expected);
        let turned = "[[walls]]\nname = \"a\"\nmesh = \"a.stl\"\nunit = \"mm\"\nscale = 10\nrotate = [0, 0, 90]\nmove = [0.0, 0.0, 0.5]";
        let wall = &read(turned, &path).expect("read")["walls"][0]["triangles"][0];
        let at = |corner: usize, axis: usize| wall[corner][axis].as_float().expect("a number");
        assert!(
            (at(1, 0).abs(), at(1, 1), at(1, 2)) < (1e-15, 0.001 + 1e-15, 0.5 + 1e-15)
                && (at(2, 0) + 0.01).abs() < 1e-15
        );
        let unit = read("[[walls]]\nmesh = \"a.stl\"\nunit = \"ft\"", &path).expect_err("no such unit");
        assert!(unit.contains("`walls[0].unit` is \"ft\", but must be one of"), "{unit}");
        let map = read("[[walls]]\nmesh = \"a.stl\"\nscale = 500000", &path).expect_err("a map");
        assert!(
            map.contains("\"a.stl\" reaches 500000 m from the origin, beyond 1e5 m; subtract a common offset"),
            "{map}"
        );
        let own = "[[walls]]\nmesh = \"gone.stl\"\ntriangles = []";
        assert!(read(own, &path).is_ok(), "a wall that has triangles needs no file");
        assert_eq!(
            read("[[walls]]\nmesh = \"gone.stl\"", Path::new("mine/case.toml")).expect_err("no file"),
            "mine/case.toml: `walls[0].mesh`: \"gone.stl\" cannot be \
             read (No such file or directory (os error 2)); check the path, which is relative to this file, and its permissions"
        );
    }
}
