//! Columns beside points that experimenters measured: the final surface of a pile of aluminium bars, and run-outs of round columns.

use super::bands::band;
use super::quantities::*;
use super::uncertainty::Known;
use crate::case::Flow;
use crate::collapse::column::{pile_of, with_friction};
use crate::collapse::interior::wedge_of;
use crate::collapse::{Collapse, CollapseRecord, ColumnFlow, FRONT_THICKNESS};
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Limit, Metric, Origin, Value, Variant};
use crate::observation::{Frame, Recorded};
use crate::reference::collapse::{MeasuredPile, ROUND_COLUMN_RUN_OUTS};
use crate::statistics::{Extrapolation, interpolated};

/// How far the pile's run-out may be off `[-]`: twice 16 %, of which most is that nobody measured how the friction of the bars rises with the
/// rate (14 %); the rest are a row at the toe (5 %), the meaning of the friction angle (6 %) and the reading (4 %).
const PILE_RUN_OUT: f64 = 0.33;
/// The same of its height at the wall `[-]`: twice what its points as a whole are off by.
const PILE_HEIGHT: f64 = 0.03;
/// Largest distance between the surfaces in shares of the initial height `[%]`: a row of twenty.
const PILE_SURFACE: f64 = 5.0;
/// How far the run-out of a round column may be off the measured ones `[-]`.
const ROUND: f64 = 0.2;
/// Fewest round columns whose median counts.
const FEWEST: usize = 3;

const READING: &str =
    "scatter of the points of the surface about the line through their neighbours, at the toe over its slope";
const AREA: &str = "the area under the measured points exceeds the area of the pile by this share";

/// Thickness of a deposit at a distance from the wall, both over r_0; its innermost bin's at the wall.
fn thickness(collapse: &Collapse, place: f64) -> f64 {
    at(&collapse.deposit, place).unwrap_or(f64::NAN)
}

/// Value of points at a place, at their ends beyond them; none without points.
fn at(points: &[(f64, f64)], place: f64) -> Option<f64> {
    interpolated(points, place, (Extrapolation::EndValue, Extrapolation::EndValue))
}

/// Root mean square of what a function gives at the places of the measured surface, over the initial height `[%]`.
fn over_surface(pile: &MeasuredPile, difference: impl Fn(f64, f64) -> f64) -> f64 {
    let square = |&(x, height): &(f64, f64)| difference(x / pile.length, height / pile.length).powi(2);
    let mean = pile.surface.iter().map(square).sum::<f64>() / pile.surface.len() as f64;
    100.0 * mean.sqrt() * pile.length / pile.height
}

