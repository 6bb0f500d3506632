//! Everything that a scene is, and what the plane and space each give of it in their own way: all else is written once, over
//! [`Dimension`].

use super::given::PlainData;
use super::measured::MeasuredSeries;
use super::periods::Periods;
use super::setting::{SceneBody, SceneGauge, SceneInlet, SceneWall, vector};
use super::sides::SceneSides;
use super::surfaces::SideSearch;
use super::{BodyPreparation, Measurand, shapes};
use crate::figure::{Figure, Panel};
use crate::metric::Variant;
use crate::observation::Frame;
use crate::setup::Bulk;
use bagnold_solver::material::equation_of_state::Tension;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{at_least, between, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet::Facet;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::walls::SideWalls;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// From a scene and its sites to the panels of a figure.
pub type DrawSites<S, const D: usize> = fn(&SceneFlow<S, D>, &[(Vector<D>, f64)]) -> Vec<Panel>;
/// From a scene and its frames to a figure.
pub type DrawFrames<S, const D: usize> = fn(&SceneFlow<S, D>, &[Frame]) -> Figure;

/// The plane (D = 2) or space (D = 3).
pub trait Dimension<const D: usize>: Debug + Clone + Copy + PartialEq + Send + Sync + 'static {
    /// Coordinates or components along the axes, as a case file gives them.
    type Place: PlainData + Copy + Into<[f64; D]>;
    /// The sides of the domain by their names.
    type Sides: SceneSides<D>;
    /// A piece of material.
    type Body: SceneBody<D>;
    /// A wall.
    type Wall: SceneWall<D>;
    /// An opening by which material comes in.
    type Inlet: SceneInlet<D>;
    /// A gauge.
    type Gauge: SceneGauge<D>;

    /// Search for the side of facets, compiled with the solver.
    const SIDE: SideSearch<D>;
    /// Name of the case.
    const NAME: &'static str;
    /// One line for `bagnold list`.
    const SUMMARY: &'static str;
    /// A paragraph for the report.
    const DESCRIPTION: &'static str;
    /// The scenes of the tiers, as a list of runs.
    const RUNS: &'static str;
    /// Gravity of a scene that gives none `[m/s²]`.
    const GRAVITY: Self::Place;
    /// Remedy for a scene without bodies.
    const ADD_A_BODY: &'static str;
    /// Cost of a particle-step over that of a layer in the plane `[-]`.
    const COST: f64;
    /// Unit of a force.
    const FORCE_UNIT: &'static str;
    /// Unit of a mass.
    const MASS_UNIT: &'static str;
    /// Unit of a mass per time.
    const FLUX_UNIT: &'static str;

    /// Places of the start between walls, inlets and what is measured, with a value each from 0 to 1; a panel a view.
    const SETUP: DrawSites<Self, D>;
    /// Pictures of the material between its walls.
    const PICTURES: DrawFrames<Self, D>;
}

