//! How collapses are judged: limits with their reasons, and the quantities that they stand for.

pub(crate) mod bands;
pub(crate) mod convergence;
mod interior;
pub(crate) mod measured;
pub(crate) mod other_codes;
mod other_numerics;
pub(crate) mod quantities;
pub(crate) mod scaling;
mod statements;
pub(crate) mod stress_updates;
mod uncertainty;

use crate::case::Flow;
use crate::collapse::column::pile_of;
use crate::collapse::{Collapse, CollapseRecord, ColumnFlow, Material};
use crate::evidence::{ValidationSet, WAY_OF_FRONT};
use crate::metric::{Confidence, Limit, Metric, MetricKind, PredictionInterval, Quantity, Variant};
use crate::reference::collapse::{
    COLLAPSE_DURATION, CodeQuantity, CollapseLaw, CollapseLawSource, PLANAR_COLLAPSE, ROUND_COLLAPSE,
};
use crate::setup::energy_ledger::{self, EnergyScale};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::weakly_compressible::{Numerics, ViscousStep};
use bands::AcceptanceBand;
use convergence::{numerical_uncertainty, relative_spread};
use other_codes::{Beside, MID_COLLAPSE};
use quantities::*;
use uncertainty::Known;

/// Aspect ratio above which columns of the sand may be too coarse for a law `[-]`.
const TALLEST_FINE: f64 = 5.0;

/// A number that a deposit has.
pub(crate) type Measure = fn(&Collapse) -> f64;
/// The results that published laws are about, by name.
const RESULTS: [(&str, Measure); 2] = [(RUN_OUT.name, Collapse::run_out), (FINAL_HEIGHT.name, Collapse::final_height)];
/// Aspect ratios about that of the paper's cone `[-]`.
const CONES: std::ops::RangeInclusive<f64> = 2.0..=3.5;
/// Share of the variance that a line explains of a flank whose lower half is half as steep as its upper one `[-]`.
const BENT_FLANK: f64 = 0.973;

pub(crate) fn all<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Metric> {
    let spreads = RESULTS.map(|(_, measure)| relative_spread(records, measure));
    let mut metrics = Vec::new();
    let mut ratios = Vec::new();
    for column in records {
        let (run, record) = column;
        let is_law = run.stands_for_itself(records);
        if let Some(beside) = Beside::of_column(run, &record.data).filter(|_| is_law) {
            metrics.extend(beside.metrics(&run.variant(), MID_COLLAPSE));
        }
        let conservation =
            conservation(&run.variant(), &record.data, &run.numerics, energy_scale(run.initial_height()));
        metrics.extend(conservation);
        // no experiment has round columns of these grains
        if !is_law || (D, run.made_of()) == (3, Material::LAGREE) {
            continue;
        }
        let known = [0, 1].map(|result| Known {
            study: numerical_uncertainty(records, run, RESULTS[result].1),
            spread: spreads[result],
        });
        // points of its own experiment stand in the place of other experiments' laws
        let pile = pile_of(run).filter(|_| !run.is_of_own_grains());
        let laws = pile.is_none().then(|| against_laws(run, &record.data, known, has_seeds(records, run)));
        let mut own: Vec<Metric> = laws.into_iter().flatten().chain(of_column(run, &record.data)).collect();
        // columns that only exponents are fitted to are too coarse for more
        if run.made_of() == Material::SAND && D == 2 && run.aspect_ratio > TALLEST_FINE && run.resolution < 20 {
            for metric in own.iter_mut().filter(|metric| metric.kind == MetricKind::Validation) {
                (metric.reference, metric.gate) = (None, None);
            }
        }
        metrics.extend(own);
        metrics.extend(pile.into_iter().flat_map(|pile| measured::of_pile(records, column, pile, known)));
        if let Some(ratio) = measured::of_round_column(run, &record.data, known[0]) {
            ratios.push((run.initial_height(), ratio.clone()));
            metrics.push(ratio);
        }
        metrics.extend(interior::of_run(column, records));
        metrics.extend(statements::of_run(run, record));
    }
    metrics.extend(measured::of_round_columns(&ratios));
    metrics.extend(convergence::metrics(records));
    metrics.extend(stress_updates::metrics(records));
    metrics.extend(other_numerics::metrics(records));
    metrics.extend(scaling::metrics(&laws_among(records)));
    metrics
}

/// The columns that laws judge.
pub(crate) fn laws_among<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<&CollapseRecord<D>> {
    records.iter().filter(|(run, _)| run.stands_for_itself(records)).collect()
}

