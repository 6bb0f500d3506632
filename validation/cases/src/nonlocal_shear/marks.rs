//! How rows are marked in every figure of the case.

use super::run::ShearRun;

/// Least velocity that a logarithmic axis shows, over its largest `[-]`: three decades of a tail.
pub(super) const LEAST: f64 = 1e-3;
/// Least velocity whose relative error is drawn, over that of the plate `[-]`: rows that are nearly at rest keep the unevenness of the start.
pub(super) const LEAST_OF_ERRORS: f64 = 1e-2;

pub(super) const NONLOCAL: &str = "nonlocal law, without particles";
pub(super) const LOCAL: &str = "local law under the same stresses";

pub(super) fn label(run: &ShearRun) -> String {
    match run.particles_per_diameter {
        1 => "1 particle per diameter".to_owned(),
        count => format!("{count} particles per diameter"),
    }
}

/// Points that an axis from a least value on can show.
pub(super) fn shown(points: impl IntoIterator<Item = (f64, f64)>, least: f64) -> Vec<(f64, f64)> {
    points.into_iter().filter(|(_, value)| *value >= least).collect()
}

/// One row per diameter, which leaves the curve behind them to be seen.
pub(super) fn thinned(run: &ShearRun, rows: Vec<(f64, f64)>) -> impl Iterator<Item = (f64, f64)> {
    rows.into_iter().skip(run.particles_per_diameter / 2).step_by(run.particles_per_diameter)
}
