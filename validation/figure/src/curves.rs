//! Contents of the frame: bands, lines, references, points with error bars.

use super::canvas::{Canvas, Ink, Point, Rectangle};
use super::clip::{clip_chain, clip_polygon, dashes, thin};
use super::error::Drawn;
use super::palette::{BLACK, GREY, colour, shape};
use super::range::Mapping;
use super::{Band, Mark, Panel, Series};
use plotters::style::{RGBColor, WHITE};

/// Stroke of a simulated curve `[px]`.
const CURVE: f64 = 4.0;
/// Stroke of a reference `[px]`.
const REFERENCE: f64 = 3.5;
/// Opacity of a band: two that overlap remain distinguishable.
const BAND_OPACITY: f64 = 0.25;

/// The two axes and the window between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plot {
    pub(super) x: Mapping,
    pub(super) y: Mapping,
    pub(super) window: Rectangle,
}

impl Plot {
    /// Position `[px]` of a value pair; `None` where a value is not on its axis.
    pub(super) fn place(&self, (x, y): (f64, f64)) -> Option<Point> {
        Some((self.x.pixel(x)?, self.y.pixel(y)?))
    }

    fn chain(&self, points: &[(f64, f64)]) -> Vec<Option<Point>> {
        points.iter().map(|&point| self.place(point)).collect()
    }
}

/// Draws bands, then lines, then references, then points: what is judged stays visible under what judges it.
pub(super) fn draw_bands(canvas: &mut Canvas<'_>, plot: &Plot, bands: &[Band]) -> Drawn {
    for band in bands {
        for outline in band_outlines(plot, band) {
            canvas.polygon(&outline, Ink { colour: GREY, opacity: BAND_OPACITY, width: 0.0 })?;
        }
    }
    Ok(())
}

/// Draws every series of a panel.
pub(super) fn draw_series(canvas: &mut Canvas<'_>, plot: &Plot, panel: &Panel) -> Drawn {
    let of = |wanted: &'static [Mark]| panel.series.iter().filter(move |series| wanted.contains(&series.mark));
    for series in of(&[Mark::Line, Mark::LinePoints]) {
        for piece in clip_chain(&plot.chain(&series.points), &plot.window) {
            canvas.polyline(&thin(piece), Ink::solid(colour(series.colour), CURVE))?;
        }
    }
    for series in of(&[Mark::Reference]) {
        let pattern = reference_pattern(panel, series);
        for piece in clip_chain(&plot.chain(&series.points), &plot.window) {
            for dash in dashes(&thin(piece), pattern) {
                canvas.polyline(&dash, Ink::solid(BLACK, REFERENCE))?;
            }
        }
    }
    for series in of(&[Mark::Points, Mark::OpenPoints, Mark::LinePoints]) {
        draw_points(canvas, plot, series)?;
    }
    Ok(())
}

/// The closed outlines of a band, one for each run of drawable points.
pub(super) fn band_outlines(plot: &Plot, band: &Band) -> Vec<Vec<Point>> {
    let mut outlines = Vec::new();
    let mut run: Vec<(Point, Point)> = Vec::new();
    let edges = band.points.iter().map(|&(x, lower, upper)| {
        // On a logarithmic axis a lower edge at or below zero is the bottom of the plot.
        let bottom = plot.y.pixel(lower).or((lower <= 0.0).then_some(plot.window.bottom));
        Some(((plot.x.pixel(x)?, bottom?), (plot.x.pixel(x)?, plot.y.pixel(upper)?)))
    });
    for edge in edges.chain(std::iter::once(None)) {
        match edge {
            Some(pair) => run.push(pair),
            None => {
                let outline: Vec<Point> =
                    run.iter().map(|pair| pair.0).chain(run.iter().rev().map(|pair| pair.1)).collect();
                run.clear();
                let cut = clip_polygon(&outline, &plot.window);
                if cut.len() >= 3 {
                    outlines.push(cut);
                }
            }
        }
    }
    outlines
}

fn draw_points(canvas: &mut Canvas<'_>, plot: &Plot, series: &Series) -> Drawn {
    let radius = marker_radius(series.points.len());
    let ink = colour(series.colour);
    let mut last: Option<Point> = None;
    for (index, &(x, y)) in series.points.iter().enumerate() {
        let Some(centre) = plot.place((x, y)).filter(|&centre| plot.window.grown(0.5).contains(centre)) else {
            continue;
        };
        // Markers that hide their own line say less than fewer markers.
        let crowded = series.mark == Mark::LinePoints
            && last.is_some_and(|last| (centre.0 - last.0).hypot(centre.1 - last.1) < 3.0 * radius);
        if crowded {
            continue;
        }
        last = Some(centre);
        if let Some(&half) = series.error.get(index).filter(|half| half.is_finite() && **half > 0.0) {
            draw_error_bar(canvas, plot, (x, y), half, ink)?;
        }
        draw_marker(canvas, centre, radius, series)?;
    }
    Ok(())
}

