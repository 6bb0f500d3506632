//! How far a column's result depends on the resolution, on the seed and on the hourglass coefficient.

use super::Record;
use super::column::{ColumnRun, Purpose};
use super::deposit::Collapse;
use super::material::Material;
use super::quantities::{
    ENSEMBLE_MEAN, ENSEMBLE_SPREAD, ENSEMBLE_STANDARD_ERROR, GRID_CONVERGENCE_INDEX, HOURGLASS_SPREAD, OBSERVED_ORDER,
};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::statistics::{Mean, grid_convergence};

/// Name, measure and largest index `[-]` of what must converge.
type Measured = (&'static str, fn(&Collapse) -> f64, f64);

/// Fewest seeds whose scatter counts as a spread.
const ENSEMBLE: usize = 5;

const MEASURED: [Measured; 2] =
    [("centroid", |collapse| collapse.centroid, 0.03), ("run_out", Collapse::run_out, 0.08)];

pub(super) fn metrics(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (material, aspect_ratio) in studied(records, Purpose::Convergence) {
        for (quantity, measure, largest) in MEASURED {
            let means = means(records, material, aspect_ratio, measure);
            let variant = Variant::of("quantity", quantity)
                .and("material", material.to_string())
                .and("aspect_ratio", aspect_ratio);
            for mean in &means {
                let at = variant.clone().and("resolution", mean.resolution);
                let values = [(ENSEMBLE_MEAN, mean.value), (ENSEMBLE_STANDARD_ERROR, mean.standard_error)];
                metrics.extend(
                    values.map(|(quantity, value)| quantity.of(&at, value).with_snapshot_tolerance(1e-3, 1e-3)),
                );
            }
            let Some(found) = means.last_chunk::<3>().and_then(grid_convergence) else { continue };
            metrics.push(OBSERVED_ORDER.of(&variant, found.order).with_snapshot_tolerance(0.05, 0.05));
            metrics.push(
                GRID_CONVERGENCE_INDEX
                    .of(&variant, 100.0 * found.index)
                    .with_snapshot_tolerance(0.05, 0.2)
                    .exactly(0.0, "1.25 |f_3 − f_2|/(r^p − 1)/f_3 of the three finest means")
                    .gated(
                        Limit::AtMost(100.0 * (largest + found.scatter)),
                        "specification 2: 3 % for the centroid, 8 % for the run-out, plus the standard error of the \
                         finest mean",
                    ),
            );
        }
    }
    let spreads = [
        ("run_out", relative_spread(records, Collapse::run_out)),
        ("final_height", relative_spread(records, Collapse::final_height)),
    ];
    for (quantity, spread) in spreads {
        if spread > 0.0 {
            metrics.push(
                ENSEMBLE_SPREAD
                    .of(&Variant::of("quantity", quantity), 100.0 * spread)
                    .against(
                        None,
                        "largest relative standard deviation over the seeds of the initial displacements; the gates of \
                         run-out and height are narrowed by twice of it",
                        Confidence::Exact,
                    )
                    .with_snapshot_tolerance(0.02, 0.02),
            );
        }
    }
    for (material, aspect_ratio) in studied(records, Purpose::Hourglass) {
        for resolution in resolutions(records, material, aspect_ratio) {
            let values: Vec<f64> =
                hourglass(records, material, aspect_ratio, resolution).iter().map(|point| point.1).collect();
            let (least, most) = values.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &v| (a.min(v), b.max(v)));
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let variant = Variant::of("material", material.to_string())
                .and("aspect_ratio", aspect_ratio)
                .and("resolution", resolution);
            metrics.push(
                HOURGLASS_SPREAD
                    .of(&variant, 100.0 * (most - least) / mean)
                    .against(
                        None,
                        "run-out, largest less smallest over the mean: its modelling uncertainty",
                        Confidence::Exact,
                    )
                    .with_snapshot_tolerance(0.02, 0.2),
            );
        }
    }
    metrics
}

/// Largest relative standard deviation of a measure over an ensemble of [`ENSEMBLE`] seeds or more `[-]`; 0 without one.
pub(super) fn relative_spread(records: &[Record], measure: fn(&Collapse) -> f64) -> f64 {
    let mut largest = 0.0_f64;
    for (material, aspect_ratio) in studied(records, Purpose::Convergence) {
        for mean in means(records, material, aspect_ratio, measure) {
            if mean.runs >= ENSEMBLE {
                largest = largest.max(mean.standard_error * (mean.runs as f64).sqrt() / mean.value.abs());
            }
        }
    }
    largest
}

