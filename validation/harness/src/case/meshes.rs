//! Meshes that a case file names: their triangles are read with the file and are parameters like any others, so that a
//! run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use crate::input::{MOST_TRIANGLES, read_mesh};
use std::path::Path;
use toml::{Table, Value};

/// Adds the triangles of the meshes that `walls` name by a path from the case file on. A wall that has triangles keeps
/// them: the name then says where they came from.
pub(super) fn read_beside(fields: &mut Table, path: &Path) -> Result<(), ParameterError> {
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut count = 0;
    let walls = fields.get_mut("walls").and_then(Value::as_array_mut);
    for (index, wall) in walls.into_iter().flatten().enumerate() {
        let Some(wall) = wall.as_table_mut().filter(|wall| !wall.contains_key("triangles")) else { continue };
        let Some(name) = wall.get("mesh").and_then(Value::as_str).filter(|name| !name.is_empty()) else { continue };
        let field = format!("walls[{index}].mesh");
        let refused =
            |rule: &str, remedy: &str| ParameterError::field(&field, format!("\"{name}\""), rule, remedy).in_file(path);
        let mesh = read_mesh(&beside.join(name)).map_err(|error| {
            ParameterError::field(&field, format!("\"{name}\" {error}"), "", error.remedy()).in_file(path)
        })?;
        count += mesh.triangles.len();
        if count > MOST_TRIANGLES {
            let rule = format!("at most {MOST_TRIANGLES} triangles together with the meshes before it");
            return Err(refused(&rule, "simplify the meshes"));
        }
        if mesh.left_out > 0 {
            tracing::warn!("{name}: {} triangles without an area are left out", mesh.left_out);
        }
        let triangles = Value::try_from(&mesh.triangles).map_err(|_| {
            refused("a mesh that a case file can repeat", "write it anew from the program that made it")
        })?;
        wall.insert("triangles".to_owned(), triangles);
    }
    Ok(())
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
        let own = "[[walls]]\nmesh = \"gone.stl\"\ntriangles = []";
        assert!(read(own, &path).is_ok(), "a wall that has triangles needs no file");
        assert_eq!(
            read("[[walls]]\nmesh = \"gone.stl\"", Path::new("mine/case.toml")).expect_err("no file"),
            "mine/case.toml: `walls[0].mesh`: \"gone.stl\" cannot be \
             read (No such file or directory (os error 2)); check the path, which begins at this file, and its permissions"
        );
    }
}
