//! Figures and animations of a report as files, drawn or taken from what was drawn before.

use crate::figure::{self, Animation, Figure, FigureError, FigureFormat, encode_gif, render};
use crate::store::Drawings;
use std::path::{Path, PathBuf};

/// Writes `NAME.svg`, `NAME.png`, `NAME.pdf` and the data as `NAME.csv` into a folder that is there; the path of the PNG.
pub(super) fn write_figure(figure: &Figure, folder: &Path, drawings: &Drawings) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let format = drawings.format();
    let key = drawings.key(&(figure, format));
    let vectors = drawings.bytes(&key, "svg", || render::svg(figure, format).map(String::into_bytes))?;
    let svg = String::from_utf8_lossy(&vectors);
    let pixels = drawings.bytes(&key, "png", || render::png(&svg, format))?;
    let page = drawings.bytes(&key, "pdf", || render::pdf(&svg, format))?;
    let path = |ending: &str| folder.join(format!("{}.{ending}", figure.name));
    put(path("svg"), &vectors)?;
    put(path("pdf"), &page)?;
    put(path("csv"), figure::csv(figure).as_bytes())?;
    put(path("png"), &pixels)
}

/// Writes `NAME.png` for a small place on a page into a folder that is there; its path.
pub(super) fn write_small(figure: &Figure, folder: &Path, drawings: &Drawings) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let format = FigureFormat::SMALL;
    let draw = || render::png(&render::svg(figure, format)?, format);
    let pixels = drawings.bytes(&drawings.key(&(figure, format)), "png", draw)?;
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
