//! From the parameters to a scene of the solver, and what is watched while it runs.

use super::body::{depth, holder};
use super::gauge::{Memory, read_all};
use super::parameters::SpaceParameters;
use super::vector;
use super::wall::Wall;
use crate::case::recording::{self, Ending, Followed, Stage};
use crate::case::{ParameterError, Progress, Run, cost};
use crate::cases::enclosed::SceneObservation;
use crate::cases::enclosed::sides::{self, coordinate};
use crate::metric::Variant;
use crate::observation::{Frame, Recorded};
use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::facet::Facet;
use bagnold_solver::weakly_compressible::boundary::facet_grid::FacetGrid;
use bagnold_solver::weakly_compressible::boundary::{Enclosure, mesh_backing};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use rand::{RngExt, SeedableRng};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Sites nearer to a wall than this are left free, in spacings `[-]`.
const FREE: f64 = 0.4;

/// What space costs of the plane: its neighbours `[-]`.
const OF_THE_PLANE: f64 = 4.0;

/// The scene as a run.
#[derive(Debug, Clone, Serialize)]
pub struct SpaceRun {
    /// All of it.
    pub scene: SpaceParameters,
}

/// What is kept from sample to sample.
#[derive(Serialize, Deserialize)]
struct Watch {
    observation: SceneObservation<3>,
    memory: Memory,
    frames: Vec<Frame>,
}

/// Facets that stand together, with a grid to find them by.
struct Surface {
    facets: Vec<Facet<3>>,
    grid: FacetGrid<3>,
}

impl Surface {
    fn of(facets: Vec<Facet<3>>, range: f64) -> Self {
        Self { grid: FacetGrid::new(&facets, range), facets }
    }

    /// Distance of a place `[m]`, negative behind; none where it is farther than the range.
    fn distance(&self, place: &Vector<3>) -> Option<f64> {
        self.grid.standing(&self.facets, place).map(|found| found.distance)
    }
}

impl Run for SpaceRun {
    type Observation = SceneObservation<3>;

    fn variant(&self) -> Variant {
        Variant::of("scene", self.scene.name.as_str())
    }

    fn particles(&self) -> f64 {
        let volumes = self.scene.bodies.iter().map(|body| {
            let (lower, upper) = body.extent();
            (upper - lower).product()
        });
        let (volume, spacing) = (volumes.sum::<f64>(), self.scene.spacing);
        let behind = self.scene.walls.iter().map(Wall::area).sum::<f64>() * self.rows() as f64 * spacing;
        (volume + behind) / (spacing * spacing * spacing)
    }

    fn particle_steps(&self) -> f64 {
        let step = self.scene.numerics.acoustic_courant * self.scene.numerics.smoothing_ratio * self.scene.spacing
            / self.equation_of_state().sound_speed();
        self.particles() * self.scene.duration / step
    }

