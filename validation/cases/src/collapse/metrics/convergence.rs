//! How far a column's result depends on the resolution, on the seed and on the hourglass coefficient.

use super::Measure;
use super::bands::{SAME_LAW, SAME_LAW_REASON, band};
use super::quantities::*;
use crate::collapse::heap::with_resolution;
use crate::collapse::{Collapse, CollapseRecord, ColumnFlow, Material};
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Confidence, Limit, Metric, Origin, Variant};
use crate::reference::collapse::{CollapseLawSource, PLANAR_COLLAPSE};
use crate::shared::{distinct, range};
use crate::statistics::{GridConvergence, Mean, grid_convergence, mean};
use std::collections::BTreeMap;

/// Fewest seeds whose scatter counts as a spread.
const ENSEMBLE: usize = 5;

/// Name, measure and largest index `[-]` of what must converge.
const MEASURED: [(&str, Measure, f64); 3] = [
    ("centroid", |collapse| collapse.centroid, 0.03),
    (RUN_OUT.name, Collapse::run_out, 0.08),
    ("front_at_0.05_r0", Collapse::run_out_of_rows, 0.08),
];

/// A column that is studied, and all records.
#[derive(Clone, Copy)]
struct ConvergenceStudy<'a, const D: usize> {
    material: Material,
    aspect_ratio: f64,
    records: &'a [CollapseRecord<D>],
}

impl<'a, const D: usize> ConvergenceStudy<'a, D> {
    /// The columns that have runs of a kind, in their order.
    fn all(records: &'a [CollapseRecord<D>], is_of_kind: fn(&ColumnFlow<D>) -> bool) -> Vec<Self> {
        let studied = records.iter().map(|(run, _)| run).filter(|run| is_of_kind(run));
        let columns = distinct(studied.map(|run| (run.made_of(), run.aspect_ratio))).into_iter();
        columns.map(|(material, aspect_ratio)| Self { material, aspect_ratio, records }).collect()
    }

    /// Whether its grains are the published ones.
    fn is_published(&self) -> bool {
        self.records.iter().any(|(run, _)| run.made_of() == self.material && run.has_published_law())
    }

    /// A variant with the column's keys at its end.
    fn name(&self, variant: Variant) -> Variant {
        variant.and("material", self.material.to_string()).and("aspect_ratio", self.aspect_ratio)
    }

    /// Runs of a kind, resolution by resolution.
    fn by_resolution(
        &self,
        is_of_kind: impl Fn(&ColumnFlow<D>) -> bool,
    ) -> BTreeMap<usize, Vec<&'a CollapseRecord<D>>> {
        let is_own = |(run, _): &&CollapseRecord<D>| {
            let is_column = run.made_of() == self.material && run.aspect_ratio == self.aspect_ratio;
            is_column && is_of_kind(run)
        };
        let mut found = BTreeMap::<usize, Vec<&CollapseRecord<D>>>::new();
        for record in self.records.iter().filter(is_own) {
            found.entry(record.0.resolution).or_default().push(record);
        }
        found
    }

    /// Means over the seeds, resolution by resolution.
    fn means(&self, measure: Measure) -> Vec<Mean> {
        let of = |(resolution, runs): (usize, Vec<&CollapseRecord<D>>)| {
            let values: Vec<f64> = runs.iter().map(|(_, record)| measure(&record.data)).collect();
            Mean::of(resolution, &values)
        };
        self.ensembles().into_iter().filter_map(of).collect()
    }

    /// Runs of ensembles: one that stands for itself is one of them.
    fn ensembles(&self) -> BTreeMap<usize, Vec<&'a CollapseRecord<D>>> {
        self.by_resolution(|run| run.is_of_ensemble() || run.stands_for_itself(self.records))
    }

    /// What a share of a row makes of the run-out at a resolution, over r_0 `[-]`: the largest of the seeds.
    fn row(&self, resolution: usize) -> Option<f64> {
        let runs = self.ensembles().remove(&resolution)?;
        runs.iter().filter_map(|(_, record)| record.data.front_uncertainty()).reduce(f64::max)
    }

    /// Resolutions at which the hourglass coefficient was varied, with means over the seeds by ascending coefficient.
    fn hourglasses(&self, measure: Measure) -> Vec<(usize, Vec<f64>)> {
        let point = |(run, record): &CollapseRecord<D>| (run.numerics.hourglass, measure(&record.data));
        let sorted = |(resolution, runs): (usize, Vec<&CollapseRecord<D>>)| {
            let mut points: Vec<(f64, f64)> = runs.into_iter().map(point).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let of_one = |points: &[(f64, f64)]| mean(&points.iter().map(|point| point.1).collect::<Vec<_>>());
            (resolution, points.chunk_by(|a, b| a.0 == b.0).map(of_one).collect())
        };
        self.by_resolution(ColumnFlow::varies_hourglass).into_iter().map(sorted).collect()
    }
}

