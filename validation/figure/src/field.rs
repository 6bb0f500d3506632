//! Particles coloured by a scalar, and the colour bar.

use super::Field;
use super::axes::{Sizes, TICK_GAP, text, uncrowded, widest_label};
use super::canvas::{Canvas, Direction, Ink, Rectangle, TextSpec};
use super::curves::Plot;
use super::error::FigureError;
use super::font::{Weight, width};
use super::palette::{AXIS, BLACK, ColourMap, FIRST, GREY, SECOND};
use super::range::{Mapping, Range};
use super::ticks::{Ticks, ticks};
use super::{Axis, Scale};
use plotters::style::text_anchor::{HPos, VPos};

/// Thickness of a colour bar `[px]`.
const BAR: f64 = 26.0;
/// Most ticks of a bar above a plot.
const MOST_ABOVE: usize = 5;
/// Space between plot and colour bar `[px]`.
const BAR_GAP: f64 = 26.0;

/// Where a colour bar stands: a flat field has no height to put one beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BarPlace {
    Beside,
    Above,
    /// Above the left half of a plot with two fields: the first one's.
    AboveLeft,
    /// Above the right half: the opposite one's.
    AboveRight,
}

impl BarPlace {
    /// Ends of a bar above the plot over the plot's width; its label stands before it.
    fn span(self) -> (f64, f64) {
        match self {
            Self::Beside | Self::Above => (0.55, 1.0),
            Self::AboveLeft => (0.13, 0.47),
            Self::AboveRight => (0.66, 1.0),
        }
    }
}

/// The scale of a field's colours with its bar.
#[derive(Debug)]
pub(super) struct ColourScale {
    range: Range,
    ticks: Ticks,
    map: ColourMap,
    has_bar: bool,
    place: BarPlace,
}

impl ColourScale {
    pub(super) fn of(field: &Field, place: BarPlace) -> Self {
        let range = Range::of_colours(field.limits, &field.values);
        let wanted = match place {
            BarPlace::Beside => 6,
            BarPlace::Above | BarPlace::AboveLeft | BarPlace::AboveRight => MOST_ABOVE,
        };
        let map = if place == BarPlace::AboveRight { SECOND } else { FIRST };
        let ticks = ticks(range, Scale::Linear, wanted);
        Self { range, ticks, map, has_bar: !field.label.is_empty(), place }
    }

    fn fraction(&self, value: f64) -> f64 {
        (value - self.range.lower) / (self.range.upper - self.range.lower)
    }

    /// The label with the factor of the numbers, such as `p [Pa] · 10³`.
    fn label(&self, field: &Field) -> String {
        if self.ticks.factor.is_empty() {
            field.label.clone()
        } else {
            format!("{}  ({})", field.label, self.ticks.factor)
        }
    }

    /// Space that the bar takes from the panel: (right of the plot, above it) `[px]`.
    pub(super) fn space(&self, sizes: Sizes) -> (f64, f64) {
        if !self.has_bar {
            return (0.0, 0.0);
        }
        match self.place {
            BarPlace::Beside => {
                (BAR_GAP + BAR + TICK_GAP + widest_label(&self.ticks, sizes.tick) + 1.9 * sizes.label, 0.0)
            }
            BarPlace::Above | BarPlace::AboveLeft | BarPlace::AboveRight => {
                (0.0, 14.0 + BAR + TICK_GAP + 1.6 * sizes.tick)
            }
        }
    }

    /// Draws the bar at the plot's side.
    pub(super) fn draw_bar(
        &self,
        canvas: &mut Canvas<'_>,
        field: &Field,
        window: &Rectangle,
        sizes: Sizes,
    ) -> Result<(), FigureError> {
        match self.place {
            _ if !self.has_bar => Ok(()),
            BarPlace::Beside => self.draw_beside(canvas, field, window, sizes),
            BarPlace::Above | BarPlace::AboveLeft | BarPlace::AboveRight => {
                self.draw_above(canvas, field, window, sizes)
            }
        }
    }

    fn draw_beside(
        &self,
        canvas: &mut Canvas<'_>,
        field: &Field,
        window: &Rectangle,
        sizes: Sizes,
    ) -> Result<(), FigureError> {
        let left = window.right + BAR_GAP;
        let bar = Rectangle { left, right: left + BAR, ..*window };
        let steps = COLOUR_STEPS;
        for step in 0..steps {
            // Each strip reaches to the end, so that no seam shows between strips.
            let bottom = bar.bottom - bar.height() * f64::from(step) / f64::from(steps);
            let strip = Rectangle { bottom, ..bar };
            canvas.fill_rectangle(&strip, self.strip_ink(step, steps))?;
        }
        canvas.frame(&bar, Ink::solid(AXIS, 2.0))?;
        let mapping = Mapping { range: self.range, scale: Scale::Linear, start: bar.bottom, end: bar.top };
        let spec = text(sizes.tick, HPos::Left, VPos::Center, AXIS);
        for tick in &self.ticks.major {
            if let Some(y) = mapping.pixel(tick.value) {
                canvas.line((bar.right, y), (bar.right + 6.0, y), Ink::solid(AXIS, 2.0))?;
                canvas.text(&tick.label, (bar.right + 6.0 + TICK_GAP, y), spec)?;
            }
        }
        let x = bar.right + TICK_GAP + widest_label(&self.ticks, sizes.tick) + 1.2 * sizes.label;
        let upwards =
            TextSpec { direction: Direction::Upwards, ..text(sizes.label, HPos::Center, VPos::Center, BLACK) };
        canvas.text(&self.label(field), (x, 0.5 * (bar.top + bar.bottom)), upwards)
    }

