//! The deterministic path of a collapse is not a matter of chance: a displacement of 1e-10 spacings changes nothing
//! that is measured of it.

use super::run_out::{PlanarColumn, column};
use bagnold_cases::collapse::Collapse;
use bagnold_harness::case::{Flow, Progress};

/// Relative change that the baseline allows `[-]`.
const TOLERANCE: f64 = 1e-3;
/// Allowed relative change of the stopping time `[-]`: the front creeps over its last percent, so that a thousandth of
/// its way is a hundredth of its time. The snapshots repeat to the bit and need no such allowance.
const STOPPING_TIME_TOLERANCE: f64 = 1e-2;

/// Allowed relative change of the run-out `[-]`: a grain more or less in the toe, which counts by its mass, moves the
/// front by 0.57 spacings.
const RUN_OUT_TOLERANCE: f64 = 1.2e-2;

/// The column a = 1 of Lagrée's grains from a lattice with displacements of this many spacings.
fn collapse(jitter: f64) -> Collapse {
    PlanarColumn { jitter, ..column(1.0) }.simulate(&Progress::SILENT).expect("a valid scene").data
}

#[test]
fn a_displacement_of_a_ten_billionth_spacing_changes_no_metric() {
    let (lattice, displaced) = (collapse(0.0), collapse(1e-10));
    assert_ne!(lattice.centroid, displaced.centroid, "the displacement must be there");
    type Measure = (&'static str, fn(&Collapse) -> f64, f64);
    let measures: [Measure; 6] = [
        ("run-out", Collapse::run_out, RUN_OUT_TOLERANCE),
        ("run-out of rows", Collapse::run_out_of_rows, TOLERANCE),
        ("final height", Collapse::final_height, TOLERANCE),
        ("centroid", |collapse| collapse.centroid, TOLERANCE),
        ("mass quantile", |collapse| collapse.quantiles.1, TOLERANCE),
        ("stopping time", Collapse::stopping_time, STOPPING_TIME_TOLERANCE),
    ];
    for (name, measure, tolerance) in measures {
        let (a, b) = (measure(&lattice), measure(&displaced));
        println!("{name}: {a} and {b}, relative difference {:.1e}", a / b - 1.0);
        assert!((a / b - 1.0).abs() < tolerance, "{name}: {a} and {b}");
    }
}
