//! Observation of a scene: the gauges' series, and its balances.

use crate::observation::EnergyBook;
use bagnold_solver::material::pore_liquid::SKELETON_SHARE;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::energy::{EnergyAccount, EnergyLedger};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use serde::{Deserialize, Serialize};

/// Share of the particles whose speed counts.
const SLOWER_SHARE: f64 = 0.995;

/// Outflow through one side; in the plane, masses are those per metre of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct OutflowRecord {
    /// Particles.
    pub particles: u64,
    /// Their mass `[kg]`.
    pub mass: f64,
}

/// Inflow through an inlet up to the last sample; in the plane, masses are those per metre of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FedMass {
    /// Particles.
    pub particles: u64,
    /// Their mass `[kg]`.
    pub mass: f64,
    /// Largest difference of the mass that was fed from the integral of the rate, at any sample, over the mass of a row `[-]`.
    pub farthest: f64,
    /// Size of their momentum as they came `[kg m/s]`.
    #[serde(default)]
    pub impulse: f64,
}

/// Volume that a mixture of grains and liquid has lost, and where its water went, up to the last sample; in the plane per metre of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WaterBook {
    /// Volume, and what compression of the pore liquid and expelled water have taken from it, at the start `[m³]`.
    start: (f64, f64),
    /// Water that has left by the free surface `[m³]`.
    pub expelled: f64,
    /// Largest volume lost or gained at a sample `[m³]`.
    pub largest: f64,
    /// Largest difference at a sample of the volume lost from what has left and what is compressed `[m³]`.
    pub missing: f64,
}

impl WaterBook {
    fn enter<const D: usize>(&mut self, simulation: &Simulation<D>, snapshot: &Snapshot<D>, is_first: bool) {
        if simulation.rheology().pore_liquid().is_none() {
            return;
        }
        let modulus = (1.0 - SKELETON_SHARE) * simulation.bulk_modulus();
        let volumes = snapshot.mass.iter().zip(&snapshot.density).map(|(mass, density)| mass / density);
        let (mut volume, mut compressed) = (0.0, 0.0);
        self.expelled = 0.0;
        for ((own, pressure), memory) in volumes.zip(&snapshot.field).zip(&snapshot.memory) {
            volume += own;
            compressed += own * pressure / modulus;
            self.expelled += own * memory[1];
        }
        if is_first {
            self.start = (volume, compressed + self.expelled);
        }
        let lost = self.start.0 - volume;
        self.largest = self.largest.max(lost.abs());
        self.missing = self.missing.max((lost - self.expelled - (compressed - self.start.1)).abs());
    }
}

/// Sums of a simulation at the start of an observation.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct SumsBefore {
    /// Mass inside and outside without that of inlets `[kg]`.
    mass: f64,
    /// Mass times the time that it was there `[kg s]`.
    mass_times_time: f64,
    ledger: EnergyLedger,
}

/// Series and balances; every series has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SceneObservation<const D: usize> {
    /// Times `[s]`.
    pub time: Vec<f64>,
    /// Mass in the scene `[kg]`.
    pub mass: Vec<f64>,
    /// Root mean square of the speed in the scene `[m/s]`.
    pub rms_speed: Vec<f64>,
    /// The gauges' values, shape `[columns][samples]`.
    pub gauges: Vec<Vec<f64>>,
    /// The energy ledger, with what has left still counted, and what inlets have brought not.
    pub energy: EnergyBook,
    /// Outflow through the lower and the upper side of the first axis, then of the next, up to the last sample.
    pub left: Vec<OutflowRecord>,
    /// Inflow, inlet by inlet.
    pub fed: Vec<FedMass>,
    /// Largest difference between the mass (inside and outside) and the initial plus fed mass `[kg]`.
    pub missing_mass: f64,
    /// Largest impulse that has no cause among gravity, walls, side walls, sides, and what implicit steps leave out `[kg m/s]`.
    pub missing_impulse: f64,
    /// Largest impulse that implicit viscous steps have left out up to a sample `[kg m/s]`.
    pub unsolved_impulse: f64,
    /// Iterations of an implicit viscous step, their mean over all steps.
    pub viscous_iterations: f64,
    /// Largest difference between what the walls have given, wall by wall, and what the particles have got from them, mirrors
    /// included `[kg m/s]`.
    pub unassigned_impulse: f64,
    /// Impulse of gravity up to the last sample, its size, and more under pressure `[kg m/s]`.
    pub gravity_impulse: f64,
    /// Momentum at the start, without what a state has got before `[kg m/s]`; none before the first sample.
    pub momentum_at_start: Option<Vector<D>>,
    /// Sums at the start: those of a state that the scene starts from.
    pub(super) before: SumsBefore,
    /// The same without directions, Σ m |v| `[kg m/s]`.
    #[serde(default)]
    pub motion_at_start: f64,
    /// Largest speed of the slower 99.5 % of the particles at any sample `[m/s]`, relative to the wall from which all are slowest: single grains
    /// do not decide it.
    pub largest_speed: f64,
    /// Particles that are behind a wall at the end.
    pub behind: u64,
    /// Water of a mixture.
    #[serde(default)]
    pub water: WaterBook,
    /// Share of the sites of bodies that are behind walls, as `cut_at_most` limits it of each `[-]`.
    pub cut_off: f64,
}

