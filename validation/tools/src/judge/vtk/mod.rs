//! Particles from files of VTK: `.vtu`, `.vtp`, legacy `.vtk`, and the times of a `.pvd` collection.
//!
//! - `nesting` parses XML that is nested no deeper than a parser's stack allows;
//! - `xml` finds pieces and arrays, `stored` the bytes of an array in base 64, appended or compressed;
//! - `array` makes numbers of text or bytes;
//! - `legacy` reads the format of keywords;
//! - `collection` the files of a collection.

mod array;
mod collection;
mod legacy;
mod nesting;
mod stored;
mod xml;

use crate::input::FieldError;
use std::collections::BTreeMap;
use std::path::Path;

pub(super) use collection::{PARALLEL, collection, pieces};

/// Points with their arrays, each value by value; vectors are parted into `name:0`, `name:1`, `name:2`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PointArrays {
    /// Arrays by name; the places are `Points:0`, `Points:1`, `Points:2`.
    pub(super) arrays: BTreeMap<String, Vec<f64>>,
}

/// Name of the places among the arrays.
pub(super) const PLACES: &str = "Points";

/// First bytes of an HDF5 file.
const HDF5: &[u8] = b"\x89HDF";

/// Endings of files that are read as VTK's, or refused as such: grids in several files and in HDF5 are no tables.
pub(super) const ENDINGS: [&str; 8] = ["vtu", "vtp", "vtk", "pvtu", "pvtp", "vtm", "vtpd", "vtkhdf"];

/// Reason for the rejection of a file; completes "`file` is …".
#[derive(Debug, Clone, PartialEq)]
struct Refusal {
    value: String,
    rule: &'static str,
    remedy: &'static str,
}

impl From<String> for Refusal {
    fn from(value: String) -> Self {
        let remedy = "write points with arrays at points, as ParaView reads them";
        Self { value, rule: "an unstructured grid or polygonal data of VTK", remedy }
    }
}

impl From<&str> for Refusal {
    fn from(value: &str) -> Self {
        value.to_owned().into()
    }
}

impl PointArrays {
    /// Reads a file's points.
    ///
    /// # Errors
    /// A file that is none of VTK's, is damaged, or holds no points.
    pub(super) fn parse(bytes: &[u8], file: &Path) -> Result<Self, FieldError> {
        let is_legacy = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("vtk"));
        let read = if bytes.starts_with(HDF5) {
            let remedy = "write it as .vtu or .vtp, in ParaView by Save Data";
            let rule = "an unstructured grid or polygonal data of VTK";
            Err(Refusal { value: "in HDF5".to_owned(), rule, remedy })
        } else if is_legacy {
            legacy::read(bytes)
        } else {
            xml::read(bytes)
        };
        read.and_then(Self::checked).map_err(|refusal| {
            let Refusal { value, rule, remedy } = refusal;
            FieldError::new("file", value, rule, remedy).in_file(file)
        })
    }

    fn checked(self) -> Result<Self, Refusal> {
        let count = self.arrays.get(&format!("{PLACES}:0")).map_or(0, Vec::len);
        if count == 0 {
            return Err("without points".into());
        }
        match self.arrays.iter().find(|(_, values)| values.len() != count) {
            Some((name, values)) => Err(format!("of {count} points, but {} values of `{name}`", values.len()).into()),
            None => Ok(self),
        }
    }

    /// Parts an array into its components.
    fn part(&mut self, name: &str, components: usize, values: &[f64]) {
        for component in 0..components {
            let name = if components == 1 { name.to_owned() } else { format!("{name}:{component}") };
            self.arrays.entry(name).or_default().extend(values.iter().skip(component).step_by(components));
        }
    }
}

#[cfg(test)]
mod foreign_tests;
#[cfg(test)]
mod tests;