pub(crate) fn metrics<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for study in ConvergenceStudy::all(records, ColumnFlow::is_of_ensemble) {
        for (quantity, measure, largest) in MEASURED {
            let means = study.means(measure);
            let variant = study.name(Variant::of("quantity", quantity));
            let run_out = means.iter().filter(|mean| quantity == RUN_OUT.name && mean.runs >= ENSEMBLE);
            metrics.extend(run_out.map(|mean| against_law(&study, &variant, mean)));
            metrics.extend(of_ensembles(variant, &means, largest));
        }
    }
    for study in ConvergenceStudy::all(records, ColumnFlow::varies_hourglass) {
        metrics
            .extend(MEASURED.iter().flat_map(|(quantity, measure, _)| hourglass_spreads(&study, quantity, *measure)));
    }
    metrics
}

/// An ensemble's mean run-out against the law of the same material: one run alone scatters too much to be judged by it.
/// Its seeds share the error of the spacing.
fn against_law<const D: usize>(study: &ConvergenceStudy<'_, D>, variant: &Variant, mean: &Mean) -> Metric {
    let law = CollapseLawSource::Lagree.law(&PLANAR_COLLAPSE.run_out);
    let expected = law.value(study.aspect_ratio);
    let metric = ENSEMBLE_RUN_OUT.of(&variant.clone().and("resolution", mean.resolution), mean.value);
    let limit = expected.map(|expected| band(expected, SAME_LAW));
    let uncertainty = uncertainty_at(&study.means(Collapse::run_out), mean.resolution);
    with_resolution(metric, uncertainty, study.row(mean.resolution))
        .known_to(Origin::Repeat, Some(mean.standard_error), "standard error of the mean over the seeds")
        .against(expected, &law.source, law.confidence)
        .with_snapshot_tolerance(1e-3, 1e-3)
        .gated_by(limit.filter(|_| study.is_published()), SAME_LAW_REASON)
}

/// How far the choice of the hourglass coefficient moves a result, resolution by resolution.
fn hourglass_spreads<const D: usize>(study: &ConvergenceStudy<'_, D>, quantity: &str, measure: Measure) -> Vec<Metric> {
    let spread = |(resolution, values): (usize, Vec<f64>)| {
        let (least, most) = range(values.iter().copied());
        let variant = study.name(Variant::of("quantity", quantity)).and("resolution", resolution);
        let metric = HOURGLASS_SPREAD.of(&variant, 100.0 * (most - least) / mean(&values));
        let (limit, reason) = match (quantity, resolution) {
            ("centroid", ..40) => (None, ""),
            ("centroid", _) => {
                (Some(0.5), "the project's aim: the hourglass coefficient changes the centroid by at most 0.5 %")
            }
            (_, ..40) => {
                (Some(5.0), "the project's aim: 5 %, one row, with fewer than 40 particles over the half width")
            }
            (_, ..80) => (Some(3.0), "the project's aim: 3 % from 40 particles over the half width on"),
            _ => (Some(1.5), "the project's aim: 1.5 % from 80 particles over the half width on"),
        };
        let source = "largest less smallest over the mean, coefficient by coefficient: a modelling uncertainty";
        metric
            .against(None, source, Confidence::Exact)
            .with_snapshot_tolerance(0.02, 0.2)
            .gated_by(limit.map(Limit::AtMost), reason)
    };
    study.hourglasses(measure).into_iter().map(spread).collect()
}

/// Convergence of the means of a quantity over the seeds.
fn of_ensembles(variant: Variant, means: &[Mean], largest_index: f64) -> Vec<Metric> {
    let Some(found) = finest(means) else { return Vec::new() };
    let source = "half width of the finest mean's 95 % interval, from the three finest means: 1.25 |f − f_∞| of every \
                  order from 0.4 to 2 that the scatter over the seeds leaves open, and that scatter";
    vec![
        OBSERVED_ORDER.of(&variant, found.order).with_snapshot_tolerance(0.05, 0.05),
        GRID_CONVERGENCE_INDEX
            .of(&variant, 100.0 * found.index)
            .with_snapshot_tolerance(0.05, 0.2)
            .exactly(0.0, source)
            .gated(
                Limit::AtMost(100.0 * largest_index),
                "the project's aim: 3 % for the centroid, 8 % for the run-out, with scatter between seeds",
            ),
    ]
}

