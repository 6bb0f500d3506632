//! Relaxation of bodies to rest before the clock of a run starts.
//!
//! Displaced particles do not bear each other as the lattice did. Released at once they drop until they do, are weightless
//! meanwhile, and so without friction, and some of that stays as a slow motion for good. Settled bodies start at rest, with the
//! stress that bears them: they move under their own law and between the walls as these are at the start, and whenever their kinetic energy
//! passes a peak, all velocities are set to zero (dynamic relaxation), until a peak is so low that it counts as rest.
//!
//! Bodies that neither walls nor their friction hold never come to that. They are refused by how far a particle has moved.

use super::periods::Periods;
use crate::case::ParameterError;
use crate::checkpoint::is_interrupted;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::FeedRate;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Preparation before the run starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BodyPreparation {
    /// Nothing: the run starts with the particles as they were displaced.
    None,
    /// Bodies come to rest on walls, which stay where they are at the start meanwhile or give way to their loads, and by their friction; they then get their
    /// velocities.
    Settled,
    /// Grains find their places as a liquid does, and start with the stress that holds them: the weight of the material above across
    /// periodic sides and, along these, as much of its shear stress as the static friction bears.
    Stressed,
}

/// Way of a particle from its start after which a body is not held, in spacings `[-]`.
const FARTHEST: f64 = 1.0;
/// Mean way of all particles below which bodies are held, though particles change places, in spacings `[-]`.
const STIRRED: f64 = 0.1;
/// Peaks in a row that have to be low, so that a short swing of some particles is not taken for rest.
pub(super) const LOW_PEAKS: usize = 3;
/// Peaks after which a liquid counts as settled: without friction it swings for long.
const PEAKS_OF_LIQUID: usize = 12;
/// Time without a peak after which a speed below that of rest is taken for creep, in times that sound needs across the scene `[-]`.
const LONGEST_SWING: f64 = 10.0;
/// Usual settling, in times that sound needs across the scene `[-]`: for estimates.
pub(super) const USUAL: f64 = 40.0;
/// Usual settling as a liquid, in the same unit `[-]`.
pub(super) const USUAL_OF_LIQUID: f64 = 4.0;
/// Longest settling, in times that sound needs across the scene `[-]`.
const LONGEST: f64 = 400.0;

/// Criterion of rest for bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestCriterion {
    /// Root mean square of the speed at a peak of the kinetic energy `[m/s]`.
    pub(super) speed: f64,
    /// Number of consecutive peaks that have to be as low.
    pub(super) peaks: usize,
    /// √(g H), by which the speed is given `[m/s]`.
    pub(super) fall: f64,
    /// Time that sound needs across the scene `[s]`.
    pub(super) crossing: f64,
}

/// The scene with its bodies settled, each particle with the velocity of its body, and the time that it took `[s]`.
///
/// # Errors
/// Bodies that are not held or do not come to rest, and a scene that breaks a rule of the solver.
pub(super) fn settled<const D: usize>(scene: Scene<D>, rest: RestCriterion) -> Result<(Scene<D>, f64), ParameterError>
where
    Simulation<D>: Compiled<D>,
{
    let mut resting = scene.clone();
    for wall in &mut resting.enclosure.walls {
        // it keeps its table, so that its corners are not joined to those of walls at rest
        wall.motion.displacements.fill(Vector::zeros());
        wall.motion.turn.iter_mut().for_each(|turn| turn.angles.fill(Vector::zeros()));
    }
    for inlet in &mut resting.enclosure.inlets {
        inlet.rate = FeedRate::closed();
    }
    let (mut elapsed, mut low) = (0.0, 0);
    loop {
        resting.flow.velocity.fill(Vector::zeros());
        let mut simulation = Simulation::new(resting.clone())?;
        let mut peak = 0.0_f64;
        loop {
            // a run does not begin where the program is to end
            if is_interrupted() {
                return Ok((scene, elapsed));
            }
            if let Err(divergence) = simulation.step() {
                let defect = format!("the simulation diverges while the bodies settle ({divergence})");
                let remedy = "remove `preparation` to see the start of the divergence";
                return Err(refused_for(&defect, remedy));
            }
            let speed = rms_speed(&simulation);
            let creeps = speed <= rest.speed && simulation.time() > LONGEST_SWING * rest.crossing;
            if speed <= peak || creeps {
                break;
            }
            peak = speed;
            if elapsed + simulation.time() > LONGEST * rest.crossing {
                let after = LONGEST * rest.crossing;
                let value = format!("after {after:.2} s the bodies still move {}", against_rest(peak, rest));
                return Err(refused_for(&value, &raise(peak, rest)));
            }
        }
        elapsed += simulation.time();
        let snapshot = simulation.snapshot();
        for (wall, pose) in resting.enclosure.walls.iter_mut().zip(simulation.facet_wall_poses()) {
            wall.motion.load.iter_mut().for_each(|load| load.travel = pose.shift.dot(&load.direction));
        }
        check_held(&resting, &scene.flow.position, &snapshot.position, (peak, rest))?;
        let flow = &mut resting.flow;
        (flow.position, flow.density, flow.stress) = (snapshot.position, snapshot.density, snapshot.stress);
        low = if peak <= rest.speed { low + 1 } else { 0 };
        if low == rest.peaks {
            resting.flow.velocity = scene.flow.velocity.clone();
            return Ok((begun(scene, resting), elapsed));
        }
    }
}