/// Figures of the studies that were made.
pub(super) fn figures(records: &[Record]) -> Vec<Figure> {
    let mut resolution = studied(records, Purpose::Convergence);
    // an ensemble at one resolution says nothing of convergence
    resolution.retain(|(material, aspect_ratio)| {
        means(records, *material, *aspect_ratio, |collapse| collapse.centroid).len() > 1
    });
    let coefficient = studied(records, Purpose::Hourglass);
    let mut figures = Vec::new();
    if !resolution.is_empty() {
        let panels = MEASURED.map(|(name, measure, _)| {
            let y = format!("{} over the finest − 1 [%]", name.replace('_', "-"));
            let mut panel = Panel::new("", Axis::linear("particles over r0 [-]"), Axis::linear(&y));
            for (slot, (material, aspect_ratio)) in resolution.iter().enumerate() {
                let means = means(records, *material, *aspect_ratio, measure);
                let finest = means.last().map_or(1.0, |mean| mean.value);
                let percent = |value: f64| 100.0 * value / finest;
                let label = format!("{material}, a = {aspect_ratio}");
                let points = means.iter().map(|mean| (mean.resolution as f64, percent(mean.value) - 100.0)).collect();
                let mut series = Series::new(&label, Mark::LinePoints, slot, points);
                let error = |mean: &Mean| if mean.standard_error.is_nan() { 0.0 } else { percent(mean.standard_error) };
                series.error = means.iter().map(error).collect();
                panel.series.push(series);
            }
            panel
        });
        figures.push(
            Figure::new(
                "grid-convergence",
                "Centroid and run-out of the deposit over the resolution, relative to the finest: means over several \
             seeds of the initial displacements, with the standard error of the mean.",
                panels.to_vec(),
            )
            .in_columns(2),
        );
    }
    if !coefficient.is_empty() {
        let mut panel =
            Panel::new("", Axis::linear("hourglass coefficient [-]"), Axis::linear("run-out (r∞ − r0)/r0 [-]"));
        let mut slot = 0;
        for (material, aspect_ratio) in coefficient {
            for resolution in resolutions(records, material, aspect_ratio) {
                let points = hourglass(records, material, aspect_ratio, resolution);
                let label = format!("{material}, a = {aspect_ratio}, {resolution} over r0");
                panel.line_points(&label, slot, points);
                slot += 1;
            }
        }
        figures.push(Figure::new(
            "hourglass",
            "Run-out over the coefficient of the hourglass control: what the choice of a numerical parameter does to \
             the result, at two resolutions.",
            vec![panel],
        ));
    }
    figures
}

/// Materials and aspect ratios that have runs of a purpose, in their order.
fn studied(records: &[Record], purpose: Purpose) -> Vec<(Material, f64)> {
    let mut found: Vec<(Material, f64)> = Vec::new();
    for (run, _) in records.iter().filter(|(run, _)| run.purpose == purpose) {
        let key = (run.material, run.aspect_ratio);
        if !found.contains(&key) {
            found.push(key);
        }
    }
    found
}

fn is_of(run: &ColumnRun, material: Material, aspect_ratio: f64) -> bool {
    run.material == material && run.aspect_ratio == aspect_ratio && run.regularisation_rate.is_none()
}

/// Means over the seeds, resolution by resolution. A run that stands for itself is one of its ensemble.
fn means(records: &[Record], material: Material, aspect_ratio: f64, measure: fn(&Collapse) -> f64) -> Vec<Mean> {
    let runs = || {
        records.iter().filter(|(run, _)| {
            is_of(run, material, aspect_ratio) && matches!(run.purpose, Purpose::Law | Purpose::Convergence)
        })
    };
    let mut resolutions: Vec<usize> = runs().map(|(run, _)| run.resolution).collect();
    resolutions.sort_unstable();
    resolutions.dedup();
    let mean = |&resolution: &usize| {
        let of_resolution = runs().filter(|(run, _)| run.resolution == resolution);
        Mean::of(resolution, &of_resolution.map(|(_, record)| measure(&record.data)).collect::<Vec<_>>())
    };
    resolutions.iter().filter_map(mean).collect()
}

/// Resolutions at which the hourglass coefficient was varied.
fn resolutions(records: &[Record], material: Material, aspect_ratio: f64) -> Vec<usize> {
    let varied = records.iter().map(|(run, _)| run);
    let varied = varied.filter(|run| run.purpose == Purpose::Hourglass && is_of(run, material, aspect_ratio));
    let mut found: Vec<usize> = varied.map(|run| run.resolution).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// (coefficient, run-out) of a resolution, in ascending order.
fn hourglass(records: &[Record], material: Material, aspect_ratio: f64, resolution: usize) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = records
        .iter()
        .filter(|(run, _)| run.purpose == Purpose::Hourglass && run.resolution == resolution)
        .filter(|(run, _)| is_of(run, material, aspect_ratio))
        .map(|(run, record)| (run.release.numerics.hourglass, record.data.run_out()))
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}
