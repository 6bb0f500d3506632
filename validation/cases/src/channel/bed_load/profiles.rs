//! What is read off the profiles of water and grains.

use super::flow::BedLoadFlow;
use super::observation::BedLoadObservation;
use crate::channel::ProfilePoint;
use crate::metric::Variant;
use crate::output::Table;
use crate::reference::one_dimension::bed_load::LayerState;
use crate::statistics::{
    Extrapolation, Segmented, curvature, interpolated, linear_fit, number_of_pieces, segmented_regression,
};

/// ln((z + z_0)/d) with the offset z_0 of the logarithmic law, over which u of clear water is a straight line `[-]`.
fn log_height(run: &BedLoadFlow, height: f64) -> f64 {
    libm::log((height + run.clear_water().origin_offset) / run.grain_diameter)
}

/// Heights between which the slope of u over ln(z + z_0) is fitted `[m]`.
pub(super) const LAYERS: [(f64, f64); 4] = [(5e-4, 3.5e-3), (3e-3, 8e-3), (8e-3, 18e-3), (15e-3, 43e-3)];

/// Slope of u over ln(z + z_0) between two heights, over u_*/κ `[-]`.
pub(super) fn semi_log_slope(run: &BedLoadFlow, points: &[ProfilePoint], lower: f64, upper: f64) -> f64 {
    let inside = points.iter().filter(|point| point.height >= lower && point.height <= upper);
    let pairs: Vec<(f64, f64)> = inside.map(|point| (log_height(run, point.height), point.velocity)).collect();
    if pairs.len() < 2 {
        return f64::NAN;
    }
    let between_two = || (pairs[1].1 - pairs[0].1) / (pairs[1].0 - pairs[0].0);
    linear_fit(&pairs).map_or_else(between_two, |fit| fit.slope) / run.clear_water().semi_logarithmic_slope()
}

/// Most layers that are looked for: the paper sees three.
const MOST_LAYERS: usize = 3;

/// u/u_* over ln((z + z_0)/d) above the bed, up to 0.9 h.
pub(super) fn semi_logarithmic(run: &BedLoadFlow, points: &[ProfilePoint]) -> Vec<(f64, f64)> {
    let scale = run.clear_water().friction_velocity();
    let top = 0.9 * run.depth;
    let inside = points.iter().filter(|point| point.height > 0.0 && point.height < top);
    inside.map(|point| (log_height(run, point.height), point.velocity / scale)).collect()
}

/// Number of layers of different semi-logarithmic slope, by a segmented regression.
pub(super) fn number_of_layers(run: &BedLoadFlow, points: &[ProfilePoint]) -> usize {
    number_of_pieces(&semi_logarithmic(run, points), MOST_LAYERS)
}

/// The layers: breaks in ln((z + z_0)/d), slopes in u_*.
pub(super) fn layers(run: &BedLoadFlow, points: &[ProfilePoint], count: usize) -> Option<Segmented> {
    segmented_regression(&semi_logarithmic(run, points), count)
}

/// Second derivative of the grains' velocity above or below the top of the bed, times d²/u_* `[-]`: negative where the
/// profile is concave. Not a number with fewer than four moving rows.
pub(super) fn grain_curvature(run: &BedLoadFlow, points: &[ProfilePoint], above: bool) -> f64 {
    let (diameter, scale) = (run.grain_diameter, run.clear_water().friction_velocity());
    let moving = points.iter().filter(|point| (point.height > 0.0) == above && point.velocity > 1e-4);
    let values: Vec<(f64, f64)> = moving.map(|point| (point.height / diameter, point.velocity / scale)).collect();
    curvature(&values).unwrap_or(f64::NAN)
}

/// Velocity of the water at a height, over u_* `[-]`.
pub(super) fn velocity_at(run: &BedLoadFlow, points: &[ProfilePoint], z: f64) -> f64 {
    let points: Vec<(f64, f64)> = points.iter().map(|point| (point.height, point.velocity)).collect();
    interpolated(&points, z, (Extrapolation::Nothing, Extrapolation::Nothing))
        .map_or(f64::NAN, |velocity| velocity / run.clear_water().friction_velocity())
}

/// Semi-logarithmic slope next to the bed over that of the outer flow, of the lines through all heights that fit best `[-]`.
pub(super) fn slope_ratio(run: &BedLoadFlow, points: &[ProfilePoint]) -> Option<f64> {
    let fit = layers(run, points, number_of_layers(run, points).max(2))?;
    Some(fit.slopes.first()? / fit.slopes.last()?)
}

/// Length over which the grains' velocity falls by e below z = 0 `[m]`.
pub(super) fn decay_length(points: &[ProfilePoint]) -> f64 {
    let tail: Vec<(f64, f64)> = points
        .iter()
        .filter(|point| point.height < 0.0 && point.velocity > 1e-4)
        .map(|point| (point.height, libm::log(point.velocity)))
        .collect();
    linear_fit(&tail).map_or(f64::NAN, |fit| 1.0 / fit.slope)
}