    fn seconds_per_particle_step(&self) -> f64 {
        OF_THE_PLANE * cost::WEAKLY_COMPRESSIBLE
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SceneObservation<3>>, ParameterError> {
        let scene = &self.scene;
        let made = self.scene();
        let begun = made.flow.position.len();
        let gravity = vector(&scene.gravity);
        let down = gravity.normalize();
        let stage = Stage { progress, end: scene.duration, interval: scene.interval, context: &() };
        let begin = |_: &Simulation<3>| Watch {
            observation: SceneObservation::default(),
            memory: Memory::default(),
            frames: Vec::new(),
        };
        let Followed { simulation, stop, kept: (last_good, watch), started } = recording::follow(
            stage,
            |_| -> Result<Scene<3>, SceneError> { Ok(made.clone()) },
            |simulation: &Simulation<3>| (simulation.snapshot(), begin(simulation)),
            |(last_good, watch): &mut (Snapshot<3>, Watch), simulation| {
                *last_good = simulation.snapshot();
                let steps = simulation.steps() as f64 * last_good.mass.len() as f64;
                progress.advance(last_good.time, scene.duration, steps);
                let values = read_all(&scene.gauges, simulation, begun, &mut watch.memory, &down);
                watch.observation.enter(simulation, last_good, &gravity, values);
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

impl SpaceRun {
    /// Layers of dummy particles.
    fn rows(&self) -> usize {
        (2.0 * self.scene.numerics.smoothing_ratio).ceil() as usize + 1
    }

    fn density(&self) -> f64 {
        self.scene.bulk.density(&self.scene.material)
    }

    fn equation_of_state(&self) -> EquationOfState {
        let SpaceParameters { stiffness, tension, .. } = self.scene;
        let fastest = self.scene.bodies.iter().map(|body| body.velocity().norm_squared()).fold(0.0, f64::max);
        let falls = vector(&self.scene.gravity).norm() * self.scene.height();
        // what moves at the start must be as slow against sound as what falls
        let bulk_modulus = stiffness * self.density() * falls.max(0.5 * fastest);
        EquationOfState { reference_density: self.density(), bulk_modulus, tension }
    }

    fn scene(&self) -> Scene<3> {
        let SpaceParameters { spacing, numerics, material, .. } = self.scene;
        let domain = Domain { axes: self.scene.sides.axes() };
        let mut shells: Vec<_> = self.scene.walls.iter().map(Wall::shell).collect();
        mesh_backing::lay(&mut shells, &domain, spacing, self.rows());
        let enclosure = Enclosure { shells, exits: sides::exits(self.scene.sides.pairs()) };
        let equation_of_state = self.equation_of_state();
        let flow = self.fill(&enclosure, &equation_of_state);
        let mut scene = Scene::unbounded(flow, spacing, equation_of_state, material);
        (scene.domain, scene.enclosure, scene.numerics) = (domain, enclosure, numerics);
        scene.gravity = vector(&self.scene.gravity);
        scene
    }

    /// Particles on the sites of a lattice through the origin that bodies hold and that are free of walls, under the
    /// pressure of the material above them.
    fn fill(&self, enclosure: &Enclosure<3>, equation_of_state: &EquationOfState) -> Flow<3> {
        let SpaceParameters { spacing, jitter, ref bodies, .. } = self.scene;
        let gravity = vector(&self.scene.gravity);
        let (up, weight) = (-gravity.normalize(), equation_of_state.reference_density * gravity.norm());
        let mut random = rand_pcg::Pcg64::seed_from_u64(self.scene.seed);
        let mut shift = || jitter * spacing * (2.0 * random.random::<f64>() - 1.0);
        let surfaces = self.surfaces(enclosure);
        let (mut sites, mut velocities) = (Vec::new(), Vec::new());
        let corners = bodies.iter().map(super::body::Body::extent);
        let whole = corners.reduce(|(lower, upper), (low, high)| (lower.inf(&low), upper.sup(&high)));
        let (lower, upper) = whole.unwrap_or_default();
        let cells = |axis: usize| {
            let cell = |coordinate: f64| (coordinate / spacing).floor() as i64;
            cell(lower[axis])..=cell(upper[axis])
        };
        for (z, y) in cells(2).flat_map(|z| cells(1).map(move |y| (z, y))) {
            for x in cells(0) {
                let site = Vector::<3>::from([x, y, z].map(|cell| cell as f64 + 0.5)) * spacing;
                if let Some(body) = holder(bodies, &site)
                    && self.is_inside(&site)
                    && self.is_free(&surfaces, &site)
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
            *mass = *rho * spacing * spacing * spacing;
            *position += Vector::<3>::new(shift(), shift(), shift());
        }
        flow
    }

    /// Whether a site lies between the sides of the domain.
    fn is_inside(&self, site: &Vector<3>) -> bool {
        self.scene.sides.pairs().into_iter().enumerate().all(|(axis, (lower, upper))| {
            coordinate(lower).is_none_or(|plane| site[axis] > plane)
                && coordinate(upper).is_none_or(|plane| site[axis] < plane)
        })
    }

    /// What walls at rest make up together, and each that moves.
    fn surfaces(&self, enclosure: &Enclosure<3>) -> Vec<Surface> {
        let (rest, moving): (Vec<_>, Vec<_>) = enclosure.shells.iter().partition(|shell| shell.motion.is_rest());
        let rest = rest.into_iter().flat_map(|shell| shell.facets.clone()).collect();
        let all = std::iter::once(rest).chain(moving.into_iter().map(|shell| shell.facets.clone()));
        let range = self.rows() as f64 * self.scene.spacing;
        all.map(|facets| Surface::of(facets, range)).collect()
    }

    /// Whether a site is in front of all walls, or farther behind them than they are thick.
    fn is_free(&self, surfaces: &[Surface], site: &Vector<3>) -> bool {
        let near = FREE * self.scene.spacing;
        surfaces.iter().all(|surface| surface.distance(site).is_none_or(|distance| distance > near))
    }

    /// Particles at the end that are behind a wall by less than half a spacing: they have passed it.
    fn behind(&self, simulation: &Simulation<3>) -> u64 {
        let range = 0.5 * self.scene.spacing;
        let surfaces: Vec<_> =
            simulation.shells().iter().map(|shell| Surface::of(shell.facets.clone(), range)).collect();
        let particles = simulation.particles();
        let count = particles.position[..particles.flow_count()].iter().filter(|place| {
            let shells = surfaces.iter().zip(simulation.shell_displacements());
            shells.into_iter().any(|(surface, moved)| surface.distance(&(*place - moved)).is_some_and(|d| d < 0.0))
        });
        count.count() as u64
    }
}
