//! A column as another code gives it: the same measurements, taken by the same surveyor.

use super::column::{ColumnRun, EARLIEST_REST, Geometry};
use super::deposit::Collapse;
use super::quantities::{
    BREAK_POINT, DEPOSIT_SLOPE_ANGLE, FINAL_HEIGHT, HEIGHT_BY_TOP, PARTICLES_LOST, REST_TIME, RUN_OUT,
    SCALING_EXPONENT, STOPPING_TIME,
};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema, ParticleFrame};
use crate::input::FieldError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

/// What a column's run may yield.
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
        20 to 80 % of the front's distance.",
};

/// Metrics that a deposit suffices for.
const OF_DEPOSIT: [&str; 5] =
    [RUN_OUT.name, FINAL_HEIGHT.name, DEPOSIT_SLOPE_ANGLE.name, SCALING_EXPONENT.name, BREAK_POINT.name];

pub(crate) fn observe(run: &ColumnRun, given: &ExternalData) -> Result<ExternalObservation<Collapse>, FieldError> {
    match run.geometry {
        Geometry::Planar => of::<2>(run, given),
        Geometry::Round => of::<3>(run, given),
    }
}

fn of<const D: usize>(run: &ColumnRun, given: &ExternalData) -> Result<ExternalObservation<Collapse>, FieldError> {
    let unmeasured = Collapse {
        top: f64::NAN,
        centroid: f64::NAN,
        quantiles: (f64::NAN, f64::NAN),
        momentum_residual: f64::NAN,
        ..Collapse::default()
    };
    let mut measured = Vec::new();
    let mut collapse = unmeasured;
    let has_fallen = |time: f64| time >= EARLIEST_REST * run.time_scale();
    let room = Room {
        spacing: run.spacing(),
        reach: REACH * run.half_width * (1.0 + run.aspect_ratio),
        density: run.bulk_density,
        size: match run.geometry {
            Geometry::Planar => 1.0,
            Geometry::Round => std::f64::consts::FRAC_PI_4 * run.half_width,
        } * run.half_width
            * run.half_width
            * run.initial_height(),
        kind: "column",
        origin: ORIGIN,
    };
    if let Some((end, _)) = given.pictures.split_last() {
        let snapshots: Vec<Snapshot<D>> =
            given.pictures.iter().map(|picture| snapshot(&room, picture)).collect::<Result<_, _>>()?;
        let mut surveyor = run.surveyor();
        for snapshot in &snapshots {
            surveyor.observe(snapshot);
        }
        if let Some(last) = snapshots.last() {
            collapse = surveyor.finish(last);
        }
        collapse.momentum_residual = f64::NAN;
        if has_fallen(end.time) {
            measured.extend(OF_DEPOSIT);
            measured.push(HEIGHT_BY_TOP.name);
        }
        measured.push(PARTICLES_LOST.name);
        let moves = ["vx", "vy"].iter().all(|name| !end.column(name).is_empty());
        if moves && given.pictures.len() > 1 {
            measured.push(REST_TIME.name);
        }
        if given.pictures.len() >= PICTURES_OF_A_HISTORY {
            measured.push(STOPPING_TIME.name);
        }
    }
    let r = run.half_width;
    let (x, thickness) = (given.profile("x"), given.profile("thickness"));
    if !x.is_empty() && !thickness.is_empty() {
        collapse.deposit = x.iter().zip(thickness).map(|(x, thickness)| (x / r, thickness / r)).collect();
        measured.extend(OF_DEPOSIT);
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
            measured.push(STOPPING_TIME.name);
        }
    }
    measured.sort_unstable();
    measured.dedup();
    Ok(ExternalObservation { observation: collapse, measured })
}

/// How far from the origin a particle may be, over the sum of half width and height: further than any column spreads.
const REACH: f64 = 50.0;
/// Least number of pictures from which the stopping time is taken: four over √(h_0/g), five times as long.
const PICTURES_OF_A_HISTORY: usize = 20;

/// Largest factor by which material may become more or less, in volume `[-]`: grains dilate and codes lose some, but twice as
/// much is another unit, or the whole of a column of which half is asked.
const BULKING: f64 = 1.6;

const ORIGIN: &str = "check the unit and the origin: it lies on the bed in the symmetry plane, and only the half (quarter) beyond it is given";

/// Where particles of a heap may be, and what they weigh.
pub(super) struct Room {
    /// Particle spacing of ours `[m]`.
    pub(super) spacing: f64,
    /// Largest coordinate `[m]`.
    pub(super) reach: f64,
    /// Density in bulk `[kg/m³]`.
    pub(super) density: f64,
    /// Area of all at the start, in space the volume `[m²]` or `[m³]`.
    pub(super) size: f64,
    /// What collapses, in words.
    pub(super) kind: &'static str,
    /// What to do about places that are out of reach.
    pub(super) origin: &'static str,
}

