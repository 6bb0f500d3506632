//! Errors between a figure's data and its files.

use std::path::PathBuf;

/// Error in drawing or writing a figure; the message completes "failed to …".
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The font inside the program could not be read.
    #[error("read the embedded font {style}: the font file is damaged, rebuild the program")]
    Font {
        /// Name of the embedded font.
        style: &'static str,
    },
    /// The drawing library refused an element.
    #[error("draw the figure: {0}")]
    Draw(String),
    /// The SVG text could not be read back for rasterising.
    #[error("read the SVG of the figure: {0}")]
    Svg(String),
    /// The picture could not be rasterised or encoded.
    #[error("rasterise the figure: {0}")]
    Raster(String),
    /// Pictures could not be put together to an animation.
    #[error("encode the animation: {0}")]
    Animation(String),
    /// A name that would not stay inside its folder.
    #[error(
        "write the figure {name:?}: a name consists of letters, digits, '-', '_' and '.', and starts with a letter or digit"
    )]
    Name {
        /// The name as given.
        name: String,
    },
    /// A file or folder could not be written.
    #[error("write {path}: {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Error from the system.
        source: std::io::Error,
    },
}

/// What drawing an element leads to.
pub(super) type Drawn = Result<(), FigureError>;