/// A scene of the cases `scene` and `scene-space`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(bound = "")]
#[schemars(rename = "SceneFlow", bound = "")]
pub struct SceneFlow<S: Dimension<D>, const D: usize> {
    /// Name of the scene, in figures and files.
    pub name: String,
    /// Gravity along each axis `[m/s²]`.
    pub gravity: S::Place,
    /// Particle spacing `[m]`.
    #[schemars(transform = positive("give it in metres: a tenth to a twentieth of the smallest length that matters"))]
    pub spacing: f64,
    /// Simulated time `[s]`.
    #[schemars(transform = positive("give it in seconds"))]
    pub duration: f64,
    /// Time between two rows of the series `[s]`.
    #[schemars(transform = positive("give it in seconds, such as a hundredth of the duration"))]
    pub interval: f64,
    /// Least number of pictures over the duration, which are 1, 2, 4, … intervals apart; the last state follows.
    pub pictures: usize,
    /// Bulk modulus over ρ0 (g H + p/ρ0) `[-]`, of the pressure p and of the height H of the material and of what it can fall onto: neither walls that
    /// move nor vertical ones below a floor add to it. Where it is left out, it is 50, and sound is also five times as fast as bodies, inflow and
    /// walls move towards or along each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = between(20.0, 1e6, "give 50 for grains, or 200, with which sound is seven times as fast as a fall"))]
    pub stiffness: Option<f64>,
    /// Treatment of a negative pressure.
    pub tension: Tension,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.3, "give 0.05 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Preparation before the run starts.
    pub preparation: BodyPreparation,
    /// Root mean square of the speed at which settled bodies count as being at rest, over √(g H) with the scene's height H `[-]`.
    #[schemars(transform = between(1e-6, 0.1, "give 1e-4, which is 0.1 mm/s in a scene 0.1 m high"))]
    pub rest_speed: f64,
    /// Largest share of a body that may stand behind walls, where it is left out `[-]`.
    #[schemars(transform = between(0.0, 1.0, "give 0.1 to allow for what corners and curved walls cut off"))]
    pub cut_at_most: f64,
    /// Constitutive law of the material.
    pub material: Rheology,
    /// Bulk density or solid fraction of the material.
    pub bulk: Bulk,
    /// Sides of the domain.
    pub sides: S::Sides,
    /// Material at the start; none where an inlet brings it.
    pub bodies: Vec<S::Body>,
    /// Pressure at the start, beside that of the weight of the material above `[Pa]`. What walls enclose on all sides keeps it; a free
    /// surface lets it go.
    #[serde(default, skip_serializing_if = "is_none")]
    #[schemars(transform = at_least(0.0, "give 0 or more, or leave it out for material under its weight alone"))]
    pub pressure: f64,
    /// Ratio K_0 of horizontal to vertical stress at the start, of the weight of the material above `[-]`; vertical is along gravity. 1 is
    /// hydrostatic, 1 − sin φ is Jaky's (1944) for deposited grains. A ratio unlike 1 requires a law that carries its stress along.
    #[serde(default = "hydrostatic", skip_serializing_if = "is_hydrostatic")]
    #[schemars(transform = positive("give 1 for a hydrostatic start, 1 − sin φ for deposited grains"))]
    pub lateral_pressure_ratio: f64,
    /// Share of the weight of the material above that its pore liquid bears at the start `[-]`: 0 is drained, 1 a mixture whose grains have just
    /// lost their contacts.
    #[serde(default, skip_serializing_if = "is_none")]
    #[schemars(transform = between(0.0, 1.0, "give 0 for grains at rest, 1 for liquefied ones"))]
    pub pore_pressure_ratio: f64,
    /// Walls; material not held by a wall falls.
    pub walls: Vec<S::Wall>,
    /// Openings by which material comes in.
    pub inlets: Vec<S::Inlet>,
    /// Two plates beside a scene in the plane, which rub on its material; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side_walls: Option<SideWalls>,
    /// Gauges, whose values are written over time.
    pub gauges: Vec<S::Gauge>,
    /// Measured series that gauges are compared with.
    pub measured: Vec<MeasuredSeries>,
    /// State that the scene starts from in place of its bodies; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<SceneStart>,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
}

/// A state that a run of a scene has left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneStart {
    /// File of the state, from the current folder.
    pub file: String,
    /// SHA-256 of the state.
    pub sha256: String,
    /// Bulk modulus of the state `[Pa]`, which the scene keeps: its densities stand for other pressures under another one. That of the
    /// scene where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = positive("leave it out: `--from` reads it from the state"))]
    pub bulk_modulus: Option<f64>,
}

fn is_none(pressure: &f64) -> bool {
    *pressure == 0.0
}

fn hydrostatic() -> f64 {
    1.0
}

fn is_hydrostatic(ratio: &f64) -> bool {
    *ratio == hydrostatic()
}

