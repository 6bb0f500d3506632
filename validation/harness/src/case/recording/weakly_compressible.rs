//! Records of weakly compressible simulations.

use super::{Recordable, RecordedState, Restartable, picture};
use crate::observation::Frame;
use bagnold_solver::run::{ContinueError, Observer, RunProgress, SceneError, StopReason};
use bagnold_solver::vector::{Vector, equivalent_shear_stress, shear_rate};
use bagnold_solver::weakly_compressible::SavedSimulation;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

impl<const D: usize> RecordedState for Snapshot<D> {
    fn bits(&self) -> Vec<u8> {
        self.to_bytes()
    }

    fn frame(&self) -> Frame {
        Frame::of_flow(self)
    }
}

impl<const D: usize> Recordable for Simulation<D>
where
    Self: Compiled<D>,
{
    type State = Snapshot<D>;

    fn state(&self) -> Snapshot<D> {
        self.snapshot()
    }

    fn picture(&self) -> Frame {
        picture::of_flow(self)
    }

    fn walls(&self) -> Option<Frame> {
        picture::of_walls(self)
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

impl<const D: usize> Restartable<D> for Simulation<D>
where
    Self: Compiled<D>,
{
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

    fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> StopReason<D> {
        self.follow(course, observer)
    }
}

impl Frame {
    /// A picture of the flow, in the plane or in space.
    #[must_use]
    pub fn of_flow<const D: usize>(snapshot: &Snapshot<D>) -> Self {
        let flat = |v: &Vector<D>| [v[0], v[1], if D == 3 { v[2] } else { 0.0 }];
        Self {
            time: snapshot.time,
            position: snapshot.position.iter().map(flat).collect(),
            scalars: vec![
                ("pressure".to_owned(), "Pa".to_owned(), snapshot.pressure.clone()),
                ("density".to_owned(), "kg/m³".to_owned(), snapshot.density.clone()),
                ("mass".to_owned(), "kg".to_owned(), snapshot.mass.clone()),
                ("shear_stress".to_owned(), "Pa".to_owned(), snapshot.stress.iter().map(|s| s[(0, 1)]).collect()),
                ("viscosity".to_owned(), "Pa·s".to_owned(), apparent_viscosities(snapshot)),
                (
                    "shear_rate".to_owned(),
                    "1/s".to_owned(),
                    snapshot.velocity_gradient.iter().map(shear_rate).collect(),
                ),
            ],
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), snapshot.velocity.iter().map(flat).collect())],
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
