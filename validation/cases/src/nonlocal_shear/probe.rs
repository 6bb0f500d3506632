//! What the rows of a channel have in the mean over time.

use super::channel::Channel;
use crate::metric::unsteadiness;
use crate::observation::EnergyBook;
use crate::statistics::mean;
use bagnold_solver::weakly_compressible::Snapshot;
use serde::{Deserialize, Serialize};

/// Results of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ShearObservation {
    /// Times of the series `[s]`.
    pub time: Vec<f64>,
    /// Mean velocity along the walls at these times `[m/s]`.
    pub mean_velocity: Vec<f64>,
    /// The rows from below, over the last part of the run: mean heights `[m]`.
    pub height: Vec<f64>,
    /// Velocities of the rows `[m/s]`.
    pub velocity: Vec<f64>,
    /// Pressures of the rows `[Pa]`, as they act on the walls.
    pub pressure: Vec<f64>,
    /// Shear stresses s_xy of the rows `[Pa]`, as they act on the walls.
    pub shear_stress: Vec<f64>,
    /// Mass over volume `[kg/m³]`.
    pub density: f64,
    /// The energy ledger.
    pub energy: EnergyBook,
    /// Particles that ended behind a wall.
    pub particles_lost: usize,
}

impl ShearObservation {
    /// Mean pressure of all rows `[Pa]`.
    pub fn mean_pressure(&self) -> f64 {
        mean(&self.pressure)
    }

    /// (height `[m]`, velocity `[m/s]`) of the rows from below.
    pub fn velocities(&self) -> Vec<(f64, f64)> {
        self.height.iter().copied().zip(self.velocity.iter().copied()).collect()
    }

    /// Why the rows over the last `window` `[s]` are not those of a steady flow; none where they are.
    pub fn unsteadiness(&self, window: f64) -> Option<String> {
        let series = self.time.iter().copied().zip(self.mean_velocity.iter().copied());
        unsteadiness("the mean velocity", series, window)
    }
}

/// Collects what a run leaves behind.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ShearProbe {
    width: f64,
    area: f64,
    averaged_from: f64,
    /// Sum of the particles' volumes over that of the channel, and of how many samples.
    filling: (f64, f64),
    /// Sums over the samples of each row: height, velocity, pressure, shear stress, and how many there are.
    sums: Vec<[f64; 5]>,
    seen: ShearObservation,
}

impl ShearProbe {
    /// One for a channel whose rows are averaged from a time on `[s]`.
    pub(super) fn new(channel: &Channel<'_>, averaged_from: f64) -> Self {
        Self {
            width: channel.width,
            area: channel.width * channel.length(),
            averaged_from,
            filling: (0.0, 0.0),
            sums: vec![[0.0; 5]; channel.grains.rows],
            seen: ShearObservation::default(),
        }
    }

    pub(super) fn observe(&mut self, snapshot: &Snapshot<2>) {
        let mass: f64 = snapshot.mass.iter().sum();
        let momentum: f64 = snapshot.mass.iter().zip(&snapshot.velocity).map(|(m, v)| m * v[0]).sum();
        self.seen.time.push(snapshot.time);
        self.seen.mean_velocity.push(momentum / mass);
        self.seen.density = mass / self.area;
        self.seen.particles_lost = snapshot.position.iter().filter(|x| !(x[1] > 0.0 && x[1] < self.width)).count();
        if let Some(account) = &snapshot.energy {
            self.seen.energy.enter(snapshot.time, account, 0.0);
        }
        if snapshot.time < self.averaged_from {
            return;
        }
        let volume: f64 = snapshot.mass.iter().zip(&snapshot.density).map(|(mass, density)| mass / density).sum();
        self.filling = (self.filling.0 + volume / self.area, self.filling.1 + 1.0);
        let rows = self.sums.len();
        for index in 0..snapshot.position.len() {
            let y = snapshot.position[index][1];
            let row = ((y / self.width * rows as f64).max(0.0) as usize).min(rows - 1);
            let stress = snapshot.stress[index][(0, 1)];
            let values = [y, snapshot.velocity[index][0], snapshot.pressure[index], stress, 1.0];
            self.sums[row].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
    }

    /// Observed data. The mean stress of a volume is Σ V σ over it, with the volumes m/ρ by which particles act on each other.
    /// Displaced particles have a few parts in a thousand more of that than there is room, as sums over displaced neighbours are not
    /// consistent with constants: their stresses bear on the walls by as much more than their own values say.
    pub(super) fn finish(self) -> ShearObservation {
        let filling = self.filling.0 / self.filling.1;
        // grains between walls fill every row; one without would say so by not being a number
        let column = |place: usize, factor: f64| self.sums.iter().map(|sums| factor * sums[place] / sums[4]).collect();
        ShearObservation {
            height: column(0, 1.0),
            velocity: column(1, 1.0),
            pressure: column(2, filling),
            shear_stress: column(3, filling),
            ..self.seen
        }
    }
}
