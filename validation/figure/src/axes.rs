//! Frame, grid, ticks and labels of one panel.

use super::Scale;
use super::canvas::{Canvas, Direction, Ink, Rectangle, TextSpec};
use super::curves::Plot;
use super::error::Drawn;
use super::font::width;
use super::format::LABEL;
use super::palette::{AXIS, BLACK, GRID};
use super::range::{Mapping, Range};
use super::ticks::{Ticks, ticks};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontStyle, RGBColor};

/// Length of a major tick `[px]`.
pub(super) const TICK: f64 = 9.0;
/// Space between a tick and its number `[px]`.
pub(super) const TICK_GAP: f64 = 7.0;
const FRAME: f64 = 2.0;
/// Most length of an axis label over that of its axis `[-]`; a longer one has smaller letters.
const MOST_LABEL: f64 = 1.15;

/// Font sizes of a sheet `[px]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes {
    pub(super) title: f64,
    pub(super) label: f64,
    pub(super) tick: f64,
    pub(super) legend: f64,
}

impl Sizes {
    /// Sheets for the screen are shown at about half of their size; nothing may become smaller than 11 px there.
    pub(super) fn for_columns(columns: usize) -> Self {
        if columns <= 2 {
            Self { title: 29.0, label: LABEL, tick: 25.0, legend: 25.0 }
        } else {
            Self { title: 26.0, label: 25.0, tick: 22.0, legend: 22.0 }
        }
    }
}

/// A text in the regular weight.
pub(super) fn text(em: f64, horizontal: HPos, vertical: VPos, colour: RGBColor) -> TextSpec {
    TextSpec { em, weight: FontStyle::Normal, horizontal, vertical, colour, direction: Direction::Rightwards }
}

/// About `wanted` ticks along a horizontal length `[px]`, or so few that their numbers stand clear of each other.
pub(super) fn uncrowded((range, scale): (Range, Scale), length: f64, em: f64, mut wanted: usize) -> Ticks {
    loop {
        let found = ticks(range, scale, wanted);
        let numbers = found.major.iter().filter(|tick| !tick.label.is_empty()).count() as f64;
        if wanted <= 2 || numbers * (widest_label(&found, em) + 0.8 * em) <= length {
            return found;
        }
        wanted -= 1;
    }
}

/// Width of the widest tick number `[px]`.
pub(super) fn widest_label(ticks: &Ticks, em: f64) -> f64 {
    ticks.major.iter().map(|tick| width(&tick.label, em, FontStyle::Normal)).fold(0.0, f64::max)
}

/// Draws the grid; it lies under the data.
pub(super) fn draw_grid(canvas: &mut Canvas<'_>, plot: &Plot, x_ticks: &Ticks, y_ticks: &Ticks) -> Drawn {
    let window = &plot.window;
    let ink = Ink::solid(GRID, 1.5);
    for x in pixels(&plot.x, x_ticks.major.iter().map(|tick| tick.value)) {
        canvas.line((x, window.top), (x, window.bottom), ink)?;
    }
    for y in pixels(&plot.y, y_ticks.major.iter().map(|tick| tick.value)) {
        canvas.line((window.left, y), (window.right, y), ink)?;
    }
    Ok(())
}

/// Draws frame, ticks and numbers; they lie over the data.
pub(super) fn draw_axes(
    canvas: &mut Canvas<'_>,
    plot: &Plot,
    (x_ticks, y_ticks): (&Ticks, &Ticks),
    (x_label, y_label): (&str, &str),
    sizes: Sizes,
) -> Drawn {
    let window = &plot.window;
    let ink = Ink::solid(AXIS, FRAME);
    canvas.frame(window, ink)?;
    for x in pixels(&plot.x, x_ticks.minor.iter().copied()) {
        canvas.line((x, window.bottom), (x, window.bottom + 0.55 * TICK), ink)?;
    }
    for y in pixels(&plot.y, y_ticks.minor.iter().copied()) {
        canvas.line((window.left, y), (window.left - 0.55 * TICK, y), ink)?;
    }
    let below = text(sizes.tick, HPos::Center, VPos::Top, AXIS);
    for tick in &x_ticks.major {
        if let Some(x) = plot.x.pixel(tick.value) {
            canvas.line((x, window.bottom), (x, window.bottom + TICK), ink)?;
            canvas.text(&tick.label, (x, window.bottom + TICK + TICK_GAP), below)?;
        }
    }
    let before = text(sizes.tick, HPos::Right, VPos::Center, AXIS);
    for tick in &y_ticks.major {
        if let Some(y) = plot.y.pixel(tick.value) {
            canvas.line((window.left, y), (window.left - TICK, y), ink)?;
            canvas.text(&tick.label, (window.left - TICK - TICK_GAP, y), before)?;
        }
    }
    draw_labels(canvas, window, (x_ticks, y_ticks), (x_label, y_label), sizes)
}

fn draw_labels(
    canvas: &mut Canvas<'_>,
    window: &Rectangle,
    (x_ticks, y_ticks): (&Ticks, &Ticks),
    (x_label, y_label): (&str, &str),
    sizes: Sizes,
) -> Drawn {
    let x_label_top = window.bottom + TICK + TICK_GAP + 1.25 * sizes.tick;
    let centre = 0.5 * (window.left + window.right);
    let along = |label: &str, length: f64| {
        let whole = width(label, sizes.label, FontStyle::Normal);
        sizes.label * (MOST_LABEL * length / whole).min(1.0)
    };
    let x_size = along(x_label, window.width());
    canvas.text(x_label, (centre, x_label_top), text(x_size, HPos::Center, VPos::Top, BLACK))?;
    canvas.text(&x_ticks.factor, (window.right, x_label_top), text(sizes.tick, HPos::Right, VPos::Top, AXIS))?;

    let y_label_right = window.left - TICK - TICK_GAP - widest_label(y_ticks, sizes.tick) - 0.8 * sizes.label;
    let y_size = along(y_label, window.height());
    let upwards = TextSpec { direction: Direction::Upwards, ..text(y_size, HPos::Center, VPos::Center, BLACK) };
    canvas.text(y_label, (y_label_right, 0.5 * (window.top + window.bottom)), upwards)?;
    // Left of the frame: the line above the plot belongs to the title.
    let factor = text(sizes.tick, HPos::Right, VPos::Center, AXIS);
    canvas.text(&y_ticks.factor, (window.left - TICK, window.top - 0.85 * sizes.tick), factor)
}

fn pixels(mapping: &Mapping, values: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    values.filter_map(|value| mapping.pixel(value))
}
