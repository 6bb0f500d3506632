//! From the parameters to a scene of the solver, and what is watched while it runs.

use super::body::{depth, holder, vector};
use super::gauge::{Memory, read_all};
use super::parameters::SceneParameters;
use super::wall::WallLine;
use crate::case::recording::{self, Ending, Followed, Stage};
use crate::case::{ParameterError, Progress, Run, cost};
use crate::cases::enclosed::SceneObservation;
use crate::cases::enclosed::sides::coordinate;
use crate::metric::Variant;
use crate::observation::{Frame, Recorded};
use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::standing::standing;
use bagnold_solver::weakly_compressible::boundary::{Enclosure, backing};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use rand::{RngExt, SeedableRng};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Sites nearer to a wall than this are left free, in spacings `[-]`.
const FREE: f64 = 0.4;

/// The scene as a run.
#[derive(Debug, Clone, Serialize)]
pub struct SceneRun {
    /// All of it.
    pub scene: SceneParameters,
}

/// What is kept from sample to sample.
#[derive(Serialize, Deserialize)]
struct Watch {
    observation: SceneObservation<2>,
    memory: Memory,
    frames: Vec<Frame>,
}

impl Run for SceneRun {
    type Observation = SceneObservation<2>;

    fn variant(&self) -> Variant {
        Variant::of("scene", self.scene.name.as_str())
    }

    fn particles(&self) -> f64 {
        let areas = self.scene.bodies.iter().map(|body| {
            let (lower, upper) = body.extent();
            (upper - lower).product()
        });
        let (area, spacing) = (areas.sum::<f64>(), self.scene.spacing);
        area / (spacing * spacing)
            + self.scene.walls.iter().map(WallLine::length).sum::<f64>() / spacing * self.rows() as f64
    }

    fn particle_steps(&self) -> f64 {
        let step = self.scene.numerics.acoustic_courant * self.scene.numerics.smoothing_ratio * self.scene.spacing
            / self.equation_of_state().sound_speed();
        self.particles() * self.scene.duration / step
    }

