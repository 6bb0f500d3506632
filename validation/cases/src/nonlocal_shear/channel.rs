//! Grains between two rough walls, compressed until they carry a pressure, or on one of them under their weight.

use crate::case::recording::StartState;
use crate::layer::{raised, settled};
use crate::setup::{Lattice, displaced_flow, wall_rows};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::walls::wall::fill;
use bagnold_solver::weakly_compressible::{Numerics, Scene, SideWalls, Wall};

/// Bulk modulus over the largest pressure `[-]`.
pub const STIFFNESS: f64 = 50.0;

/// Initial motion of the grains at a height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Velocity along the walls `[m/s]`.
    pub velocity: f64,
    /// Shear rate, whatever its sign `[1/s]`.
    pub shear_rate: f64,
    /// Shear stress s_xy `[Pa]`.
    pub shear_stress: f64,
}

/// The particles of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelGrains {
    /// Density of the bulk without pressure `[kg/m³]`.
    pub density: f64,
    /// Rows of particles from wall to wall.
    pub rows: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
}

/// Boundary at the upper end of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UpperBoundary {
    /// A rough wall that moves at a velocity `[m/s]`.
    Wall(f64),
    /// A free surface between two side walls.
    Surface(SideWalls),
}

/// Grains that fill the space between a wall at y = 0 and some width, periodic along the wall.
pub struct Channel<'a> {
    /// Particles of the channel.
    pub grains: ChannelGrains,
    /// Law of the grains.
    pub rheology: Rheology,
    /// Distance of the walls, or of the surface from the wall `[m]`.
    pub width: f64,
    /// Gravity along the walls and across them `[m/s²]`.
    pub gravity: [f64; 2],
    /// Pressure at a height `[Pa]`.
    pub pressure: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Boundary above the grains.
    pub above: UpperBoundary,
    /// The motion at a height `[m]` at the start.
    pub start: &'a (dyn Fn(f64) -> Motion + Sync),
}

impl Channel<'_> {
    /// Particle spacing Δ `[m]`.
    pub fn spacing(&self) -> f64 {
        self.width / self.grains.rows as f64
    }

    /// Length of the period `[m]`.
    pub fn length(&self) -> f64 {
        self.grains.columns as f64 * self.spacing()
    }

    /// Grains between pressure and density.
    pub fn equation_of_state(&self) -> EquationOfState {
        let most = (self.pressure)(0.0).max((self.pressure)(self.width));
        EquationOfState {
            reference_density: self.grains.density,
            bulk_modulus: STIFFNESS * most,
            tension: Tension::Cut,
        }
    }

    /// The scene that a run begins with or is continued in.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver.
    pub fn scene(&self, beginning: StartState) -> Result<Scene<2>, SceneError> {
        match beginning {
            StartState::New => {
                let settled = settled(self.at_rest())?;
                Ok(self.started(match self.above {
                    UpperBoundary::Wall(_) => self.compressed(settled),
                    UpperBoundary::Surface(_) => raised(settled, self.width),
                }))
            }
            StartState::Continued | StartState::Described => {
                Ok(Scene { gravity: Vector::from(self.gravity), ..self.moving(self.at_rest()) })
            }
        }
    }

    /// Displaced grains between walls at rest, under the gravity across them.
    fn at_rest(&self) -> Scene<2> {
        let ChannelGrains { rows, columns, jitter, seed, numerics, .. } = self.grains;
        let spacing = self.spacing();
        let lattice = Lattice { spacing, rows, columns, bottom: 0.0 };
        let material = self.equation_of_state();
        let flow = displaced_flow(
            lattice.sites(),
            (jitter * spacing, seed),
            |site| material.density((self.pressure)(site[1])),
            |density| density * spacing * spacing,
        );
        let along = AxisBoundary::Periodic { lower: 0.0, upper: self.length() };
        let domain = Domain { axes: [along, AxisBoundary::Open] };
        let mut walls = vec![Wall::still(1, 0.0, 1.0)];
        if let UpperBoundary::Wall(_) = self.above {
            walls.push(Wall::still(1, self.width, -1.0));
        }
        let extent = (Vector::<2>::zeros(), Vector::<2>::new(self.length(), self.width));
        Scene {
            wall_particles: fill(&walls, &domain, extent, spacing, wall_rows(numerics.smoothing_ratio)),
            walls,
            domain,
            gravity: Vector::<2>::new(0.0, self.gravity[1]),
            numerics,
            ..Scene::unbounded(flow, spacing, material, self.rheology)
        }
    }

    /// The same grains, as dense as the mean pressure asks for.
    ///
    /// Disorder fills the space between walls a few parts in a thousand better or worse than a lattice, of which the pressure would
    /// make K/p times as much.
    fn compressed(&self, mut scene: Scene<2>) -> Scene<2> {
        let material = scene.equation_of_state;
        let flow = &mut scene.flow;
        let count = flow.position.len() as f64;
        let found = flow.density.iter().map(|&density| material.pressure(density)).sum::<f64>() / count;
        let due = flow.position.iter().map(|x| (self.pressure)(x[1])).sum::<f64>() / count;
        let factor = material.density(due) / material.density(found);
        flow.density.iter_mut().for_each(|density| *density *= factor);
        flow.mass.iter_mut().for_each(|mass| *mass *= factor);
        scene
    }

    fn moving(&self, mut scene: Scene<2>) -> Scene<2> {
        match self.above {
            UpperBoundary::Wall(velocity) => scene.walls[1].velocity[0] = velocity,
            UpperBoundary::Surface(side_walls) => scene.side_walls = Some(side_walls),
        }
        scene
    }

    /// The grains in motion, with the stress and the fluidity of it.
    fn started(&self, scene: Scene<2>) -> Scene<2> {
        let mut scene = self.moving(scene);
        scene.gravity = Vector::from(self.gravity);
        for index in 0..scene.flow.position.len() {
            let y = scene.flow.position[index][1];
            let Motion { velocity, shear_rate, shear_stress } = (self.start)(y);
            scene.flow.velocity[index][0] = velocity;
            scene.flow.stress[index] = Tensor::<2>::new(0.0, shear_stress, shear_stress, 0.0);
            let stress_ratio = shear_stress.abs() / (self.pressure)(y).max(f64::MIN_POSITIVE);
            scene.flow.field.extend(scene.rheology.field_in_flow(shear_rate, stress_ratio));
        }
        scene
    }
}