impl Room {
    /// Refuses a picture whose particles have much more or less area or volume together than there was at the start.
    fn check(&self, sum: f64, axes: usize, picture: &ParticleFrame) -> Result<(), FieldError> {
        if sum > self.size / BULKING && sum < self.size * BULKING {
            return Ok(());
        }
        let (size, unit) = if axes == 2 { ("area", "m^2") } else { ("volume", "m^3") };
        let given = if picture.column(size).is_empty() { "mass" } else { size };
        let value = format!("{sum:.4e} {unit} over all particles at {} s", picture.time);
        let start = format!("{:.4e} {unit}", self.size);
        let rule = format!("within a factor {BULKING} of what the {} has at the start, {start}", self.kind);
        let remedy = "check the unit, and which part of it is given";
        Err(FieldError::new(&format!("particles.columns.{given}"), value, &rule, remedy))
    }
}

pub(super) fn snapshot<const D: usize>(room: &Room, picture: &ParticleFrame) -> Result<Snapshot<D>, FieldError> {
    let Room { spacing, reach, density: bulk_density, .. } = *room;
    let least = if D == 2 { [-spacing, -reach, -reach] } else { [-spacing, -reach, -spacing] };
    picture.within(reach, least, room.origin)?;
    if D == 2 && !picture.column("z").is_empty() {
        let remedy = &format!("a planar {} has x along the bed and y upwards", room.kind);
        return Err(FieldError::new("particles.columns.z", "given", "absent: this run is planar", remedy));
    }
    let axes = ["x", "y", "z"];
    let speeds = ["vx", "vy", "vz"];
    let places: Vec<&[f64]> = axes[..D]
        .iter()
        .map(|axis| picture.needed(axis, "a place has two coordinates in a planar column and three in a round one"))
        .collect::<Result<_, _>>()?;
    let count = places[0].len();
    let velocities: Vec<&[f64]> = speeds[..D].iter().map(|speed| picture.column(speed)).collect();
    let size = if D == 2 { "area" } else { "volume" };
    let (mass, density) = if picture.column(size).is_empty() {
        let remedy = format!("name the column of the {size}, or those of mass and density");
        let wanted = |name| {
            picture
                .needed(name, "")
                .map_err(|_| FieldError::new(&format!("particles.columns.{size}"), "missing", "given", &remedy))
        };
        (wanted("mass")?.to_vec(), wanted("density")?.to_vec())
    } else {
        let mass = picture.column(size).iter().map(|size| size * bulk_density).collect();
        (mass, vec![bulk_density; count])
    };
    let sum: f64 = mass.iter().zip(&density).map(|(mass, density)| mass / density).sum();
    room.check(sum, D, picture)?;
    let of = |columns: &[&[f64]], particle: usize| {
        Vector::<D>::from_fn(|axis, _| columns[axis].get(particle).copied().unwrap_or(f64::NAN))
    };
    Ok(Snapshot {
        time: picture.time,
        position: (0..count).map(|particle| of(&places, particle)).collect(),
        velocity: (0..count).map(|particle| of(&velocities, particle)).collect(),
        mass,
        density,
        ..Snapshot::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{NamedColumns, Parameters, Tier};
    use crate::collapse::planar::ColumnPlanarParameters;

    /// A column higher than half of it is wide.
    fn run() -> ColumnRun {
        let runs = ColumnPlanarParameters::of_tier(Tier::Quick).runs();
        runs.into_iter().find(|run| (run.aspect_ratio - 1.5).abs() < 0.5).expect("a column")
    }

    /// A wedge of thickness (1 − x/3) r_0 in square cells; what is less than a cell goes to the next column.
    fn wedge(run: &ColumnRun) -> ParticleFrame {
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
        assert!(seen.observation.centroid.is_nan() && !seen.measured.contains(&"height_by_top"));
    }

    #[test]
    fn another_unit_of_the_size_is_refused_and_no_column_has_fallen_at_its_start() {
        let run = run();
        let mut picture = wedge(&run);
        picture.columns.get_mut("area").expect("declared").iter_mut().for_each(|area| *area *= 1e4);
        let message = observe(&run, &ExternalData { pictures: vec![picture], ..ExternalData::default() })
            .expect_err("cm²")
            .to_string();
        assert!(message.starts_with("`particles.columns.area` is ") && message.contains(" m^2 over all particles at 1 s, but must be within a factor 1.6 of what the column has at the start"), "{message}");
        let early = ParticleFrame { time: 0.0, ..wedge(&run) };
        let seen = observe(&run, &ExternalData { pictures: vec![early], ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, ["particles_lost"]);
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
