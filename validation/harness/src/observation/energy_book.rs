//! The energy ledger of a run as it was observed: what came in, where it went, and what the ledger leaves open.

use bagnold_solver::weakly_compressible::energy::EnergyAccount;
use serde::{Deserialize, Serialize};

/// Energies over the samples of a run `[J]`, in two dimensions `[J/m]`; empty where the numerics keep no ledger.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyBook {
    /// Kinetic, elastic and potential energy, the latter from zero at the start.
    pub total: Vec<f64>,
    /// Change of total energy since the start that the ledger explains.
    pub explained: Vec<f64>,
    /// Work of gravity up to the last sample.
    pub gravity: f64,
    /// Energy that walls, at rest and moving, have given up to the last sample.
    pub walls: f64,
    /// Energy that the kernel corrections have fed in up to the last sample.
    pub correction: f64,
    /// Energy dissipated up to the last sample, by cause.
    pub dissipated: Vec<(String, f64)>,
    /// Kinetic energy at the start, and energy that inlets have brought up to the last sample.
    pub entered: (f64, f64),
    /// Absolute work of gravity and of walls, summed over the intervals between samples.
    pub exchanged: (f64, f64),
    /// Time integral of the kinetic energy `[J s]`, in two dimensions `[J s/m]`.
    pub motion: f64,
    /// Time `[s]` and kinetic energy at the last sample.
    pub last: (f64, f64),
    /// Largest loss of kinetic energy from one sample to the next, the time between them `[s]`, and the kinetic energy before.
    pub braking: (f64, f64, f64),
    /// Time `[s]` and kinetic energy when it was last seen between samples, or at one after that.
    seen: (f64, f64),
    /// Loss of kinetic energy by an impact, the time that it took `[s]`, and the energy before: a quarter or more between two times that it
    /// was seen.
    pub impact: (f64, f64, f64),
}

/// Least share of the kinetic energy that an impact takes `[-]`.
const IMPACT: f64 = 0.25;

impl EnergyBook {
    /// Enters the kinetic energy at a time `[s]` between samples that are so far apart that an impact is over in between.
    pub fn see(&mut self, time: f64, kinetic: f64) {
        let lost = self.seen.1 - kinetic;
        if lost > self.impact.0.max(IMPACT * self.seen.1) {
            self.impact = (lost, time - self.seen.0, self.seen.1);
        }
        self.seen = (time, kinetic);
    }

    /// Enters a sample at a time `[s]`, the last of which is the end, with the energy that has left with particles.
    pub fn enter(&mut self, time: f64, account: &EnergyAccount, left: f64) {
        let ledger = &account.ledger;
        if !self.total.is_empty() {
            self.exchanged.0 += (ledger.gravity - self.gravity).abs();
            self.exchanged.1 += (ledger.walls - self.walls).abs();
            self.motion += 0.5 * (account.kinetic + self.last.1) * (time - self.last.0);
            if self.last.1 - account.kinetic > self.braking.0 {
                self.braking = (self.last.1 - account.kinetic, time - self.last.0, self.last.1);
            }
        } else {
            self.entered.0 = account.kinetic;
        }
        if self.seen.0 > self.last.0 {
            self.see(time, account.kinetic);
        }
        self.last = (time, account.kinetic);
        self.total.push(account.total() + left);
        self.explained.push(ledger.given() - ledger.dissipated());
        (self.gravity, self.walls, self.correction) = (ledger.gravity, ledger.walls, ledger.correction);
        let causes = [
            ("viscosity", ledger.viscous),
            ("plastic flow", ledger.plastic),
            ("artificial terms", ledger.artificial),
            ("hourglass control at walls", ledger.wall_control),
            ("density coupling", ledger.density_coupling),
            ("contacts", ledger.contact),
        ];
        // few flows have side walls, and none of the others has a cause less for them
        let side_walls = (ledger.side_walls != 0.0).then_some(("friction of side walls", ledger.side_walls));
        self.dissipated =
            causes.into_iter().chain(side_walls).map(|(cause, energy)| (cause.to_owned(), energy)).collect();
    }

