//! Particles coloured by a scalar, and the colour bar.

use super::axes::{Sizes, TICK_GAP, text, uncrowded, widest_label};
use super::canvas::{Canvas, Direction, Ink, Rectangle, TextSpec};
use super::curves::Plot;
use super::error::Drawn;
use super::font::width;
use super::palette::{AXIS, BLACK, ColourMap, FIRST, GREY, SECOND};
use super::range::{Mapping, Range};
use super::ticks::{Ticks, ticks};
use super::{Axis, Field, Panel, Scale};
use plotters::style::FontStyle;
use plotters::style::text_anchor::{HPos, VPos};

/// Thickness of a colour bar `[px]`.
const BAR: f64 = 26.0;
/// Space between plot and colour bar `[px]`.
const BAR_GAP: f64 = 26.0;
/// About as many ticks has a bar with room for them.
const TICKS: usize = 6;
/// The longest bar at the top of a sheet `[px]`.
const LONGEST: f64 = 700.0;

/// The scale of a field's colours with its bar.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColourScale {
    /// Label of the bar with the factor of the numbers, such as `p [Pa]  (×10³)`; empty for no bar.
    pub(super) label: String,
    range: Range,
    ticks: Ticks,
    map: ColourMap,
}

impl ColourScale {
    fn of(field: &Field, map: ColourMap) -> Self {
        let range = Range::of_colours(field.limits, &field.values);
        let ticks = ticks(range, Scale::Linear, TICKS);
        let has_factor = !(field.label.is_empty() || ticks.factor.is_empty());
        let factor = if has_factor { format!("  ({})", ticks.factor) } else { String::new() };
        Self { label: format!("{}{factor}", field.label), range, ticks, map }
    }

    /// The scales of a panel's first and second field.
    pub(super) fn of_panel(panel: &Panel) -> [Option<Self>; 2] {
        let fields = [(&panel.field, FIRST), (&panel.opposite, SECOND)];
        fields.map(|(field, map)| field.as_ref().map(|field| Self::of(field, map)))
    }

    /// Width of a bar beside a plot, with its gap, numbers and label `[px]`.
    pub(super) fn width_beside(&self, sizes: Sizes) -> f64 {
        BAR_GAP + BAR + TICK_GAP + widest_label(&self.ticks, sizes.tick) + 1.9 * sizes.label
    }

    /// Height of a bar at the top of a sheet, with its numbers `[px]`.
    pub(super) fn height_on_top(sizes: Sizes) -> f64 {
        BAR + TICK_GAP + 1.6 * sizes.tick
    }

    /// Draws the bar right of a plot.
    pub(super) fn draw_beside(&self, canvas: &mut Canvas<'_>, window: &Rectangle, sizes: Sizes) -> Drawn {
        let left = window.right + BAR_GAP;
        let bar = Rectangle { left, right: left + BAR, ..*window };
        self.draw_colours(canvas, |share| Rectangle { bottom: bar.bottom - share * bar.height(), ..bar })?;
        let mapping = Mapping { range: self.range, scale: Scale::Linear, start: bar.bottom, end: bar.top };
        let spec = text(sizes.tick, HPos::Left, VPos::Center, AXIS);
        let wanted = TICKS.min((bar.height() / (1.5 * sizes.tick)) as usize);
        for tick in &ticks(self.range, Scale::Linear, wanted).major {
            if let Some(y) = mapping.pixel(tick.value) {
                canvas.line((bar.right, y), (bar.right + 6.0, y), Ink::solid(AXIS, 2.0))?;
                canvas.text(&tick.label, (bar.right + 6.0 + TICK_GAP, y), spec)?;
            }
        }
        let x = bar.right + TICK_GAP + widest_label(&self.ticks, sizes.tick) + 1.2 * sizes.label;
        let upwards =
            TextSpec { direction: Direction::Upwards, ..text(sizes.label, HPos::Center, VPos::Center, BLACK) };
        canvas.text(&self.label, (x, 0.5 * (bar.top + bar.bottom)), upwards)
    }

    /// Draws the bar at the top of a sheet, between `left` and `right` with its label before it and its numbers above it.
    pub(super) fn draw_on_top(
        &self,
        canvas: &mut Canvas<'_>,
        (left, right, bottom): (f64, f64, f64),
        sizes: Sizes,
    ) -> Drawn {
        let left = left + width(&self.label, sizes.label, FontStyle::Normal) + sizes.label;
        let bar = Rectangle { left, top: bottom - BAR, right: right.min(left + LONGEST), bottom };
        self.draw_colours(canvas, |share| Rectangle { left: bar.left + share * bar.width(), ..bar })?;
        let mapping = Mapping { range: self.range, scale: Scale::Linear, start: bar.left, end: bar.right };
        let spec = text(sizes.tick, HPos::Center, VPos::Center, AXIS);
        for tick in &uncrowded((self.range, Scale::Linear), bar.width(), sizes.tick, TICKS).major {
            if let Some(x) = mapping.pixel(tick.value) {
                canvas.line((x, bar.top), (x, bar.top - 6.0), Ink::solid(AXIS, 2.0))?;
                canvas.text(&tick.label, (x, bar.top - 6.0 - 0.7 * sizes.tick), spec)?;
            }
        }
        let label = text(sizes.label, HPos::Right, VPos::Center, BLACK);
        canvas.text(&self.label, (bar.left - sizes.label, 0.5 * (bar.top + bar.bottom)), label)
    }

    /// Draws a bar that `rest` cuts to what is beyond a share of its length.
    fn draw_colours(&self, canvas: &mut Canvas<'_>, rest: impl Fn(f64) -> Rectangle) -> Drawn {
        for step in 0..COLOUR_STEPS {
            // Each strip reaches to the end, so that no seam shows between strips.
            let share = |part: f64| (f64::from(step) + part) / f64::from(COLOUR_STEPS);
            canvas.fill_rectangle(&rest(share(0.0)), Ink::solid(self.map.at(share(0.5)), 0.0))?;
        }
        canvas.frame(&rest(0.0), Ink::solid(AXIS, 2.0))
    }
}

const COLOUR_STEPS: u32 = 128;

/// Draws every particle at its true size, those without a value in grey.
pub(super) fn draw_field(canvas: &mut Canvas<'_>, plot: &Plot, field: &Field, colours: &ColourScale) -> Drawn {
    let scale = plot.window.width() / (plot.x.range.upper - plot.x.range.lower);
    let drawn = 0.5 * diameter(field) * scale;
    // Gaps between discs of a few pixels only make the colours pale: small discs grow until their squares are full.
    let full = 1.0 + (std::f64::consts::SQRT_2 - 1.0) * (0.5 * (4.0 - drawn)).clamp(0.0, 1.0);
    // A particle below a pixel would vanish from the sheet.
    let radius = (full * drawn).clamp(0.6, 400.0);
    for (index, &point) in field.points.iter().enumerate() {
        let Some(centre) = plot.place(point).filter(|&centre| plot.window.contains(centre)) else { continue };
        let value = field.values.get(index).copied().unwrap_or(f64::NAN);
        let range = &colours.range;
        let fraction = (value - range.lower) / (range.upper - range.lower);
        let colour = if value.is_nan() { GREY } else { colours.map.at(fraction) };
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
