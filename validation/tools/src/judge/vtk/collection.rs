//! The times and files of a collection.

use super::nesting;
use crate::input::FieldError;
use std::path::{Path, PathBuf};

/// Endings of files that name the pieces of one picture.
pub(in crate::judge) const PARALLEL: [&str; 3] = ["pvtu", "pvtp", "vtm"];

/// Times `[s]` and files of a collection, `.pvd` or `.series`, by time; a picture in parts has several. Of a time that a restart has
/// written again the last counts.
///
/// # Errors
/// A file that is no collection of VTK's, or has a data set without a time or a file.
pub(in crate::judge) fn collection(text: &str, file: &Path) -> Result<Vec<(f64, PathBuf)>, FieldError> {
    let wrong = |defect: &str| FieldError::finding("file", defect, "write it as ParaView's PVD format").in_file(file);
    let mut sets: Vec<(f64, String, PathBuf)> = Vec::new();
    let mut enter = |time: Option<f64>, part: &str, name: Option<&str>| {
        let time = time.filter(|time| time.is_finite());
        let time = time.ok_or_else(|| wrong("a data set has no time"))?;
        let name = name.ok_or_else(|| wrong("a data set has no file"))?;
        let name = beside(file, name);
        // files of one time that follow each other are its parts; what comes later was written by a restart
        let follows = sets.last().is_some_and(|(other, _, last)| *other == time && *last != name);
        if !follows {
            sets.retain(|(other, own, _)| (*other, own.as_str()) != (time, part));
        }
        sets.push((time, part.to_owned(), name));
        Ok::<(), FieldError>(())
    };
    if file.extension().is_some_and(|ending| ending == "series") {
        let series: serde_json::Value =
            serde_json::from_str(text).map_err(|error| wrong(&format!("not a series of VTK ({error})")))?;
        for set in series["files"].as_array().into_iter().flatten() {
            enter(set["time"].as_f64(), "", set["name"].as_str())?;
        }
    } else {
        let document = nesting::parse(text).map_err(|reason| wrong(&format!("not a collection of VTK ({reason})")))?;
        for node in document.descendants().filter(|node| node.has_tag_name("DataSet")) {
            let time = node.attribute("timestep").and_then(|time| time.parse().ok());
            enter(time, node.attribute("part").unwrap_or_default(), node.attribute("file"))?;
        }
    }
    sets.sort_by(|a, b| a.0.total_cmp(&b.0));
    if sets.is_empty() {
        return Err(wrong("no data sets"));
    }
    Ok(sets.into_iter().map(|(time, _, file)| (time, file)).collect())
}

/// Files of the pieces that a file of [`PARALLEL`] names.
///
/// # Errors
/// A file that is no document of VTK's or names no piece.
pub(in crate::judge) fn pieces(text: &str, file: &Path) -> Result<Vec<PathBuf>, FieldError> {
    let wrong = |value: &str| {
        let remedy = "write points in one file, in ParaView by Save Data";
        FieldError::finding("file", format!("not a list of pieces of VTK ({value})"), remedy).in_file(file)
    };
    let document = nesting::parse(text).map_err(|reason| wrong(&reason))?;
    let source = |node: roxmltree::Node<'_, '_>| match node.tag_name().name() {
        "Piece" => node.attribute("Source").map(|name| beside(file, name)),
        "DataSet" if !is_of_boundary(node) => node.attribute("file").map(|name| beside(file, name)),
        _ => None,
    };
    let pieces: Vec<PathBuf> = document.descendants().filter_map(source).collect();
    if pieces.is_empty() { Err(wrong("without pieces")) } else { Ok(pieces) }
}

/// Whether a data set stands in a block of the boundary, as OpenFOAM writes it.
fn is_of_boundary(node: roxmltree::Node<'_, '_>) -> bool {
    node.ancestors().any(|block| block.attribute("name") == Some("boundary"))
}

/// A file beside another, also where its name was written by Windows.
fn beside(file: &Path, name: &str) -> PathBuf {
    file.parent().unwrap_or_else(|| Path::new("")).join(name.replace('\\', "/"))
}
