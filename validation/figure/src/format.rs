//! Size of a figure: its width, its letters and its pixels.

use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Width of a sheet for the screen `[px]`: twice what a page shows, so that it is sharp on any screen.
const SCREEN_WIDTH: f64 = 1600.0;
/// Height of an axis label's letters on every sheet `[px]`.
pub(super) const LABEL: f64 = 28.0;
/// No column of panels is narrower than this `[px]`, or its numbers would not fit.
const NARROWEST_COLUMN: f64 = 400.0;
/// A point of a printer `[mm]`.
const POINT: f64 = 25.4 / 72.0;

/// Size of a drawn figure.
///
/// ```
/// use bagnold_figure::FigureFormat;
///
/// let format: FigureFormat = "85mm,9pt,300dpi".parse().expect("a format");
/// assert_eq!(format.pixels(), 1004.0); // 85/25.4 · 300
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FigureFormat {
    /// Width on which text, strokes and panels are laid out `[px]`.
    pub(super) sheet: f64,
    /// Pixels of the raster file per pixel of the sheet `[-]`.
    pub(super) scale: f64,
    /// Width on paper `[mm]`; none for the screen.
    pub(super) paper: Option<f64>,
}

impl Default for FigureFormat {
    fn default() -> Self {
        Self::SCREEN
    }
}

impl FigureFormat {
    /// For a page that shows the figure 800 px wide.
    pub const SCREEN: Self = Self { sheet: SCREEN_WIDTH, scale: 1.0, paper: None };
    /// Screen format with half of the pixels, used by animations.
    pub const HALF: Self = Self { scale: 0.5, ..Self::SCREEN };
    /// For a page that shows the figure about 300 px wide, with letters of the usual size.
    pub const SMALL: Self = Self { sheet: 640.0, scale: 1.0, paper: None };

    /// For paper: width `[mm]`, axis labels `[pt]` and resolution of the raster file `[dpi]`.
    pub fn paper(width: f64, letters: f64, resolution: f64) -> Self {
        let sheet = (LABEL * width / (letters * POINT)).round();
        Self { sheet, scale: (width / 25.4 * resolution).round() / sheet, paper: Some(width) }
    }

    /// Width of the raster file `[px]`.
    pub fn pixels(self) -> f64 {
        (self.sheet * self.scale).round()
    }

    /// Number of columns of panels that fit on the format, at most the wanted number.
    pub(super) fn columns(self, wanted: usize) -> usize {
        wanted.min((self.sheet / NARROWEST_COLUMN) as usize).max(1)
    }

    /// Length of a pixel of the sheet in the vector files `[pt]`.
    pub(super) fn point_size(self) -> f64 {
        self.paper.map_or(0.375, |width| width / POINT / self.sheet)
    }
}

impl FromStr for FigureFormat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let rule =
            || "must be a width of 30 to 400 mm, letters of 4 to 30 pt and 50 to 1200 dpi, as in 85mm,9pt,300dpi";
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let [width, letters, resolution] = parts[..] else { return Err(rule().to_owned()) };
        let number = |text: &str, unit: &str, least: f64, most: f64| {
            let number: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
            (least..=most).contains(&number).then_some(number)
        };
        let found = (
            number(width, "mm", 30.0, 400.0),
            number(letters, "pt", 4.0, 30.0),
            number(resolution, "dpi", 50.0, 1200.0),
        );
        let (Some(width), Some(letters), Some(resolution)) = found else { return Err(rule().to_owned()) };
        Ok(Self::paper(width, letters, resolution))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_as_high_as_asked_and_columns_fit() {
        let format: FigureFormat = "85mm, 9pt, 300dpi".parse().expect("a format");
        // 28 px of the sheet are 9 pt of 85 mm
        assert!((LABEL * format.point_size() - 9.0).abs() < 0.01, "{}", LABEL * format.point_size());
        assert_eq!((format.pixels(), format.columns(3)), (1004.0, 1));
        assert_eq!(FigureFormat::SCREEN.columns(4), 4);
    }

    #[test]
    fn other_formats_are_rejected_with_the_rule() {
        for text in ["", "85mm", "85,9,300", "85mm,9pt,300", "0mm,9pt,300dpi", "85mm,NaNpt,300dpi", "85mm,9pt,1e9dpi"] {
            let error = text.parse::<FigureFormat>().expect_err(text);
            assert!(error.contains("85mm,9pt,300dpi"), "{text}: {error}");
        }
    }
}
