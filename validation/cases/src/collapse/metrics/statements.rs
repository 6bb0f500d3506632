//! What the collapse paper says of single columns at single times: fast grains that come to rest, a top that falls as it is, and a
//! flow like a plug at the foot.

use super::quantities::*;
use crate::case::Flow;
use crate::collapse::interior::Station;
use crate::collapse::{BIN_WIDTH, Collapse, ColumnFlow, Material};
use crate::metric::{Confidence, Metric};
use crate::observation::{Frame, Recorded};

/// Aspect ratio, and the times `[s]` between which fast grains get fewer.
const FAST: (f64, [f64; 2]) = (0.9, [0.07, 0.11]);
/// Aspect ratio, and the time `[s]` at which the top still has its shape.
const TOP: (f64, f64) = (4.8, 0.2);
/// Part of a column that is its top `[-]`.
const TOP_SHARE: f64 = 0.25;
/// Depth below the surface that belongs to it, in spacings `[-]`.
const SURFACE: f64 = 2.0;
/// Speed of fast grains over the largest at the first time `[-]`.
const FAST_SHARE: f64 = 0.5;
/// Time at which the foot is looked at over √(h_0/g) `[-]`, and its place on the way from the column's edge to the front `[-]`.
const FOOT: (f64, f64) = (1.5, 0.9);
/// How far the nearest picture may be off its time `[s]`.
const SAME_TIME: f64 = 5e-3;

/// The statements of a column that has pictures for them.
pub(super) fn of_run<const D: usize>(run: &ColumnFlow<D>, record: &Recorded<Collapse>) -> Vec<Metric> {
    if D != 2 || !matches!(run.made_of(), Material::SAND | Material::GLASS) {
        return Vec::new();
    }
    let at = |time: f64| Frame::nearest(&record.frames, time).filter(|frame| (frame.time - time).abs() < SAME_TIME);
    let mut metrics = Vec::new();
    let stated = |metric: Metric, statement: &str| {
        metric.against(None, statement, Confidence::Medium).with_snapshot_tolerance(0.02, 0.02)
    };
    let [first, second] = FAST.1.map(at);
    if let (true, Some(first), Some(second)) = (run.aspect_ratio == FAST.0, first, second) {
        metrics.push(stated(
            FAST_UPSTREAM_RATIO.of(&run.variant(), fast_upstream(run, first, second)),
            "statement of the collapse paper: at 0.11 s fewer fast grains are upstream on the surface than at 0.07 s",
        ));
    }
    if let (true, Some(start), Some(frame)) = (run.aspect_ratio == TOP.0, record.frames.first(), at(TOP.1)) {
        metrics.push(stated(
            TOP_DISTORTION.of(&run.variant(), 100.0 * distortion_of_top(start, frame) / run.half_width),
            "statement of the collapse paper: the upper part falls without a change of its shape, still seen at 0.2 s",
        ));
    }
    let plug = "statement of the collapse paper: near the foot of the column the flow is like a plug";
    let ratio = foot_velocity_ratio(run, record).map(|ratio| FOOT_VELOCITY_RATIO.of(&run.variant(), ratio));
    metrics.extend(ratio.map(|ratio| stated(ratio, plug)));
    metrics
}

/// Fast grains within the initial half width and at the surface: their number at the second time over that at the first.
fn fast_upstream<const D: usize>(run: &ColumnFlow<D>, first: &Frame, second: &Frame) -> f64 {
    let speeds = first.speeds();
    let fast = FAST_SHARE * speeds.iter().copied().fold(0.0, f64::max);
    let count = |frame: &Frame| {
        let width = BIN_WIDTH * run.half_width;
        let bin = |x: f64| (x / width).max(0.0) as usize;
        let mut tops = vec![0.0_f64; bin(run.half_width) + 1];
        let inside: Vec<usize> = (0..frame.position.len()).filter(|&k| frame.position[k][0] < run.half_width).collect();
        for &k in &inside {
            let top = &mut tops[bin(frame.position[k][0])];
            *top = top.max(frame.position[k][1]);
        }
        let at_surface = |k: usize| frame.position[k][1] > tops[bin(frame.position[k][0])] - SURFACE * run.spacing();
        let speeds = frame.speeds();
        inside.iter().filter(|&&k| at_surface(k) && speeds[k] > fast).count() as f64
    };
    count(second) / count(first)
}

/// Root mean square of the displacements of the grains of the top less their mean `[m]`.
fn distortion_of_top(start: &Frame, frame: &Frame) -> f64 {
    let highest = start.position.iter().map(|x| x[1]).fold(0.0, f64::max);
    let top: Vec<usize> =
        (0..start.position.len()).filter(|&k| start.position[k][1] > (1.0 - TOP_SHARE) * highest).collect();
    let way = |k: usize, axis: usize| frame.position[k][axis] - start.position[k][axis];
    let variance = |axis: usize| {
        let mean = top.iter().map(|&k| way(k, axis)).sum::<f64>() / top.len() as f64;
        top.iter().map(|&k| (way(k, axis) - mean).powi(2)).sum::<f64>() / top.len() as f64
    };
    (variance(0) + variance(1)).sqrt()
}

/// Velocity of the lowest row near the front over that of the fastest row there, in mid-collapse; none where there is but one row.
fn foot_velocity_ratio<const D: usize>(run: &ColumnFlow<D>, record: &Recorded<Collapse>) -> Option<f64> {
    let time = FOOT.0 * run.time_scale();
    let frame = Frame::nearest(&record.frames, time)?;
    let place = 1.0 + FOOT.1 * (record.data.front[record.data.nearest(time)?] - 1.0);
    let station = Station::of(frame, place * run.half_width, BIN_WIDTH * run.half_width, run.spacing());
    let fastest = station.profile.iter().map(|point| point.1).fold(0.0, f64::max);
    (station.profile.len() > 1 && fastest > 0.0).then(|| station.profile[0].1 / fastest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(position: Vec<[f64; 3]>) -> Frame {
        Frame { time: 0.0, position, scalars: Vec::new(), vectors: Vec::new() }
    }

    #[test]
    fn a_top_that_falls_as_a_whole_is_not_distorted_and_one_that_spreads_is() {
        let start: Vec<[f64; 3]> = (0..400).map(|k| [f64::from(k % 10), f64::from(k / 10), 0.0]).collect();
        let fallen = start.iter().map(|x| [x[0], x[1] - 3.0, 0.0]).collect();
        assert!(distortion_of_top(&frame(start.clone()), &frame(fallen)) < 1e-12);
        // twice as wide: displacements of 0 to 9 with the deviation √(99/12)
        let spread = start.iter().map(|x| [2.0 * x[0], x[1] - 3.0, 0.0]).collect();
        let expected = (99.0_f64 / 12.0).sqrt();
        assert!((distortion_of_top(&frame(start), &frame(spread)) - expected).abs() < 1e-12);
    }
}
