//! A column as another code gives it: the same measurements, taken by the same surveyor.

use super::heap::{Room, SPEEDS, Start, snapshot};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema, ParticleFrame};
use crate::collapse::column::EARLIEST_REST;
use crate::collapse::interior::PROFILE_TIME;
use crate::collapse::metrics::other_codes::MID_COLLAPSE;
use crate::collapse::metrics::quantities::*;
use crate::collapse::{Collapse, ColumnFlow};
use crate::input::FieldError;
use crate::metric::Quantity;
use crate::setup::energy_ledger::{CORRECTION_WORK, ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK};
use bagnold_solver::weakly_compressible::Snapshot;

/// Possible data of a column's run.
pub(crate) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[
        ExternalColumn::new(
            "x",
            "m",
            "distance from the symmetry plane along the bed; of round columns one of two horizontal axes",
        ),
        ExternalColumn::new("y", "m", "height above the bed"),
        ExternalColumn::new("z", "m", "second horizontal axis of round columns"),
        ExternalColumn::new("area", "m^2", "area that a particle or cell of a planar column stands for"),
        ExternalColumn::new("volume", "m^3", "volume that one of a round column stands for"),
        ExternalColumn::new(
            "mass",
            "kg",
            "mass of one, of planar columns a metre of it; with the density in place of area or volume",
        ),
        ExternalColumn::new("density", "kg/m^3", "density"),
        ExternalColumn::new("vx", "m/s", "velocity along x"),
        ExternalColumn::new("vy", "m/s", "velocity along y"),
        ExternalColumn::new("vz", "m/s", "velocity along z"),
    ],
    series: &[
        ExternalColumn::new("time", "s", "time since the release"),
        ExternalColumn::new("front", "m", "distance of the front from the symmetry plane, at a thickness of 0.02 r_0"),
        ExternalColumn::new(
            "front_of_rows",
            "m",
            "where the thickness in bins falls below 0.05 r_0, from which the stopping time is taken",
        ),
        ExternalColumn::new("height", "m", "thickness at the symmetry plane"),
    ],
    profile: &[
        ExternalColumn::new("x", "m", "distance from the symmetry plane, rising"),
        ExternalColumn::new("thickness", "m", "thickness of the deposit there: volume per area of the bed"),
    ],
    description: "Only half of a planar column and a quarter of a round one is given, with x (and z) positive; the last picture is the \
        deposit, if it is not earlier than 2 √(h_0/g). \
        Each particle counts as a cell as wide as it is high, the root of its area (cube root of its volume). The front at a thickness is the \
        length of the bed that carries it, from the thickest place outwards (in space the radius of a quarter circle of that area), \
        with thickness counted in whole rows of the mean cell and read half a row below; what lies in fewer than four rows (in space two; half the \
        rows of a low column) counts as a wedge of its volume; grains beyond a gap of two cells do not count. Where a \
        profile is given instead, the front is where it first falls below. run_out is the distance of the front at 0.02 r_0 less r_0, over \
        r_0; without particles or profile that of the last row of the series. For the other numbers the bed is divided into bins \
        (rings) of 0.1 r_0, with each particle's volume spread evenly over a spacing to either side: final_height is the innermost bin's \
        thickness over r_0. stopping_time is when the place where that thickness, followed outwards, first falls below \
        0.05 r_0, linear between the centres of bins, has covered 99 % of its way, over √(h_0/g). deposit_slope_angle is that of a line through the thickness over \
        20 to 80 % of the front's distance. In the last picture the fastest 0.5 % of the mass count as at rest: single grains slide on.",
};