/// Glass beads without bodies, walls and gauges.
impl<S: Dimension<D>, const D: usize> Default for SceneFlow<S, D> {
    fn default() -> Self {
        let beads = MuI {
            static_friction: 0.382,
            limiting_friction: 0.643,
            reference_inertia: 0.279,
            grain_diameter: 0.5e-3,
            grain_density: 2500.0,
        };
        Self {
            name: S::NAME.to_owned(),
            gravity: S::GRAVITY,
            spacing: 0.01,
            duration: 0.4,
            interval: 0.01,
            pictures: 4,
            stiffness: None,
            tension: Tension::Cut,
            jitter: 0.05,
            seed: 1,
            preparation: BodyPreparation::None,
            rest_speed: 1e-4,
            material: Rheology::MuI(beads),
            bulk: Bulk::of_grains(0.6),
            sides: S::Sides::default(),
            bodies: Vec::new(),
            cut_at_most: 0.1,
            walls: Vec::new(),
            inlets: Vec::new(),
            pressure: 0.0,
            pore_pressure_ratio: 0.0,
            lateral_pressure_ratio: hydrostatic(),
            side_walls: None,
            gauges: Vec::new(),
            measured: Vec::new(),
            from: None,
            // a liquid comes to rest, grains keep the operator that they are verified with
            // with a tenth, 0.6 % of the weight of a block of mud at rest stays unsolved
            numerics: Numerics {
                momentum_operator: MomentumOperator::ByLaw,
                viscous_tolerance: 0.03,
                ..Numerics::default()
            },
        }
    }
}

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Variant of the scene among the runs of its case.
    pub(super) fn named(&self) -> Variant {
        Variant::of("scene", self.name.as_str())
    }

    /// Gravity that moves the material `[m/s²]`: of grains in a liquid the share that is not carried by hydrostatic pressure.
    pub(super) fn pull(&self) -> Vector<D> {
        vector::<D>(&self.gravity) * self.material.pore_liquid().map_or(1.0, |pore| pore.buoyant_share())
    }

    /// Parts of the pull that press the material together at the start and that its shear stress bears `[m/s²]`: of grains in a liquid, and of
    /// those that start with their stress, across and along periodic sides.
    pub(super) fn pulls(&self) -> (Vector<D>, Vector<D>) {
        if self.preparation == BodyPreparation::Stressed || self.material.pore_liquid().is_some() {
            Periods::of(&self.sides.axes()).split(&self.pull())
        } else {
            (self.pull(), Vector::zeros())
        }
    }

    /// The unit vector along gravity `[-]`; without gravity against the last axis.
    pub(super) fn down(&self) -> Vector<D> {
        let gravity = vector::<D>(&self.gravity);
        if gravity.norm() == 0.0 {
            Vector::from_fn(|axis, _| if axis + 1 == D { -1.0 } else { 0.0 })
        } else {
            gravity.normalize()
        }
    }

    /// Measurands of the gauges, gauge by gauge.
    pub(super) fn measures(&self) -> Vec<Measurand<'_, D>> {
        self.gauges.iter().map(|gauge| gauge.measure(&self.direction_of(gauge))).collect()
    }

    /// The unit vector along which a gauge measures a thickness: gravity, unless it says otherwise.
    pub(crate) fn direction_of(&self, gauge: &S::Gauge) -> Vector<D> {
        let of_wall = |name: &str| {
            let wall = self.walls.iter().find(|wall| wall.name() == name)?;
            let Measurand::Depth(depth) = gauge.measure(&self.down()) else { return None };
            let facets = wall.facet_wall().facets;
            let distance = |facet: &Facet<D>| (facet.nearest(&depth.at) - depth.at).norm();
            facets.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|facet| facet.normal)
        };
        let (given, wall) = gauge.along();
        given.map(|given| given.normalize()).or(wall.and_then(of_wall)).unwrap_or_else(|| self.down())
    }

    /// Lower and upper corner of all material, walls and inlets `[m]`.
    pub(crate) fn extent(&self) -> (Vector<D>, Vector<D>) {
        let bodies = self.bodies.iter().flat_map(|body| <[Vector<D>; 2]>::from(body.extent()));
        let inlets = self.inlets.iter().flat_map(SceneInlet::corners);
        shapes::around(bodies.chain(self.walls.iter().flat_map(SceneWall::hull)).chain(inlets))
    }
}