/// How the three finest means converge.
fn finest(means: &[Mean]) -> Option<GridConvergence> {
    means.last_chunk::<3>().and_then(|means| grid_convergence(means))
}

/// Relative standard uncertainty of a measure from the spacing where a study of the run's column has its resolution `[-]`.
pub(crate) fn numerical_uncertainty<const D: usize>(
    records: &[CollapseRecord<D>],
    run: &ColumnFlow<D>,
    measure: Measure,
) -> Option<f64> {
    let study = ConvergenceStudy { material: run.made_of(), aspect_ratio: run.aspect_ratio, records };
    uncertainty_at(&study.means(measure), run.resolution)
}

/// The same from the means of a study: at the finest resolution half of the index, at a coarser one also its distance from
/// what the means approach.
fn uncertainty_at(means: &[Mean], resolution: usize) -> Option<f64> {
    let found = finest(means)?;
    let (own, fine) = (means.iter().find(|mean| mean.resolution == resolution)?, means.last()?);
    let interval = found.index * fine.value;
    let off = if own.resolution == fine.resolution { 0.0 } else { own.value - found.limit };
    Some(0.5 * off.hypot(interval) / own.value.abs())
}

/// Largest relative standard deviation of a measure over an ensemble of [`ENSEMBLE`] seeds or more `[-]`; 0 without one.
pub(crate) fn relative_spread<const D: usize>(records: &[CollapseRecord<D>], measure: Measure) -> f64 {
    let studies = ConvergenceStudy::all(records, ColumnFlow::is_of_ensemble);
    let ensembles = studies.iter().flat_map(|study| study.means(measure)).filter(|mean| mean.runs >= ENSEMBLE);
    let spread = |mean: Mean| mean.standard_error * (mean.runs as f64).sqrt() / mean.value.abs();
    ensembles.map(spread).fold(0.0, f64::max)
}

/// Figure of the studies of the resolution; none without any.
pub(crate) fn figure<const D: usize>(records: &[CollapseRecord<D>]) -> Option<Figure> {
    let mut studies = ConvergenceStudy::all(records, ColumnFlow::is_of_ensemble);
    // an ensemble at one resolution says nothing of convergence
    studies.retain(|study| study.means(|collapse| collapse.centroid).len() > 1);
    let panels = MEASURED.map(|(name, measure, _)| {
        let y = format!("{} over the finest − 1 [%]", name.replace('_', "-"));
        let mut panel = Panel::new("", Axis::linear("particles over r0 [-]"), Axis::linear(&y));
        for (slot, study) in studies.iter().enumerate() {
            let means = study.means(measure);
            let scale = means.last().map_or(1.0, |mean| mean.value);
            let percent = |value: f64| 100.0 * value / scale;
            let points = means.iter().map(|mean| (mean.resolution as f64, percent(mean.value) - 100.0));
            let error = |mean: &Mean| if mean.standard_error.is_nan() { 0.0 } else { percent(mean.standard_error) };
            let mut errors: Vec<f64> = means.iter().map(error).collect();
            if let (Some(last), Some(found)) = (errors.last_mut(), finest(&means)) {
                *last = 100.0 * found.index;
            }
            panel.line_points(&format!("{}, a = {}", study.material, study.aspect_ratio), slot, points).error = errors;
        }
        panel
    });
    let drawn = Figure::new(
        "grid-convergence",
        "Centroid, run-out and front at 0.05 r0 over the resolution, relative to the finest: means over seeds with standard \
         errors, at the finest the 95 % interval (grid convergence index with scatter).",
        panels.to_vec(),
    );
    (!studies.is_empty()).then_some(drawn)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarse_resolution_is_known_to_its_distance_from_what_the_means_approach() {
        // 2 (1 + 1/n): exactly of first order
        let means = [20, 40, 80].map(|n| Mean {
            resolution: n,
            value: 2.0 * (1.0 + 1.0 / n as f64),
            standard_error: f64::NAN,
            runs: 1,
        });
        for (n, off) in [(20, 0.1), (40, 0.05)] {
            let expanded = 2.0 * uncertainty_at(&means, n).expect("a study") * 2.0 * (1.0 + 1.0 / n as f64);
            assert!(expanded >= off && expanded < 1.2 * off + 0.07, "{n}: {expanded}");
        }
        let finest = 2.0 * uncertainty_at(&means, 80).expect("a study") * means[2].value;
        assert!((0.025..0.07).contains(&finest), "{finest}");
        assert_eq!(uncertainty_at(&means, 60), None);
        assert_eq!(uncertainty_at(&means[..2], 20), None);
    }
}
