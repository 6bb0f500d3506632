//! Figure → SVG → PNG.

use super::Figure;
use super::error::FigureError;
use super::font;
use super::raster::pixels;
use super::sheet;

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
/// If the text is no SVG of [`svg`], or too large to rasterise.
pub fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    pixels(svg, 1.0)?.encode_png().map_err(|error| FigureError::Raster(error.to_string()))
}
