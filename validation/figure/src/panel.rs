//! One panel: how much room it wants, and drawing it in the room it gets.

use super::axes::{Sizes, TICK, TICK_GAP, draw_axes, draw_grid, text, uncrowded, widest_label};
use super::canvas::{Canvas, Rectangle, TextSpec};
use super::curves::{Plot, draw_bands, draw_series};
use super::error::Drawn;
use super::field::{ColourScale, draw_field, extent};
use super::font::width;
use super::legend::{Legend, LegendPosition};
use super::palette::{AXIS, BLACK};
use super::range::{Mapping, Range};
use super::ticks::{Ticks, ticks};
use super::{Panel, Scale};
use plotters::style::FontStyle;
use plotters::style::text_anchor::{HPos, VPos};

/// Space around a plot for everything that stands outside its frame `[px]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Margins {
    /// Margins with the larger value of both on each side.
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            right: self.right.max(other.right),
            top: self.top.max(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// A panel whose axes are known and whose place is not yet.
pub(super) struct ScaledPanel<'p> {
    panel: &'p Panel,
    title: String,
    sizes: Sizes,
    x: (Range, Scale, Ticks),
    y: (Range, Scale, Ticks),
    colours: Option<ColourScale>,
    opposite: Option<ColourScale>,
    /// A colour bar of its own stands right of the plot.
    has_bar: bool,
    /// Whether numbers and label are drawn under the horizontal axis of this panel, not of the panel below.
    pub(super) has_x_numbers: bool,
    legend: Legend,
    legend_place: LegendPosition,
    has_data: bool,
}

impl<'p> ScaledPanel<'p> {
    /// Fits axes and ticks of `panel` for a plot of about `width` × `height` pixels; `bars` stand at the top of the sheet.
    pub(super) fn new(
        panel: &'p Panel,
        title: String,
        bars: &[ColourScale],
        sizes: Sizes,
        (wide, high): (f64, f64),
    ) -> Self {
        let (x, y, has_data) = ranges(panel);
        let [colours, opposite] = ColourScale::of_panel(panel);
        let has_bar = colours.as_ref().is_some_and(|scale| !scale.label.is_empty() && !bars.contains(scale));
        // Equal scales: the narrower direction decides.
        let aspect = (y.0.upper - y.0.lower) / (x.0.upper - x.0.lower);
        let (plot_wide, plot_high) = match colours {
            Some(_) => (wide.min(high / aspect), high.min(wide * aspect)),
            None => (wide, high),
        };
        let x_wanted = (plot_wide / (5.0 * sizes.tick)).clamp(2.0, 8.0) as usize;
        let x_ticks = uncrowded(x, plot_wide, sizes.tick, x_wanted);
        let y_wanted = (plot_high / (3.0 * sizes.tick)).clamp(2.0, 8.0) as usize;
        let y_ticks = ticks(y.0, y.1, y_wanted);
        Self {
            panel,
            title,
            sizes,
            x: (x.0, x.1, x_ticks),
            y: (y.0, y.1, y_ticks),
            colours,
            opposite,
            has_bar,
            has_x_numbers: true,
            legend: Legend::of(panel, sizes.legend, wide + 100.0),
            legend_place: LegendPosition::Inside,
            has_data,
        }
    }

    /// Height of the plot over its width where both axes must have one scale.
    pub(super) fn aspect(&self) -> Option<f64> {
        let (x, y) = (self.x.0, self.y.0);
        self.colours.as_ref().map(|_| (y.upper - y.lower) / (x.upper - x.lower))
    }

    /// Whether this picture and another one above or below it can have one horizontal axis.
    pub(super) fn shares_axis(&self, other: &Self) -> bool {
        let is_picture = self.panel.field.is_some() && self.legend.is_empty();
        let axis = |panel: &Self| (panel.x.0, panel.aspect());
        is_picture && axis(self) == axis(other) && self.panel.x.label == other.panel.x.label
    }

    /// Leaves numbers and label of the horizontal axis to a panel below.
    pub(super) fn leave_axis(&mut self) {
        self.has_x_numbers = false;
        self.x.2.factor.clear();
        self.x.2.major.iter_mut().for_each(|tick| tick.label.clear());
    }

    /// Decides on which side the legend stands, given the plot that the panel would have with none outside.
    pub(super) fn settle_legend(&mut self, trial: &Rectangle) {
        let plot = self.plot(self.fitted(trial));
        self.legend_place = if self.legend.is_empty() || self.legend.free_place(self.panel, &plot).is_some() {
            LegendPosition::Inside
        } else if trial.width() > 1000.0 && self.panel.field.is_none() {
            LegendPosition::Beside
        } else {
            LegendPosition::Below
        };
    }

    /// The room that axes, title, legend and colour bar need around the plot in a column of a width `[px]`.
    pub(super) fn margins(&self, column_width: f64) -> Margins {
        let sizes = self.sizes;
        let label = |label: &str| if label.is_empty() { 0.0 } else { 1.5 * sizes.label };
        let half_last =
            self.x.2.major.last().map_or(0.0, |tick| 0.5 * width(&tick.label, sizes.tick, FontStyle::Normal));
        let mut margins = Margins {
            left: TICK + TICK_GAP + widest_label(&self.y.2, sizes.tick) + label(&self.panel.y.label) + 10.0,
            right: half_last.max(12.0) + 8.0,
            top: 14.0,
            bottom: TICK + TICK_GAP + 1.2 * sizes.tick + label(&self.panel.x.label).max(0.3 * sizes.tick) + 8.0,
        };
        if !self.has_x_numbers {
            margins.bottom = TICK;
        }
        if let Some(colours) = self.colours.as_ref().filter(|_| self.has_bar) {
            margins.right = margins.right.max(colours.width_beside(sizes) + 10.0);
        }
        if !self.title.is_empty() {
            margins.top += 1.5 * sizes.title;
        }
        if !self.y.2.factor.is_empty() {
            margins.top = margins.top.max(1.6 * sizes.tick);
            let factor = width(&self.y.2.factor, sizes.tick, FontStyle::Normal);
            margins.left = margins.left.max(TICK + factor + 4.0);
        }
        match self.legend_place {
            LegendPosition::Inside => {}
            LegendPosition::Beside => margins.right += self.legend.box_width() + 24.0,
            LegendPosition::Below => {
                margins.bottom += self.legend.height_below(column_width - margins.left - margins.right);
            }
        }
        margins
    }

