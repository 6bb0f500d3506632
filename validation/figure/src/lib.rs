//! Figures as plain data: who has something to show describes what to draw, this package draws it, as SVG, PNG, PDF and GIF. The
//! files are the same to the byte on every machine: fonts and rasteriser are part of the package.
//!
//! A [`Figure`] is a sheet of [`Panel`]s; a panel has two [`Axis`], and in it curves and clouds ([`Series`]), [`Band`]s of
//! uncertainty and [`Field`]s of particles. Colours are told apart by the colour-blind, and marks differ in shape too.
//!
//! ```
//! use bagnold_figure::{Axis, Figure, FigureFormat, Panel};
//!
//! let mut panel = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h [-]"));
//! panel.reference("exact", (0..=20).map(|k| f64::from(k) / 20.0).map(|y| (y * (2.0 - y), y)));
//! panel.points("measured", 0, [(0.44, 0.25), (0.74, 0.5), (0.95, 0.75)]);
//! let figure = Figure::new("profile", "Velocity over the depth of a film.", vec![panel]);
//!
//! let folder = tempfile::tempdir().expect("a folder");
//! let picture = bagnold_figure::write(&figure, folder.path(), FigureFormat::SCREEN).expect("drawn");
//! assert!(std::fs::read_to_string(picture.with_extension("svg")).expect("written").contains("y/h [-]"));
//! assert_eq!(bagnold_figure::size_of(&picture).expect("a picture").0, 1600);
//! ```

mod animation;
mod axes;
mod canvas;
mod clip;
mod construct;
mod curves;
mod discs;
mod elements;
mod error;
mod field;
mod font;
mod format;
mod gif;
mod glyphs;
mod legend;
mod palette;
mod panel;
mod pdf;
mod range;
mod raster;
pub mod render;
mod script;
mod sheet;
mod size;
mod table;
mod ticks;

#[cfg(test)]
mod tests;

pub use animation::{Animation, AnimationFrame};
pub use error::FigureError;
pub use format::FigureFormat;
pub use gif::encode as encode_gif;
pub use size::size_of;
pub use table::csv;

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// One coordinate axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[must_use]
pub struct Axis {
    /// Label with unit, such as `u [m/s]`.
    pub label: String,
    /// Scale, linear or logarithmic.
    pub scale: Scale,
    /// Fixed limits; `None` fits the data.
    pub limits: Option<(f64, f64)>,
    /// Quantity and scale of a dimensionless axis, for an axis with one scale for all curves.
    pub ratio: Option<AxisRatio>,
}

/// A quantity over a scale: x/r0 is x `[m]` over r0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AxisRatio {
    /// Name of the quantity, such as `x`.
    pub name: String,
    /// Unit of quantity and scale.
    pub unit: String,
    /// The scale, in that unit.
    pub scale: f64,
}

/// Spacing of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios; values ≤ 0 are not drawn.
    Logarithmic,
}

/// Mark of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mark {
    /// Solid line: a simulation that is continuous.
    Line,
    /// Dashed black line: a reference.
    Reference,
    /// Points, with error bars where `error` is given.
    Points,
    /// Line with points.
    LinePoints,
    /// Hollow points, with error bars where `error` is given.
    OpenPoints,
}

/// One curve or cloud.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Legend entry; empty for none.
    pub label: String,
    /// Mark of the series.
    pub mark: Mark,
    /// Colour slot in the colour-blind safe palette; the same slot is the same run in every panel.
    pub colour: usize,
    /// Points (x, y) in axis units.
    pub points: Vec<(f64, f64)>,
    /// Half height of the error bar of each point, or empty.
    pub error: Vec<f64>,
}

/// A shaded band, such as a reference's uncertainty or a gate: (x, lower, upper).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Legend entry; empty for none.
    pub label: String,
    /// (x, lower, upper) in axis units.
    pub points: Vec<(f64, f64, f64)>,
}

/// Particles coloured by a scalar, drawn with equal axis scales and a colour bar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Field {
    /// Positions (x, y) in axis units.
    pub points: Vec<(f64, f64)>,
    /// The scalar of each point.
    pub values: Vec<f64>,
    /// Label of the colour bar with unit; empty for no bar.
    pub label: String,
    /// Particle diameter in axis units.
    pub diameter: f64,
    /// Colour limits; `None` fits the data.
    pub limits: Option<(f64, f64)>,
}

/// One coordinate system and the series, bands and marks drawn in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// Title, may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Bands, drawn first.
    pub bands: Vec<Band>,
    /// Curves and point clouds.
    pub series: Vec<Series>,
    /// A particle field, drawn between bands and series.
    pub field: Option<Field>,
    /// A second field that leaves the first one's particles free, with a colour map and bar of its own; only beside a
    /// first one.
    pub opposite: Option<Field>,
}

/// A figure: one or more panels on one sheet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[must_use]
pub struct Figure {
    /// File name without ending, kebab-case, unique within its folder.
    pub name: String,
    /// Caption for the report: what is seen and what it means.
    pub caption: String,
    /// Panels in reading order.
    pub panels: Vec<Panel>,
    /// Panels per row.
    pub columns: usize,
}

/// Draws `figure` in a format into `folder` as `NAME.svg`, `NAME.png` and `NAME.pdf`, with its data in `NAME.csv`; the
/// folder is made if it is missing. The path of the PNG.
///
/// # Errors
/// If the name is no file name, drawing fails, or a file cannot be written.
pub fn write(figure: &Figure, folder: &Path, format: FigureFormat) -> Result<PathBuf, FigureError> {
    let drawn = render::svg(figure, format)?;
    let raster = render::png(&drawn, format)?;
    let page = render::pdf(&drawn, format)?;
    let put = |ending: &str, bytes: &[u8]| put(folder, &figure.name, ending, bytes);
    put("pdf", &page)?;
    put("csv", csv(figure).as_bytes())?;
    put("svg", drawn.as_bytes())?;
    put("png", &raster)
}

/// Writes a file of a figure into a folder, which is made if it is missing; its path.
///
/// # Errors
/// If the name is no file name, or the file cannot be written.
pub fn put(folder: &Path, name: &str, ending: &str, bytes: &[u8]) -> Result<PathBuf, FigureError> {
    if !is_file_name(name) {
        return Err(FigureError::Name { name: name.to_owned() });
    }
    std::fs::create_dir_all(folder).map_err(|source| FigureError::Write { path: folder.to_owned(), source })?;
    let path = folder.join(format!("{name}.{ending}"));
    match std::fs::write(&path, bytes) {
        Ok(()) => Ok(path),
        Err(source) => Err(FigureError::Write { path, source }),
    }
}

/// Whether `name` is safe as a file or folder name: it can neither leave its folder nor need quoting in a link.
pub fn is_file_name(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_alphanumeric())
        && name.chars().all(|character| character.is_ascii_alphanumeric() || "-_.".contains(character))
}