/// Large clouds get small markers.
fn marker_radius(points: usize) -> f64 {
    match points {
        0..=60 => 8.0,
        61..=400 => 5.5,
        _ => 3.5,
    }
}

fn draw_error_bar(canvas: &mut Canvas<'_>, plot: &Plot, (x, y): (f64, f64), half: f64, colour: RGBColor) -> Drawn {
    let ink = Ink::solid(colour, 2.5);
    let Some(across) = plot.x.pixel(x) else { return Ok(()) };
    let window = &plot.window;
    // A bar that reaches below zero on a logarithmic axis ends at the frame.
    let low = plot.y.pixel(y - half).unwrap_or(window.bottom);
    let high = plot.y.pixel(y + half).unwrap_or(window.top);
    let (bottom, top) = (low.clamp(window.top, window.bottom), high.clamp(window.top, window.bottom));
    canvas.line((across, bottom), (across, top), ink)?;
    for (end, cut) in [(low, bottom), (high, top)] {
        if end == cut {
            canvas.line((across - 8.0, cut), (across + 8.0, cut), ink)?;
        }
    }
    Ok(())
}

/// Draws one marker of a series.
fn draw_marker(canvas: &mut Canvas<'_>, (x, y): Point, radius: f64, series: &Series) -> Drawn {
    let corners = shape(series.colour);
    let scaled = |radius: f64| corners.iter().map(move |&(dx, dy)| (x + radius * dx, y + radius * dy));
    if series.mark == Mark::OpenPoints && !corners.is_empty() {
        // Around the outer border and back around the inner one: what lies below is seen through the opening.
        let (outer, inner) = (scaled(radius), scaled(0.6 * radius));
        let ring: Vec<Point> =
            outer.clone().chain(outer.take(1)).chain(inner.clone().take(1)).chain(inner.rev()).collect();
        return canvas.polygon(&ring, Ink::solid(colour(series.colour), 0.0));
    }
    // A white rim keeps neighbours apart; on a line of its own it would only cut the line.
    let rim = (series.mark != Mark::LinePoints).then_some((radius + 1.5, WHITE));
    let hollow = (series.mark == Mark::OpenPoints).then_some((0.6 * radius, WHITE));
    for (radius, colour) in rim.into_iter().chain([(radius, colour(series.colour))]).chain(hollow) {
        let ink = Ink::solid(colour, 0.0);
        if corners.is_empty() {
            canvas.disc((x, y), radius, ink)?;
        }
        canvas.polygon(&scaled(radius).collect::<Vec<_>>(), ink)?;
    }
    Ok(())
}

/// Dashed for the first reference of a panel; a second and third label get dash-dots and dots.
fn reference_pattern(panel: &Panel, series: &Series) -> &'static [f64] {
    const PATTERNS: [&[f64]; 3] = [&[13.0, 8.0], &[16.0, 7.0, 4.0, 7.0], &[4.0, 7.0]];
    let mut labels: Vec<&str> = Vec::new();
    for other in panel.series.iter().filter(|other| other.mark == Mark::Reference && !other.label.is_empty()) {
        if !labels.contains(&other.label.as_str()) {
            labels.push(&other.label);
        }
    }
    let slot = labels.iter().position(|&label| label == series.label).unwrap_or(0);
    PATTERNS[slot % PATTERNS.len()]
}

/// Draws the sample of a series in a legend, between two points at one height.
pub(super) fn draw_sample(canvas: &mut Canvas<'_>, panel: &Panel, series: &Series, [left, right]: [Point; 2]) -> Drawn {
    let ink = colour(series.colour);
    match series.mark {
        Mark::Reference => {
            for dash in dashes(&[left, right], reference_pattern(panel, series)) {
                canvas.polyline(&dash, Ink::solid(BLACK, REFERENCE))?;
            }
        }
        Mark::Line | Mark::LinePoints => canvas.line(left, right, Ink::solid(ink, CURVE))?,
        Mark::Points | Mark::OpenPoints => {}
    }
    if matches!(series.mark, Mark::Points | Mark::OpenPoints | Mark::LinePoints) {
        let middle = (0.5 * (left.0 + right.0), left.1);
        draw_marker(canvas, middle, marker_radius(series.points.len()).max(5.5), series)?;
    }
    Ok(())
}

/// Draws the sample of a band in a legend.
pub(super) fn draw_band_sample(canvas: &mut Canvas<'_>, place: &Rectangle) -> Drawn {
    canvas.fill_rectangle(place, Ink { colour: GREY, opacity: BAND_OPACITY, width: 0.0 })
}