    fn seconds_per_particle_step(&self) -> f64 {
        cost::WEAKLY_COMPRESSIBLE
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SceneObservation<2>>, ParameterError> {
        let scene = &self.scene;
        let begun = self.scene().flow.position.len();
        let down = vector(&scene.gravity).normalize();
        let stage = Stage { progress, end: scene.duration, interval: scene.interval, context: &() };
        let begin = |_: &Simulation<2>| Watch {
            observation: SceneObservation::default(),
            memory: Memory::default(),
            frames: Vec::new(),
        };
        let Followed { simulation, stop, kept: (last_good, watch), started } = recording::follow(
            stage,
            |_| -> Result<Scene<2>, SceneError> { Ok(self.scene()) },
            |simulation: &Simulation<2>| (simulation.snapshot(), begin(simulation)),
            |(last_good, watch): &mut (Snapshot<2>, Watch), simulation| {
                *last_good = simulation.snapshot();
                let steps = simulation.steps() as f64 * last_good.mass.len() as f64;
                progress.advance(last_good.time, scene.duration, steps);
                let values = read_all(&scene.gauges, simulation, begun, &mut watch.memory, &down);
                watch.observation.enter(simulation, last_good, &vector(&scene.gravity), values);
                let due = watch.frames.len() as f64 * scene.duration / scene.pictures as f64;
                if last_good.time >= due - 0.5 * scene.interval && watch.frames.len() < scene.pictures {
                    watch.frames.push(Frame::of_flow(last_good));
                }
                if last_good.mass.is_empty() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        )?;
        let mut ending = Ending::of(stop, last_good, started);
        "all material has left by open sides".clone_into(&mut ending.criterion);
        ending.frames = watch.frames;
        let mut observation = watch.observation;
        observation.behind = self.behind(&simulation);
        Ok(ending.record(&simulation, |_| observation))
    }
}

impl SceneRun {
    /// Rows of dummy particles.
    fn rows(&self) -> usize {
        (2.0 * self.scene.numerics.smoothing_ratio).ceil() as usize + 1
    }

    fn density(&self) -> f64 {
        self.scene.bulk.density(&self.scene.material)
    }

    fn equation_of_state(&self) -> EquationOfState {
        let SceneParameters { stiffness, tension, .. } = self.scene;
        let fastest = self.scene.bodies.iter().map(|body| body.velocity().norm_squared()).fold(0.0, f64::max);
        let falls = vector(&self.scene.gravity).norm() * self.scene.height();
        // what moves at the start must be as slow against sound as what falls
        let bulk_modulus = stiffness * self.density() * falls.max(0.5 * fastest);
        EquationOfState { reference_density: self.density(), bulk_modulus, tension }
    }

    pub(super) fn scene(&self) -> Scene<2> {
        let SceneParameters { spacing, numerics, material, .. } = self.scene;
        let domain = Domain { axes: self.scene.sides.axes() };
        let mut shells: Vec<_> = self.scene.walls.iter().map(WallLine::shell).collect();
        backing::lay(&mut shells, &domain, spacing, self.rows());
        let enclosure = Enclosure { shells, exits: self.scene.exits() };
        let equation_of_state = self.equation_of_state();
        let flow = self.fill(&enclosure, &equation_of_state);
        let mut scene = Scene::unbounded(flow, spacing, equation_of_state, material);
        (scene.domain, scene.enclosure, scene.numerics) = (domain, enclosure, numerics);
        scene.gravity = vector(&self.scene.gravity);
        scene
    }

    /// Particles on the sites of a lattice through the origin that bodies hold and that are free of walls, under the
    /// pressure of the material above them.
    fn fill(&self, enclosure: &Enclosure<2>, equation_of_state: &EquationOfState) -> Flow<2> {
        let SceneParameters { spacing, jitter, ref bodies, .. } = self.scene;
        let gravity = vector(&self.scene.gravity);
        let (up, weight) = (-gravity.normalize(), equation_of_state.reference_density * gravity.norm());
        let mut random = rand_pcg::Pcg64::seed_from_u64(self.scene.seed);
        let mut shift = || jitter * spacing * (2.0 * random.random::<f64>() - 1.0);
        let (mut sites, mut velocities) = (Vec::new(), Vec::new());
        let corners = bodies.iter().map(super::body::Body::extent);
        let whole = corners.reduce(|(lower, upper), (low, high)| (lower.inf(&low), upper.sup(&high)));
        let (lower, upper) = whole.unwrap_or_default();
        let cells = |coordinate: f64| (coordinate / spacing).floor() as i64;
        for row in cells(lower[1])..=cells(upper[1]) {
            for column in cells(lower[0])..=cells(upper[0]) {
                let site = Vector::<2>::new(column as f64 + 0.5, row as f64 + 0.5) * spacing;
                if let Some(body) = holder(bodies, &site)
                    && self.is_inside(&site)
                    && self.is_free(enclosure, &site)
                {
                    sites.push(site);
                    velocities.push(body.velocity());
                }
            }
        }
        let density = equation_of_state.reference_density;
        let mut flow = Flow::at_rest(sites, density, spacing);
        flow.velocity = velocities;
        for (position, (rho, mass)) in flow.position.iter_mut().zip(flow.density.iter_mut().zip(&mut flow.mass)) {
            *rho = equation_of_state.density(weight * depth(bodies, position, &up, spacing));
            *mass = *rho * spacing * spacing;
            *position += Vector::<2>::new(shift(), shift());
        }
        flow
    }

    /// Whether a site lies between the sides of the domain.
    fn is_inside(&self, site: &Vector<2>) -> bool {
        self.scene.sides.pairs().into_iter().enumerate().all(|(axis, (lower, upper))| {
            coordinate(lower).is_none_or(|plane| site[axis] > plane)
                && coordinate(upper).is_none_or(|plane| site[axis] < plane)
        })
    }

    /// Whether a site is in front of all walls, or farther behind them than they are thick.
    fn is_free(&self, enclosure: &Enclosure<2>, site: &Vector<2>) -> bool {
        let thick = self.rows() as f64 * self.scene.spacing;
        let free = |distance: f64| distance > FREE * self.scene.spacing || distance < -thick;
        let rest = enclosure.shells.iter().filter(|shell| shell.motion.is_rest());
        let together = rest.flat_map(|shell| &shell.facets).map(|facet| (facet, *site));
        let moving = enclosure.shells.iter().filter(|shell| !shell.motion.is_rest());
        standing(together).is_none_or(|found| free(found.distance))
            && moving
                .map(|shell| standing(shell.facets.iter().map(|facet| (facet, *site))))
                .all(|found| found.is_none_or(|found| free(found.distance)))
    }

    /// Particles at the end that are behind a wall by less than it is thick: they have passed it.
    fn behind(&self, simulation: &Simulation<2>) -> u64 {
        let thick = self.rows() as f64 * self.scene.spacing;
        let particles = simulation.particles();
        let count = particles.position[..particles.flow_count()].iter().filter(|place| {
            simulation.shells().iter().zip(simulation.shell_displacements()).any(|(shell, moved)| {
                let place = *place - moved;
                let near = shell.facets.iter().filter(|facet| facet.may_reach(&place, thick));
                standing(near.map(|facet| (facet, place)))
                    .is_some_and(|found| found.distance < 0.0 && -found.distance < 0.5 * self.scene.spacing)
            })
        });
        count.count() as u64
    }
}
