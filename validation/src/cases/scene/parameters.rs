//! Parameters: everything that a scene is, and the tiers' default scene, a column of grains that collapses onto a step.

use super::Place;
use super::body::{Body, vector};
use super::gauge::Gauge;
use super::run::SceneRun;
use super::wall::{FlowSide, Sides, WallLine};
use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::Bulk;
use crate::cases::enclosed::{DomainSide, Measured, sides};
use bagnold_solver::material::equation_of_state::Tension;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, filled, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::enclosure::Exits;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SceneParameters {
    /// Name of the scene, in figures and files.
    pub name: String,
    /// Gravity along x and y `[m/s²]`.
    pub gravity: Place,
    /// Particle spacing `[m]`.
    #[schemars(transform = positive("give it in metres: a twentieth of the smallest thing that matters"))]
    pub spacing: f64,
    /// Simulated time `[s]`.
    #[schemars(transform = positive("give it in seconds"))]
    pub duration: f64,
    /// Time between two rows of the series `[s]`.
    #[schemars(transform = positive("give it in seconds, such as a hundredth of the duration"))]
    pub interval: f64,
    /// Pictures over the duration.
    pub pictures: usize,
    /// Bulk modulus over ρ0 g and the height of the scene `[-]`.
    #[schemars(transform = between(20.0, 1e4, "50 for grains; 200 make sound seven times as fast as a fall"))]
    pub stiffness: f64,
    /// What becomes of a negative pressure.
    pub tension: Tension,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.3, "0.05 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Constitutive law of the material.
    pub material: Rheology,
    /// Its density.
    pub bulk: Bulk,
    /// Sides of the domain.
    pub sides: Sides,
    /// Where the material is at the start.
    #[schemars(transform = filled("at least one body", "add a box, a disc or a polygon of material"))]
    pub bodies: Vec<Body>,
    /// Walls; what is not held by one falls.
    pub walls: Vec<WallLine>,
    /// What is measured.
    pub gauges: Vec<Gauge>,
    /// Measured series that gauges are compared with.
    pub measured: Vec<Measured>,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for SceneParameters {
    type Run = SceneRun;

    fn of_tier(tier: Tier) -> Self {
        let rows = match tier {
            Tier::Quick => 20.0,
            Tier::Paper => 40.0,
            Tier::Fine => 80.0,
        };
        let grains = MuI {
            static_friction: 0.382,
            limiting_friction: 0.643,
            reference_inertia: 0.279,
            grain_diameter: 0.5e-3,
            grain_density: 2500.0,
        };
        Self {
            name: "step".to_owned(),
            gravity: (0.0, -9.81),
            spacing: 0.1 / rows,
            duration: 0.6,
            interval: 0.005,
            pictures: 4,
            stiffness: 50.0,
            tension: Tension::Cut,
            jitter: 0.05,
            seed: 1,
            material: Rheology::MuI(grains),
            bulk: Bulk::of_grains(0.6),
            sides: Sides {
                left: DomainSide::Mirror(0.0),
                right: DomainSide::Open(0.45),
                bottom: DomainSide::Open(-0.1),
                top: DomainSide::None,
            },
            bodies: vec![Body::Box { lower: (0.0, 0.0), upper: (0.1, 0.1), velocity: (0.0, 0.0) }],
            walls: vec![WallLine {
                name: "step".to_owned(),
                points: vec![(0.0, 0.0), (0.16, 0.0), (0.17, 0.02), (0.21, 0.02), (0.21, -0.08)],
                closed: false,
                flow: FlowSide::Left,
                surface: Surface::Rough,
                motion: Vec::new(),
            }],
            gauges: vec![
                Gauge::Front { name: "front".to_owned(), from: (0.0, 0.0), to: (0.21, 0.0), thickness: 0.1 / rows },
                Gauge::Depth { name: "on-the-step".to_owned(), at: (0.19, 0.02), width: 0.02 },
                Gauge::Force { name: "force".to_owned(), wall: "step".to_owned() },
                Gauge::Flux { name: "over-the-edge".to_owned(), from: (0.21, 0.2), to: (0.21, 0.02) },
            ],
            measured: Vec::new(),
            numerics: Numerics::default(),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()
    }

    fn runs(&self) -> Vec<SceneRun> {
        vec![SceneRun { scene: self.clone() }]
    }
}

impl SceneParameters {
    /// Lower and upper corner of all material and walls `[m]`.
    pub(super) fn extent(&self) -> (Vector<2>, Vector<2>) {
        let walls = self.walls.iter().map(|wall| super::body::extent(&wall.points));
        let none = (Vector::repeat(f64::INFINITY), Vector::repeat(f64::NEG_INFINITY));
        let all = self.bodies.iter().map(Body::extent).chain(walls);
        all.fold(none, |(lower, upper), (low, high)| (lower.inf(&low), upper.sup(&high)))
    }

    /// Height of the scene along gravity, from the highest material to the lowest of walls and material `[m]`.
    pub(super) fn height(&self) -> f64 {
        let up = -vector(&self.gravity).normalize();
        let highest = self.bodies.iter().map(|body| {
            let (lower, upper) = body.extent();
            (0..2).map(|axis| (up[axis] * lower[axis]).max(up[axis] * upper[axis])).sum::<f64>()
        });
        let of_bodies = self.bodies.iter().map(|body| {
            let (lower, upper) = body.extent();
            (0..2).map(|axis| (up[axis] * lower[axis]).min(up[axis] * upper[axis])).sum::<f64>()
        });
        let of_walls = self.walls.iter().flat_map(|wall| &wall.points).map(|point| up.dot(&vector(point)));
        highest.fold(f64::NEG_INFINITY, f64::max) - of_bodies.chain(of_walls).fold(f64::INFINITY, f64::min)
    }

    /// The planes of the open sides.
    pub(super) fn exits(&self) -> Exits<2> {
        sides::exits(self.sides.pairs())
    }
}
