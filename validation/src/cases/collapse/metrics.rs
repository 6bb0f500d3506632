//! How the columns are judged.

use super::Record;
use super::column::{ColumnRun, Geometry, Purpose};
use super::convergence::relative_spread;
use super::deposit::Collapse;
use super::material::{Grains, Material};
use super::quantities::{
    DEPOSIT_SLOPE_ANGLE, FINAL_HEIGHT, HEIGHT_BY_TOP, KINETIC_ENERGY_SHARE, MASS_CHANGE, MOMENTUM_RESIDUAL,
    PARTICLES_LOST, RUN_OUT, STOPPING_TIME,
};
use crate::case::Run;
use crate::metric::{Limit, Metric, Quantity, Variant};
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
            of_column(&mut metrics, run, &record.data, spread);
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
    // an implicit step keeps no account of what the walls gave
    if numerics.viscous_step == ViscousStep::Explicit {
        metrics.push(
            MOMENTUM_RESIDUAL
                .of(variant, collapse.momentum_residual)
                .exactly(0.0, "momentum against gravity and what bed, planes, gate and contacts gave, over M g t")
                .gated(Limit::AtMost(1e-6), "specification 2: forces between grains cancel in pairs")
                .with_snapshot_tolerance(0.0, 1e-10),
        );
    }
    metrics
}

/// The grains are at rest at the end: gated where the law has a yield, for a liquid never rests.
pub(in crate::cases) fn at_rest(variant: &Variant, collapse: &Collapse, law: &Rheology) -> Metric {
    let share = KINETIC_ENERGY_SHARE
        .of(variant, collapse.agitation())
        .exactly(0.0, "a static deposit")
        .with_snapshot_tolerance(0.0, 1e-6);
    if law.is_plastic() {
        share.gated(Limit::AtMost(1e-6), "specification 2: at most 1e-6 of the potential energy that was released")
    } else {
        share
    }
}

/// Relative standard deviation of results over the seeds of an ensemble `[-]`: what a single run leaves open.
#[derive(Debug, Clone, Copy)]
struct Spread {
    run_out: f64,
    height: f64,
}

/// The band of a relative `tolerance` around a value, narrowed by twice the ensemble's spread.
fn band(expected: f64, tolerance: f64, spread: f64) -> Limit {
    let left = (tolerance - 2.0 * spread).max(0.0);
    Limit::Within((1.0 - left) * expected, (1.0 + left) * expected)
}

fn of_column(metrics: &mut Vec<Metric>, run: &ColumnRun, collapse: &Collapse, spread: Spread) {
    let variant = run.variant();
    let a = run.initial_height();
    let observed = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
    let of_sand = run.material == Material::SAND && run.has_published_law();
    metrics.extend(conservation(&variant, collapse, &run.release.numerics));
    let (run_out_law, height_law) = laws_of(run);
    let run_out = observed(RUN_OUT, collapse.run_out()).against(
        run_out_law.value(a),
        &run_out_law.source,
        run_out_law.confidence,
    );
    metrics.push(match run_out_law.value(a) {
        Some(expected) if run.geometry == Geometry::Round && run.is_resolved() && run.has_published_law() => run_out
            .gated(
                band(expected, 0.2, spread.run_out),
                "specification 2: within 20 % of Lube's law for round columns at 20 rows and more",
            ),
        _ => run_out,
    });
    let height = observed(FINAL_HEIGHT, collapse.final_height()).against(
        height_law.value(a),
        &height_law.source,
        height_law.confidence,
    );
    metrics.push(match height_law.value(a) {
        Some(expected) if of_sand && a > 1.15 => height.gated(
            band(expected, 0.15, spread.height),
            "specification 2: a^0.4 within 15 % above a = 1.15, less twice the spread over the seeds",
        ),
        Some(expected) if run.geometry == Geometry::Planar && of_sand && a <= 0.7 => height.gated(
            band(expected, 0.03, spread.height),
            "specification 2: undisturbed within 3 % up to a = 0.7, less twice the spread over the seeds",
        ),
        _ => height,
    });
    metrics.push(observed(STOPPING_TIME, collapse.stopping_time() / run.time_scale()).against(
        Some(COLLAPSE_DURATION.0),
        &format!("about {} √(h_0/g), {}; 99 % of the front's way here", COLLAPSE_DURATION.0, COLLAPSE_DURATION.1),
        COLLAPSE_DURATION.2,
    ));
    metrics.push(at_rest(&variant, collapse, &run.law));
    let slope = observed(DEPOSIT_SLOPE_ANGLE, collapse.slope_angle());
    metrics.push(match run.law.contact_friction() {
        friction if friction > 0.0 => slope.exactly(
            libm::atan(friction).to_degrees(),
            "arctan μ_s, the steepest slope that can rest; line over 20–80 % of the front",
        ),
        _ => slope,
    });
    let excess = 100.0 * (collapse.top / collapse.final_height() - 1.0);
    let top = HEIGHT_BY_TOP
        .of(&variant, excess)
        .exactly(0.0, "highest particle beside the symmetry plane against the volume there")
        .with_snapshot_tolerance(0.01, 0.2);
    metrics.push(if a <= 5.0 {
        top.gated(
            Limit::Within(-10.0, 10.0),
            "specification 2: within 10 % up to a = 5, or particles stand above the heap",
        )
    } else {
        top
    });
    let of_quantity = |quantity: &str| Variant::of("quantity", quantity).followed_by(&variant);
    let (x96, x99) = collapse.quantiles;
    let quantities = [("centroid", collapse.centroid), ("mass_quantiles", 2.0 * x99 - x96 - 1.0)];
    for (quantity, value) in quantities {
        metrics.push(RUN_OUT.of(&of_quantity(quantity), value).with_snapshot_tolerance(1e-3, 1e-3));
    }
}
