//! Figures and animations of a report as files, drawn or taken from what was drawn before.

use crate::figure::{self, Animation, Figure, FigureError, encode_gif, render};
use crate::store::Drawings;
use std::path::{Path, PathBuf};

/// Writes `NAME.svg` and `NAME.png` into a folder that is there; the path of the latter.
pub(super) fn write_figure(figure: &Figure, folder: &Path, drawings: &Drawings) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let key = drawings.key(figure);
    let vectors = drawings.bytes(&key, "svg", || render::svg(figure).map(String::into_bytes))?;
    let pixels = drawings.bytes(&key, "png", || render::png(&String::from_utf8_lossy(&vectors)))?;
    put(folder.join(format!("{}.svg", figure.name)), &vectors)?;
    put(folder.join(format!("{}.png", figure.name)), &pixels)
}

/// Writes `NAME.gif` into a folder that is there; its path.
pub(super) fn write_animation(
    animation: &Animation,
    folder: &Path,
    drawings: &Drawings,
) -> Result<PathBuf, FigureError> {
    check_name(&animation.name)?;
    let moving = drawings.bytes(&drawings.key(animation), "gif", || encode_gif(animation))?;
    put(folder.join(format!("{}.gif", animation.name)), &moving)
}

fn check_name(name: &str) -> Result<(), FigureError> {
    if figure::is_file_name(name) { Ok(()) } else { Err(FigureError::Name { name: name.to_owned() }) }
}

fn put(path: PathBuf, bytes: &[u8]) -> Result<PathBuf, FigureError> {
    match std::fs::write(&path, bytes) {
        Ok(()) => Ok(path),
        Err(source) => Err(FigureError::Write { path, source }),
    }
}
