//! Conversion of the potential energy of a flow.

use crate::figure::{Axis, Figure, Panel};

/// End of the time axis over √(h_0/g) `[-]`: the deposits rest by then.
const LONGEST: f64 = 6.0;

/// Kinetic and potential energy over time, in any one unit.
#[derive(Debug, Clone, Copy)]
pub struct Energies<'a> {
    /// Times `[s]`.
    pub time: &'a [f64],
    /// Kinetic energy.
    pub kinetic: &'a [f64],
    /// Potential energy above the bed.
    pub potential: &'a [f64],
}

impl Energies<'_> {
    /// Potential energy released between start and end.
    fn released(&self) -> Option<f64> {
        let released = self.potential.first()? - self.potential.last()?;
        (released > 0.0).then_some(released)
    }

    /// Largest excess of kinetic plus potential energy over that of the start, over the initial potential energy `[-]`;
    /// never negative, since the start counts.
    pub fn largest_gain(&self) -> f64 {
        let total = self.kinetic.iter().zip(self.potential).map(|(kinetic, potential)| kinetic + potential);
        let largest = total.fold(f64::NEG_INFINITY, f64::max);
        match (self.kinetic.first(), self.potential.first()) {
            (Some(kinetic), Some(potential)) => (largest - kinetic - potential) / potential,
            _ => f64::NAN,
        }
    }
}

/// One panel per run: energy released, kinetic, and the rest, over the energy released at the end.
pub fn figure(name: &str, caption: &str, runs: &[(String, f64, Energies<'_>)]) -> Figure {
    let panels = runs.iter().filter_map(|(title, time_scale, energies)| {
        let (whole, start) = (energies.released()?, energies.potential.first()?);
        let time = Axis::linear("t/√(h0/g) [-]").between(0.0, LONGEST);
        let mut panel = Panel::new(title, time, Axis::linear("energy/released [-]").between(-0.05, 1.1));
        let mut curve = |label: &str, slot: usize, value: &dyn Fn(usize) -> f64| {
            let points = energies.time.iter().enumerate().map(|(k, time)| (time / time_scale, value(k) / whole));
            panel.line(label, slot, points);
        };
        let released = |k: usize| start - energies.potential[k];
        curve("released", 0, &released);
        curve("kinetic", 1, &|k| energies.kinetic[k]);
        curve("dissipated", 2, &|k| released(k) - energies.kinetic[k]);
        Some(panel)
    });
    Figure::new(name, caption, panels.collect()).in_columns(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_gain_counts_only_excess_over_the_start() {
        let time = [0.0, 1.0, 2.0];
        let gaining = Energies { time: &time, kinetic: &[0.0, 3.0, 0.0], potential: &[10.0, 8.0, 5.0] };
        assert!((gaining.largest_gain() - 0.1).abs() < 1e-15);
        let losing = Energies { kinetic: &[0.0, 1.0, 0.0], ..gaining };
        assert_eq!(losing.largest_gain(), 0.0);
        assert_eq!(figure("e", "", &[("run".to_owned(), 1.0, losing)]).panels[0].series.len(), 3);
        let rising = Energies { potential: &[1.0, 2.0, 3.0], ..gaining };
        assert!(figure("e", "", &[("run".to_owned(), 1.0, rising)]).panels.is_empty());
    }
}
