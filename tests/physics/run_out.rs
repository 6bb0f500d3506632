//! Run-out of columns: the measurement at rest, and the uncertainty at the default resolution.

use crate::threads::alone;
use bagnold_cases::collapse::columns::ColumnCase;
use bagnold_cases::collapse::{Collapse, ColumnFlow, Material};
use bagnold_harness::case::{Case, Flow, Progress, RunList, Tier};
use bagnold_harness::metric::{COVERAGE, Origin};
use bagnold_harness::observation::{Frame, Recorded};
use bagnold_solver::material::rheology::Rheology;

pub(super) type PlanarColumn = ColumnFlow<2>;

/// A column of Lagrée's grains, 20 particles over the half width.
pub(super) fn column(aspect_ratio: f64) -> PlanarColumn {
    let runs = RunList::<PlanarColumn>::of_tier(Tier::Quick);
    let lagree = runs.flows().iter().find(|run| run.made_of() == Material::LAGREE).expect("the tier has them");
    PlanarColumn { aspect_ratio, ..lagree.clone() }
}

fn records<R: Flow<Observation = Collapse>>(runs: Vec<R>) -> Vec<(R, Recorded<Collapse>)> {
    alone();
    let simulated = |run: R| {
        let record = run.simulate(&Progress::SILENT).expect("a valid scene");
        (run, record)
    };
    runs.into_iter().map(simulated).collect()
}

#[test]
fn a_column_that_does_not_move_has_no_run_out() {
    // nothing yields
    let standing = |aspect_ratio: f64| {
        let mut run = PlanarColumn { duration: 1.0, ..column(aspect_ratio) };
        if let Rheology::MuI(law) = &mut run.material {
            (law.static_friction, law.limiting_friction) = (5.0, 6.0);
        }
        run
    };
    for (run, record) in records([0.1, 0.5, 1.0, 3.0].map(standing).to_vec()) {
        let (start, end) = (record.data.front[0] - 1.0, record.data.run_out());
        let half_spacing = 0.5 / run.resolution as f64;
        println!("a = {}: {start} at the start, {end} at the end", run.aspect_ratio);
        assert!(start.abs() < half_spacing, "a = {}: {start}", run.aspect_ratio);
        // taller ones bulge by their elasticity, and buckle
        assert!(run.aspect_ratio > 0.5 || end.abs() < half_spacing, "a = {}: {end}", run.aspect_ratio);
    }
}

/// Run-out that columns of a = 0.5 approach: means over 40, 80 and 160 particles over the half width were 0.982, 0.949
/// and 0.935 by the thickness in bins of 0.1 r_0, which does not know rows, so of order 1.2; 0.962, 0.954 and 0.935 by
/// rows.
const APPROACHED: f64 = 0.924;

#[test]
fn the_interval_of_a_shallow_column_holds_what_finer_ones_approach() {
    let members = (2..=20).map(|ensemble_member| PlanarColumn { ensemble_member, ..column(0.5) });
    let records = records([column(0.5)].into_iter().chain(members).collect());
    assert_eq!(records.len(), 20);
    let metrics = (ColumnCase::<2>::METRICS)(&records);
    let shown = metrics.iter().find(|metric| metric.name == "run_out").expect("the column's own run-out");
    let own = records.iter().map(|(_, record)| record.data.run_out());
    let mean = own.clone().sum::<f64>() / records.len() as f64;
    // the scatter, which the metric takes from the ensemble, and each run's own share of a row
    let repeat = shown.uncertainty.standard().expect("known").powi(2)
        - shown.uncertainty.of(&[Origin::Numerical]).expect("known").powi(2);
    let covered = records.iter().filter(|(_, record)| {
        let spacing = record.data.front_uncertainty().expect("particles");
        (record.data.run_out() - APPROACHED).abs() <= COVERAGE * (repeat + spacing * spacing).sqrt()
    });
    let covered = covered.count();
    println!(
        "mean {mean}, {covered} of 20 intervals hold {APPROACHED}; that of seed 1 is {} ± {}",
        shown.value,
        COVERAGE * shown.uncertainty.standard().unwrap_or(0.0)
    );
    assert!((mean / APPROACHED - 1.0).abs() < 0.03, "{mean}");
    assert!(covered >= 18, "{covered} of 20");
}

/// Bulk modulus over the pressure below a column at rest `[-]`, as the paper has it.
const STIFFNESS: f64 = 50.0;

#[test]
fn grains_of_the_papers_stiffness_are_nearly_incompressible() {
    for (run, record) in records([1.0, 3.0].map(column).to_vec()) {
        let densest = |frame: &Frame| frame.scalar("density").iter().copied().fold(0.0, f64::max) / run.density();
        let compressions: Vec<f64> = record.frames.iter().map(|frame| densest(frame) - 1.0).collect();
        // the lowest grains are half a row above the bed, and displaced
        let row = 1.0 / (run.aspect_ratio * run.resolution as f64);
        println!("a = {}: {compressions:?}, over {}", run.aspect_ratio, 1.0 / STIFFNESS);
        assert!((STIFFNESS * compressions[0] - 1.0).abs() < row, "the weight of the column: {}", compressions[0]);
        // grains that are let go press with their weight at most
        let most = (1.0 + row) / STIFFNESS;
        assert!(compressions.iter().all(|&compression| compression < most), "{compressions:?}");
        assert!(compressions.len() >= 4 && record.data.run_out() > 0.5, "the column has collapsed");
    }
}
