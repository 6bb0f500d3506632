//! The flow: a column of water that collapses on a bed.

use crate::case::recording::{self, ObservedRun, SimulationStage};
use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::metric::{FlowRegime, Variant};
use crate::observation::{EnergyBook, Recorded};
use crate::reference::water::{GATED_WATER_FRONT, MeasuredFront, WATER_FRONT};
use crate::setup::front::FrontLine;
use crate::setup::{Lattice, displaced_flow, rules, wall_rows};
use crate::shared::close_by_gate;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::parameter::{between, not_negative, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::walls::wall::fill;
use bagnold_solver::weakly_compressible::{MomentumOperator, Numerics, Scene, Snapshot, Surface, Wall};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Thickness at the front over the column's width `[-]`.
const FRONT_THICKNESS: f64 = 0.02;
/// Width over which the height at the symmetry plane is taken, over the column's `[-]`.
const WALL_STRIP: f64 = 0.1;
/// End of the bed over the column's width `[-]`.
const BED_END: f64 = 6.0;
/// Observations a run.
const SAMPLES: f64 = 400.0;

/// Release of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Release {
    /// All of it at once.
    AtOnce,
    /// By a gate that is lifted.
    Gate,
}

/// A column of water that collapses on a bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaterColumnFlow {
    /// Width a of the column from its symmetry plane `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.05715"))]
    pub width: f64,
    /// Height over width `[-]`; 2 was measured, and 1 behind a gate.
    #[schemars(transform = between(0.5, 4.0, "give 2, for which measurements exist"))]
    pub aspect_ratio: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density of the water `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Viscosity of the water `[Pa·s]`.
    #[schemars(transform = not_negative("give it in Pa·s, such as 0.001"))]
    pub viscosity: f64,
    /// Bulk modulus over ρ0 g and the height `[-]`.
    #[schemars(transform = between(50.0, 1e4, "give 200, with which sound is seven times as fast as the fall"))]
    pub stiffness: f64,
    /// Particles over the width.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Surface of the bed.
    pub surface: Surface,
    /// Treatment of a negative pressure.
    pub tension: Tension,
    /// Kind of release.
    pub release: Release,
    /// Speed at which a gate is lifted `[m/s]`.
    #[schemars(transform = positive("give it in m/s, such as 4.53"))]
    pub gate_speed: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.3, "give 0.05 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Simulated time over √(a/(2g)) `[-]`.
    #[schemars(transform = between(2.6, 4.0, "give 2.6 or more: the measured front ends at 2.51"))]
    pub duration: f64,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
}

impl Default for WaterColumnFlow {
    fn default() -> Self {
        let momentum_operator = MomentumOperator::UncorrectedDivergence;
        Self {
            width: 0.05715,
            aspect_ratio: 2.0,
            gravity: 9.81,
            density: 1000.0,
            viscosity: 1e-3,
            stiffness: 200.0,
            resolution: 20,
            surface: Surface::Smooth,
            tension: Tension::Cut,
            release: Release::AtOnce,
            gate_speed: 4.53,
            jitter: 0.05,
            seed: 1,
            duration: 2.8,
            numerics: Numerics { momentum_operator, ..Numerics::default() },
        }
    }
}

impl Flow for WaterColumnFlow {
    const RUNS: &'static str = include_str!("../../runs/water-column.toml");
    type Observation = ColumnObservation;

    fn check(&self) -> Result<(), ParameterError> {
        rules::viscous_step("numerics", &self.numerics, &self.rheology())?;
        if self.surface == Surface::Smooth { rules::gate("numerics", &self.numerics) } else { Ok(()) }
    }

    fn regime(&self, _: &ColumnObservation) -> FlowRegime {
        FlowRegime { aspect_ratio: Some(self.aspect_ratio), slope_angle: Some(0.0), ..FlowRegime::default() }
    }

    fn laws(&self) -> Vec<Rheology> {
        vec![self.rheology()]
    }

    fn variant(&self) -> Variant {
        let surface = if self.surface == Surface::Smooth { "smooth" } else { "rough" };
        let tension = if self.tension == Tension::Kept { "kept" } else { "cut" };
        let start = if self.is_gated() { Variant::of("release", "gate") } else { Variant::default() };
        start.and("bed", surface).and("tension", tension).and("resolution", self.resolution)
    }

    fn cost(&self) -> RunCost {
        let particles = self.aspect_ratio * (self.resolution as f64).powi(2);
        let crossing = self.stiffness.sqrt() * self.resolution as f64;
        RunCost::weakly_compressible(particles, crossing * self.duration)
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<ColumnObservation>, ParameterError> {
        let end = self.duration * self.time_scale();
        let stage = SimulationStage { progress, end, interval: end / SAMPLES, window: 0.0, context: &() };
        let begin = |_: &_| ColumnObservation::default();
        let watched = recording::watch(
            stage,
            |_| Ok(self.scene()),
            begin,
            |observation, snapshot| {
                observation.time.push(snapshot.time / self.time_scale());
                observation.front.push(self.front(snapshot) / self.width);
                observation.height.push(self.height(snapshot) / (self.aspect_ratio * self.width));
                if let Some(account) = &snapshot.energy {
                    observation.energy.enter(snapshot.time, account, 0.0);
                }
                ControlFlow::Continue(())
            },
        )?;
        let ObservedRun { simulation, ending, kept } = watched;
        Ok(ending.record(&simulation, |_| kept))
    }
}

/// Results of a run; every array has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ColumnObservation {
    /// Times over √(a/(2g)) `[-]`.
    pub time: Vec<f64>,
    /// Places of the front over a `[-]`.
    pub front: Vec<f64>,
    /// Heights at the symmetry plane over that of the column at first `[-]`; none where another code gives only a front.
    pub height: Vec<f64>,
    /// The energy ledger.
    pub energy: EnergyBook,
}

impl WaterColumnFlow {
    /// Whether a lift gate releases it.
    pub(super) fn is_gated(&self) -> bool {
        self.release == Release::Gate
    }

    /// The front that it is compared with.
    pub(super) fn measured(&self) -> &'static MeasuredFront {
        if self.is_gated() { &GATED_WATER_FRONT } else { &WATER_FRONT }
    }

    /// √(a/(2g)) `[s]`.
    pub(super) fn time_scale(&self) -> f64 {
        (self.width / (2.0 * self.gravity)).sqrt()
    }

    fn rheology(&self) -> Rheology {
        Rheology::Newtonian(Newtonian { viscosity: self.viscosity })
    }

    fn spacing(&self) -> f64 {
        self.width / self.resolution as f64
    }

    fn scene(&self) -> Scene<2> {
        let Self { gravity, density, stiffness, jitter, numerics, .. } = *self;
        let (spacing, height) = (self.spacing(), self.aspect_ratio * self.width);
        let bulk_modulus = stiffness * density * gravity * height;
        let equation_of_state = EquationOfState { reference_density: density, bulk_modulus, tension: self.tension };
        let rows = (self.aspect_ratio * self.resolution as f64).round() as usize;
        let lattice = Lattice { spacing, rows, columns: self.resolution, bottom: 0.0 };
        let flow = displaced_flow(
            lattice.sites(),
            (jitter * spacing, self.seed),
            |site| equation_of_state.density(density * gravity * (height - site[1])),
            |_| density * (spacing * spacing),
        );
        let domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
        let bed = Wall { roughness: self.surface, ..Wall::still(1, 0.0, 1.0) };
        let extent = (Vector::<2>::zeros(), Vector::<2>::new(BED_END * self.width, height));
        let rheology = self.rheology();
        let rows = wall_rows(numerics.smoothing_ratio);
        let walls = vec![bed];
        let mut scene = Scene {
            wall_particles: fill(&walls, &domain, extent, spacing, rows),
            walls,
            domain,
            gravity: Vector::<2>::new(0.0, -gravity),
            numerics,
            ..Scene::unbounded(flow, spacing, equation_of_state, rheology)
        };
        if self.is_gated() {
            close_by_gate(&mut scene, self.width, height, self.gate_speed, rows);
        }
        scene
    }

    /// Height of the water beside the symmetry plane, half a spacing above the highest particle there `[m]`. Its volume there would fall by
    /// steps, for columns of particles leave the plane one after the other.
    fn height(&self, snapshot: &Snapshot<2>) -> f64 {
        let beside = snapshot.position.iter().filter(|place| place[0] < WALL_STRIP * self.width);
        beside.fold(0.0_f64, |top, place| top.max(place[1])) + 0.5 * self.spacing()
    }

    /// The first place from the symmetry plane outwards where less than [`FRONT_THICKNESS`] of the width stands `[m]`.
    fn front(&self, snapshot: &Snapshot<2>) -> f64 {
        let (from, to) = (Vector::<2>::zeros(), Vector::<2>::new(BED_END * self.width, 0.0));
        let line = FrontLine { from, to, section: FRONT_THICKNESS * self.width, strip: None, side: None };
        line.reached(self.spacing(), snapshot)
    }
}