/// Whether further seeds of a column are judged together.
fn has_seeds<const D: usize>(records: &[CollapseRecord<D>], run: &ColumnFlow<D>) -> bool {
    records.iter().any(|(other, _)| {
        other.is_of_ensemble() && (other.made_of(), other.aspect_ratio) == (run.made_of(), run.aspect_ratio)
    })
}

/// Scale of the energy's balance: the taller a column is, the more falls within a step.
fn energy_scale(aspect_ratio: f64) -> EnergyScale {
    if aspect_ratio <= 3.0 { EnergyScale::Fall } else { EnergyScale::Work }
}

/// Nothing is lost: no particle and, where the numerics keep account of it, no momentum.
pub(crate) fn conservation(
    variant: &Variant,
    collapse: &Collapse,
    numerics: &Numerics,
    scale: EnergyScale,
) -> Vec<Metric> {
    let mut metrics = vec![
        PARTICLES_LOST
            .of(variant, collapse.lost as f64)
            .exactly(0.0, "no particle passes the bed, the symmetry plane or the bed's end")
            .gated(Limit::AtMost(0.0), "0: a lost particle is lost mass"),
    ];
    metrics.extend(energy_ledger::metrics(variant, &collapse.energy, scale));
    // an implicit step keeps no account of what the walls gave
    if numerics.viscous_step == ViscousStep::Explicit {
        metrics.push(
            MOMENTUM_RESIDUAL
                .of(variant, collapse.momentum_residual)
                .exactly(0.0, "momentum against gravity and what bed, planes, gate and contacts gave, over M g t")
                .gated(
                    Limit::AtMost(1e-7),
                    "1e-7: pair forces cancel up to single-precision rounding, 6e-8 of each force",
                )
                .with_snapshot_tolerance(0.0, 1e-10),
        );
    }
    metrics
}

/// Slope `[°]` of a heap from the final height to the front of the experiment with the longest run-out, less as much as heights may be
/// off by; of planar columns of the sand, whose grains that experiment's are like.
fn flattest<const D: usize>(run: &ColumnFlow<D>) -> Option<f64> {
    let of_sand = D == 2 && run.made_of() == Material::SAND && run.has_published_law();
    let value =
        |laws: &[CollapseLaw]| CollapseLawSource::Lajeunesse.law(laws).value(run.initial_height()).filter(|_| of_sand);
    let (height, run_out) = (value(&PLANAR_COLLAPSE.height)?, value(&PLANAR_COLLAPSE.run_out)?);
    Some((1.0 - bands::WIDEST) * libm::atan(height / (1.0 + run_out)).to_degrees())
}

/// The grains come to rest before the longest time of a run `[s]`: gated where the law has a yield, for a liquid never
/// rests.
pub(crate) fn at_rest(variant: &Variant, collapse: &Collapse, law: &Rheology, longest: f64) -> Metric {
    let stop = collapse.stopping_time();
    let limit = if stop.is_finite() { Limit::Within(stop, longest) } else { Limit::AtMost(longest) };
    let reason = "limits: between the front's stop (at 99 % of its way) and the run's end";
    REST_TIME
        .of(variant, collapse.rest_time())
        .against(None, "grains with a yield stress come to rest", Confidence::Exact)
        .with_snapshot_tolerance(0.02, 0.0)
        .gated_by(law.is_plastic().then_some(limit), reason)
}

/// Where the true value of a user's own grains lies, by how far those of published ones were off.
fn predicted<const D: usize>(
    run: &ColumnFlow<D>,
    collapse: &Collapse,
    quantities: &[&str],
    value: f64,
) -> Option<PredictionInterval> {
    let regime = run.is_of_own_grains().then(|| run.regime(collapse))?;
    ValidationSet::shipped().predict(quantities, regime, value)
}

