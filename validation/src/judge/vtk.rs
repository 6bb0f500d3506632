//! Particles from files of VTK: `.vtu`, `.vtp`, legacy `.vtk`, and the times of a `.pvd` collection.

use crate::input::FieldError;
use resvg::usvg::roxmltree::Document;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Once;
use vtkio::Vtk;
use vtkio::model::{Attribute, DataSet, IOBuffer, Piece};

/// Points with their arrays, each value by value; vectors are parted into `name:0`, `name:1`, `name:2`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Points {
    /// Arrays by name; the places are `Points:0`, `Points:1`, `Points:2`.
    pub(super) arrays: BTreeMap<String, Vec<f64>>,
}

/// Name of the places among the arrays.
pub(super) const PLACES: &str = "Points";

impl Points {
    /// Reads a file's points.
    ///
    /// # Errors
    /// A file that is none of VTK's, is damaged, or holds no points.
    pub(super) fn parse(bytes: &[u8], file: &Path) -> Result<Self, FieldError> {
        let damaged = |reason: &str| {
            let remedy = "write points with arrays at points, as ParaView reads them";
            FieldError::new("file", reason, "an unstructured grid or polygonal data of VTK", remedy).in_file(file)
        };
        let vtk = read(bytes, file).map_err(|reason| damaged(&reason))?;
        let mut points = Self::default();
        match vtk.data {
            DataSet::UnstructuredGrid { pieces, .. } => {
                for piece in pieces {
                    let Piece::Inline(piece) = piece else { return Err(damaged("in several files")) };
                    points.append(piece.points, piece.data.point).map_err(|reason| damaged(&reason))?;
                }
            }
            DataSet::PolyData { pieces, .. } => {
                for piece in pieces {
                    let Piece::Inline(piece) = piece else { return Err(damaged("in several files")) };
                    points.append(piece.points, piece.data.point).map_err(|reason| damaged(&reason))?;
                }
            }
            _ => return Err(damaged("a grid of another kind")),
        }
        let count = points.arrays.get(&format!("{PLACES}:0")).map_or(0, Vec::len);
        if count == 0 {
            return Err(damaged("without points"));
        }
        if let Some((name, values)) = points.arrays.iter().find(|(_, values)| values.len() != count) {
            return Err(damaged(&format!("of {count} points, but {} values of `{name}`", values.len())));
        }
        Ok(points)
    }

    fn append(&mut self, places: IOBuffer, attributes: Vec<Attribute>) -> Result<(), String> {
        self.part(PLACES, 3, places)?;
        for attribute in attributes {
            match attribute {
                Attribute::DataArray(array) => {
                    let components = array.num_comp();
                    self.part(&array.name, components, array.data)?;
                }
                Attribute::Field { data_array, .. } => {
                    for array in data_array {
                        self.part(&array.name, array.elem as usize, array.data)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Parts an array into its components.
    fn part(&mut self, name: &str, components: usize, data: IOBuffer) -> Result<(), String> {
        let values: Vec<f64> =
            data.cast_into().ok_or_else(|| format!("with an array `{name}` that is not of numbers"))?;
        let components = components.max(1);
        if !values.len().is_multiple_of(components) {
            return Err(format!("with {} values of `{name}`, which has {components} components", values.len()));
        }
        for component in 0..components {
            let name = if components == 1 { name.to_owned() } else { format!("{name}:{component}") };
            self.arrays.entry(name).or_default().extend(values.iter().skip(component).step_by(components));
        }
        Ok(())
    }
}

thread_local! {
    /// Whether a panic of this thread is expected and caught.
    static EXPECTED: Cell<bool> = const { Cell::new(false) };
}

/// The crate takes some damaged files for impossible and panics: that is caught here, and not printed.
fn read(bytes: &[u8], file: &Path) -> Result<Vtk, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let others = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            if !EXPECTED.get() {
                others(panic);
            }
        }));
    });
    let is_legacy = file.extension().is_some_and(|ending| ending == "vtk");
    EXPECTED.set(true);
    let read = std::panic::catch_unwind(|| if is_legacy { Vtk::parse_legacy_be(bytes) } else { Vtk::parse_xml(bytes) });
    EXPECTED.set(false);
    match read {
        Ok(Ok(vtk)) => Ok(vtk),
        Ok(Err(error)) => Err(format!("damaged ({error})")),
        Err(_) => Err("damaged".to_owned()),
    }
}

