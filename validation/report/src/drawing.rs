//! Figures and animations of a report as files, drawn or taken from what was drawn before.

use crate::figure::{self, Animation, Figure, FigureError, FigureFormat, encode_gif, render};
use crate::store::Drawings;
use std::path::{Path, PathBuf};

/// Writes `NAME.svg`, `NAME.png`, `NAME.pdf` and the data as `NAME.csv` into a folder; the path of the PNG.
pub(super) fn write_figure(figure: &Figure, folder: &Path, drawings: &Drawings) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let format = drawings.format();
    let key = drawings.key(&(figure, format));
    let vectors = drawings.bytes(&key, "svg", || render::svg(figure, format).map(String::into_bytes))?;
    let svg = String::from_utf8_lossy(&vectors);
    let pixels = drawings.bytes(&key, "png", || render::png(&svg, format))?;
    let page = drawings.bytes(&key, "pdf", || render::pdf(&svg, format))?;
    let put = |ending: &str, bytes: &[u8]| figure::put(folder, &figure.name, ending, bytes);
    put("svg", &vectors)?;
    put("pdf", &page)?;
    put("csv", figure::csv(figure).as_bytes())?;
    put("png", &pixels)
}

/// Writes `NAME.png` in a format into a folder; its path.
pub(super) fn write_picture(
    figure: &Figure,
    folder: &Path,
    drawings: &Drawings,
    format: FigureFormat,
) -> Result<PathBuf, FigureError> {
    check_name(&figure.name)?;
    let draw = || render::png(&render::svg(figure, format)?, format);
    let pixels = drawings.bytes(&drawings.key(&(figure, format)), "png", draw)?;
    figure::put(folder, &figure.name, "png", &pixels)
}

/// Writes `NAME.gif` and, for who wants nothing to move, its middle picture `NAME.png` into a folder; the path of the GIF.
pub(super) fn write_animation(
    animation: &Animation,
    folder: &Path,
    drawings: &Drawings,
) -> Result<PathBuf, FigureError> {
    check_name(&animation.name)?;
    let moving = drawings.bytes(&drawings.key(animation), "gif", || encode_gif(animation))?;
    if let Some(middle) = animation.frames.get(animation.frames.len() / 2) {
        write_picture(&animation.figure(middle), folder, drawings, FigureFormat::HALF)?;
    }
    figure::put(folder, &animation.name, "gif", &moving)
}

fn check_name(name: &str) -> Result<(), FigureError> {
    if figure::is_file_name(name) { Ok(()) } else { Err(FigureError::Name { name: name.to_owned() }) }
}
