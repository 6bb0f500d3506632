//! Figure → SVG → PNG and PDF.

use super::canvas::UNITS_PER_PIXEL;
use super::error::FigureError;
use super::format::FigureFormat;
use super::pdf::page;
use super::{Figure, raster, sheet};

/// Draws `figure` as SVG; the same data give the same bytes on any machine.
///
/// # Errors
/// Only if the drawing library refuses; odd data (empty, constant, NaN, infinite) draw an odd figure.
pub fn svg(figure: &Figure, format: FigureFormat) -> Result<String, FigureError> {
    sheet::draw(figure, format)
}

/// Rasterises an SVG of [`svg`] in the same format.
///
/// # Errors
/// If the text is no SVG of [`svg`], or too large to rasterise.
pub fn png(svg: &str, format: FigureFormat) -> Result<Vec<u8>, FigureError> {
    raster::png(&raster::pixels(svg, format.scale as f32)?)
}

/// Turns an SVG of [`svg`] in the same format into a page of PDF.
///
/// # Errors
/// If the text is no SVG of [`svg`].
pub fn pdf(svg: &str, format: FigureFormat) -> Result<Vec<u8>, FigureError> {
    page(svg, format.point_size() / UNITS_PER_PIXEL)
}