/// Metrics that the profile of a deposit suffices for.
const OF_PROFILE: [&[Quantity]; 2] = [
    &[RUN_OUT, FINAL_HEIGHT, DEPOSIT_SLOPE_ANGLE, FLANK_R_SQUARED],
    &[SURFACE_DISTANCE, SCALING_EXPONENT, BREAK_POINT],
];
/// Metrics of the velocities in mid-collapse.
const OF_MOTION: [&[Quantity]; 2] = [
    &[KINETIC_ENERGY, ENERGY_GAIN, FOOT_VELOCITY_RATIO],
    &[FLOWING_LAYER_R_SQUARED, FASTEST_HEIGHT, LINEAR_MISFIT_RATIO, TAIL_DECAY_LENGTH_OVER_SPACING],
];
/// Share of the mass that may slide on alone when a heap rests `[-]`.
const STRAY: f64 = 0.005;
/// Time over √(h_0/g) before which a column stands as at the start: it has fallen by half a hundredth of its height `[-]`.
const STILL: f64 = 0.1;
/// Distance of a picture from a time of the metrics over √(h_0/g) `[-]`.
const NEAR: f64 = 0.15;

pub(crate) fn observe<const D: usize>(
    run: &ColumnFlow<D>,
    given: &ExternalData,
) -> Result<ExternalObservation<Collapse>, FieldError> {
    let mut collapse = Collapse {
        top: f64::NAN,
        centroid: f64::NAN,
        quantiles: (f64::NAN, f64::NAN),
        momentum_residual: f64::NAN,
        ..Collapse::default()
    };
    let mut measured = Vec::new();
    let (r, scale) = (run.half_width, run.time_scale());
    let has_fallen = |time: f64| time >= EARLIEST_REST * scale;
    let (size, middle) = if D == 2 { (1.0, 0.5) } else { (std::f64::consts::FRAC_PI_4 * r, 2.0 / 3.0) };
    let room = Room {
        spacing: run.spacing(),
        reach: REACH * r * (1.0 + run.aspect_ratio),
        density: run.density(),
        size: size * r * r * run.initial_height(),
        start: Some(Start { until: STILL * scale, width: r, height: run.initial_height() * r, middle: middle * r }),
        kind: "column",
        origin: ORIGIN,
    };
    let mut snapshots: Vec<Snapshot<D>> =
        given.pictures.iter().map(|picture| snapshot(&room, picture)).collect::<Result<_, _>>()?;
    if let Some(last) = snapshots.last_mut() {
        without_stray_grains(last);
    }
    if let Some(end) = snapshots.last() {
        let mut surveyor = run.surveyor();
        for snapshot in &snapshots {
            surveyor.observe(snapshot);
        }
        collapse = Collapse { momentum_residual: f64::NAN, ..surveyor.finish(end) };
        measured.push(PARTICLES_LOST.name);
        if has_fallen(end.time) {
            measured.extend(told(run, given, &snapshots, &collapse));
        }
    }
    let (x, thickness) = (given.profile("x"), given.profile("thickness"));
    if !x.is_empty() && !thickness.is_empty() {
        collapse.deposit = x.iter().zip(thickness).map(|(x, thickness)| (x / r, thickness / r)).collect();
        room.check_profile(x, thickness, D)?;
        if D == 2 && given.pictures.is_empty() {
            let weights: Vec<f64> = (0..x.len()).map(|k| thickness[k] * width_around(x, k)).collect();
            let moment: f64 = x.iter().zip(&weights).map(|(x, weight)| x * weight).sum();
            collapse.centroid = moment / (weights.iter().sum::<f64>() * r);
        }
        measured.extend(OF_PROFILE.concat().iter().map(|own| own.name));
    }
    let time = given.series("time");
    if !time.is_empty() {
        let unknown = || vec![f64::NAN; time.len()];
        let over_r = |name: &str| given.full_series(name).iter().map(|length| length / r).collect();
        (collapse.front, collapse.rows_front, collapse.height) =
            (over_r("front"), over_r("front_of_rows"), over_r("height"));
        // energies belong to the pictures' times
        (collapse.kinetic_energy, collapse.potential_energy) = (unknown(), unknown());
        collapse.time = time.to_vec();
        if collapse.deposit.is_empty()
            && !given.series("front").is_empty()
            && time.last().is_some_and(|end| has_fallen(*end))
        {
            measured.push(RUN_OUT.name);
        }
        measured.retain(|name| ![REST_TIME.name, STOPPING_TIME.name].contains(name));
        if !given.series("front_of_rows").is_empty() {
            if time.len() >= PICTURES_OF_A_HISTORY {
                measured.push(STOPPING_TIME.name);
            }
            let is_seen = |place: f64, near: f64| time.iter().any(|time| (time / scale - place).abs() < near);
            if is_seen(0.0, STILL) && is_seen(MID_COLLAPSE, NEAR) {
                measured.push(FRONT.name);
            }
        }
    }
    measured.sort_unstable();
    measured.dedup();
    Ok(ExternalObservation { observation: collapse, measured })
}

