//! How the columns are judged.

use super::Record;
use super::column::{ColumnRun, Geometry, Purpose};
use super::convergence::{numerical_uncertainty, relative_spread};
use super::deposit::Collapse;
use super::material::{Grains, Material};
use super::quantities::{
    DEPOSIT_SLOPE_ANGLE, FINAL_HEIGHT, HEIGHT_BY_TOP, KINETIC_ENERGY_SHARE, MASS_CHANGE, MOMENTUM_RESIDUAL,
    PARTICLES_LOST, RUN_OUT, STOPPING_TIME,
};
use crate::case::Run;
use crate::cases::energy_ledger;
use crate::metric::{Limit, Metric, Origin, Quantity, Variant};
use crate::reference::{COLLAPSE_DURATION, CollapseLaw, PLANAR_COLLAPSE, ROUND_COLLAPSE};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};

const LUBE: usize = 0;
const LAGREE: usize = 1;

pub(in crate::cases) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let spread = Spread {
        run_out: relative_spread(records, Collapse::run_out),
        height: relative_spread(records, Collapse::final_height),
    };
    for (run, record) in records {
        if run.purpose == Purpose::Law {
            let numerical = |measure| numerical_uncertainty(records, run, measure);
            let known = Known {
                numerical_run_out: numerical(Collapse::run_out),
                numerical_height: numerical(Collapse::final_height),
                spread,
            };
            metrics.extend(of_column(run, &record.data, known));
            metrics.extend(super::flow_metrics::of_run(run, record));
        } else {
            metrics.extend(conservation(&run.variant(), &record.data, &run.release.numerics));
        }
    }
    metrics.extend(super::convergence::metrics(records));
    metrics.extend(super::stress_updates::metrics(records));
    metrics.extend(super::scaling::metrics(records));
    metrics
}

/// The laws of run-out and height whose geometry a run has, and whose material it has or comes closest to.
fn laws_of(run: &ColumnRun) -> (&'static CollapseLaw, &'static CollapseLaw) {
    let (laws, author) = match run.geometry {
        Geometry::Planar if run.material.grains == Grains::Lagree => (&*PLANAR_COLLAPSE, LAGREE),
        Geometry::Planar => (&*PLANAR_COLLAPSE, LUBE),
        Geometry::Round => (&*ROUND_COLLAPSE, LUBE),
    };
    (&laws.run_out[author], &laws.height[author])
}

/// Nothing is lost: no particle, no mass and, where the numerics keep account of it, no momentum.
pub(in crate::cases) fn conservation(variant: &Variant, collapse: &Collapse, numerics: &Numerics) -> Vec<Metric> {
    let mut metrics = vec![
        PARTICLES_LOST
            .of(variant, collapse.lost as f64)
            .exactly(0.0, "no particle passes the bed, the symmetry plane or the bed's end")
            .gated(Limit::AtMost(0.0), "grains do not vanish"),
        MASS_CHANGE
            .of(variant, collapse.mass_change)
            .exactly(0.0, "the mass of a particle never changes")
            .gated(Limit::Within(0.0, 0.0), "exact by construction"),
    ];
    metrics.extend(energy_ledger::metrics(variant, &collapse.energy, energy_ledger::Scale::Gravity));
    // an implicit step keeps no account of what the walls gave
    if numerics.viscous_step == ViscousStep::Explicit {
        metrics.push(
            MOMENTUM_RESIDUAL
                .of(variant, collapse.momentum_residual)
                .exactly(0.0, "momentum against gravity and what bed, planes, gate and contacts gave, over M g t")
                .gated(Limit::AtMost(1e-6), "forces between grains cancel in pairs")
                .with_snapshot_tolerance(0.0, 1e-10),
        );
    }
    metrics
}

/// The grains are at rest at the end: gated where the law has a yield, for a liquid never rests.
pub(in crate::cases) fn at_rest(variant: &Variant, collapse: &Collapse, law: &Rheology) -> Metric {
    let limit = law.is_plastic().then_some(Limit::AtMost(1e-6));
    KINETIC_ENERGY_SHARE
        .of(variant, collapse.agitation())
        .exactly(0.0, "a static deposit")
        .with_snapshot_tolerance(0.0, 1e-6)
        .gated_by(limit, "the project's aim: at most 1e-6 of the potential energy that was released")
}

/// Relative standard deviation of results over the seeds of an ensemble `[-]`: what a single run leaves open.
#[derive(Debug, Clone, Copy)]
struct Spread {
    run_out: f64,
    height: f64,
}

