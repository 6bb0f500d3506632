//! Figure → SVG → PNG.

use super::Figure;
use super::error::FigureError;
use super::font;
use super::sheet;
use resvg::{tiny_skia, usvg};

/// Draws `figure` as SVG; the same data give the same bytes on any machine.
///
/// # Errors
/// Only if the drawing library refuses; odd data (empty, constant, NaN, infinite) draw an odd figure.
pub fn svg(figure: &Figure) -> Result<String, FigureError> {
    font::register()?;
    sheet::draw(figure)
}

/// Rasterises an SVG of [`svg`] at its own size.
///
/// # Errors
/// If the text is no SVG, or too large to rasterise.
pub fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    raster(svg, 1.0)?.encode_png().map_err(|error| FigureError::Raster(error.to_string()))
}

/// The pixels of an SVG at `scale` times its own size.
pub(super) fn raster(svg: &str, scale: f32) -> Result<tiny_skia::Pixmap, FigureError> {
    let options =
        usvg::Options { fontdb: font::raster_fonts(), font_family: font::FAMILY.to_owned(), ..Default::default() };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| FigureError::Svg(error.to_string()))?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(scale)
        .ok_or_else(|| FigureError::Raster(format!("no pixels at {scale} times the sheet's size")))?;
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| FigureError::Raster(format!("no memory for {} × {} pixels", size.width(), size.height())))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    Ok(pixels)
}