/// Length of the bed that a point of a profile stands for `[m]`.
fn width_around(x: &[f64], point: usize) -> f64 {
    let after = x.get(point + 1).unwrap_or(&x[point]);
    // the innermost bin begins at the plane
    let before = if point == 0 { -x[0] } else { x[point - 1] };
    0.5 * (after - before)
}

/// Names of what pictures up to a deposit tell: all metrics of the case but those that need more than was given.
fn told<const D: usize>(
    run: &ColumnFlow<D>,
    given: &ExternalData,
    snapshots: &[Snapshot<D>],
    collapse: &Collapse,
) -> Vec<&'static str> {
    let scale = run.time_scale();
    let times: Vec<f64> = given.pictures.iter().map(|picture| picture.time / scale).collect();
    let is_seen = |time: f64| times.iter().any(|own| (own - time).abs() < NEAR);
    let has_speeds = |picture: &ParticleFrame| SPEEDS[..D].iter().all(|name| !picture.column(name).is_empty());
    let moves = given.pictures.iter().all(has_speeds);
    let from_start = times.first().is_some_and(|time| *time < STILL) && times.len() > 1;
    // cells of a mesh stay where they are, and their numbers tell no grain
    let grains = |pair: &[Snapshot<D>]| pair[0].position.len() == pair[1].position.len();
    let is_mesh = snapshots.windows(2).all(|pair| grains(pair) && pair[0].position == pair[1].position);
    let follows = from_start && !is_mesh && snapshots.windows(2).all(grains);
    let rests = collapse.rest_time().is_finite();
    // a run that was ended early does not say that it never rests
    let is_long = times.last().is_some_and(|end| *end >= run.duration);
    let lacks: [(bool, &[Quantity]); 6] = [
        (true, &[ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK, CORRECTION_WORK, MOMENTUM_RESIDUAL]),
        (!(moves && from_start && is_seen(PROFILE_TIME)), &OF_MOTION.concat()),
        (!(from_start && is_seen(MID_COLLAPSE)), &[FRONT, KINETIC_ENERGY]),
        (
            !follows,
            &[UNDISTURBED_SHARE, FAILURE_SURFACE_ANGLE, FAILURE_LINE_DISTANCE, FAST_UPSTREAM_RATIO, TOP_DISTORTION],
        ),
        (!(moves && from_start && (rests || is_long)), &[REST_TIME]),
        (times.len() < PICTURES_OF_A_HISTORY, &[STOPPING_TIME]),
    ];
    let lacks: Vec<&str> =
        lacks.iter().filter(|(lacks, _)| *lacks).flat_map(|(_, names)| names.iter().map(|own| own.name)).collect();
    QUANTITIES.iter().map(|own| own.name).filter(|name| !lacks.contains(name)).collect()
}

/// Stops the fastest grains, up to a share of the mass, which slide on alone when the heap rests.
fn without_stray_grains<const D: usize>(end: &mut Snapshot<D>) {
    if end.velocity.iter().any(|velocity| velocity.norm_squared().is_nan()) {
        return;
    }
    let mut order: Vec<usize> = (0..end.mass.len()).collect();
    order.sort_by(|&a, &b| end.velocity[b].norm_squared().total_cmp(&end.velocity[a].norm_squared()));
    let mut left = STRAY * end.mass.iter().sum::<f64>();
    for particle in order {
        left -= end.mass[particle];
        if left < 0.0 {
            break;
        }
        end.velocity[particle].fill(0.0);
    }
}

/// How far from the origin a particle may be, over the sum of half width and height: further than any column spreads.
const REACH: f64 = 50.0;
/// Least number of pictures from which the stopping time is taken: four over √(h_0/g), five times as long.
const PICTURES_OF_A_HISTORY: usize = 20;

