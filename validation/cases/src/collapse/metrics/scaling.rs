//! How run-out and height of tall columns grow with the aspect ratio: fitted power laws and where they begin.

use super::quantities::*;
use super::{Measure, RESULTS};
use crate::collapse::{Alteration, CollapseRecord, Material};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, Value, Variant};
use crate::reference::collapse::{CollapseLawSource, PLANAR_COLLAPSE};
use crate::shared::range;
use crate::statistics::{Exponent, power_law, student_quantile};

/// Fewest tall columns that a power law is fitted to.
const FEWEST: usize = 4;
/// Aspect ratio up to which run-out is taken for proportional to it `[-]`.
const SHALLOW: f64 = 2.0;
/// Confidence of the intervals `[-]`.
const CONFIDENCE: f64 = 0.95;

/// Largest half width of an interval by which an exponent is judged `[-]`.
const WIDEST: f64 = 0.075;

/// A range of exponents as a limit of a value that is known to a half width.
fn within_reach(range: Limit, half_width: f64) -> Limit {
    match range {
        Limit::Within(lower, upper) => Limit::Within(lower - half_width, upper + half_width),
        one_sided => one_sided,
    }
}

/// Material, smallest aspect ratio of a tall column, gates of the exponents of run-out and height.
type Family = (Material, f64, Option<Limit>, Option<Limit>);

const FAMILIES: [Family; 3] = [
    (Material::SAND, 5.0, Some(Limit::Within(2.0 / 3.0 - 0.05, 2.0 / 3.0 + 0.05)), Some(Limit::Within(0.35, 0.45))),
    (Material::LAGREE, 7.0, Some(Limit::Within(0.65, 0.75)), Some(Limit::Within(0.3, 0.45))),
    (Material { altered: Alteration::ReferenceInertia, value: 0.279, ..Material::SAND }, 5.0, None, None),
];

/// A power law through the tall columns of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scaling {
    /// Fitted power law.
    pub(crate) law: Exponent,
    /// Half width of the exponent's 95 % interval `[-]`.
    pub(crate) half_width: f64,
    /// Aspect ratios between which it was fitted `[-]`.
    pub(crate) range: (f64, f64),
}

/// The planar columns of a material, between two aspect ratios.
fn columns<'a, const D: usize>(
    records: &[&'a CollapseRecord<D>],
    material: Material,
    from: f64,
    to: f64,
) -> Vec<&'a CollapseRecord<D>> {
    let own =
        |(run, _): &&CollapseRecord<D>| D == 2 && run.made_of() == material && (from..=to).contains(&run.aspect_ratio);
    records.iter().copied().filter(|record| own(record)).collect()
}

/// The fit of a quantity; none for fewer than four tall columns.
pub(crate) fn fit<const D: usize>(
    records: &[&CollapseRecord<D>],
    material: Material,
    quantity: Measure,
) -> Option<Scaling> {
    let smallest = FAMILIES.iter().find(|family| family.0 == material)?.1;
    let tall = columns(records, material, smallest, f64::INFINITY);
    let points: Vec<(f64, f64)> =
        tall.iter().map(|(run, record)| (run.initial_height(), quantity(&record.data))).collect();
    let law = power_law(&points).filter(|_| points.len() >= FEWEST)?;
    let half_width = half_width(&law, points.len());
    Some(Scaling { law, half_width, range: range(points.iter().map(|point| point.0)) })
}

/// Half width of an exponent's 95 % interval from its scatter about a fit through some points `[-]`.
fn half_width(law: &Exponent, points: usize) -> f64 {
    law.standard_error * student_quantile(CONFIDENCE, points - 2)
}

/// Power law of the run-outs of shallow columns; none for fewer than three.
fn shallow_law<const D: usize>(records: &[&CollapseRecord<D>], material: Material) -> Option<(Exponent, Value)> {
    let shallow = columns(records, material, 0.0, SHALLOW);
    let points = shallow.iter().map(|(run, record)| (run.initial_height(), record.data.run_out()));
    let points: Vec<(f64, f64)> = points.collect();
    let ratios = Value::list(shallow.iter().map(|(run, _)| run.aspect_ratio));
    (points.len() >= 3).then(|| power_law(&points)).flatten().map(|law| (law, ratios))
}