/// Lowest height at which the grains are faster than `speed` `[m/s]`, `[m]`.
pub(super) fn moves_above(points: &[ProfilePoint], speed: f64) -> f64 {
    points.iter().filter(|point| point.velocity > speed).map(|point| point.height).fold(f64::INFINITY, f64::min)
}

/// Root mean square of u_f − u_1D over 0.5 mm … 0.9 h, over u_* `[-]`.
pub(super) fn fluid_rms(run: &BedLoadFlow, points: &[ProfilePoint], layer: &LayerState) -> f64 {
    let errors = compared(run, points).map(|p| (p.velocity - layer.at(p.height).fluid_velocity).powi(2));
    root_mean(errors) / run.clear_water().friction_velocity()
}

/// Depth mean of u_f over that of the layer at the same heights `[-]`.
pub(super) fn fluid_mean(run: &BedLoadFlow, points: &[ProfilePoint], layer: &LayerState) -> f64 {
    let (own, other) = compared(run, points)
        .fold((0.0, 0.0), |(own, other), point| (own + point.velocity, other + layer.at(point.height).fluid_velocity));
    own / other
}

/// Sum of a drag over equal bins, as `(z [m], [N/m³])`, over that of the layer at the same heights `[-]`.
pub(super) fn drag_ratio(drag: &[(f64, f64)], layer: &LayerState) -> f64 {
    let of_layer = |height: f64| {
        let point = layer.at(height);
        point.exchange * (point.fluid_velocity - point.grain_velocity)
    };
    let (own, other) = drag.iter().fold((0.0, 0.0), |sums, (z, drag)| (sums.0 + drag, sums.1 + of_layer(*z)));
    own / other
}

/// Drag per volume on the topmost bin of grains divided by the drag on the bin below; NaN with fewer than two bins `[-]`.
pub(super) fn drag_top_ratio(drag: &[(f64, f64)]) -> f64 {
    if let [.., (_, below), (_, top)] = drag { top / below } else { f64::NAN }
}

/// Root mean square of u_s − u_1D where the layer's grains are faster than 1 cm/s, over u_* `[-]`.
pub(super) fn grain_rms(run: &BedLoadFlow, points: &[ProfilePoint], layer: &LayerState) -> f64 {
    let errors = points.iter().filter_map(|point| {
        let velocity = layer.at(point.height).grain_velocity;
        (velocity > 0.01).then(|| (point.velocity - velocity).powi(2))
    });
    root_mean(errors) / run.clear_water().friction_velocity()
}

fn compared<'a>(run: &BedLoadFlow, points: &'a [ProfilePoint]) -> impl Iterator<Item = &'a ProfilePoint> {
    let top = 0.9 * run.depth;
    points.iter().filter(move |point| point.height > 5e-4 && point.height < top)
}

fn root_mean(squares: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), square| (sum + square, count + 1.0));
    (sum / count).sqrt()
}

/// Grains over the height.
pub(super) fn grain_table(variant: &Variant, data: &BedLoadObservation) -> Option<Table> {
    let stem = variant.file_name();
    let (points, errors) = (data.sediment.points(), data.sediment.velocities());
    if points.is_empty() {
        return None;
    }
    let (drag, fraction) = (data.drag_profile(), data.solid_fraction());
    let rows = (0..points.len()).map(|k| {
        let (point, error) = (&points[k], &errors[k]);
        vec![point.height, point.velocity, error.standard_error, fraction[k].1, drag[k].1]
    });
    let names = ["z [m]", "u_s [m/s]", "standard error of u_s [m/s]", "solid fraction [-]", "drag [N/m³]"];
    Some(Table::of_rows(format!("grains-{stem}"), &names, rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_on_the_topmost_row_is_compared_with_the_row_below() {
        assert_eq!(drag_top_ratio(&[(-12.5e-3, 1.0), (-7.5e-3, 4.0), (-2.5e-3, 2.0)]), 0.5);
        assert!(drag_top_ratio(&[(-2.5e-3, 2.0)]).is_nan());
    }

    #[test]
    fn clear_water_has_one_layer_of_the_slope_one() {
        let run = BedLoadFlow::default();
        let law = run.clear_water();
        let point = |k: i32| {
            let height = 1e-3 * (2.0 * f64::from(k) + 1.0);
            ProfilePoint { height, velocity: law.velocity(height), pressure: 0.0, samples: 1.0 }
        };
        let points: Vec<ProfilePoint> = (0..23).map(point).collect();
        for (lower, upper) in LAYERS {
            let slope = semi_log_slope(&run, &points, lower, upper);
            assert!((slope - 1.0).abs() < 1e-9, "{lower} to {upper}: {slope}");
        }
        assert_eq!(number_of_layers(&run, &points), 1);
        let fit = layers(&run, &points, 2).expect("enough points");
        assert!((fit.slopes[0] / fit.slopes[1] - 1.0).abs() < 1e-6, "{fit:?}");
        let law_at = law.velocity(0.023) / law.friction_velocity();
        assert!((velocity_at(&run, &points, 0.023) - law_at).abs() < 1e-9);
        assert!((slope_ratio(&run, &points).expect("enough points") - 1.0).abs() < 1e-6);
    }
}
