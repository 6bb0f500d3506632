//! How displaced particles come to rest before a run starts.

use crate::checkpoint::is_interrupted;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::{Scene, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Preparation before the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Preparation {
    /// The displaced particles settle without friction and without flowing.
    Settled,
    /// The same, and a layer with a free surface that has sunk meanwhile is raised to its height again.
    Raised,
    /// Nothing: the run starts with the particles as they were displaced.
    None,
}

/// Peaks of the kinetic energy after which the layer counts as settled.
const PEAKS: usize = 12;
/// Longest settling, in times that sound needs across the layer `[-]`.
const LONGEST: f64 = 60.0;

/// Lets the particles of a scene at rest find their places.
///
/// Displaced particles do not support each other as the lattice did: released at once the layer drops by a few
/// parts in a thousand, is weightless meanwhile, and so without friction, and picks up speed that no continuum has.
/// The layer settles as a frictionless liquid under the gravity across it, and whenever its kinetic energy passes a
/// peak all velocities are set to zero (dynamic relaxation).
pub(crate) fn settled(scene: Scene<2>) -> Result<Scene<2>, SceneError> {
    let height = scene.flow.position.iter().fold(0.0_f64, |most, x| most.max(x[1]));
    let limit = LONGEST * height / scene.equation_of_state.sound_speed();
    let mut resting = scene.clone();
    resting.rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
    resting.gravity = Vector::<2>::new(0.0, scene.gravity[1]);
    let mut elapsed = 0.0;
    for _ in 0..PEAKS {
        let mut simulation = Simulation::new(resting.clone())?;
        let mut highest = 0.0_f64;
        while elapsed + simulation.time() < limit {
            // the run itself will say what is wrong with this start, and does not begin where the program is to end
            if is_interrupted() || simulation.step().is_err() {
                return Ok(scene);
            }
            let energy = kinetic_energy(&simulation);
            if energy < highest {
                break;
            }
            highest = energy;
        }
        elapsed += simulation.time();
        let snapshot = simulation.snapshot();
        resting.flow.position = snapshot.position;
        resting.flow.density = snapshot.density;
        resting.flow.velocity.fill(Vector::<2>::zeros());
        resting.flow.stress.fill(Tensor::<2>::zeros());
    }
    let flow = resting.flow;
    Ok(Scene { flow, ..scene })
}

/// Raises a settled layer to the height `[m]` that it was made for.
///
/// Particles that lost the lattice find closer places: by 0.02, 0.23 and 2.3 % of the height where they were displaced by up
/// to 0.02, 0.1 and 0.3 spacings, whatever the spacing, with a smoothing length of 1.5 spacings; by 0.07 instead of 0.23 % with
/// 2. The density that the continuity equation carries along does not know of it, since sums over displaced neighbours are
/// not consistent with constants. A layer that stays that low flows as a lower one would at every resolution, as
/// the square of its height for a liquid. Raised, it has the volume again that its mass and density say.
pub(crate) fn raised(mut scene: Scene<2>, height: f64) -> Scene<2> {
    let position = &mut scene.flow.position;
    let mean = position.iter().map(|x| x[1]).sum::<f64>() / position.len().max(1) as f64;
    // all particles of a layer have the same volume
    let factor = 0.5 * height / mean;
    if factor.is_finite() {
        position.iter_mut().for_each(|x| x[1] *= factor);
    }
    scene
}

fn kinetic_energy(simulation: &Simulation<2>) -> f64 {
    let particles = simulation.particles();
    let flow = particles.flow_count();
    particles.mass[..flow].iter().zip(&particles.velocity[..flow]).map(|(m, v)| 0.5 * m * v.norm_squared()).sum()
}
