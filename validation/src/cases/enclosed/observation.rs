//! What a scene leaves behind: the gauges' series, and its balances.

use crate::observation::EnergyBook;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use serde::{Deserialize, Serialize};

/// What left by one side; in the plane, masses and impulses are those per metre of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Left {
    /// Particles.
    pub particles: u64,
    /// Their mass `[kg]`.
    pub mass: f64,
}

/// Series and balances; every series has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneObservation<const D: usize> {
    /// Times `[s]`.
    pub time: Vec<f64>,
    /// Mass in the scene `[kg]`.
    pub mass: Vec<f64>,
    /// Root mean square of the speed in the scene `[m/s]`.
    pub rms_speed: Vec<f64>,
    /// The gauges' values, shape `[columns][samples]`.
    pub gauges: Vec<Vec<f64>>,
    /// The energy ledger, with what has left still counted.
    pub energy: EnergyBook,
    /// What left by the lower and the upper side of the first axis, then of the next, up to the last sample.
    pub left: Vec<Left>,
    /// Largest difference of the mass inside and outside from that of the start `[kg]`.
    pub missing_mass: f64,
    /// Largest impulse that has no cause among gravity, walls and sides `[kg m/s]`.
    pub missing_impulse: f64,
    /// Largest difference between what the walls have given, wall by wall, and what the particles have got from them, mirrors
    /// included `[kg m/s]`.
    pub unassigned_impulse: f64,
    /// Impulse of gravity up to the last sample, its size `[kg m/s]`.
    pub gravity_impulse: f64,
    /// Momentum at the start `[kg m/s]`.
    pub momentum_at_start: Vector<D>,
    /// Particles that are behind a wall at the end.
    pub behind: u64,
    /// Share of the sites of bodies that are behind walls or nearer to them than particles start `[-]`.
    pub cut_off: f64,
}

impl<const D: usize> Default for SceneObservation<D> {
    fn default() -> Self {
        Self {
            time: Vec::new(),
            mass: Vec::new(),
            rms_speed: Vec::new(),
            gauges: Vec::new(),
            energy: EnergyBook::default(),
            left: Vec::new(),
            missing_mass: 0.0,
            missing_impulse: 0.0,
            unassigned_impulse: 0.0,
            gravity_impulse: 0.0,
            momentum_at_start: Vector::zeros(),
            behind: 0,
            cut_off: 0.0,
        }
    }
}

impl<const D: usize> SceneObservation<D> {
    /// Enters a sample.
    pub(super) fn enter(
        &mut self,
        simulation: &Simulation<D>,
        snapshot: &Snapshot<D>,
        gravity: &Vector<D>,
        gauges: Vec<f64>,
    ) {
        let sides = &simulation.departures().sides;
        let inside: f64 = snapshot.mass.iter().sum();
        let outside: f64 = sides.iter().map(|side| side.mass).sum();
        let held: Vector<D> = snapshot.velocity.iter().zip(&snapshot.mass).map(|(v, m)| v * *m).sum();
        let gone: Vector<D> = sides.iter().map(|side| side.momentum).sum();
        let supports: Vector<D> = snapshot.support_impulse.iter().sum::<Vector<D>>()
            + sides.iter().map(|side| side.support).sum::<Vector<D>>();
        let walls: Vector<D> = simulation.shell_impulses().iter().sum();
        let worked: f64 = sides.iter().map(|side| side.mass_times_time).sum();
        let given = gravity * (inside * snapshot.time + worked);
        if self.time.is_empty() {
            self.momentum_at_start = held;
            self.gauges = vec![Vec::new(); gauges.len()];
        }
        let missing = held + gone - self.momentum_at_start - supports - given;
        self.time.push(snapshot.time);
        self.mass.push(inside);
        let squares: f64 = snapshot.velocity.iter().zip(&snapshot.mass).map(|(v, m)| v.norm_squared() * m).sum();
        self.rms_speed.push((squares / inside).sqrt());
        for (series, value) in self.gauges.iter_mut().zip(gauges) {
            series.push(value);
        }
        self.left = sides.iter().map(|side| Left { particles: side.particles, mass: side.mass }).collect();
        self.missing_mass = self.missing_mass.max((inside + outside - self.mass[0]).abs());
        self.missing_impulse = self.missing_impulse.max(missing.norm());
        self.unassigned_impulse = self.unassigned_impulse.max((supports - walls).norm());
        self.gravity_impulse = given.norm();
        if let Some(account) = &snapshot.energy {
            let kept: f64 = sides.iter().map(|side| side.energy).sum();
            self.energy.enter(snapshot.time, account, kept);
        }
    }
}
