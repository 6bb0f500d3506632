//! The legend: what it says, where it hides no data, and how it is drawn.

use super::axes::text;
use super::canvas::{Canvas, Ink, Point, Rectangle};
use super::curves::{Plot, band_outlines, draw_band_sample, draw_sample};
use super::error::Drawn;
use super::font::width;
use super::palette::{BLACK, GRID};
use super::{Mark, Panel};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontStyle, WHITE};

/// Places for a legend along each side of a plot, less one.
const STEPS: usize = 8;

/// Position of a legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LegendPosition {
    /// In a corner or at an edge of the plot that holds no data.
    Inside,
    /// Right of the plot.
    Beside,
    /// Under the horizontal axis.
    Below,
}

#[derive(Debug, Clone, Copy)]
enum LegendEntry {
    Band,
    Series(usize),
}

/// The entries of a panel's legend with their measures.
#[derive(Debug)]
pub(super) struct Legend {
    entries: Vec<(String, LegendEntry)>,
    em: f64,
    widest: f64,
    /// Most width of a label `[px]`.
    room: f64,
}

impl Legend {
    /// Every label once: simulations in their order, then references, then bands. A label that would be wider than `most` has
    /// smaller letters.
    pub(super) fn of(panel: &Panel, em: f64, most: f64) -> Self {
        let mut entries: Vec<(String, LegendEntry)> = Vec::new();
        let of = |reference: bool| {
            let enumerated = panel.series.iter().enumerate();
            let wanted = enumerated.filter(move |(_, series)| (series.mark == Mark::Reference) == reference);
            wanted.map(|(index, series)| (&series.label, LegendEntry::Series(index)))
        };
        let bands = panel.bands.iter().map(|band| (&band.label, LegendEntry::Band));
        for (label, item) in of(false).chain(of(true)).chain(bands) {
            if !label.is_empty() && entries.iter().all(|(known, _)| known != label) {
                entries.push((label.clone(), item));
            }
        }
        let mut legend = Self { entries, em, widest: 0.0, room: most - 3.9 * em };
        legend.widest = legend.entries.iter().map(|(label, _)| legend.label(label).1).fold(0.0, f64::max);
        legend
    }

