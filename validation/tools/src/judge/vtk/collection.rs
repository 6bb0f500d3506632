//! The times and files of a collection.

use super::nesting;
use crate::input::FieldError;
use std::path::{Path, PathBuf};

/// Times `[s]` and files of a collection, in its order.
///
/// # Errors
/// A file that is no collection of VTK's, or has a data set without a time or a file.
pub(in crate::judge) fn collection(text: &str, file: &Path) -> Result<Vec<(f64, PathBuf)>, FieldError> {
    let wrong =
        |value: &str, rule: &str| FieldError::new("file", value, rule, "see ParaView's PVD format").in_file(file);
    let document = nesting::parse(text).map_err(|reason| wrong(&reason, "a collection of VTK"))?;
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