/// Times `[s]` and files of a collection, in its order.
///
/// # Errors
/// A file that is no collection of VTK's, or has a data set without a time or a file.
pub(super) fn collection(text: &str, file: &Path) -> Result<Vec<(f64, PathBuf)>, FieldError> {
    let wrong =
        |value: &str, rule: &str| FieldError::new("file", value, rule, "see ParaView's PVD format").in_file(file);
    let document = Document::parse(text).map_err(|_| wrong("damaged", "a collection of VTK"))?;
    let folder = file.parent().unwrap_or_else(|| Path::new(""));
    let sets: Vec<(f64, PathBuf)> = document
        .descendants()
        .filter(|node| node.has_tag_name("DataSet"))
        .map(|node| {
            let time = node.attribute("timestep").and_then(|time| time.parse().ok());
            let time = time.ok_or_else(|| wrong("with a data set without `timestep`", "a time each"))?;
            let name = node.attribute("file").ok_or_else(|| wrong("with a data set without `file`", "a file each"))?;
            Ok((time, folder.join(name)))
        })
        .collect::<Result<_, FieldError>>()?;
    if sets.is_empty() { Err(wrong("without data sets", "a collection of VTK")) } else { Ok(sets) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEGACY: &str = "# vtk DataFile Version 3.0\nparticles\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0 1 0\n2 3 0\n\
        CELLS 2 4\n1 0\n1 1\nCELL_TYPES 2\n1\n1\nPOINT_DATA 2\nSCALARS mass float 1\nLOOKUP_TABLE default\n0.5 0.25\n\
        VECTORS velocity float\n1 0 0\n0 1 0\n";

    #[test]
    fn a_legacy_file_gives_its_arrays() {
        let points = Points::parse(LEGACY.as_bytes(), Path::new("a.vtk")).expect("a grid");
        assert_eq!(points.arrays["Points:1"], [1.0, 3.0]);
        assert_eq!(points.arrays["mass"], [0.5, 0.25]);
        assert_eq!(points.arrays["velocity:1"], [0.0, 1.0]);
    }

    #[test]
    fn what_is_no_file_of_vtk_is_refused_without_a_panic() {
        for text in [
            "",
            "x,y\n1,2\n",
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece/></UnstructuredGrid></VTKFile>",
        ] {
            for name in ["a.vtu", "a.vtk"] {
                let message = Points::parse(text.as_bytes(), Path::new(name)).expect_err("no grid").to_string();
                assert!(message.starts_with(&format!("{name}: `file` is ")), "{message}");
            }
        }
    }

    #[test]
    fn a_collection_names_files_beside_itself() {
        let text = "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0.5\" file=\"a/1.vtu\"/></Collection></VTKFile>";
        let sets = collection(text, Path::new("out/all.pvd")).expect("a collection");
        assert_eq!(sets, [(0.5, PathBuf::from("out/a/1.vtu"))]);
        assert!(collection("<VTKFile/>", Path::new("all.pvd")).is_err());
        assert!(collection("no", Path::new("all.pvd")).is_err());
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig { cases: 300, ..Default::default() })]

        #[test]
        fn a_file_with_some_bytes_changed_is_read_or_refused(
            changes in proptest::collection::vec((0..LEGACY.len(), proptest::num::u8::ANY), 1..6),
            is_legacy in proptest::bool::ANY,
        ) {
            let mut bytes = LEGACY.as_bytes().to_vec();
            for (place, byte) in changes {
                bytes[place] = byte;
            }
            let name = if is_legacy { "a.vtk" } else { "a.vtu" };
            if let Ok(points) = Points::parse(&bytes, Path::new(name)) {
                let count = points.arrays["Points:0"].len();
                proptest::prop_assert!(points.arrays.values().all(|values| values.len() == count));
            }
        }
    }
}
