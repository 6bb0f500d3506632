//! Common parts of the pages of reports, judgements, comparisons and calibrations: the style, the templates' filling,
//! and figures that are drawn beside them.

mod template;

pub use template::fill;

use crate::figure::{self, Figure, FigureError};
use serde::Serialize;
use std::path::Path;

/// A figure that was drawn, as a page shows it.
#[derive(Debug, Serialize)]
pub struct PageFigure {
    name: String,
    caption: String,
    /// Width and height in pixels, where they are known.
    size: Option<(u32, u32)>,
}

/// Draws figures into a folder. One that cannot be drawn is said in the log and left out: it is no reason to lose the numbers.
///
/// # Errors
/// Files that cannot be written.
pub fn draw<'f>(figures: impl IntoIterator<Item = &'f Figure>, folder: &Path) -> Result<Vec<PageFigure>, FigureError> {
    let mut drawn = Vec::new();
    for figure in figures {
        match figure::write(figure, folder) {
            Ok(written) => drawn.push(PageFigure {
                name: figure.name.clone(),
                caption: figure.caption.clone(),
                size: figure::size_of(&written),
            }),
            Err(error @ FigureError::Write { .. }) => return Err(error),
            Err(error) => tracing::error!("figure {}: failed to {error}", figure.name),
        }
    }
    Ok(drawn)
}