/// Run-out and height against the laws of experiments and other codes.
fn against_laws<const D: usize>(
    run: &ColumnFlow<D>,
    collapse: &Collapse,
    known: [Known; 2],
    has_seeds: bool,
) -> [Metric; 2] {
    let (variant, a) = (run.variant(), run.initial_height());
    let by_law = |quantity: Quantity, value: f64, law: &CollapseLaw, laws: &[CollapseLaw], band: AcceptanceBand| {
        let metric = quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
        if run.is_of_own_grains() {
            // beside all laws, gaps included, and before all else
            let beside: Vec<String> = laws.iter().map(|law| law.in_words(a)).collect();
            let source = format!(
                "{}. None of them judges it: each holds for the grains of its own experiment or simulation, and these have another law",
                beside.join("; ")
            );
            let quantities: &[&str] = if quantity.name == RUN_OUT.name { &WAY_OF_FRONT } else { &[FINAL_HEIGHT.name] };
            let interval = predicted(run, collapse, quantities, value)
                .map(|interval| PredictionInterval { unit_length: Some(run.half_width), ..interval });
            return metric.against(None, &source, Confidence::Medium).predicted(interval).leading();
        }
        // in a gap between its branches a law judges nothing, and says so
        let source = if law.value(a).is_some() { law.source.clone() } else { law.in_words(a) };
        let (limit, reason) = band.map_or((None, ""), |((low, high), reason)| (Some(Limit::Within(low, high)), reason));
        metric.against(law.value(a), &source, law.confidence).gated_by(limit, reason)
    };
    let (run_out_law, height_law) = bands::laws_of(run);
    let laws = if D == 2 { &*PLANAR_COLLAPSE } else { &*ROUND_COLLAPSE };
    let run_out = by_law(RUN_OUT, collapse.run_out(), run_out_law, &laws.run_out, bands::run_out(run, has_seeds));
    let height = by_law(FINAL_HEIGHT, collapse.final_height(), height_law, &laws.height, bands::height(run));
    [known[0].of(run_out, collapse.front_uncertainty()), known[1].of(height, None)]
}

/// Stop, rest and shape of the heap.
fn of_column<const D: usize>(run: &ColumnFlow<D>, collapse: &Collapse) -> Vec<Metric> {
    let (variant, a) = (run.variant(), run.initial_height());
    let observed = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
    let (duration, source, confidence) = &*COLLAPSE_DURATION;
    let stopping_time = collapse.stopping_time() / run.time_scale();
    let of_sand = run.made_of() == Material::SAND && run.has_published_law();
    let slope = observed(DEPOSIT_SLOPE_ANGLE, collapse.slope_angle());
    let friction = run.material.contact_friction();
    let steepest = libm::atan(friction).to_degrees();
    let mut metrics = vec![
        observed(STOPPING_TIME, stopping_time)
            .predicted(predicted(run, collapse, &[STOPPING_TIME.name], stopping_time))
            .against(
                Some(*duration),
                &format!("about {duration} √(h_0/g), {source}; here the time of 99 % of the front's displacement"),
                *confidence,
            )
            .gated_by(
                of_sand.then_some(Limit::Within(2.25, 3.6)),
                "2.25 to 3.6: published values 2.5, 3 and 3.3, widened by 10 % as definitions differ",
            ),
        at_rest(&variant, collapse, &run.material, run.duration * run.time_scale()),
        if friction > 0.0 {
            slope
                .exactly(steepest, "arctan μ_s, the steepest slope that can rest; line over 20–80 % of the front")
                .gated(
                    flattest(run).map_or(Limit::AtMost(steepest), |flattest| Limit::Within(flattest, steepest)),
                    "limits: at most the friction angle; for planar sand at least Lajeunesse's slope less 15 %",
                )
        } else {
            slope
        },
        observed(FLANK_R_SQUARED, collapse.flank_r_squared())
            .against(
                Some(1.0),
                "statement of the collapse paper, of a = 2.75: the deposit is a cone in the end",
                Confidence::Medium,
            )
            .gated_by(
                (of_sand && CONES.contains(&a)).then_some(Limit::AtLeast(BENT_FLANK)),
                "0.973: the R² of a bent flank, half as steep in its lower half",
            ),
        HEIGHT_BY_TOP
            .of(&variant, 100.0 * (collapse.top / collapse.final_height() - 1.0))
            .exactly(0.0, "highest particle beside the symmetry plane against the volume there")
            .with_snapshot_tolerance(0.01, 0.2)
            .gated_by(
                (a <= 5.0).then_some(Limit::Within(-10.0, 10.0)),
                "10 %: the project's aim up to aspect ratio 5; single particles above the heap exceed it",
            ),
    ];
    let (x96, x99) = collapse.quantiles;
    let others = [
        ("centroid", collapse.centroid, Some(CodeQuantity::CentroidAtRest)),
        ("mass_quantiles", 2.0 * x99 - x96 - 1.0, None),
        ("front_at_0.05_r0", collapse.run_out_of_rows(), Some(CodeQuantity::FrontAtRest)),
    ];
    let codes = Beside::of_column(run, collapse);
    metrics.extend(others.map(|(quantity, value, of_codes)| {
        let variant = Variant::of("quantity", quantity).followed_by(&variant);
        let metric = RUN_OUT.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
        match codes.as_ref().zip(of_codes) {
            Some((codes, of_codes)) => codes.deposit(metric, of_codes),
            None => metric,
        }
    }));
    metrics
}