/// Mean of the run-out over the aspect ratio of shallow columns `[-]`; none without any.
fn shallow_coefficient<const D: usize>(records: &[&CollapseRecord<D>], material: Material) -> Option<f64> {
    let shallow = columns(records, material, 0.0, SHALLOW);
    let sum: f64 = shallow.iter().map(|(run, record)| record.data.run_out() / run.initial_height()).sum();
    (!shallow.is_empty()).then(|| sum / shallow.len() as f64)
}

/// Aspect ratio at which c a meets C aⁿ `[-]`.
fn break_point(shallow: f64, tall: &Exponent) -> f64 {
    libm::pow(tall.coefficient / shallow, 1.0 / (1.0 - tall.value))
}

/// A break point against the middle of the gap between Lube's branches.
fn against_lube(metric: Metric) -> Metric {
    let lube = CollapseLawSource::Lube.law(&PLANAR_COLLAPSE.run_out);
    let [shallow, tall] = lube.branches.as_slice() else { return metric };
    let source =
        format!("between the branches of Lube et al. 2005, which end at {} and begin at {}", shallow.to, tall.from);
    metric.against(Some(0.5 * (shallow.to + tall.from)), &source, lube.confidence)
}

pub(crate) fn metrics<const D: usize>(records: &[&CollapseRecord<D>]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (material, smallest, run_out_gate, height_gate) in FAMILIES {
        let columns = columns(records, material, smallest, f64::INFINITY);
        let ratios = Value::list(columns.iter().map(|(run, _)| run.aspect_ratio));
        for ((quantity, measure), gate) in RESULTS.into_iter().zip([run_out_gate, height_gate]) {
            let Some(scaling) = fit(records, material, measure) else { continue };
            let variant = Variant::of("quantity", quantity)
                .and("material", material.to_string())
                .and("aspect_ratio", ratios.clone());
            let observed =
                |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-2, 5e-3);
            let gate = gate.filter(|_| columns.iter().all(|(run, _)| run.has_published_law()));
            let published = "published exponents of tall planar columns: 2/3 to 0.7, height 0.33 to 0.4";
            let interval = "half width of the exponent's 95 % interval, from the scatter about the fit";
            metrics.extend([
                observed(SCALING_EXPONENT, scaling.law.value).against(None, published, Confidence::High).gated_by(
                    gate.map(|gate| within_reach(gate, scaling.half_width)),
                    "limits are the published exponents, which depend little on material, widened by this exponent's 95 % interval",
                ),
                observed(SCALING_CONFIDENCE, scaling.half_width).against(None, interval, Confidence::Exact).gated_by(
                    gate.map(|_| Limit::AtMost(WIDEST)),
                    "0.075: half of 0.15, the widest range of published exponents (that of heights)",
                ),
            ]);
            if quantity == RUN_OUT.name
                && let Some(shallow) = shallow_coefficient(records, material)
            {
                metrics.push(against_lube(observed(BREAK_POINT, break_point(shallow, &scaling.law))));
            }
        }
        if let Some((law, ratios)) = shallow_law(records, material) {
            let variant = Variant::of("quantity", RUN_OUT.name).and("material", material.to_string());
            let gate = run_out_gate.and(Some(Limit::Within(0.9, 1.1)));
            let lube = CollapseLawSource::Lube.law(&PLANAR_COLLAPSE.run_out);
            metrics.push(
                SCALING_EXPONENT
                    .of(&variant.and("aspect_ratio", ratios), law.value)
                    .against(None, &lube.source, lube.confidence)
                    .known_to(Origin::Numerical, Some(law.standard_error), "scatter about the fit")
                    .gated_by(gate, "1 ± 10 %: run-outs of low columns are proportional to the aspect ratio")
                    .with_snapshot_tolerance(1e-2, 5e-3),
            );
        }
    }
    metrics
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_an_exponent_is_that_of_the_printed_table() {
        // Student's distribution, two-sided 95 %: 4.3027 for 2 degrees of freedom, 2.3646 for 7
        let law = Exponent { value: 0.7, standard_error: 0.01, coefficient: 3.9 };
        assert!((half_width(&law, 4) - 0.043_027).abs() < 1e-5, "{}", half_width(&law, 4));
        assert!((half_width(&law, 9) - 0.023_646).abs() < 1e-5, "{}", half_width(&law, 9));
    }

    #[test]
    fn the_branches_meet_at_the_break_point() {
        let tall = Exponent { value: 0.7, standard_error: 0.0, coefficient: 3.9 };
        let a = break_point(2.2, &tall);
        assert!((2.2 * a - 3.9 * libm::pow(a, 0.7)).abs() < 1e-9, "{a}");
    }
}