/// The scene with its particles in the places of a liquid that comes to rest under gravity `across` periodic sides alone `[m/s²]`, and the
/// time that it took `[s]`. Their stress is that of the scene.
///
/// # Errors
/// Those of [`settled`].
pub(super) fn stressed<const D: usize>(
    scene: Scene<D>,
    across: Vector<D>,
    rest: RestCriterion,
) -> Result<(Scene<D>, f64), ParameterError>
where
    Simulation<D>: Compiled<D>,
{
    let rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
    let mut liquid = Scene { rheology, gravity: across, ..scene.clone() };
    liquid.flow.stress.fill(Tensor::zeros());
    let (mut liquid, elapsed) =
        settled(liquid, RestCriterion { speed: f64::INFINITY, peaks: PEAKS_OF_LIQUID, ..rest })?;
    liquid.flow.stress = scene.flow.stress.clone();
    Ok((begun(scene, liquid), elapsed))
}

/// A scene with the flow of another one at rest, and with the travels of its walls under loads.
fn begun<const D: usize>(mut scene: Scene<D>, resting: Scene<D>) -> Scene<D> {
    for (wall, at_rest) in scene.enclosure.walls.iter_mut().zip(&resting.enclosure.walls) {
        wall.motion.load = at_rest.motion.load;
    }
    Scene { flow: resting.flow, ..scene }
}

/// Root mean square of the speed of the flow `[m/s]`.
fn rms_speed<const D: usize>(simulation: &Simulation<D>) -> f64 {
    let particles = simulation.particles();
    let flow = particles.flow_count();
    let (mass, velocity) = (&particles.mass[..flow], &particles.velocity[..flow]);
    let squares: f64 = mass.iter().zip(velocity).map(|(m, v)| m * v.norm_squared()).sum();
    (squares / mass.iter().sum::<f64>()).sqrt()
}

/// Refuses bodies of which a particle has left its start or gone farther than a spacing and the way of loads, at a root mean square of the
/// speed `[m/s]`.
fn check_held<const D: usize>(
    scene: &Scene<D>,
    starts: &[Vector<D>],
    places: &[Vector<D>],
    (speed, rest): (f64, RestCriterion),
) -> Result<(), ParameterError> {
    if places.len() < starts.len() {
        let left = starts.len() - places.len();
        return Err(refused_for(&format!("{left} particles leave by open sides before the bodies rest"), SUPPORT));
    }
    let periods = Periods::of(&scene.domain.axes);
    // what has wrapped at periodic sides is near its start beyond them
    let ways: Vec<_> =
        starts.iter().zip(places).map(|(start, place)| periods.unwrapped(place, start).0 - start).collect();
    let far = |one: &usize, other: &usize| ways[*one].norm().total_cmp(&ways[*other].norm());
    let loads = scene.enclosure.walls.iter().filter_map(|wall| wall.motion.load.as_ref());
    let farthest = loads.map(|load| load.travel.abs()).fold(0.0, f64::max) + FARTHEST * scene.spacing;
    let Some(index) = (0..ways.len()).max_by(far).filter(|index| ways[*index].norm() > farthest) else {
        return Ok(());
    };
    let parts: Vec<String> = starts[index].iter().map(|part| format!("{part:.4}")).collect();
    let from = parts.join(", ");
    let moves = format!("particle initially at ({from}) m moves more than a spacing ({} m)", scene.spacing);
    if rest.speed.is_infinite() {
        let remedy = "support the bodies with walls, or set `preparation` to \"settled\"";
        return Err(refused_for(&format!("{moves} while settling as a liquid"), remedy));
    }
    let (across, along) = periods.split(&scene.gravity);
    let mean = ways.iter().sum::<Vector<D>>() / ways.len() as f64;
    if along.norm() > 0.0 {
        let pressure = rest.fall.powi(2) * scene.equation_of_state.reference_density;
        let held = scene.rheology.strength_at_rest(pressure).map_or(0.0, |strength| strength / pressure);
        let slope = along.norm() / across.norm();
        let value = format!("{moves}; slope tangent {slope:.3}, static friction {held:.3}");
        return Err(refused_for(&value, "set `preparation` to \"stressed\" for grains, or remove it"));
    }
    if mean.norm() < STIRRED * scene.spacing {
        let value = format!("particles move more than a spacing and keep mixing {}", against_rest(speed, rest));
        return Err(refused_for(&value, &raise(speed, rest)));
    }
    let is_liquid = matches!(scene.rheology, Rheology::Newtonian(_));
    Err(refused_for(&moves, if is_liquid { SUPPORT_OF_LIQUID } else { SUPPORT }))
}

const SUPPORT_OF_LIQUID: &str = "close open sides, or remove `preparation`: inclined walls keep liquid circulating";
const SUPPORT: &str = "support the bodies with walls, keep slopes below the static friction, or remove `preparation`";

/// A speed `[m/s]` beside that which counts as rest.
fn against_rest(speed: f64, rest: RestCriterion) -> String {
    format!("at {speed:.1e} m/s (limit {:.1e} m/s, `rest_speed` √(g H))", rest.speed)
}

/// Remedy for bodies that keep a speed `[m/s]`: a `rest_speed` above it, also when rounded.
fn raise(speed: f64, rest: RestCriterion) -> String {
    format!("raise `rest_speed` to {:.1e}, or remove `preparation`", 1.25 * speed / rest.fall)
}

fn refused_for(value: &str, remedy: &str) -> ParameterError {
    ParameterError::field("preparation", value, "", remedy)
}
