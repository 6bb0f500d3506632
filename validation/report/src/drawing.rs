//! Figures and animations of a report as files, drawn or taken from what was drawn before.

use crate::figure::{self, Animation, Drawing, Figure, FigureError, FigureFormat, encode_gif};
use crate::store::Drawings;
use std::cell::LazyCell;
use std::path::{Path, PathBuf};

/// Writes `NAME.svg`, `NAME.png`, `NAME.pdf` and the data as `NAME.csv` into a folder that is there; the path of the PNG.
pub(super) fn write_figure(figure: &Figure, folder: &Path, drawings: &Drawings) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let format = drawings.format();
    let key = drawings.key(&(figure, format));
    let drawing = LazyCell::new(|| Drawing::of(figure, format));
    let vectors = drawings.bytes(&key, "svg", || Ok(drawing.svg().into_bytes()))?;
    let pixels = drawings.bytes(&key, "png", || drawing.png())?;
    let page = drawings.bytes(&key, "pdf", || Ok(drawing.pdf()))?;
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
    let draw = || Drawing::of(figure, format).png();
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
