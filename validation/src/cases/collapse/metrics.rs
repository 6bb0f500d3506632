//! How the columns are judged.

use super::Record;
use super::column::{ColumnRun, Geometry, Purpose};
use super::convergence::relative_spread;
use super::deposit::Collapse;
use super::material::{Grains, Material};
use super::quantities::{
    DEPOSIT_SLOPE_ANGLE, FINAL_HEIGHT, HEIGHT_BY_TOP, MOMENTUM_RESIDUAL, PARTICLES_LOST, REST_TIME, RUN_OUT,
    STOPPING_TIME,
};
use crate::case::Run;
use crate::cases::energy_ledger;
use crate::metric::{Confidence, Limit, Metric, Quantity, Variant};
use crate::reference::{COLLAPSE_DURATION, CollapseLaw, PLANAR_COLLAPSE, ROUND_COLLAPSE};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};

const LUBE: usize = 0;
const LAGREE: usize = 1;
const LAJEUNESSE: usize = 2;

pub(in crate::cases) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let spread = Spread {
        run_out: relative_spread(records, Collapse::run_out),
        height: relative_spread(records, Collapse::final_height),
    };
    for (run, record) in records {
        if run.purpose == Purpose::Law {
            metrics.extend(of_column(run, &record.data, spread));
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

/// Nothing is lost: no particle and, where the numerics keep account of it, no momentum.
pub(in crate::cases) fn conservation(variant: &Variant, collapse: &Collapse, numerics: &Numerics) -> Vec<Metric> {
    let mut metrics = vec![
        PARTICLES_LOST
            .of(variant, collapse.lost as f64)
            .exactly(0.0, "no particle passes the bed, the symmetry plane or the bed's end")
            .gated(Limit::AtMost(0.0), "grains do not vanish"),
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

/// The grains come to rest before the longest time of a run `[s]`: gated where the law has a yield, for a liquid never
/// rests.
pub(in crate::cases) fn at_rest(variant: &Variant, collapse: &Collapse, law: &Rheology, longest: f64) -> Metric {
    let limit = law.is_plastic().then_some(Limit::AtMost(longest));
    REST_TIME
        .of(variant, collapse.rest_time())
        .against(None, "grains with a yield stress come to rest", Confidence::Exact)
        .with_snapshot_tolerance(0.02, 0.0)
        .gated_by(limit, "the run's own longest time: a heap that creeps or trembles on does not reach rest")
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

/// Where a result must lie, and why there.
type Band = Option<(Limit, &'static str)>;

/// Where the run-out of published grains must lie.
fn run_out_band(run: &ColumnRun, law: &CollapseLaw, spread: f64) -> Band {
    let a = run.initial_height();
    if !run.is_resolved() || !run.has_published_law() {
        return None;
    }
    match (run.geometry, run.material) {
        (Geometry::Round, _) => Some((
            band(law.value(a)?, 0.2, spread),
            "the project's aim: within 20 % of Lube's law for round columns at 20 rows and more, less twice the spread over \
             the seeds",
        )),
        (Geometry::Planar, Material::SAND) => {
            let experiments = [LUBE, LAJEUNESSE].map(|author| PLANAR_COLLAPSE.run_out[author].value(a));
            let [Some(one), Some(other)] = experiments else { return None };
            let (short, long) = (one.min(other), one.max(other));
            Some((
                Limit::Within((1.0 + 2.0 * spread) * short, (1.0 - 2.0 * spread) * long),
                "between Lube's and Lajeunesse's laws for planar columns, less twice the spread over the seeds: two \
                 experiments with grains and walls of their own, of which neither tells how far its points lie from its law",
            ))
        }
        (Geometry::Planar, Material::LAGREE) => Some((
            band(law.value(a)?, 0.15, spread),
            "the same material law solved by another method, 15 %: the law is printed with two digits, and with 20 particles \
             over r_0 the front's thickness of 0.02 r_0 is less than a row (run-out 10 % longer than with 80)",
        )),
        _ => None,
    }
}

/// Where the height of published grains must lie.
fn height_band(run: &ColumnRun, law: &CollapseLaw, spread: f64) -> Band {
    let a = run.initial_height();
    let expected = law.value(a).filter(|_| run.has_published_law())?;
    let is_round = run.geometry == Geometry::Round;
    let (tolerance, reason) = match (run.material, a) {
        (Material::SAND, ..=0.7) if !is_round => {
            (0.03, "undisturbed within 3 % up to a = 0.7, less twice the spread over the seeds")
        }
        (Material::SAND, _) if !is_round || a > 1.15 => (
            0.15,
            "15 % less twice the spread over the seeds: by how much the two planar experiments' exponents, 0.4 and 1/3, differ up \
             to a = 10",
        ),
        (Material::LAGREE, _) if run.is_resolved() => (
            0.1,
            "the same material law solved by another method, within 10 % less twice the spread over the seeds: two rows of 20",
        ),
        _ => return None,
    };
    Some((band(expected, tolerance, spread), reason))
}

fn of_column(run: &ColumnRun, collapse: &Collapse, spread: Spread) -> Vec<Metric> {
    let (variant, a) = (run.variant(), run.initial_height());
    let observed = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
    let by_law = |quantity: Quantity, value: f64, law: &CollapseLaw, band: Band| {
        let metric = observed(quantity, value).against(law.value(a), &law.source, law.confidence);
        metric.gated_by(band.map(|band| band.0), band.map_or("", |band| band.1))
    };
    let (run_out_law, height_law) = laws_of(run);
    let (duration, source, confidence) = &*COLLAPSE_DURATION;
    let of_sand = run.material == Material::SAND && run.has_published_law();
    let slope = observed(DEPOSIT_SLOPE_ANGLE, collapse.slope_angle());
    let friction = run.law.contact_friction();
    let steepest = libm::atan(friction).to_degrees();
    let mut metrics = conservation(&variant, collapse, &run.release.numerics);
    metrics.extend([
        by_law(RUN_OUT, collapse.run_out(), run_out_law, run_out_band(run, run_out_law, spread.run_out)),
        by_law(FINAL_HEIGHT, collapse.final_height(), height_law, height_band(run, height_law, spread.height)),
        observed(STOPPING_TIME, collapse.stopping_time() / run.time_scale())
            .against(
                Some(*duration),
                &format!("about {duration} √(h_0/g), {source}; 99 % of the front's way here"),
                *confidence,
            )
            .gated_by(
                of_sand.then_some(Limit::Within(2.25, 3.6)),
                "three sources say 2.5, 3 and 3.3 for grains; 10 % to either side for what each calls the stop",
            ),
        at_rest(&variant, collapse, &run.law, run.release.duration * run.time_scale()),
        if friction > 0.0 {
            slope
                .exactly(steepest, "arctan μ_s, the steepest slope that can rest; line over 20–80 % of the front")
                .gated(
                    Limit::AtMost(steepest),
                    "grains without cohesion rest on no slope steeper than their angle of friction",
                )
        } else {
            slope
        },
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