const ORIGIN: &str = "check the unit and the origin: it lies on the bed in the symmetry plane, and only the half (quarter) beyond it is given";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Flow, NamedColumns};

    /// A column higher than half of it is wide.
    fn run() -> ColumnFlow<2> {
        ColumnFlow { aspect_ratio: 1.5, ..ColumnFlow::default() }
    }

    /// A wedge of thickness (1 − x/3) r_0 in square cells; what is less than a cell goes to the next column.
    fn wedge<const D: usize>(run: &ColumnFlow<D>) -> ParticleFrame {
        let (r, spacing) = (run.half_width, run.spacing());
        let mut columns: NamedColumns = ["x", "y", "area"].map(|name| (name.to_owned(), Vec::new())).into();
        let mut push = |name: &str, value: f64| columns.get_mut(name).expect("declared").push(value);
        let mut left = 0.5;
        for column in 0..3 * run.resolution {
            let x = (column as f64 + 0.5) * spacing;
            left += (r - x / 3.0) / spacing;
            let rows = left.floor();
            left -= rows;
            for row in 0..rows as usize {
                push("x", x);
                push("y", (row as f64 + 0.5) * spacing);
                push("area", spacing * spacing);
            }
        }
        ParticleFrame { time: 1.0, columns }
    }

    #[test]
    fn a_deposit_from_particles_and_from_its_profile_has_the_run_out_that_geometry_gives() {
        let run = run();
        let picture = wedge(&run);
        let particles = ExternalData { pictures: vec![picture], ..ExternalData::default() };
        let seen = observe(&run, &particles).expect("complete");
        // the thickness is 0.02 r_0 at x = 2.94 r_0
        assert!((seen.observation.run_out() - 1.94).abs() < 0.06, "{}", seen.observation.run_out());
        assert!(seen.measured.contains(&"run_out") && !seen.measured.contains(&"stopping_time"));
        assert!(!seen.measured.contains(&"rest_time") && !seen.measured.contains(&"momentum_residual"));
        let x: Vec<f64> = (0..31).map(|k| 0.1 * f64::from(k) * run.half_width).collect();
        let thickness = x.iter().map(|x| (run.half_width - x / 3.0).max(0.0)).collect();
        let profile: NamedColumns = [("x".to_owned(), x), ("thickness".to_owned(), thickness)].into();
        let seen = observe(&run, &ExternalData { profile, ..ExternalData::default() }).expect("complete");
        assert!((seen.observation.run_out() - 1.94).abs() < 1e-9, "{}", seen.observation.run_out());
        // the start in bins, the innermost of which begins at the plane
        let x: Vec<f64> = (0..10).map(|bin| (0.1 * f64::from(bin) + 0.05) * run.half_width).collect();
        let thickness = vec![run.initial_height() * run.half_width; x.len()];
        let bins: NamedColumns = [("x".to_owned(), x), ("thickness".to_owned(), thickness)].into();
        let start = observe(&run, &ExternalData { profile: bins, ..ExternalData::default() }).expect("complete");
        assert!((start.observation.centroid - 0.5).abs() < 0.03, "{}", start.observation.centroid);
        // a triangle of the length 3 r_0
        assert!((seen.observation.centroid - 1.0).abs() < 0.01, "{}", seen.observation.centroid);
        assert!(!seen.measured.contains(&"height_by_top"));
    }

    #[test]
    fn columns_over_the_half_width_and_the_time_of_fall_are_those_of_the_run() {
        let (run, scales) = (run(), run().scales().expect("a column has scales"));
        assert_eq!(scales.length, run.half_width);
        let nominal = (run.aspect_ratio * run.half_width / run.gravity).sqrt();
        // the height is a whole number of rows
        assert!((scales.time / nominal - 1.0).abs() < 0.03, "{} and {nominal}", scales.time);
    }

    #[test]
    fn another_unit_of_the_size_is_refused_and_no_column_has_fallen_at_its_start() {
        let run = run();
        let mut picture = wedge(&run);
        picture.columns.get_mut("area").expect("declared").iter_mut().for_each(|area| *area *= 1e4);
        let message = observe(&run, &ExternalData { pictures: vec![picture], ..ExternalData::default() })
            .expect_err("cm²")
            .to_string();
        assert!(
            message.starts_with("`particles.columns.area` is ")
                && message.contains(
                    " m^2 over all particles at 1 s, but must be within a factor 1.2 of the column's initial value"
                ),
            "{message}"
        );
        let seen = observe(&run, &ExternalData { pictures: vec![block(&run, [1.0; 3])], ..ExternalData::default() });
        assert_eq!(seen.expect("the start").measured, ["particles_lost"]);
    }

    /// The start in square cells, by factors of its width, its height and the area of a cell.
    fn block<const D: usize>(run: &ColumnFlow<D>, [wide, high, area]: [f64; 3]) -> ParticleFrame {
        let (rows, spacing) = (40, run.half_width / 40.0);
        let count = (rows as f64 * run.initial_height()).round() as usize;
        let place = |cell: usize| (cell as f64 + 0.5) * spacing;
        let cells: Vec<(f64, f64)> =
            (0..rows * count).map(|cell| (wide * place(cell % rows), high * place(cell / rows))).collect();
        let columns: [(&str, Vec<f64>); 3] = [
            ("x", cells.iter().map(|cell| cell.0).collect()),
            ("y", cells.iter().map(|cell| cell.1).collect()),
            ("area", vec![area * wide * high * spacing * spacing; cells.len()]),
        ];
        ParticleFrame { time: 0.0, columns: columns.map(|(name, column)| (name.to_owned(), column)).into() }
    }

    #[test]
    fn another_start_is_refused_with_both_numbers() {
        let run = run();
        let refused = |factors| {
            observe(&run, &ExternalData { pictures: vec![block(&run, factors)], ..ExternalData::default() })
                .map(|_| String::new())
                .unwrap_or_else(|error| error.to_string())
        };
        assert_eq!(refused([1.0; 3]), "");
        // smaller, of grain density given as bulk density, wider and lower, mirrored
        assert!(
            refused([0.8, 0.8, 1.0]).starts_with("`particles.columns.area` is 9.0"),
            "{}",
            refused([0.8, 0.8, 1.0])
        );
        assert!(refused([1.0, 1.0, 0.81]).contains("within a factor 1.03"), "{}", refused([1.0, 1.0, 0.81]));
        let lower = refused([1.1, 1.0 / 1.1, 1.0]);
        assert!(
            lower.starts_with("`particles.columns.x` is on average 0.0") && lower.contains("within 2 %"),
            "{lower}"
        );
        assert!(refused([-1.0, 1.0, -1.0]).starts_with("`particles.columns.x"), "{}", refused([-1.0, 1.0, -1.0]));
    }

    #[test]
    fn a_series_that_goes_on_to_the_end_gives_the_run_out() {
        let run = run();
        let series = |end: f64| -> NamedColumns {
            let (time, front) = (vec![0.0, end], vec![run.half_width, 2.5 * run.half_width]);
            [("time".to_owned(), time), ("front".to_owned(), front)].into()
        };
        let of =
            |end| observe(&run, &ExternalData { series: series(end), ..ExternalData::default() }).expect("complete");
        let seen = of(5.0 * run.time_scale());
        assert_eq!(seen.measured, ["run_out"]);
        assert!((seen.observation.run_out() - 1.5).abs() < 1e-12);
        assert!(seen.observation.run_out_of_rows().is_nan(), "there is no profile");
        assert!(of(run.time_scale()).measured.is_empty());
    }

    #[test]
    fn particles_without_a_size_are_refused() {
        let run = run();
        let mut picture = wedge(&run);
        picture.columns.remove("area");
        let message =
            observe(&run, &ExternalData { pictures: vec![picture], ..ExternalData::default() }).expect_err("no size");
        assert_eq!(
            message.to_string(),
            "`particles.columns.area` is missing, but must be given; name the column of the area, or those of mass and density"
        );
    }
}
