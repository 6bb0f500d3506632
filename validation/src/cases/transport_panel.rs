//! Published formulas of bed-load transport over the Shields number, for what a case adds as points.

use crate::figure::{Axis, Panel};
use crate::reference::{HONEST_BAND, TransportFormula};

/// Shields numbers that are drawn `[-]`, evenly spaced in their logarithm.
const RANGE: (f64, f64) = (0.07, 0.5);
const POINTS: i32 = 120;

/// q* of every formula, with the band about Wong & Parker's.
pub(super) fn formulas() -> Panel {
    let mut panel = Panel::new("", Axis::logarithmic("τ* [-]"), Axis::logarithmic("q* [-]"));
    let shields = |k: i32| RANGE.0 * libm::pow(RANGE.1 / RANGE.0, f64::from(k) / f64::from(POINTS));
    let own = TransportFormula::WongParker;
    let curve = |formula: TransportFormula| (0..=POINTS).map(shields).map(move |tau| (tau, formula.transport(tau)));
    panel.band(
        &format!("factor {} … {}", HONEST_BAND.0, HONEST_BAND.1),
        (0..=POINTS)
            .map(shields)
            .map(|tau| (tau, HONEST_BAND.0 * own.transport(tau), HONEST_BAND.1 * own.transport(tau))),
    );
    panel.reference(own.name(), curve(own));
    for (slot, formula) in TransportFormula::ALL.into_iter().filter(|formula| *formula != own).enumerate() {
        panel.line(formula.name(), slot + 1, curve(formula));
    }
    panel
}
