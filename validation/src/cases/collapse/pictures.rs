//! How a heap is shown: moving pictures, and pictures with speed on one side and pressure on the other.

use crate::figure::{Animation, AnimationFrame, Axis, Field, Figure, Mark, Panel, Series};
use crate::observe::{Frame, Motion};

/// Share of all speeds that the colours span: single grains of spray would leave no colour to the heap.
const SPANNED: f64 = 0.998;
/// Time that a picture of an animation is shown `[s]`.
const SECONDS_PER_FRAME: f64 = 0.08;

/// What lengths and times are measured in, and what is drawn of a heap.
#[derive(Debug, Clone, Copy)]
pub(in crate::cases) struct View {
    /// Unit of length `[m]`.
    pub(in crate::cases) unit_length: f64,
    /// Its symbol, such as `r0`; `m` where it is a metre.
    pub(in crate::cases) unit: &'static str,
    /// √(h_0/g) `[s]`.
    pub(in crate::cases) time_scale: f64,
    /// Particle spacing `[m]`.
    pub(in crate::cases) spacing: f64,
    /// Whether x = 0 is a plane of symmetry, behind which the other half is drawn.
    pub(in crate::cases) mirrored: bool,
}

impl View {
    fn axis(&self, coordinate: &str, limits: (f64, f64)) -> Axis {
        let label =
            if self.unit == "m" { format!("{coordinate} [m]") } else { format!("{coordinate}/{} [-]", self.unit) };
        Axis { limits: Some(limits), ..Axis::linear(&label) }
    }

    /// Axes that hold all places (over the unit of length) with the bed and, if mirrored, their images.
    fn axes(&self, places: impl Iterator<Item = (f64, f64)>) -> (Axis, Axis) {
        let (mut x, mut y) = ((0.0_f64, 0.0_f64), (0.0_f64, 0.0_f64));
        for place in places {
            x = (x.0.min(place.0), x.1.max(place.0));
            y = (y.0.min(place.1), y.1.max(place.1));
        }
        let margin = self.spacing / self.unit_length;
        x.1 += margin;
        y.1 += margin;
        x.0 = if self.mirrored { -x.1 } else { x.0 - margin };
        (self.axis("x", x), self.axis("y", y))
    }

    /// The time in seconds and in times of free fall.
    fn clock(&self, time: f64) -> String {
        format!("t = {time:.3} s = {:.2} √(h0/g)", time / self.time_scale)
    }
}

/// The moving picture of a run: particles in the colours of their speed, dashed the thickness by volume and the front.
pub(in crate::cases) fn animation(name: &str, caption: &str, motion: &Motion, view: &View) -> Animation {
    let unit = view.unit_length;
    let scaled = |[x, y]: [f32; 2]| [(f64::from(x) / unit) as f32, (f64::from(y) / unit) as f32];
    let all = motion.frames.iter().flat_map(|frame| &frame.position).map(|&place| scaled(place));
    let (x, y) = view.axes(all.map(|[x, y]| (f64::from(x), f64::from(y))));
    let mast = 0.25 * y.limits.map_or(0.0, |(_, upper)| upper);
    let sides: &[f64] = if view.mirrored { &[1.0, -1.0] } else { &[1.0] };
    let line = |points: Vec<(f64, f64)>| Series::new("", Mark::Reference, 0, points);
    let frames = motion.frames.iter().map(|frame| {
        let mut picture = AnimationFrame {
            title: format!("{},  front at x = {:.2} {}", view.clock(frame.time), frame.front / unit, view.unit),
            points: Vec::new(),
            values: Vec::new(),
            // what was left out is made up for by the area of what was kept
            diameter: view.spacing / unit / motion.share.sqrt(),
            lines: Vec::new(),
        };
        for &side in sides {
            picture.points.extend(frame.position.iter().map(|&place| scaled(place)).map(|[x, y]| [side as f32 * x, y]));
            picture.values.extend(&frame.speed);
            let end = frame.surface.iter().rposition(|point| point[1] > 0.0).map_or(0, |last| last + 2);
            let surface = frame.surface.iter().take(end).map(|&point| scaled(point));
            picture.lines.push(line(surface.map(|[x, y]| (side * f64::from(x), f64::from(y))).collect()));
            let front = side * frame.front / unit;
            picture.lines.push(line(vec![(front, 0.0), (front, mast)]));
        }
        picture
    });
    let speeds = motion.frames.iter().flat_map(|frame| &frame.speed).copied().map(f64::from).collect();
    Animation {
        name: name.to_owned(),
        caption: caption.to_owned(),
        x,
        y,
        label: "|v| [m/s]".to_owned(),
        limits: (0.0, upper_end(speeds)),
        seconds_per_frame: SECONDS_PER_FRAME,
        frames: frames.collect(),
    }
}

/// Speed on the left and pressure on the right of the plane of symmetry, one panel a frame, on the same scales.
pub(in crate::cases) fn halves(name: &str, caption: &str, frames: &[&Frame], view: &View) -> Figure {
    let unit = view.unit_length;
    let places = |frame: &Frame, side: f64| -> Vec<(f64, f64)> {
        frame.position.iter().map(|x| (side * x[0] / unit, x[1] / unit)).collect()
    };
    let (x, y) = view.axes(frames.iter().flat_map(|frame| places(frame, 1.0)));
    let fastest = upper_end(frames.iter().flat_map(|frame| speeds(frame)).collect());
    let deepest = upper_end(frames.iter().flat_map(|frame| pressures(frame)).collect());
    let mut panels: Vec<Panel> = Vec::new();
    for frame in frames {
        let mut panel = Panel::new(&view.clock(frame.time), x.clone(), y.clone());
        let field = |points, values, label: &str, limit| Field {
            points,
            values,
            // the scales are the same in all panels, so their bars stand over the first
            label: if panels.is_empty() { label.to_owned() } else { String::new() },
            diameter: view.spacing / unit,
            limits: Some((0.0, limit)),
        };
        panel.field = Some(field(places(frame, -1.0), speeds(frame), "|v| [m/s]", fastest));
        panel.opposite = Some(field(places(frame, 1.0), pressures(frame), "p [kPa]", deepest));
        panels.push(panel);
    }
    Figure { name: name.to_owned(), caption: caption.to_owned(), panels, columns: 1 }
}

/// Speeds `[m/s]`.
pub(in crate::cases) fn speeds(frame: &Frame) -> Vec<f64> {
    let velocity = frame.vectors.iter().find(|(name, _, _)| name == "velocity");
    velocity.map_or(Vec::new(), |(_, _, v)| v.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).collect())
}

/// Pressures `[kPa]`.
pub(in crate::cases) fn pressures(frame: &Frame) -> Vec<f64> {
    let pressure = frame.scalars.iter().find(|(name, _, _)| name == "pressure");
    pressure.map_or(Vec::new(), |(_, _, p)| p.iter().map(|p| p * 1e-3).collect())
}

/// The frame whose time is nearest.
pub(in crate::cases) fn nearest(frames: &[Frame], time: f64) -> Option<&Frame> {
    frames.iter().min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
}

/// The end of a colour scale: the value that all but a few lie below.
fn upper_end(mut values: Vec<f64>) -> f64 {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    let place = (SPANNED * values.len() as f64) as usize;
    values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(1.0).max(f64::MIN_POSITIVE)
}
