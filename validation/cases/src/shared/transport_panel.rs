//! Published formulas of bed-load transport over the Shields number, for what a case adds as points.

use crate::figure::{Axis, Panel};
use crate::reference::bed_load::{MEASURED_BAND, MEASURED_TRANSPORT, TransportFormula};

/// Shields numbers that are drawn `[-]`, evenly spaced in their logarithm.
const RANGE: (f64, f64) = (0.055, 0.5);
const POINTS: i32 = 120;
/// Transport below which no measured run is drawn `[-]`.
const LEAST_TRANSPORT: f64 = 1e-3;
/// Shields number from which on the band holds `[-]`.
const BAND_FROM: f64 = 0.1;
/// Colour of the measured runs, behind the formulas.
const MEASURED_SLOT: usize = 6;

/// q* of every formula, with the band about Wong & Parker's.
pub(crate) fn formulas() -> Panel {
    let drawn = MEASURED_TRANSPORT.points.iter().copied().filter(|(tau, q)| *tau >= RANGE.0 && *q >= LEAST_TRANSPORT);
    let mut panel = Panel::new("", Axis::logarithmic("τ* [-]"), Axis::logarithmic("q* [-]"));
    let shields = |k: i32| RANGE.0 * libm::pow(RANGE.1 / RANGE.0, f64::from(k) / f64::from(POINTS));
    let own = TransportFormula::WongParker;
    let curve = |formula: TransportFormula| (0..=POINTS).map(shields).map(move |tau| (tau, formula.transport(tau)));
    let most = MEASURED_TRANSPORT.points.iter().map(|(tau, _)| *tau).fold(0.0, f64::max);
    panel.band(
        &format!("90 % of the runs with τ* ≥ 0.1: factor {:.2} … {:.2}", MEASURED_BAND.0, MEASURED_BAND.1),
        (0..=POINTS)
            .map(shields)
            .filter(|tau| (BAND_FROM..=most).contains(tau))
            .map(|tau| (tau, MEASURED_BAND.0 * own.transport(tau), MEASURED_BAND.1 * own.transport(tau))),
    );
    panel.points("measured, Meyer-Peter & Müller 1948", MEASURED_SLOT, drawn);
    panel.reference(own.name(), curve(own));
    for (slot, formula) in TransportFormula::ALL.into_iter().filter(|formula| *formula != own).enumerate() {
        panel.line(formula.name(), slot + 1, curve(formula));
    }
    panel
}