    fn draw_above(
        &self,
        canvas: &mut Canvas<'_>,
        field: &Field,
        window: &Rectangle,
        sizes: Sizes,
    ) -> Result<(), FigureError> {
        let bottom = window.top - 14.0;
        let (start, end) = self.place.span();
        let place = |share: f64| window.left + share * window.width();
        let bar = Rectangle { left: place(start), top: bottom - BAR, right: place(end), bottom };
        let steps = COLOUR_STEPS;
        for step in 0..steps {
            let left = bar.left + bar.width() * f64::from(step) / f64::from(steps);
            canvas.fill_rectangle(&Rectangle { left, ..bar }, self.strip_ink(step, steps))?;
        }
        canvas.frame(&bar, Ink::solid(AXIS, 2.0))?;
        let mapping = Mapping { range: self.range, scale: Scale::Linear, start: bar.left, end: bar.right };
        let spec = text(sizes.tick, HPos::Center, VPos::Center, AXIS);
        let ticks = uncrowded((self.range, Scale::Linear), bar.width(), sizes.tick, MOST_ABOVE);
        for tick in &ticks.major {
            if let Some(x) = mapping.pixel(tick.value) {
                canvas.line((x, bar.top), (x, bar.top - 6.0), Ink::solid(AXIS, 2.0))?;
                canvas.text(&tick.label, (x, bar.top - 6.0 - 0.7 * sizes.tick), spec)?;
            }
        }
        let label = text(sizes.label, HPos::Right, VPos::Center, BLACK);
        canvas.text(&self.label(field), (bar.left - sizes.label, 0.5 * (bar.top + bar.bottom)), label)
    }

    /// Whether the bar is above the plot and leaves room for a title left of it.
    pub(super) fn leaves_room_for(&self, title: &str, field: &Field, plot_width: f64, sizes: Sizes) -> bool {
        let taken = width(&self.label(field), sizes.label, Weight::Regular) + 2.0 * sizes.label;
        self.has_bar
            && self.place == BarPlace::Above
            && width(title, sizes.title, Weight::Bold) < 0.55 * plot_width - taken
    }

    fn strip_ink(&self, step: u32, steps: u32) -> Ink {
        Ink::solid(self.map.at((f64::from(step) + 0.5) / f64::from(steps)), 0.0)
    }
}

const COLOUR_STEPS: u32 = 128;

/// Draws every particle at its true size, those without a value in grey.
pub(super) fn draw_field(
    canvas: &mut Canvas<'_>,
    plot: &Plot,
    field: &Field,
    colours: &ColourScale,
) -> Result<(), FigureError> {
    let scale = plot.window.width() / (plot.x.range.upper - plot.x.range.lower);
    let drawn = 0.5 * diameter(field) * scale;
    // Gaps between discs of a few pixels only make the colours pale: small discs grow until their squares are full.
    let full = 1.0 + (std::f64::consts::SQRT_2 - 1.0) * (0.5 * (4.0 - drawn)).clamp(0.0, 1.0);
    // A particle below a pixel would vanish from the sheet.
    let radius = (full * drawn).clamp(0.6, 400.0);
    for (index, &point) in field.points.iter().enumerate() {
        let Some(centre) = plot.place(point).filter(|&centre| plot.window.contains(centre)) else { continue };
        let value = field.values.get(index).copied().unwrap_or(f64::NAN);
        let colour = if value.is_nan() { GREY } else { colours.map.at(colours.fraction(value)) };
        canvas.disc(centre, radius, Ink::solid(colour, 0.0))?;
    }
    Ok(())
}

/// The particle diameter, 0 where it makes no sense.
fn diameter(field: &Field) -> f64 {
    if field.diameter.is_finite() { field.diameter.max(0.0) } else { 0.0 }
}

/// The part of the plane that an axis with fields shows: its own limits, else all particles with their radii.
pub(super) fn extent(axis: &Axis, fields: &[&Field], coordinate: fn(&(f64, f64)) -> f64) -> (Range, bool) {
    let edges = fields.iter().flat_map(|field| {
        let radius = 0.5 * diameter(field);
        field.points.iter().map(coordinate).flat_map(move |centre| [centre - radius, centre + radius])
    });
    Range::fit(axis, Scale::Linear, edges)
}
