//! Records of weakly compressible simulations.

use super::picture::{self, flat, named};
use super::{Restartable, Stop};
use crate::case::ParameterError;
use crate::observation::Frame;
use bagnold_solver::run::{ContinueError, Observer, RunProgress, SceneError};
use bagnold_solver::vector::{equivalent_shear_stress, shear_rate};
use bagnold_solver::weakly_compressible::SavedSimulation;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

impl<const D: usize> Restartable for Simulation<D>
where
    Self: Compiled<D>,
{
    type State = Snapshot<D>;
    type Scene = Scene<D>;
    type Saved = SavedSimulation<'static, D>;

    fn begin(scene: Scene<D>) -> Result<Self, SceneError> {
        Self::new(scene)
    }

    fn continued(scene: Scene<D>, saved: Self::Saved) -> Result<Self, ContinueError> {
        Self::continued(scene, saved)
    }

    fn saved(&self) -> impl serde::Serialize {
        self.save()
    }

    fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> Result<Stop, ParameterError> {
        Stop::of(self.follow(course, observer))
    }

    fn state(&self) -> Snapshot<D> {
        self.snapshot()
    }

    fn bits(state: &Snapshot<D>) -> Vec<u8> {
        state.to_bytes()
    }

    fn frame(state: &Snapshot<D>) -> Frame {
        Frame::of_flow(state)
    }

    fn pictures(&self) -> (Frame, Option<Frame>) {
        (picture::of_flow(self), picture::of_walls(self))
    }

    fn particles(&self) -> usize {
        self.particles().flow_count()
    }

    fn steps(&self) -> u64 {
        self.steps()
    }

    fn time(&self) -> f64 {
        self.time()
    }
}

impl Frame {
    /// A picture of the flow, in the plane or in space.
    pub fn of_flow<const D: usize>(snapshot: &Snapshot<D>) -> Self {
        Self {
            time: snapshot.time,
            position: snapshot.position.iter().map(flat).collect(),
            scalars: vec![
                named("pressure", "Pa", snapshot.pressure.clone()),
                named("density", "kg/m³", snapshot.density.clone()),
                named("mass", "kg", snapshot.mass.clone()),
                named("shear_stress", "Pa", snapshot.stress.iter().map(|s| s[(0, 1)]).collect()),
                named("viscosity", "Pa·s", apparent_viscosities(snapshot)),
                named("shear_rate", "1/s", snapshot.velocity_gradient.iter().map(shear_rate).collect()),
            ],
            vectors: vec![named("velocity", "m/s", snapshot.velocity.iter().map(flat).collect())],
        }
    }
}

/// Shear rate below which an apparent viscosity is no longer told from that of a solid `[1/s]`.
const NO_SHEAR: f64 = 1e-6;

/// Apparent viscosity τ/|γ̇| `[Pa·s]` of every particle.
fn apparent_viscosities<const D: usize>(snapshot: &Snapshot<D>) -> Vec<f64> {
    let viscosity = |(stress, gradient)| equivalent_shear_stress(stress) / shear_rate(gradient).max(NO_SHEAR);
    snapshot.stress.iter().zip(&snapshot.velocity_gradient).map(viscosity).collect()
}
