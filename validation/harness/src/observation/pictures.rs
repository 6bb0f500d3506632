//! Pictures of the particles of a heap: animations, and pictures with speed on one side and pressure on the other.

use super::{Frame, MotionFrame, MotionSequence};
use crate::figure::{Animation, AnimationFrame, Axis, Field, Figure, Mark, Panel, Series};

/// Share of all speeds that the colours span: single grains of spray would leave no colour to the heap.
const SPANNED: f64 = 0.998;
/// Time that a picture of an animation is shown `[s]`.
const SECONDS_PER_FRAME: f64 = 0.08;

/// Units of length and time of a heap's pictures, and the part of the heap that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// Unit of length `[m]`.
    pub unit_length: f64,
    /// Symbol, such as `r0`; `m` where it is a metre.
    pub unit: &'static str,
    /// √(h_0/g) `[s]`.
    pub time_scale: f64,
    /// Particle spacing `[m]`.
    pub spacing: f64,
    /// Whether x = 0 is a plane of symmetry, behind which the other half is drawn.
    pub mirrored: bool,
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
        x.1 += 0.02 * (x.1 - x.0) + margin;
        y.1 += 0.05 * (y.1 - y.0) + margin;
        x.0 = if self.mirrored { -x.1 } else { x.0 - margin };
        (self.axis("x", x), self.axis("y", y))
    }

    /// Time in seconds, with a given number of decimals, and in free-fall times.
    fn clock(&self, time: f64, decimals: usize) -> String {
        format!("t = {time:.decimals$} s = {:.2} √(h0/g)", time / self.time_scale)
    }
}

