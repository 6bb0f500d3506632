//! Watches a heap while it spreads: survey, animation, pictures at their times, and whether it has come to rest.

use super::camera::Camera;
use super::deposit::{AT_REST, Collapse, Surveyor};
use crate::observation::Frame;
use bagnold_solver::weakly_compressible::Snapshot;
use serde::{Deserialize, Serialize};

/// Observer of a run.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct CollapseObserver {
    /// Measures every snapshot.
    surveyor: Surveyor,
    /// Takes the frames of the animation.
    camera: Camera,
    /// Times of the pictures `[s]`, rising.
    times: Vec<f64>,
    /// Time before which no heap has come to rest `[s]`.
    earliest_rest: f64,
    /// Particles at the times shown in figures.
    pub(crate) frames: Vec<Frame>,
    /// How many of the times have passed.
    passed: usize,
}

impl CollapseObserver {
    /// Initial state; takes a frame of the animation every `frame_interval` `[s]`.
    pub(crate) fn new(surveyor: Surveyor, frame_interval: f64, times: Vec<f64>, earliest_rest: f64) -> Self {
        let camera = Camera::new(frame_interval, surveyor.spacing);
        Self { surveyor, camera, times, earliest_rest, frames: Vec::new(), passed: 0 }
    }

    /// Observes a snapshot; returns the thickness over r_0, bin by bin, and whether the heap is at rest.
    pub(crate) fn observe<const D: usize>(&mut self, snapshot: &Snapshot<D>) -> (Vec<(f64, f64)>, bool) {
        let thickness = self.surveyor.observe(snapshot);
        let r = self.surveyor.half_width;
        let front = self.surveyor.collapse.front.last().copied().unwrap_or(0.0);
        if self.camera.is_due(snapshot.time) {
            self.camera.take(snapshot, thickness.iter().map(|(x, h)| (x * r, h * r)), front * r);
        }
        let passed = self.times.iter().filter(|&&time| snapshot.time >= time).count();
        if passed > self.passed {
            self.passed = passed;
            self.frames.push(Frame::of_flow(snapshot));
        }
        let rests = snapshot.time > self.earliest_rest && self.surveyor.collapse.agitation() < AT_REST;
        (thickness, rests)
    }

    /// Measurements and pictures.
    pub(crate) fn finish<const D: usize>(self, end: &Snapshot<D>) -> Collapse {
        Collapse { motion: self.camera.motion, ..self.surveyor.finish(end) }
    }

    /// The same with a last frame of the deposit.
    pub(crate) fn finish_with_deposit<const D: usize>(mut self, end: &Snapshot<D>) -> Collapse {
        let r = self.surveyor.half_width;
        let collapse = self.surveyor.finish(end);
        let surface = collapse.deposit.iter().map(|(x, h)| (x * r, h * r));
        self.camera.take(end, surface, collapse.deposit_front() * r);
        Collapse { motion: self.camera.motion, ..collapse }
    }
}