    /// Draws the panel with its plot in `room`.
    pub(super) fn draw(&self, canvas: &mut Canvas<'_>, room: &Rectangle) -> Drawn {
        let plot = self.plot(self.fitted(room));
        let window = plot.window;
        let sizes = self.sizes;
        draw_grid(canvas, &plot, &self.x.2, &self.y.2)?;
        draw_bands(canvas, &plot, &self.panel.bands)?;
        for (field, colours) in [(&self.panel.field, &self.colours), (&self.panel.opposite, &self.opposite)] {
            if let (Some(field), Some(colours)) = (field, colours) {
                draw_field(canvas, &plot, field, colours)?;
                if self.has_bar {
                    colours.draw_beside(canvas, &window, sizes)?;
                }
            }
        }
        draw_series(canvas, &plot, self.panel)?;
        let x_label = if self.has_x_numbers { self.panel.x.label.as_str() } else { "" };
        let labels = (x_label, self.panel.y.label.as_str());
        draw_axes(canvas, &plot, (&self.x.2, &self.y.2), labels, sizes)?;
        let whole = width(&self.title, sizes.title, FontStyle::Bold);
        let title = text(sizes.title * (room.width() / whole).min(1.0), HPos::Left, VPos::Center, BLACK);
        let above = (window.left, window.top - 0.85 * sizes.title);
        canvas.text(&self.title, above, TextSpec { weight: FontStyle::Bold, ..title })?;
        if !self.has_data {
            let middle = (0.5 * (window.left + window.right), 0.5 * (window.top + window.bottom));
            canvas.text("no data", middle, text(sizes.label, HPos::Center, VPos::Center, AXIS))?;
        }
        self.draw_legend(canvas, &plot)
    }

    fn draw_legend(&self, canvas: &mut Canvas<'_>, plot: &Plot) -> Drawn {
        if self.legend.is_empty() {
            return Ok(());
        }
        let window = &plot.window;
        match self.legend_place {
            LegendPosition::Beside => self.legend.draw_box(canvas, self.panel, (window.right + 24.0, window.top)),
            LegendPosition::Below => {
                let top = window.bottom + TICK + TICK_GAP + 1.25 * self.sizes.tick + 1.5 * self.sizes.label;
                self.legend.draw_rows(canvas, self.panel, (window.left, window.right, top))
            }
            LegendPosition::Inside => {
                let gap = 0.5 * self.sizes.legend;
                // Panels that share margins may have got a slightly smaller plot than the trial's.
                let corner = self
                    .legend
                    .free_place(self.panel, plot)
                    .map_or((window.right - gap - self.legend.box_width(), window.top + gap), |place| {
                        (place.left, place.top)
                    });
                self.legend.draw_box(canvas, self.panel, corner)
            }
        }
    }

    /// The largest plot in `room` that keeps equal scales, if it must.
    fn fitted(&self, room: &Rectangle) -> Rectangle {
        let Some(aspect) = self.aspect() else { return *room };
        let width = room.width().min(room.height() / aspect);
        let height = width * aspect;
        Rectangle { top: room.bottom - height, right: room.left + width, ..*room }
    }

    fn plot(&self, window: Rectangle) -> Plot {
        Plot {
            x: Mapping { range: self.x.0, scale: self.x.1, start: window.left, end: window.right },
            y: Mapping { range: self.y.0, scale: self.y.1, start: window.bottom, end: window.top },
            window,
        }
    }
}

type Span = (Range, Scale);

/// Ranges of both axes, and whether there is anything to show.
fn ranges(panel: &Panel) -> (Span, Span, bool) {
    let fields: Vec<_> = panel.field.iter().chain(&panel.opposite).collect();
    if !fields.is_empty() {
        let (x, has_x) = extent(&panel.x, &fields, |point| point.0);
        let (y, has_y) = extent(&panel.y, &fields, |point| point.1);
        return ((x, Scale::Linear), (y, Scale::Linear), has_x && has_y);
    }
    let points = || panel.series.iter().flat_map(|series| &series.points);
    let bands = || panel.bands.iter().flat_map(|band| &band.points);
    // Error bars count for the extent where they are finite: they are part of the statement.
    let bars = panel
        .series
        .iter()
        .flat_map(|series| series.points.iter().zip(&series.error).flat_map(|(&(_, y), &half)| [y - half, y + half]));
    let xs = points().map(|point| point.0).chain(bands().map(|point| point.0));
    let ys = points().map(|point| point.1).chain(bands().flat_map(|&(_, lower, upper)| [lower, upper])).chain(bars);
    let (x, has_x) = Range::fit(&panel.x, panel.x.scale, xs);
    let (y, has_y) = Range::fit(&panel.y, panel.y.scale, ys);
    ((x, panel.x.scale), (y, panel.y.scale), has_x && has_y)
}
