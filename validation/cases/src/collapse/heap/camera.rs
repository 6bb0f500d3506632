//! Takes the frames of an animation during a run.

use crate::observation::{MotionFrame, MotionSequence};
use bagnold_solver::weakly_compressible::Snapshot;
use serde::{Deserialize, Serialize};

/// Most pictures of a run: what comes later is at rest.
const MOST_FRAMES: usize = 60;
/// Most particles of a picture: more would only fill the store, a page shows no more.
const MOST_PARTICLES: f64 = 5000.0;
/// Fractional part of the golden ratio: its multiples spread evenly, whatever the order of the particles.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Takes a picture every `interval`; of a flow in space it sees a slab beside the symmetry plane z = 0.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Camera {
    /// Time between pictures `[s]`.
    pub(crate) interval: f64,
    /// Thickness of the slab `[m]`.
    pub(crate) slab: f64,
    /// Pictures taken so far.
    pub(crate) motion: MotionSequence,
}

impl Camera {
    /// A camera without pictures yet.
    pub(crate) fn new(interval: f64, slab: f64) -> Self {
        Self { interval, slab, motion: MotionSequence::default() }
    }

    /// Whether it is time for a picture.
    pub(crate) fn is_due(&self, time: f64) -> bool {
        let taken = self.motion.frames.len();
        // an observer's times are multiples up to rounding
        taken < MOST_FRAMES && time >= (taken as f64 - 1e-6) * self.interval
    }

    /// Takes a picture; one of the same time is not taken twice. `surface` is a chain of points and `front` a place, both in `[m]`.
    pub(crate) fn take<const D: usize>(
        &mut self,
        snapshot: &Snapshot<D>,
        surface: impl Iterator<Item = (f64, f64)>,
        front: f64,
    ) {
        if self.motion.frames.last().is_some_and(|last| last.time >= snapshot.time) {
            return;
        }
        let seen: Vec<usize> = (0..snapshot.position.len())
            .filter(|&index| D == 2 || snapshot.position[index][D - 1] < self.slab)
            .collect();
        if self.motion.frames.is_empty() {
            self.motion.share = (MOST_PARTICLES / seen.len().max(1) as f64).min(1.0);
        }
        let kept = |index: usize| (index as f64 * GOLDEN).fract() < self.motion.share;
        let mut frame = MotionFrame {
            time: snapshot.time,
            surface: surface.map(|(x, y)| [x as f32, y as f32]).collect(),
            front,
            ..MotionFrame::default()
        };
        for index in seen.into_iter().filter(|&index| kept(index)) {
            let position = &snapshot.position[index];
            frame.position.push([position[0] as f32, position[1] as f32]);
            frame.speed.push(snapshot.velocity[index].norm() as f32);
        }
        self.motion.frames.push(frame);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::vector::Vector;

    fn snapshot<const D: usize>(time: f64, count: usize) -> Snapshot<D> {
        let place = |index: usize| Vector::<D>::repeat(index as f64);
        Snapshot {
            time,
            position: (0..count).map(place).collect(),
            velocity: (0..count).map(place).collect(),
            ..Snapshot::default()
        }
    }

    #[test]
    fn pictures_come_at_their_times_and_the_last_once() {
        let mut camera = Camera::new(0.1, 0.0);
        for step in 0..9 {
            let seen = snapshot::<2>(0.025 * f64::from(step), 3);
            if camera.is_due(seen.time) {
                camera.take(&seen, [(0.0, 1.0)].into_iter(), 2.0);
            }
        }
        camera.take(&snapshot::<2>(0.2, 3), std::iter::empty(), 2.0);
        let times: Vec<f64> = camera.motion.frames.iter().map(|frame| frame.time).collect();
        assert_eq!(times, [0.0, 0.1, 0.2]);
        assert_eq!(camera.motion.frames[1].surface, [[0.0, 1.0]]);
        assert_eq!(camera.motion.frames[1].position.len(), 3);
        assert!((camera.motion.frames[1].speed[2] - 8f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn in_space_only_the_slab_is_seen_and_a_crowd_is_thinned() {
        let mut camera = Camera::new(0.1, 1.5);
        camera.take(&snapshot::<3>(0.0, 5), std::iter::empty(), 0.0);
        assert_eq!(camera.motion.frames[0].position, [[0.0, 0.0], [1.0, 1.0]]);
        let mut camera = Camera::new(0.1, 0.0);
        for time in [0.0, 0.1] {
            camera.take(&snapshot::<2>(time, 20_000), std::iter::empty(), 0.0);
        }
        assert_eq!(camera.motion.share, 0.25);
        let [first, second] = &camera.motion.frames[..] else { panic!("two pictures") };
        assert!(first.position.len().abs_diff(5000) < 10, "{}", first.position.len());
        assert_eq!(first.position, second.position);
    }
}
