//! How the runs are judged.

use super::Record;
use crate::case::Run;
use crate::metric::{Confidence, Limit, Metric};

const BALANCE: &str = "root of (ρ_s − ρ_f) g = c C_d ρ_f u²/d, c = ½ for the planar form (30)";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    records.iter().flat_map(alone).collect()
}

/// Value over its reference less one `[%]`.
fn percent(value: f64, reference: f64) -> f64 {
    100.0 * (value / reference - 1.0)
}

fn alone((run, record): &Record) -> Vec<Metric> {
    let (variant, series, root) = (run.variant(), &record.data.series, run.terminal_velocity());
    let error = |name: &str, array: &[f64]| {
        let (mean, noise) = series.mean(array);
        // a box is a chaotic flow: its mean over the window moves by its own error when anything is rounded otherwise
        Metric::observed(name, &variant, percent(mean, root), "%")
            .against(Some(0.0), BALANCE, Confidence::Exact)
            .with_snapshot_tolerance(0.0, 300.0 * noise / root)
    };
    let reason = "acceptance line 4 of the bed-load model: 1 %, mean over the last 0.6 of the run";
    vec![
        error("terminal_velocity_error", &series.slip).gated(Limit::Within(-1.0, 1.0), reason),
        error("slip_of_means_error", &series.slip_of_means),
        error("root_mean_square_slip_error", &series.root_mean_square_slip),
        momentum(&variant, record.data.momentum_error),
    ]
}

fn momentum(variant: &str, error: f64) -> Metric {
    Metric::observed("momentum_error", variant, error, "-")
        .against(Some(0.0), "change of momentum = impulse of gravity, in every step", Confidence::Exact)
        .gated(
            Limit::AtMost(1e-10),
            "acceptance line 4: 1e-10 of the grains' weight; pairs exchange equal and opposite impulses",
        )
        .with_snapshot_tolerance(0.0, 1e-10)
}