/// The animation of a run: particles in the colours of their speed, dashed the thickness by volume and the front.
pub fn animation(name: &str, caption: &str, motion: &MotionSequence, view: &View) -> Animation {
    let unit = view.unit_length;
    let scaled = |[x, y]: [f32; 2]| [(f64::from(x) / unit) as f32, (f64::from(y) / unit) as f32];
    let all = motion.frames.iter().flat_map(|frame| &frame.position).map(|&place| scaled(place));
    let (x, y) = view.axes(all.map(|[x, y]| (f64::from(x), f64::from(y))));
    let mast = 0.25 * y.limits.map_or(0.0, |(_, upper)| upper);
    let sides: &[f64] = if view.mirrored { &[1.0, -1.0] } else { &[1.0] };
    let line = |points: Vec<(f64, f64)>| Series::new("", Mark::Reference, 0, points);
    let frames = moving(motion).map(|frame| {
        let mut picture = AnimationFrame {
            title: format!("{}, front at x = {:.2} {}", view.clock(frame.time, 3), frame.front / unit, view.unit),
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

/// The frames while anything moves at more than a fiftieth of the largest speed, and the last one.
fn moving(motion: &MotionSequence) -> impl Iterator<Item = &MotionFrame> {
    let fastest = |frame: &MotionFrame| frame.speed.iter().copied().fold(0.0, f32::max);
    let limit = 0.02 * motion.frames.iter().map(fastest).fold(0.0, f32::max);
    let end = motion.frames.iter().rposition(|frame| fastest(frame) > limit).map_or(0, |last| last + 1);
    let last = motion.frames.len().saturating_sub(1);
    motion.frames.iter().take(end.min(last)).chain(motion.frames.last())
}

/// Speed on the left and pressure on the right of the plane of symmetry, one panel a frame, on the same scales.
pub fn halves(name: &str, caption: &str, frames: &[&Frame], view: &View) -> Figure {
    let unit = view.unit_length;
    let places = |frame: &Frame, side: f64| -> Vec<(f64, f64)> {
        frame.position.iter().map(|x| (side * x[0] / unit, x[1] / unit)).collect()
    };
    let (x, y) = view.axes(frames.iter().flat_map(|frame| places(frame, 1.0)));
    let fastest = upper_end(frames.iter().flat_map(|frame| frame.speeds()).collect());
    let deepest = upper_end(frames.iter().flat_map(|frame| frame.pressures()).collect());
    let mut panels: Vec<Panel> = Vec::new();
    for frame in frames {
        let mut panel = Panel::new(&view.clock(frame.time, 2), x.clone(), y.clone());
        let field = |points: Vec<(f64, f64)>, values: Vec<f64>, label: &str, limit| {
            Field::new(label, view.spacing / unit, (0.0, limit), points, values)
        };
        panel.field = Some(field(places(frame, -1.0), frame.speeds(), "|v| [m/s]", fastest));
        panel.opposite = Some(field(places(frame, 1.0), frame.pressures(), "p [kPa]", deepest));
        panels.push(panel);
    }
    Figure::new(name, caption, panels).in_columns(1)
}

/// The end of a colour scale: the value that all but a few lie below.
fn upper_end(mut values: Vec<f64>) -> f64 {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    let place = (SPANNED * values.len() as f64) as usize;
    values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(1.0).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View = View { unit_length: 0.1, unit: "r0", time_scale: 0.1, spacing: 0.01, mirrored: true };

    /// One particle that runs 0.05 m a frame and stops.
    fn motion() -> MotionSequence {
        let frame = |(index, speed): (usize, f32)| MotionFrame {
            time: 0.01 * index as f64,
            position: vec![[0.05 * index as f32, 0.0]],
            speed: vec![speed],
            surface: vec![[0.0, 0.01], [0.1, 0.0], [0.2, 0.0]],
            front: 0.1,
        };
        MotionSequence { frames: [0.0, 1.0, 2.0, 0.01, 0.01].into_iter().enumerate().map(frame).collect(), share: 0.25 }
    }

    #[test]
    fn an_animation_has_both_halves_fixed_axes_and_ends_with_the_motion() {
        let moving = animation("a", "", &motion(), &VIEW);
        // what stands still at the start belongs to it, of the rest at the end only the last picture is left
        assert_eq!(moving.frames.len(), 4);
        assert_eq!(moving.frames[1].points, [[0.5, 0.0], [-0.5, 0.0]]);
        assert_eq!(moving.frames[1].title, "t = 0.010 s = 0.10 √(h0/g), front at x = 1.00 r0");
        // a quarter of the particles with twice the diameter
        assert!((moving.frames[0].diameter - 0.2).abs() < 1e-12);
        let (left, right) = moving.x.limits.expect("fixed");
        assert!(left == -right && right > 2.0 && moving.limits == (0.0, 2.0));
        // surface and front on both sides; the surface ends where it meets the bed
        assert_eq!(moving.frames[0].lines.len(), 4);
        assert_eq!(moving.frames[0].lines[0].points.len(), 2);
        let one_sided = animation("a", "", &motion(), &View { mirrored: false, unit: "m", unit_length: 1.0, ..VIEW });
        assert_eq!((one_sided.frames[0].points.len(), one_sided.x.label.as_str()), (1, "x [m]"));
        assert!(animation("a", "", &MotionSequence::default(), &VIEW).frames.is_empty());
    }

    #[test]
    fn halves_show_speed_left_and_pressure_right_on_shared_scales() {
        let frame = |time: f64, u: f64| Frame {
            time,
            position: vec![[0.05, 0.02, 0.0]],
            scalars: vec![("pressure".to_owned(), "Pa".to_owned(), vec![2000.0])],
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), vec![[u, 0.0, 0.0]])],
        };
        let frames = [frame(0.0, 0.5), frame(0.1, 1.5)];
        assert_eq!(Frame::nearest(&frames, 0.08), Some(&frames[1]));
        let figure = halves("h", "", &[&frames[0], &frames[1]], &VIEW);
        assert_eq!(figure.panels.len(), 2);
        for panel in &figure.panels {
            let (speed, pressure) = (panel.field.as_ref().expect("speed"), panel.opposite.as_ref().expect("pressure"));
            assert_eq!((speed.points[0].0, pressure.points[0].0), (-0.5, 0.5));
            assert_eq!((speed.limits, pressure.limits), (Some((0.0, 1.5)), Some((0.0, 2.0))));
        }
    }
}
