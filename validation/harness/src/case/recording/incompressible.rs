//! Records of incompressible simulations.

use super::{Recordable, RecordedState, Restartable, picture};
use crate::observation::Frame;
use bagnold_solver::incompressible::{
    IncompressibleScene, IncompressibleSimulation, IncompressibleSnapshot, PhaseSnapshot, SavedIncompressible,
};
use bagnold_solver::run::{ContinueError, Observer, RunProgress, SceneError, StopReason};
use bagnold_solver::vector::Vector;

impl<const D: usize> RecordedState for IncompressibleSnapshot<D> {
    fn bits(&self) -> Vec<u8> {
        self.to_bytes()
    }

    fn frame(&self) -> Frame {
        Frame::of_phases(self)
    }
}

impl Recordable for IncompressibleSimulation<2> {
    type State = IncompressibleSnapshot<2>;

    fn state(&self) -> IncompressibleSnapshot<2> {
        self.snapshot()
    }

    fn picture(&self) -> Frame {
        picture::of_phases(self)
    }

    fn walls(&self) -> Option<Frame> {
        picture::of_floor(self)
    }

    fn particles(&self) -> usize {
        self.free_particles()
    }

    fn steps(&self) -> u64 {
        self.steps()
    }

    fn time(&self) -> f64 {
        self.time()
    }
}

impl Restartable<2> for IncompressibleSimulation<2> {
    type Scene = IncompressibleScene<2>;
    type Saved = SavedIncompressible<2>;

    fn begin(scene: IncompressibleScene<2>) -> Result<Self, SceneError> {
        Self::new(scene)
    }

    fn continued(scene: IncompressibleScene<2>, saved: Self::Saved) -> Result<Self, ContinueError> {
        Self::continued(scene, saved)
    }

    fn saved(&self) -> impl serde::Serialize {
        self.save()
    }

    fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> StopReason<2> {
        self.follow(course, observer)
    }
}

impl Frame {
    /// A picture of both phases, the fluid's particles first; `phase` is 0 for the fluid and 1 for the sediment.
    #[must_use]
    pub fn of_phases<const D: usize>(snapshot: &IncompressibleSnapshot<D>) -> Self {
        let phases = [&snapshot.fluid, &snapshot.sediment];
        let flat = |v: &Vector<D>| [v[0], v[1], if D == 3 { v[2] } else { 0.0 }];
        let joined = |array: fn(&PhaseSnapshot<D>) -> &Vec<Vector<D>>| {
            phases.iter().flat_map(|phase| array(phase)).map(flat).collect::<Vec<_>>()
        };
        let scalar = |array: fn(&PhaseSnapshot<D>) -> &Vec<f64>| {
            phases.iter().flat_map(|phase| array(phase)).copied().collect::<Vec<f64>>()
        };
        let counts = phases.map(|phase| phase.position.len());
        let phase = [0.0, 1.0].iter().zip(counts).flat_map(|(&phase, count)| std::iter::repeat_n(phase, count));
        Self {
            time: snapshot.time,
            position: joined(|phase| &phase.position),
            scalars: vec![
                ("pressure".to_owned(), "Pa".to_owned(), scalar(|phase| &phase.pressure)),
                ("concentration".to_owned(), "-".to_owned(), scalar(|phase| &phase.concentration)),
                ("phase".to_owned(), "-".to_owned(), phase.collect()),
            ],
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), joined(|phase| &phase.velocity))],
        }
    }
}
