//! A sheet of panels: sizes of rows, margins shared within rows and columns, drawing.

use super::Figure;
use super::axes::Sizes;
use super::canvas::{Canvas, Rectangle, polish};
use super::discs::gathered;
use super::error::FigureError;
use super::field::ColourScale;
use super::format::FigureFormat;
use super::panel::{Margins, ScaledPanel};

const BORDER: f64 = 14.0;
const GUTTER: f64 = 30.0;
/// Space under a row whose horizontal axes are those of a row below `[px]`.
const NARROW_GUTTER: f64 = 2.0;
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
    let (_, column_width) = column_of(format, columns, 0);
    // a column that is narrow needs height for its numbers, whatever the number of columns
    let shape = if columns == 1 && column_width < NARROW { 2 } else { columns };
    let aspect = ASPECTS[(shape - 1).min(ASPECTS.len() - 1)];
    let usual = (column_width - 120.0, (column_width - 120.0) * aspect);

    let bars = common_scales(figure);
    let mut panels: Vec<ScaledPanel<'_>> = figure
        .panels
        .iter()
        .enumerate()
        .map(|(index, panel)| {
            let title = lettered(&panel.title, index, figure.panels.len());
            let height = if panel.field.is_some() { TALLEST } else { usual.1 };
            ScaledPanel::new(panel, title, &bars, sizes, (usual.0, height))
        })
        .collect();
    for panel in &mut panels {
        let margins = panel.margins(column_width);
        let width = column_width - margins.left - margins.right;
        let height = plot_height(panel, width, aspect);
        panel.settle_legend(&Rectangle { left: 0.0, top: 0.0, right: width, bottom: height });
    }
    share_axes(&mut panels, columns);

    let bars_a_line = format.columns(bars.len());
    let line = ColourScale::height_on_top(sizes) + GUTTER;
    let above = bars.len().div_ceil(bars_a_line) as f64 * line;
    let rows = layout(&panels, columns, column_width, aspect);
    let height = above + rows.last().map_or(200.0, |row| row.bottom) + BORDER;
    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, format.sheet, height.ceil())?;
    for (index, scale) in bars.iter().enumerate() {
        let place = index % bars_a_line;
        let ((left, width), margins) = (column_of(format, bars_a_line, place), rows[0].margins[place.min(columns - 1)]);
        let bottom = BORDER + (index / bars_a_line + 1) as f64 * line - GUTTER;
        scale.draw_on_top(&mut canvas, (left + margins.left, left + width - margins.right, bottom), sizes)?;
    }
    for (index, panel) in panels.iter().enumerate() {
        let row = &rows[index / columns];
        let column = index % columns;
        let (left, _) = column_of(format, columns, column);
        let margins = row.margins[column];
        let top = above + row.top + row.above;
        let room = Rectangle {
            left: left + margins.left,
            top,
            right: left + column_width - margins.right,
            bottom: top + row.plot_height,
        };
        panel.draw(&mut canvas, &room)?;
    }
    canvas.finish()?;
    Ok(gathered(&polish(&text, format.sheet, height.ceil(), format)))
}

/// Left end and width of one of several columns of a sheet `[px]`.
fn column_of(format: FigureFormat, columns: usize, column: usize) -> (f64, f64) {
    let width = (format.sheet - 2.0 * BORDER - (columns - 1) as f64 * GUTTER) / columns as f64;
    (BORDER + column as f64 * (width + GUTTER), width)
}

/// Scales of colours whose bar stands at the top of the sheet: that of a single panel, those of several panels, and those of
/// two fields in one panel. Other bars stand beside their panel.
fn common_scales(figure: &Figure) -> Vec<ColourScale> {
    let (mut known, mut common) = (Vec::new(), Vec::<ColourScale>::new());
    for panel in &figure.panels {
        for scale in ColourScale::of_panel(panel).into_iter().flatten().filter(|scale| !scale.label.is_empty()) {
            let is_paired = panel.opposite.is_some();
            let is_common = figure.panels.len() == 1 || is_paired || known.contains(&scale);
            // two bars of one label could not be told apart
            if is_common && !common.iter().any(|other| *other == scale || !is_paired && other.label == scale.label) {
                common.push(scale.clone());
            }
            known.push(scale);
        }
    }
    common
}

/// Leaves numbers and label of the horizontal axis to the lowest panel of a column where it is the axis of all.
fn share_axes(panels: &mut [ScaledPanel<'_>], columns: usize) {
    for column in 0..columns {
        let mut own: Vec<_> = panels.iter_mut().skip(column).step_by(columns).collect();
        if let Some((lowest, above)) = own.split_last_mut()
            && above.iter().all(|panel| panel.shares_axis(lowest))
        {
            above.iter_mut().for_each(|panel| panel.leave_axis());
        }
    }
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
        shared[column] = shared[column].union(panel.margins(column_width));
    }
    let mut rows: Vec<PanelRow> = Vec::new();
    let mut top = BORDER;
    for row in panels.chunks(columns) {
        let own: Vec<Margins> = row.iter().map(|panel| panel.margins(column_width)).collect();
        let all = own.iter().fold(Margins::default(), |union, &margins| union.union(margins));
        let margins: Vec<Margins> = shared.iter().take(row.len()).copied().collect();
        let plot_height = row
            .iter()
            .zip(&margins)
            .map(|(panel, margins)| plot_height(panel, column_width - margins.left - margins.right, aspect))
            .fold(LOWEST, f64::max);
        let bottom = top + all.top + plot_height + all.bottom;
        rows.push(PanelRow { top, bottom, above: all.top, plot_height, margins });
        top = bottom + if row.iter().any(|panel| panel.has_x_numbers) { GUTTER } else { NARROW_GUTTER };
    }
    rows
}

fn plot_height(panel: &ScaledPanel<'_>, width: f64, aspect: f64) -> f64 {
    panel.aspect().map_or(width * aspect, |own| (width * own).clamp(LOWEST, TALLEST))
}

/// Panels of a sheet with several are called (a), (b), …, so that a caption can name them.
fn lettered(title: &str, index: usize, count: usize) -> String {
    match (count, u8::try_from(index).ok().filter(|&index| index < 26)) {
        (0 | 1, _) | (_, None) => title.to_owned(),
        (_, Some(index)) => format!("({}) {title}", char::from(b'a' + index)).trim_end().to_owned(),
    }
}