/// Run-out, height, surface and line of failure of the pile of bars against the measured ones.
pub(super) fn of_pile<const D: usize>(
    records: &[CollapseRecord<D>],
    (run, record): &CollapseRecord<D>,
    pile: &MeasuredPile,
    known: [Known; 2],
) -> Vec<Metric> {
    let (variant, collapse) = (run.variant(), &record.data);
    let judged = |limit: Limit| run.is_published().then_some(limit);
    let r = pile.length;
    let run_out = pile.front(FRONT_THICKNESS * r) / r - 1.0;
    let height = pile.surface.first().map_or(f64::NAN, |point| point.1 / r);
    let of = |metric: Metric, value: f64| {
        metric.against(Some(value), &pile.source, pile.confidence).with_snapshot_tolerance(1e-3, 1e-3)
    };
    let own = collapse.run_out();
    let of_run_out = known[0].of(of(RUN_OUT.of(&variant, own), run_out), collapse.front_uncertainty());
    let tall = collapse.final_height();
    let of_height = known[1].of(of(FINAL_HEIGHT.of(&variant, tall), height), None);
    let distance = over_surface(pile, |x, measured| thickness(collapse, x) - measured);
    let moved = |(_, other): &CollapseRecord<D>| {
        Some(over_surface(pile, |x, _| thickness(&other.data, x) - thickness(collapse, x)))
    };
    let of_surface = of(SURFACE_DISTANCE.of(&variant, distance), 0.0);
    let row = Some(100.0 * run.spacing() / pile.height / 12.0_f64.sqrt());
    let mut metrics = vec![
        with_friction(of_run_out, records, run, |(_, other)| Some(other.data.run_out() - own))
            .known_to(Origin::Digitisation, Some(pile.front_reading() / r), READING)
            .gated_by(
                judged(band(run_out, PILE_RUN_OUT)),
                "33 %: twice the uncertainty of 16 %, mostly by unmeasured rate dependence of the rods' friction",
            ),
        with_friction(of_height, records, run, |(_, other)| Some(other.data.final_height() - tall))
            .known_to(Origin::Digitisation, Some(pile.reading / r), READING)
            .known_to(Origin::Experiment, Some(pile.excess().abs() * height), AREA)
            .gated_by(judged(band(height, PILE_HEIGHT)), "3 %: twice the error of the area under the measured points"),
        with_friction(of_surface, records, run, moved)
            .known_to(Origin::Digitisation, Some(100.0 * pile.reading / pile.height), READING)
            .known_to(Origin::Experiment, Some(over_surface(pile, |_, measured| pile.excess() * measured)), AREA)
            .known_to(Origin::Numerical, row, "the surface of particles is known within one row (uniform distribution)")
            .gated_by(judged(Limit::AtMost(PILE_SURFACE)), "5 % of the initial height: one particle row of twenty"),
    ];
    let lengths = |run: &ColumnFlow<D>, frames: &[Frame]| {
        Some(wedge_of(run, frames)?.boundary.iter().map(|&(x, y)| (y, x)).collect::<Vec<(f64, f64)>>())
    };
    let over_line = |difference: &dyn Fn(f64, f64) -> Option<f64>| {
        let squares = pile.failure.iter().map(|&(x, y)| Some(difference(x, y)?.powi(2)));
        let sum: f64 = squares.sum::<Option<f64>>()?;
        Some(100.0 * (sum / pile.failure.len() as f64).sqrt() / r)
    };
    metrics.extend(lengths(run, &record.frames).map(|own| {
        // how their line was defined is not stated, and ours is by a displacement of a spacing
        let distance = over_line(&|x, y| Some(at(&own, y)? - x)).unwrap_or(f64::NAN);
        with_friction(of(FAILURE_LINE_DISTANCE.of(&variant, distance), 0.0), records, run, |(other, seen)| {
            let theirs = lengths(other, &seen.frames)?;
            over_line(&|_, y| Some(at(&theirs, y)? - at(&own, y)?))
        })
    }));
    metrics
}

/// The run-out of a round column over the measured one of its aspect ratio; none where none was measured.
pub(super) fn of_round_column<const D: usize>(
    run: &ColumnFlow<D>,
    collapse: &Collapse,
    known: Known,
) -> Option<Metric> {
    let measured = &*ROUND_COLUMN_RUN_OUTS;
    let expected = measured.at(run.initial_height()).filter(|_| D == 3)?;
    let ratio = RUN_OUT_RATIO
        .of(&run.variant(), collapse.run_out() / expected)
        .against(Some(1.0), &measured.source, measured.confidence)
        .with_snapshot_tolerance(1e-3, 1e-3);
    let row = collapse.front_uncertainty().map(|front| front / expected);
    Some(
        known
            .of(ratio, row)
            .known_to(
                Origin::Experiment,
                Some(measured.scatter),
                "relative scatter of the measured points about the line through their neighbours, from any cause",
            )
            .gated_by(
                (run.is_resolved() && run.is_published()).then_some(Limit::Within(1.0 - ROUND, 1.0 + ROUND)),
                "20 %: the project's aim; the source names no grains, but run-outs of Lube's various grains differed by less",
            ),
    )
}

/// The median over the round columns.
pub(super) fn of_round_columns(ratios: &[(f64, Metric)]) -> Option<Metric> {
    let mut values: Vec<f64> = ratios.iter().map(|(_, metric)| metric.value).collect();
    values.sort_by(f64::total_cmp);
    let middle = (values.len() >= FEWEST).then(|| 0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2]))?;
    let measured = &*ROUND_COLUMN_RUN_OUTS;
    let variant = Variant::of("aspect_ratio", Value::list(ratios.iter().map(|(ratio, _)| *ratio)));
    // independent columns, the median of which scatters by √(π/2) of their mean
    let squares: f64 = ratios.iter().filter_map(|(_, metric)| metric.uncertainty.standard()).map(|u| u * u).sum();
    let standard = (0.5 * std::f64::consts::PI * squares).sqrt() / values.len() as f64;
    Some(
        MEDIAN_RUN_OUT_RATIO
            .of(&variant, middle)
            .against(Some(1.0), &measured.source, measured.confidence)
            .known_to(Origin::Experiment, Some(standard), "from the uncertainties of the single ratios")
            .gated(
                Limit::Within(1.0 - 0.5 * ROUND, 1.0 + 0.5 * ROUND),
                "10 %, half the limit of one column: a median over columns reduces the scatter",
            )
            .with_snapshot_tolerance(1e-3, 1e-3),
    )
}