/// What is known of the uncertainty of a column's results `[-]`.
#[derive(Debug, Clone, Copy)]
struct Known {
    numerical_run_out: Option<f64>,
    numerical_height: Option<f64>,
    spread: Spread,
}

/// A metric with the parts of its uncertainty: that of the spacing and that over the seeds, both relative `[-]`. The laws
/// that it is compared with give none of their own.
fn with_uncertainty(metric: Metric, numerical: Option<f64>, spread: f64) -> Metric {
    let scale = metric.value.abs();
    metric
        .known_to(
            Origin::Numerical,
            numerical.map(|relative| relative * scale),
            "half of the grid convergence index of this column's study",
        )
        .known_to(
            Origin::Repeat,
            Some(spread * scale),
            "largest relative standard deviation over the seeds of the initial displacements",
        )
}

/// The band of a relative `tolerance` around a value, narrowed by twice the ensemble's spread.
fn band(expected: f64, tolerance: f64, spread: f64) -> Limit {
    let left = (tolerance - 2.0 * spread).max(0.0);
    Limit::Within((1.0 - left) * expected, (1.0 + left) * expected)
}

fn of_column(run: &ColumnRun, collapse: &Collapse, known: Known) -> Vec<Metric> {
    let spread = known.spread;
    let (variant, a) = (run.variant(), run.initial_height());
    let observed = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
    let by_law = |quantity: Quantity, value: f64, law: &CollapseLaw| {
        observed(quantity, value).against(law.value(a), &law.source, law.confidence)
    };
    let (run_out_law, height_law) = laws_of(run);
    let is_round = run.geometry == Geometry::Round;
    let run_out_limit = run_out_law
        .value(a)
        .filter(|_| is_round && run.is_resolved() && run.has_published_law())
        .map(|expected| band(expected, 0.2, spread.run_out));
    let of_sand = run.material == Material::SAND && run.has_published_law();
    let (tolerance, height_reason) = match a {
        _ if !of_sand => (None, ""),
        _ if a > 1.15 => (Some(0.15), "a^0.4 within 15 % above a = 1.15, less twice the spread over the seeds"),
        _ if !is_round && a <= 0.7 => {
            (Some(0.03), "undisturbed within 3 % up to a = 0.7, less twice the spread over the seeds")
        }
        _ => (None, ""),
    };
    let height_limit = height_law.value(a).zip(tolerance);
    let (duration, source, confidence) = &*COLLAPSE_DURATION;
    let slope = observed(DEPOSIT_SLOPE_ANGLE, collapse.slope_angle());
    let friction = run.law.contact_friction();
    let steepest = "arctan μ_s, the steepest slope that can rest; line over 20–80 % of the front";
    let mut metrics = conservation(&variant, collapse, &run.release.numerics);
    metrics.extend([
        with_uncertainty(
            by_law(RUN_OUT, collapse.run_out(), run_out_law).gated_by(
                run_out_limit,
                "the project's aim: within 20 % of Lube's law for round columns at 20 rows and more",
            ),
            known.numerical_run_out,
            spread.run_out,
        ),
        with_uncertainty(
            by_law(FINAL_HEIGHT, collapse.final_height(), height_law)
                .gated_by(height_limit.map(|(expected, within)| band(expected, within, spread.height)), height_reason),
            known.numerical_height,
            spread.height,
        ),
        observed(STOPPING_TIME, collapse.stopping_time() / run.time_scale()).against(
            Some(*duration),
            &format!("about {duration} √(h_0/g), {source}; 99 % of the front's way here"),
            *confidence,
        ),
        at_rest(&variant, collapse, &run.law),
        if friction > 0.0 { slope.exactly(libm::atan(friction).to_degrees(), steepest) } else { slope },
        HEIGHT_BY_TOP
            .of(&variant, 100.0 * (collapse.top / collapse.final_height() - 1.0))
            .exactly(0.0, "highest particle beside the symmetry plane against the volume there")
            .with_snapshot_tolerance(0.01, 0.2)
            .gated_by(
                (a <= 5.0).then_some(Limit::Within(-10.0, 10.0)),
                "the project's aim: within 10 % up to a = 5, or particles stand above the heap",
            ),
    ]);
    let (x96, x99) = collapse.quantiles;
    let others = [
        ("centroid", collapse.centroid),
        ("mass_quantiles", 2.0 * x99 - x96 - 1.0),
        ("front_at_0.05_r0", collapse.run_out_of_rows()),
    ];
    metrics.extend(others.map(|(quantity, value)| {
        let variant = Variant::of("quantity", quantity).followed_by(&variant);
        RUN_OUT.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3)
    }));
    metrics
}