    /// Largest difference between the change of energy since the start and the sum of the ledger.
    pub fn residual(&self) -> f64 {
        let open: Vec<f64> =
            self.total.iter().zip(&self.explained).map(|(total, explained)| total - explained).collect();
        let start = open.first().copied().unwrap_or(f64::NAN);
        open.iter().fold(if start.is_nan() { f64::NAN } else { 0.0 }, |most, open| most.max((open - start).abs()))
    }

    /// The work that a run is about: the largest of gravity's, of walls', of what was dissipated, and of what came in with the
    /// motion of the start and through inlets. What swings to and fro counts each time.
    pub fn turnover(&self) -> f64 {
        let dissipated: f64 = self.dissipated.iter().map(|(_, energy)| energy.abs()).sum();
        self.exchanged.0.max(self.exchanged.1).max(dissipated).max(self.entered.0 + self.entered.1)
    }

    /// Energy that a cause has dissipated up to the last sample.
    pub fn dissipated_by(&self, cause: &str) -> f64 {
        self.dissipated.iter().find(|(name, _)| name == cause).map_or(0.0, |(_, energy)| *energy)
    }

    /// Energy that the viscosity of the law has dissipated up to the last sample, and what the scheme has: by artificial terms, the
    /// hourglass control at walls and the density coupling, less what it has fed in beside gravity and walls.
    pub fn viscous_and_numerical(&self) -> (f64, f64) {
        let of = |cause: &str| self.dissipated_by(cause);
        let physical: f64 =
            ["viscosity", "plastic flow", "contacts", "friction of side walls"].into_iter().map(of).sum();
        (of("viscosity"), self.walls - self.explained.last().unwrap_or(&0.0) - physical)
    }

    /// Largest rise of the total energy above its least value before.
    pub fn rise(&self) -> f64 {
        let mut least = f64::INFINITY;
        self.total.iter().fold(0.0, |most: f64, &total| {
            least = least.min(total);
            most.max(total - least)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::weakly_compressible::energy::EnergyLedger;

    #[test]
    fn residual_and_rise_are_the_worst_of_all_samples() {
        let book = EnergyBook {
            total: vec![1.0, 0.5, 0.75, 0.25],
            explained: vec![0.0, -0.5, -0.375, -0.75],
            ..EnergyBook::default()
        };
        assert_eq!(book.residual(), 0.125);
        assert_eq!(book.rise(), 0.25);
        assert!(EnergyBook::default().residual().is_nan());
    }

    #[test]
    fn the_scheme_dissipates_what_neither_law_nor_walls_do() {
        let ledger = EnergyLedger {
            gravity: 64.0,
            walls: 32.0,
            viscous: 0.25,
            plastic: 16.0,
            artificial: 4.0,
            wall_control: 0.5,
            density_coupling: 1.0,
            contact: 8.0,
            side_walls: 128.0,
            correction: 2.0,
            cut: 0.125,
            ways: -1.0,
        };
        let mut book = EnergyBook::default();
        book.enter(1.0, &EnergyAccount { kinetic: 1.0, elastic: 0.0, ledger }, 0.0);
        assert_eq!(book.viscous_and_numerical(), (0.25, 4.0 + 0.5 + 1.0 - 2.0 - 0.125 + 1.0));
        assert_eq!(EnergyBook::default().viscous_and_numerical(), (0.0, 0.0));
    }

    #[test]
    fn every_swing_counts() {
        let mut book = EnergyBook::default();
        for (time, gravity, walls, kinetic) in [(0.0, 0.0, 0.0, 0.0), (1.0, 2.0, 0.5, 2.0), (3.0, -1.0, 1.5, 1.0)] {
            let ledger = EnergyLedger { gravity, walls, viscous: 0.25, ..EnergyLedger::default() };
            book.enter(time, &EnergyAccount { kinetic, elastic: 0.0, ledger }, 0.0);
        }
        assert_eq!((book.exchanged, book.motion), ((5.0, 1.5), 1.0 + 3.0));
        assert_eq!(book.braking, (1.0, 2.0, 2.0));
        assert_eq!(book.turnover(), 5.0);
        // what was in motion at the start, and what an inlet brought
        book.entered = (4.0, 2.0);
        assert_eq!(book.turnover(), 6.0);
    }
}
