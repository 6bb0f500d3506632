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

/// Arrays by name, value by value; vectors are parted into `name:0`, `name:1`, `name:2`.
pub(super) type NamedArrays = BTreeMap<String, Vec<f64>>;

/// Points and cells with their arrays.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PointArrays {
    /// Arrays at points; the places are `Points:0`, `Points:1`, `Points:2`.
    pub(super) arrays: NamedArrays,
    /// Arrays at cells; the places are the means of the points of each cell. Empty for a file without data at cells.
    pub(super) cells: NamedArrays,
}

/// Name of the places among the arrays.
pub(super) const PLACES: &str = "Points";

/// First bytes of an HDF5 file.
const HDF5: &[u8] = b"\x89HDF";

/// Endings of files that are read as VTK's, or refused as such: grids in several files and in HDF5 are no tables.
pub(super) const ENDINGS: [&str; 8] = ["vtu", "vtp", "vtk", "pvtu", "pvtp", "vtm", "vtpd", "vtkhdf"];

/// Reason for the rejection of a file; completes "`file` is …".
#[derive(Debug, Clone, PartialEq)]
struct Refusal(FieldError);

/// Rule for a file without a fault of its own.
const GRID: &str = "an unstructured grid or polygonal data of VTK";

impl From<String> for Refusal {
    fn from(value: String) -> Self {
        let remedy = "write points with arrays at points or at cells, as ParaView reads them";
        Self(FieldError::finding("file", format!("not {GRID}: {value}"), remedy))
    }
}

impl From<&str> for Refusal {
    fn from(value: &str) -> Self {
        value.to_owned().into()
    }
}

impl PointArrays {
    /// Reads the points of a file.
    ///
    /// # Errors
    /// A file that is none of VTK's, is damaged, or holds no points.
    pub(super) fn parse(bytes: &[u8], file: &Path) -> Result<Self, FieldError> {
        let is_legacy = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("vtk"));
        let read = if bytes.starts_with(HDF5) {
            let remedy = "write it as .vtu or .vtp, in ParaView by Save Data";
            Err(Refusal(FieldError::finding("file", format!("not {GRID}: in HDF5"), remedy)))
        } else if is_legacy {
            legacy::read(bytes)
        } else {
            xml::read(bytes)
        };
        read.and_then(Self::checked).map_err(|Refusal(error)| error.in_file(file))
    }

    /// Arrays at points or at cells.
    fn at(&mut self, cells: bool) -> &mut NamedArrays {
        if cells { &mut self.cells } else { &mut self.arrays }
    }

    fn checked(self) -> Result<Self, Refusal> {
        let places = format!("{PLACES}:0");
        let counts = [&self.arrays, &self.cells].map(|arrays| arrays.get(&places).map_or(0, Vec::len));
        if counts[0] == 0 {
            return Err("without points".into());
        }
        for ((arrays, count), what) in [&self.arrays, &self.cells].into_iter().zip(counts).zip(["points", "cells"]) {
            if let Some((name, values)) = arrays.iter().find(|(_, values)| values.len() != count) {
                return Err(format!("of {count} {what}, but {} values of `{name}`", values.len()).into());
            }
        }
        Ok(self)
    }
}

/// Parts an array into its components.
fn part(arrays: &mut NamedArrays, name: &str, components: usize, values: &[f64]) {
    for component in 0..components {
        let name = if components == 1 { name.to_owned() } else { format!("{name}:{component}") };
        arrays.entry(name).or_default().extend(values.iter().skip(component).step_by(components));
    }
}

/// Means of the points of each cell, three values a cell. `ends` are the places in `connectivity` where cells end.
fn centres(points: &[f64], connectivity: &[f64], ends: &[f64]) -> Result<Vec<f64>, Refusal> {
    let (points, _) = points.as_chunks::<3>();
    let mut start = 0;
    let mut centre = |end: f64| {
        let cell = connectivity.get(start..end as usize).filter(|cell| !cell.is_empty())?;
        start = end as usize;
        let corners = cell.iter().map(|&corner| points.get((corner >= 0.0).then_some(corner as usize)?));
        let corners: Vec<&[f64; 3]> = corners.collect::<Option<_>>()?;
        let sum: [f64; 3] = std::array::from_fn(|axis| corners.iter().map(|corner| corner[axis]).sum());
        Some(sum.map(|sum| sum / cell.len() as f64))
    };
    let centres: Option<Vec<[f64; 3]>> = ends.iter().map(|end| centre(*end)).collect();
    Ok(centres.ok_or("with cells of points that it lacks")?.concat())
}

#[cfg(test)]
mod foreign_tests;
#[cfg(test)]
mod tests;
