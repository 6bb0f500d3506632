//! Particles from files of VTK: `.vtu`, `.vtp`, legacy `.vtk`, and the times of a `.pvd` collection.

use crate::input::FieldError;
use roxmltree::Document;
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
        if values.is_empty() {
            return Err(format!("without a value of `{name}`"));
        }
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
    if let Some(count) = impossible_count(bytes).filter(|_| is_legacy) {
        return Err(format!("announcing {count} values in {} bytes", bytes.len()));
    }
    EXPECTED.set(true);
    let read = std::panic::catch_unwind(|| if is_legacy { Vtk::parse_legacy_be(bytes) } else { Vtk::parse_xml(bytes) });
    EXPECTED.set(false);
    match read {
        Ok(Ok(vtk)) => Ok(vtk),
        Ok(Err(error)) => Err(format!("damaged ({error})")),
        Err(_) => Err("damaged".to_owned()),
    }
}

/// Words of the legacy format that are followed by counts.
const COUNTED: [&[u8]; 12] = [
    b"POINTS",
    b"CELLS",
    b"CELL_TYPES",
    b"POINT_DATA",
    b"CELL_DATA",
    b"VERTICES",
    b"LINES",
    b"POLYGONS",
    b"TRIANGLE_STRIPS",
    b"FIELD",
    b"SCALARS",
    b"METADATA",
];

/// Types of values, which in the legacy format stand behind the counts of an array.
const TYPES: [&[u8]; 13] = [
    b"bit",
    b"unsigned_char",
    b"char",
    b"unsigned_short",
    b"short",
    b"unsigned_int",
    b"int",
    b"unsigned_long",
    b"long",
    b"float",
    b"double",
    b"vtkidtype",
    b"vtktypeint64",
];

/// A count of a legacy file's headings beyond its bytes, of which every value takes one at least: memory is asked for by
/// these counts before a value is read.
fn impossible_count(bytes: &[u8]) -> Option<u64> {
    let words: Vec<&[u8]> = bytes.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
    let is_any = |word: &[u8], list: &[&[u8]]| list.iter().any(|other| word.eq_ignore_ascii_case(other));
    let number = |word: &&[u8]| -> Option<u64> {
        let text = std::str::from_utf8(word).ok()?;
        // a number of more digits is no smaller
        text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().unwrap_or(u64::MAX))
    };
    words.iter().enumerate().find_map(|(place, word)| {
        let near = if is_any(word, &COUNTED) {
            place + 1..(place + 4).min(words.len())
        } else if is_any(word, &TYPES) {
            place.saturating_sub(2)..(place + 2).min(words.len())
        } else {
            return None;
        };
        words[near].iter().filter_map(number).find(|count| *count > bytes.len() as u64)
    })
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
mod tests;