/// The pile's surface and line of failure beside the measured ones.
pub(crate) fn pile_figure<const D: usize>(records: &[&CollapseRecord<D>]) -> Option<Figure> {
    let piles: Vec<(&ColumnFlow<D>, &Recorded<Collapse>, &MeasuredPile)> =
        records.iter().filter_map(|(run, record)| Some((run, record, pile_of(run)?))).collect();
    let (_, _, pile) = *piles.first()?;
    let centimetres = |points: &[(f64, f64)]| points.iter().map(|(x, y)| (100.0 * x, 100.0 * y)).collect::<Vec<_>>();
    let axis = |label: &str| Axis::linear(label);
    let mut surface = Panel::new("final surface", axis("x [cm]"), axis("height [cm]"));
    let mut failure = Panel::new("border of the part at rest", axis("x [cm]"), axis("height [cm]"));
    let (length, height) = (100.0 * pile.length, 100.0 * pile.height);
    surface.reference("at first", [(0.0, height), (length, height), (length, 0.0)]);
    let bar = 200.0 * (pile.reading.powi(2) + (pile.excess() * 0.5 * pile.height).powi(2)).sqrt();
    surface.points("measured", 0, centimetres(&pile.surface)).error = vec![bar; pile.surface.len()];
    failure.points("", 0, centimetres(&pile.failure));
    for (slot, (run, record, _)) in piles.iter().enumerate() {
        let r = 100.0 * run.half_width;
        let label = format!(
            "{}, {} rows",
            run.made_of().title_with(&run.material),
            (run.initial_height() * run.resolution as f64).round()
        );
        let deposit = record.data.drawn().map(|(x, thickness)| (r * x, r * thickness));
        surface.line(&label, slot + 1, deposit);
        if let Some(wedge) = wedge_of(run, &record.frames) {
            failure.line("", slot + 1, centimetres(&wedge.boundary));
        }
    }
    let altered = if piles.iter().any(|(run, ..)| !run.made_of().is_published()) {
        " μ and μ_2: altered friction."
    } else {
        ""
    };
    let caption = format!(
        "Deposit of aluminium rods, with measured points (Bui et al. 2008; error bars: twice the uncertainty). (a) \
         Surface. (b) Border of the undisturbed part, whose particles moved by less than a spacing.{altered}"
    );
    Some(Figure::new("bars-surface", &caption, vec![surface, failure]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::collapse::ALUMINIUM_BAR_PILE;

    fn collapse(surface: impl Fn(f64) -> f64) -> Collapse {
        let deposit = (0..300).map(|k| (0.01 * f64::from(k), surface(0.01 * f64::from(k)))).collect();
        Collapse { deposit, ..Collapse::default() }
    }

    #[test]
    fn the_measured_surface_is_no_distance_from_itself_and_a_lifted_one_is() {
        let pile = &*ALUMINIUM_BAR_PILE;
        let points: Vec<(f64, f64)> = pile.surface.iter().map(|(x, y)| (x / pile.length, y / pile.length)).collect();
        let same = |x: f64| at(&points, x).expect("ends are given");
        let distance = |own: &Collapse| over_surface(pile, |x, measured| thickness(own, x) - measured);
        assert!(distance(&collapse(same)) < 0.1);
        // 1 cm of 10 cm
        assert!((distance(&collapse(|x| same(x) + 0.05)) - 10.0).abs() < 0.1);
        // the block as it stood is far off
        assert!(distance(&collapse(|x| if x < 1.0 { 0.5 } else { 0.0 })) > 3.0 * PILE_SURFACE);
    }
}