impl<const D: usize> SceneObservation<D> {
    /// Enters a sample under gravity, with the acceleration by which impulses are scaled `[m/s²]`.
    pub(super) fn enter(
        &mut self,
        simulation: &Simulation<D>,
        snapshot: &Snapshot<D>,
        (gravity, pull): (&Vector<D>, f64),
        gauges: Vec<f64>,
    ) {
        let sides = &simulation.outflow().sides;
        let inside = snapshot.mass.iter().fold(0.0, |sum, mass| sum + mass);
        let outside: f64 = sides.iter().map(|side| side.mass).sum();
        let held: Vector<D> = snapshot.velocity.iter().zip(&snapshot.mass).map(|(v, m)| v * *m).sum();
        let gone: Vector<D> = sides.iter().map(|side| side.momentum).sum();
        let supports: Vector<D> = snapshot.support_impulse.iter().sum::<Vector<D>>()
            + sides.iter().map(|side| side.support).sum::<Vector<D>>();
        let walls: Vector<D> = simulation.facet_wall_impulses().iter().sum();
        let inlets = &simulation.inflow().inlets;
        let brought: f64 = inlets.iter().map(|fed| fed.mass).sum();
        let came: Vector<D> = inlets.iter().map(|fed| fed.momentum).sum();
        let absent: f64 = inlets.iter().map(|fed| fed.mass_times_time).sum();
        let worked = sides.iter().map(|side| side.mass_times_time).sum::<f64>() - absent;
        let over_time = inside * snapshot.time + worked;
        let given = gravity * over_time;
        let unsolved = simulation.unsolved_impulse();
        let taken = supports + simulation.side_wall_impulse();
        self.water.enter(simulation, snapshot, self.time.is_empty());
        if self.time.is_empty() {
            let ledger = snapshot.energy.map_or_else(EnergyLedger::default, |account| account.ledger);
            self.before = SumsBefore { mass: inside + outside - brought, mass_times_time: over_time, ledger };
            self.motion_at_start = snapshot.velocity.iter().zip(&snapshot.mass).map(|(v, m)| v.norm() * m).sum();
            self.gauges = vec![Vec::new(); gauges.len()];
        }
        let start = *self.momentum_at_start.get_or_insert(held + gone + unsolved - came - taken - given);
        let missing = held + gone + unsolved - came - start - taken - given;
        self.time.push(snapshot.time);
        self.mass.push(inside);
        let squares: f64 = snapshot.velocity.iter().zip(&snapshot.mass).map(|(v, m)| v.norm_squared() * m).sum();
        // before the first row of an inlet there is nothing that moves
        self.rms_speed.push(if inside > 0.0 { (squares / inside).sqrt() } else { 0.0 });
        self.largest_speed = self.largest_speed.max(largest_speed(simulation, snapshot));
        for (series, value) in self.gauges.iter_mut().zip(gauges) {
            series.push(value);
        }
        self.left = sides.iter().map(|side| OutflowRecord { particles: side.particles, mass: side.mass }).collect();
        self.fed.resize(inlets.len(), FedMass::default());
        for ((entry, fed), inlet) in self.fed.iter_mut().zip(inlets).zip(simulation.inlets()) {
            let off = (fed.mass - inlet.rate.mass(snapshot.time)).abs() / inlet.row_mass();
            let (farthest, impulse) = (entry.farthest.max(off), fed.momentum.norm());
            *entry = FedMass { particles: fed.particles, mass: fed.mass, farthest, impulse };
        }
        self.missing_mass = self.missing_mass.max((inside + outside - self.before.mass - brought).abs());
        self.missing_impulse = self.missing_impulse.max(missing.norm());
        self.unsolved_impulse = self.unsolved_impulse.max(unsolved.norm());
        self.viscous_iterations = simulation.viscous_iterations() as f64 / simulation.steps().max(1) as f64;
        self.unassigned_impulse = self.unassigned_impulse.max((supports - walls).norm());
        self.gravity_impulse = pull * (over_time - self.before.mass_times_time);
        if let Some(account) = &snapshot.energy {
            let kept: f64 = sides.iter().map(|side| side.energy).sum();
            let given: f64 = inlets.iter().map(|fed| fed.energy).sum();
            self.energy.entered.1 = given;
            let account = EnergyAccount { ledger: account.ledger.since(self.before.ledger), ..*account };
            self.energy.enter(snapshot.time, &account, kept - given);
        }
    }

    /// The largest impulse that enters: that of gravity, or that with which material started and came in `[kg m/s]`.
    pub(super) fn impulse(&self) -> f64 {
        self.gravity_impulse.max(self.motion_at_start + self.fed.iter().map(|fed| fed.impulse).sum::<f64>())
    }

    /// Total mass, of the start and of inlets up to the last sample `[kg]`.
    pub(super) fn whole_mass(&self) -> f64 {
        let begun = if self.mass.is_empty() { f64::NAN } else { self.before.mass };
        begun + self.fed.iter().map(|fed| fed.mass).sum::<f64>()
    }
}

/// Largest speed of the slower particles, relative to the wall from which it is smallest `[m/s]`; without walls relative to the frame.
fn largest_speed<const D: usize>(simulation: &Simulation<D>, snapshot: &Snapshot<D>) -> f64 {
    let walls = simulation.facet_walls();
    let own = walls.is_empty().then(|| simulation.frame());
    let mut frames: Vec<_> = walls.iter().map(|wall| wall.motion.velocity(snapshot.time)).chain(own).collect();
    frames.dedup();
    let Some(last) = snapshot.velocity.len().checked_sub(1) else { return 0.0 };
    let place = (SLOWER_SHARE * last as f64) as usize;
    let from = |frame: Vector<D>| {
        let mut speeds: Vec<f64> = snapshot.velocity.iter().map(|velocity| (velocity - frame).norm_squared()).collect();
        speeds.select_nth_unstable_by(place, f64::total_cmp).1.sqrt()
    };
    frames.into_iter().map(from).fold(f64::INFINITY, f64::min)
}
