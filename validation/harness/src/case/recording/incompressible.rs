//! Records of incompressible simulations.

use super::picture::{self, flat, named};
use super::{Restartable, Stop};
use crate::case::ParameterError;
use crate::observation::Frame;
use bagnold_solver::incompressible::{
    IncompressibleScene, IncompressibleSimulation, IncompressibleSnapshot, PhaseSnapshot, SavedIncompressible,
};
use bagnold_solver::run::{ContinueError, Observer, RunProgress, SceneError};
use bagnold_solver::vector::Vector;

impl Restartable for IncompressibleSimulation<2> {
    type State = IncompressibleSnapshot<2>;
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

    fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> Result<Stop, ParameterError> {
        Stop::of(self.follow(course, observer))
    }

    fn state(&self) -> IncompressibleSnapshot<2> {
        self.snapshot()
    }

    fn bits(state: &IncompressibleSnapshot<2>) -> Vec<u8> {
        state.to_bytes()
    }

    fn frame(state: &IncompressibleSnapshot<2>) -> Frame {
        Frame::of_phases(state)
    }

    fn pictures(&self) -> (Frame, Option<Frame>) {
        (picture::of_phases(self), picture::of_floor(self))
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

impl Frame {
    /// A picture of both phases, the fluid's particles first; `phase` is 0 for the fluid and 1 for the sediment.
    pub fn of_phases<const D: usize>(snapshot: &IncompressibleSnapshot<D>) -> Self {
        let phases = [&snapshot.fluid, &snapshot.sediment];
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
                named("pressure", "Pa", scalar(|phase| &phase.pressure)),
                named("concentration", "-", scalar(|phase| &phase.concentration)),
                named("phase", "-", phase.collect()),
            ],
            vectors: vec![named("velocity", "m/s", joined(|phase| &phase.velocity))],
        }
    }
}
