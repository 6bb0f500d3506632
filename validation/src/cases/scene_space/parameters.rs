//! Parameters: everything that a scene is, and the tiers' default scene, half a column that collapses in a channel.

use super::body::Body;
use super::gauge::Gauge;
use super::run::SpaceRun;
use super::wall::{Sides, Wall};
use super::{Place, vector};
use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::Bulk;
use crate::cases::enclosed::{DomainSide, Measured};
use bagnold_solver::material::equation_of_state::Tension;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, filled, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpaceParameters {
    /// Name of the scene, in figures and files.
    pub name: String,
    /// Gravity along x, y and z `[m/s²]`.
    pub gravity: Place,
    /// Particle spacing `[m]`.
    #[schemars(transform = positive("give it in metres: a tenth of the smallest thing that matters"))]
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
    #[schemars(transform = filled("at least one body", "add a box, a cylinder or a sphere of material"))]
    pub bodies: Vec<Body>,
    /// Walls; what is not held by one falls.
    pub walls: Vec<Wall>,
    /// What is measured.
    pub gauges: Vec<Gauge>,
    /// Measured series that gauges are compared with.
    pub measured: Vec<Measured>,
    /// Numerics.
    pub numerics: Numerics,
}

/// Half of a channel 0.2 m long: its bed, the face below its end, and one of its side walls.
fn channel() -> Vec<Wall> {
    let (length, half, height) = (0.2, 0.04, 0.14);
    let quad = |corners: [Place; 4]| {
        let [a, b, c, d] = corners;
        (a, b, c, d)
    };
    let bed = quad([(0.0, 0.0, 0.0), (length, 0.0, 0.0), (length, half, 0.0), (0.0, half, 0.0)]);
    let end = quad([(length, 0.0, 0.0), (length, 0.0, -0.06), (length, half, -0.06), (length, half, 0.0)]);
    let side = quad([(0.0, half, 0.0), (length, half, 0.0), (length, half, height), (0.0, half, height)]);
    vec![Wall::of_quads("bed", vec![bed, end]), Wall::of_quads("side", vec![side])]
}

impl Parameters for SpaceParameters {
    type Run = SpaceRun;

    fn of_tier(tier: Tier) -> Self {
        let rows = match tier {
            Tier::Quick => 8.0,
            Tier::Paper => 16.0,
            Tier::Fine => 24.0,
        };
        let grains = MuI {
            static_friction: 0.382,
            limiting_friction: 0.643,
            reference_inertia: 0.279,
            grain_diameter: 0.5e-3,
            grain_density: 2500.0,
        };
        let spacing = 0.08 / rows;
        Self {
            name: "channel".to_owned(),
            gravity: (0.0, 0.0, -9.81),
            spacing,
            duration: 0.4,
            interval: 0.01,
            pictures: 3,
            stiffness: 50.0,
            tension: Tension::Cut,
            jitter: 0.05,
            seed: 1,
            material: Rheology::MuI(grains),
            bulk: Bulk::of_grains(0.6),
            sides: Sides {
                left: DomainSide::Mirror(0.0),
                right: DomainSide::Open(0.4),
                front: DomainSide::Mirror(0.0),
                back: DomainSide::None,
                bottom: DomainSide::Open(-0.1),
                top: DomainSide::None,
            },
            bodies: vec![Body::Box { lower: (0.0, 0.0, 0.0), upper: (0.1, 0.04, 0.12), velocity: (0.0, 0.0, 0.0) }],
            walls: channel(),
            gauges: vec![
                Gauge::Front {
                    name: "front".to_owned(),
                    from: (0.0, 0.0, 0.0),
                    to: (0.2, 0.0, 0.0),
                    thickness: spacing,
                    width: 0.06,
                },
                Gauge::Depth { name: "depth".to_owned(), at: (0.05, 0.02, 0.0), width: 0.04 },
                Gauge::Force { name: "on-the-side".to_owned(), wall: "side".to_owned() },
                Gauge::Flux {
                    name: "over-the-edge".to_owned(),
                    corners: ((0.2, -0.1, -0.06), (0.2, 0.1, -0.06), (0.2, -0.1, 0.2)),
                },
            ],
            measured: Vec::new(),
            // in space 1.3 holds 80 neighbours, 1.5 holds 120
            numerics: Numerics { smoothing_ratio: 1.3, ..Numerics::default() },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()
    }

    fn runs(&self) -> Vec<SpaceRun> {
        vec![SpaceRun { scene: self.clone() }]
    }
}

impl SpaceParameters {
    /// Lower and upper corners of the boxes around every body and every wall `[m]`.
    fn boxes(&self) -> impl Iterator<Item = (Vector<3>, Vector<3>)> {
        self.bodies.iter().map(Body::extent).chain(self.walls.iter().map(Wall::extent))
    }

    /// Lower and upper corner of all material and walls `[m]`.
    pub(super) fn extent(&self) -> (Vector<3>, Vector<3>) {
        let none = (Vector::repeat(f64::INFINITY), Vector::repeat(f64::NEG_INFINITY));
        self.boxes().fold(none, |(lower, upper), (low, high)| (lower.inf(&low), upper.sup(&high)))
    }

    /// Height of the scene along gravity, from the highest material to the lowest of walls and material, by their
    /// boxes `[m]`.
    pub(super) fn height(&self) -> f64 {
        let up = -vector(&self.gravity).normalize();
        let ends = |(lower, upper): (Vector<3>, Vector<3>)| {
            let (one, other) = (up.component_mul(&lower), up.component_mul(&upper));
            (one.inf(&other).sum(), one.sup(&other).sum())
        };
        let highest = self.bodies.iter().map(|body| ends(body.extent()).1).fold(f64::NEG_INFINITY, f64::max);
        highest - self.boxes().map(|corners| ends(corners).0).fold(f64::INFINITY, f64::min)
    }
}
