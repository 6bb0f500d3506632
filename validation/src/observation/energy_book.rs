//! The energy ledger of a run as it was observed: what came in, where it went, and what the ledger leaves open.

use bagnold_solver::weakly_compressible::energy::EnergyAccount;
use serde::{Deserialize, Serialize};

/// Energies over the samples of a run `[J]`, in two dimensions `[J/m]`; empty where the numerics keep no ledger.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyBook {
    /// Kinetic, elastic and potential energy, the latter from zero at the start.
    pub total: Vec<f64>,
    /// What the ledger says that energy has changed by since the start.
    pub explained: Vec<f64>,
    /// Work of gravity up to the last sample.
    pub gravity: f64,
    /// What walls at rest, and those that move, have given up to the last sample.
    pub walls: f64,
    /// What the kernel corrections have fed in up to the last sample.
    pub correction: f64,
    /// What was dissipated up to the last sample, by cause.
    pub dissipated: Vec<(String, f64)>,
}

impl EnergyBook {
    /// Enters a sample, the last of which is the end.
    pub fn enter(&mut self, account: &EnergyAccount) {
        let ledger = &account.ledger;
        self.total.push(account.total());
        self.explained.push(ledger.walls + ledger.correction - ledger.dissipated());
        (self.gravity, self.walls, self.correction) = (ledger.gravity, ledger.walls, ledger.correction);
        let causes = [
            ("viscosity", ledger.viscous),
            ("plastic flow", ledger.plastic),
            ("artificial terms", ledger.artificial),
            ("hourglass control at walls", ledger.wall_control),
            ("density coupling", ledger.density_coupling),
            ("contacts", ledger.contact),
        ];
        self.dissipated = causes.map(|(cause, energy)| (cause.to_owned(), energy)).to_vec();
    }

    /// Largest difference between what the energy has changed by since the start and what the ledger says.
    #[must_use]
    pub fn residual(&self) -> f64 {
        let open: Vec<f64> =
            self.total.iter().zip(&self.explained).map(|(total, explained)| total - explained).collect();
        let start = open.first().copied().unwrap_or(f64::NAN);
        open.iter().fold(if start.is_nan() { f64::NAN } else { 0.0 }, |most, open| most.max((open - start).abs()))
    }

    /// Largest rise of the total energy above its least value before.
    #[must_use]
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
}
