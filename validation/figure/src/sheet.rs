//! A sheet of panels: sizes of rows, margins shared within rows and columns, drawing.

use super::Figure;
use super::axes::Sizes;
use super::canvas::{Canvas, Rectangle, polish};
use super::discs::gathered;
use super::error::FigureError;
use super::format::FigureFormat;
use super::panel::{Margins, ScaledPanel};

const BORDER: f64 = 14.0;
const GUTTER: f64 = 30.0;
/// Height over width of a plot, by panels a row.
const ASPECTS: [f64; 3] = [0.58, 0.78, 0.95];
/// Width of a column below which its plots are as high as those of two columns `[px]`.
const NARROW: f64 = 900.0;
/// No plot is taller than this `[px]`: a figure fits on a screen.
const TALLEST: f64 = 1150.0;
/// No plot is lower than this `[px]`, however flat its field.
const LOWEST: f64 = 60.0;

/// Draws `figure` as SVG text.
pub(super) fn draw(figure: &Figure, format: FigureFormat) -> Result<String, FigureError> {
    let columns = format.columns(figure.columns.clamp(1, 4)).min(figure.panels.len().max(1));
    let sizes = Sizes::for_columns(columns);
    let column_width = (format.sheet - 2.0 * BORDER - (columns - 1) as f64 * GUTTER) / columns as f64;
    // a column that is narrow needs height for its numbers, whatever the number of columns
    let shape = if columns == 1 && column_width < NARROW { 2 } else { columns };
    let aspect = ASPECTS[(shape - 1).min(ASPECTS.len() - 1)];
    let usual = (column_width - 120.0, (column_width - 120.0) * aspect);

    let mut panels: Vec<ScaledPanel<'_>> = figure
        .panels
        .iter()
        .enumerate()
        .map(|(index, panel)| {
            let title = lettered(&panel.title, index, figure.panels.len());
            let height = if panel.field.is_some() { TALLEST } else { usual.1 };
            ScaledPanel::new(panel, title, sizes, (usual.0, height))
        })
        .collect();
    for panel in &mut panels {
        let margins = panel.margins(usual.0);
        let width = column_width - margins.left - margins.right;
        let height = plot_height(panel, width, aspect);
        panel.settle_legend(&Rectangle { left: 0.0, top: 0.0, right: width, bottom: height });
    }

    let rows = layout(&panels, columns, column_width, aspect);
    let height = rows.last().map_or(200.0, |row| row.bottom) + BORDER;
    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, format.sheet, height.ceil())?;
    for (index, panel) in panels.iter().enumerate() {
        let row = &rows[index / columns];
        let column = index % columns;
        let left = BORDER + column as f64 * (column_width + GUTTER);
        let margins = row.margins[column];
        let room = Rectangle {
            left: left + margins.left,
            top: row.top + row.above,
            right: left + column_width - margins.right,
            bottom: row.top + row.above + row.plot_height,
        };
        panel.draw(&mut canvas, &room)?;
    }
    canvas.finish()?;
    Ok(gathered(&polish(&text, format.sheet, height.ceil(), format)))
}

/// One row of panels: plots of one height on one base line.
struct PanelRow {
    top: f64,
    bottom: f64,
    above: f64,
    plot_height: f64,
    margins: Vec<Margins>,
}

fn layout(panels: &[ScaledPanel<'_>], columns: usize, column_width: f64, aspect: f64) -> Vec<PanelRow> {
    // Plots of one column begin and end at the same place, so that their axes can be compared.
    let mut shared = vec![Margins::default(); columns];
    for (index, panel) in panels.iter().enumerate() {
        let column = index % columns;
        shared[column] = shared[column].union(panel.margins(column_width - 140.0));
    }
    let mut rows: Vec<PanelRow> = Vec::new();
    let mut top = BORDER;
    for row in panels.chunks(columns) {
        let own: Vec<Margins> = row.iter().map(|panel| panel.margins(column_width - 140.0)).collect();
        let all = own.iter().fold(Margins::default(), |union, &margins| union.union(margins));
        let margins: Vec<Margins> = shared.iter().take(row.len()).copied().collect();
        let plot_height = row
            .iter()
            .zip(&margins)
            .map(|(panel, margins)| plot_height(panel, column_width - margins.left - margins.right, aspect))
            .fold(LOWEST, f64::max);
        let bottom = top + all.top + plot_height + all.bottom;
        rows.push(PanelRow { top, bottom, above: all.top, plot_height, margins });
        top = bottom + GUTTER;
    }
    rows
}

fn plot_height(panel: &ScaledPanel<'_>, width: f64, aspect: f64) -> f64 {
    let usual = || panel.named_height().unwrap_or(width * aspect);
    panel.aspect().map_or_else(usual, |own| (width * own).clamp(LOWEST, TALLEST))
}

/// Panels of a sheet with several are called (a), (b), …, so that a caption can name them.
fn lettered(title: &str, index: usize, count: usize) -> String {
    match (count, u8::try_from(index).ok().filter(|&index| index < 26)) {
        (0 | 1, _) | (_, None) => title.to_owned(),
        (_, Some(index)) => format!("({}) {title}", char::from(b'a' + index)).trim_end().to_owned(),
    }
}