    /// Size of a label's letters, and its width `[px]`.
    fn label(&self, label: &str) -> (f64, f64) {
        let whole = width(label, self.em, FontStyle::Normal);
        let shrunk = (self.room / whole).min(1.0);
        (shrunk * self.em, shrunk * whole)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    fn sample(&self) -> f64 {
        2.2 * self.em
    }

    fn row(&self) -> f64 {
        1.35 * self.em
    }

    /// Width of the box with one entry a row.
    pub(super) fn box_width(&self) -> f64 {
        self.sample() + 0.5 * self.em + self.widest + 1.2 * self.em
    }

    fn box_height(&self) -> f64 {
        self.row() * self.entries.len() as f64 + 0.6 * self.em
    }

    /// The entries in rows that are no longer than `available`, each with its distance from the beginning of its row, and the
    /// length of every row.
    fn rows_below(&self, available: f64) -> Vec<(Vec<(usize, f64)>, f64)> {
        let mut rows: Vec<(Vec<(usize, f64)>, f64)> = Vec::new();
        for (index, (label, _)) in self.entries.iter().enumerate() {
            let length = self.sample() + 0.5 * self.em + self.label(label).1;
            match rows.last_mut().filter(|(_, end)| end + self.em + length <= available) {
                Some((row, end)) => {
                    row.push((index, *end + self.em));
                    *end += self.em + length;
                }
                None => rows.push((vec![(index, 0.0)], length)),
            }
        }
        rows
    }

    /// Height of the rows under the plot.
    pub(super) fn height_below(&self, available: f64) -> f64 {
        self.rows_below(available).len() as f64 * self.row() + 0.4 * self.em
    }

    /// The free place inside the plot that is nearest to a corner; `None` if every one would hide data.
    pub(super) fn free_place(&self, panel: &Panel, plot: &Plot) -> Option<Rectangle> {
        let window = &plot.window;
        let gap = 0.5 * self.em;
        let (width, height) = (self.box_width(), self.box_height());
        if width + 2.0 * gap > 0.7 * window.width() || height + 2.0 * gap > 0.7 * window.height() {
            return None;
        }
        let drawn = inked_points(panel, plot);
        let (right, bottom) = (window.right - gap - width, window.bottom - gap - height);
        let step = ((right - window.left - gap) / STEPS as f64, (bottom - window.top - gap) / STEPS as f64);
        let from_corner = |&(across, down): &(usize, usize)| across.min(STEPS - across) + down.min(STEPS - down);
        let mut candidates: Vec<(usize, usize)> =
            (0..=STEPS).flat_map(|down| (0..=STEPS).map(move |across| (across, down))).collect();
        // Stable: of equals the upper right ones first.
        candidates.sort_by_key(from_corner);
        candidates
            .into_iter()
            .map(|(across, down)| (right - step.0 * across as f64, window.top + gap + step.1 * down as f64))
            .map(|(left, top)| Rectangle { left, top, right: left + width, bottom: top + height })
            .find(|place| {
                let guarded = place.grown(0.4 * self.em);
                !drawn.iter().any(|&point| guarded.contains(point))
            })
    }

    /// Draws the legend in a box of its own.
    pub(super) fn draw_box(&self, canvas: &mut Canvas<'_>, panel: &Panel, (left, top): Point) -> Drawn {
        let place = Rectangle { left, top, right: left + self.box_width(), bottom: top + self.box_height() };
        canvas.fill_rectangle(&place, Ink::solid(WHITE, 0.0))?;
        canvas.frame(&place, Ink::solid(GRID, 2.0))?;
        for (index, entry) in self.entries.iter().enumerate() {
            let y = top + 0.3 * self.em + (index as f64 + 0.5) * self.row();
            self.draw_entry(canvas, panel, entry, (left + 0.6 * self.em, y))?;
        }
        Ok(())
    }

    /// Draws the legend in rows from `left` to `right`, starting at `top`.
    pub(super) fn draw_rows(
        &self,
        canvas: &mut Canvas<'_>,
        panel: &Panel,
        (left, right, top): (f64, f64, f64),
    ) -> Drawn {
        let rows = self.rows_below(right - left);
        let longest = rows.iter().map(|(_, length)| *length).fold(0.0, f64::max);
        // rows that are longer than the plot reach under the numbers at its left
        let start = (left + 0.5 * (right - left - longest)).min(right + 10.0 - longest);
        for (place, (row, _)) in rows.iter().enumerate() {
            let y = top + (place as f64 + 0.5) * self.row();
            for &(index, x) in row {
                self.draw_entry(canvas, panel, &self.entries[index], (start + x, y))?;
            }
        }
        Ok(())
    }

    fn draw_entry(
        &self,
        canvas: &mut Canvas<'_>,
        panel: &Panel,
        (label, item): &(String, LegendEntry),
        (left, y): Point,
    ) -> Drawn {
        let right = left + self.sample();
        match *item {
            LegendEntry::Band => {
                let half = 0.4 * self.em;
                draw_band_sample(canvas, &Rectangle { left, top: y - half, right, bottom: y + half })?;
            }
            LegendEntry::Series(index) => {
                if let Some(series) = panel.series.get(index) {
                    draw_sample(canvas, panel, series, [(left, y), (right, y)])?;
                }
            }
        }
        let spec = text(self.label(label).0, HPos::Left, VPos::Center, BLACK);
        canvas.text(label, (right + 0.5 * self.em, y), spec)
    }
}

/// Points that stand for everything drawn: markers, curves and outlines of bands sampled every few pixels, particles.
fn inked_points(panel: &Panel, plot: &Plot) -> Vec<Point> {
    let mut inked: Vec<Point> = Vec::new();
    for series in &panel.series {
        let places: Vec<Option<Point>> = series.points.iter().map(|&point| plot.place(point)).collect();
        inked.extend(places.iter().flatten());
        if !matches!(series.mark, Mark::Points | Mark::OpenPoints) {
            for pair in places.windows(2) {
                if let (Some(from), Some(to)) = (pair[0], pair[1]) {
                    sample_segment(&mut inked, from, to);
                }
            }
        }
        for (&(x, y), &half) in series.points.iter().zip(&series.error) {
            if let (Some(low), Some(high)) = (plot.place((x, y - half)), plot.place((x, y + half))) {
                sample_segment(&mut inked, low, high);
            }
        }
    }
    for outline in panel.bands.iter().flat_map(|band| band_outlines(plot, band)) {
        for (index, &from) in outline.iter().enumerate() {
            sample_segment(&mut inked, from, outline[(index + 1) % outline.len()]);
        }
    }
    for field in panel.field.iter().chain(&panel.opposite) {
        inked.extend(field.points.iter().filter_map(|&point| plot.place(point)));
    }
    inked
}

fn sample_segment(inked: &mut Vec<Point>, from: Point, to: Point) {
    const EVERY: f64 = 6.0;
    let length = (to.0 - from.0).hypot(to.1 - from.1);
    let steps = (length / EVERY).ceil().clamp(1.0, 2000.0) as usize;
    inked.extend((0..=steps).map(|step| {
        let share = step as f64 / steps as f64;
        (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
    }));
}
