//! A layer on an incline as another code gives it: its profile, its history, or its particles.

use super::Layer;
use super::probe::{DepthProfile, LayerObservation, LayerProbe, TimeSeries};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema, ParticleFrame};
use crate::input::FieldError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::Snapshot;

/// Possible data of a layer's run.
pub(crate) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[
        ExternalColumn::new("x", "m", "place along the slope, anywhere within the period"),
        ExternalColumn::new("y", "m", "height above the bed"),
        ExternalColumn::new("vx", "m/s", "velocity down the slope"),
        ExternalColumn::new("vy", "m/s", "velocity away from the bed"),
        ExternalColumn::new("mass", "kg", "mass of one, of a metre across; without it all count alike"),
        ExternalColumn::new("pressure", "Pa", "pressure"),
    ],
    series: &[
        ExternalColumn::new("time", "s", "time since the start"),
        ExternalColumn::new("mean_velocity", "m/s", "mean over the mass of the velocity down the slope"),
        ExternalColumn::new("rms_speed", "m/s", "root mean square of the speed"),
    ],
    profile: &[
        ExternalColumn::new("height", "m", "height above the bed, rising"),
        ExternalColumn::new("velocity", "m/s", "velocity down the slope there, a mean over the last part of the run"),
        ExternalColumn::new("pressure", "Pa", "pressure there"),
    ],
    description: "Velocities are compared at the heights at which they are given; a profile needs two points below a fifth of the \
        depth, by which the slip at the wall is measured. From particles the profile is a mean over all pictures \
        in the last quarter of the time, in twenty bins of equal height, each at the mean height of its particles. velocity_l2 is \
        the root of the summed squares of the bins' errors over that of the exact velocities. implied_stress_error, which needs \
        the pressure, is the mean of |μ(I)/tanθ − 1| over 0.1 h to 0.9 h, with the shear rate by central differences between \
        neighbouring points. transient_mean_error_… compare the mean velocity over the depth with an independent one-dimensional \
        solution at a quarter, a half and three quarters of its rise time.",
};

/// Metrics that a velocity profile suffices for.
const OF_PROFILE: [&str; 9] = [
    "plug_edge_error",
    "velocity_l2",
    "velocity_l2_compressible",
    "surface_velocity_error",
    "wall_slip",
    "implied_stress_error",
    "flux_error",
    "observed_order",
    "least_error_reduction",
];
/// Metrics that the history of the mean velocity suffices for.
const OF_HISTORY: [&str; 6] = [
    "transient_mean_error_quarter",
    "transient_mean_error_half",
    "transient_mean_error_three_quarters",
    "rise_time",
    "arrest_time",
    "least_acceleration",
];
/// How high a particle may be, over the layer's height.
const REACH: f64 = 50.0;
/// Range of a profile's highest point, over the layer's height.
const LOWEST_TOP: f64 = 0.2;
const HIGHEST_TOP: f64 = 2.0;
/// Share of the depth near the bed in which the slip at the wall is measured.
const NEAR_BED: f64 = 0.2;
/// What is wrong with places that are out of reach.
const ORIGIN: &str = "check the unit and the origin: y is the height above the bed";
/// Share of the time at the end whose pictures make the profile.
const LAST: f64 = 0.25;

/// A run that is a layer: its observation from what another code gives.
///
/// # Errors
/// Columns that are missing beside others.
pub(crate) fn observe(
    layer: &Layer<'_>,
    given: &ExternalData,
) -> Result<ExternalObservation<LayerObservation>, FieldError> {
    let mut measured = Vec::new();
    let mut observation = unmeasured();
    if let Some(end) = given.pictures.last().map(|picture| picture.time) {
        let start = given.pictures.first().map_or(end, |picture| picture.time);
        let mut probe = LayerProbe::new(layer);
        probe.window_start = end - LAST * (end - start);
        for picture in &given.pictures {
            let reach = REACH * layer.layer.layer_height;
            picture.within(f64::MAX, [f64::NEG_INFINITY, -reach, f64::NEG_INFINITY], ORIGIN)?;
            if picture.column("y").iter().any(|y| *y > reach) {
                let rule = format!("at most {reach} m");
                return Err(FieldError::new("particles.columns.y", "higher in places", &rule, ORIGIN));
            }
            probe.observe(&snapshot(picture)?);
        }
        let series = observation.series;
        observation = LayerObservation { series, ..probe.finish() };
        measured.extend(OF_PROFILE);
        measured.push("particles_lost");
    }
    let (height, velocity) = (given.profile("height"), given.profile("velocity"));
    if !height.is_empty() && !velocity.is_empty() {
        check_heights(height, layer.layer.layer_height)?;
        observation.profile = profile(given);
        measured.extend(OF_PROFILE);
    }
    let (time, mean) = (given.series("time"), given.series("mean_velocity"));
    if time.len() > 1 && !mean.is_empty() {
        observation.series = series(given);
        measured.extend(OF_HISTORY);
        if !given.series("rms_speed").is_empty() {
            measured.push("rest_rms_speed");
        }
    }
    measured.sort_unstable();
    measured.dedup();
    Ok(ExternalObservation { observation, measured })
}

/// Refuses heights of another layer, or too few near the bed for the slip at the wall.
fn check_heights(height: &[f64], depth: f64) -> Result<(), FieldError> {
    let field = "profile.columns.height";
    if let Some(highest) =
        height.last().filter(|highest| !(LOWEST_TOP * depth..=HIGHEST_TOP * depth).contains(*highest))
    {
        let rule = format!("up to the surface at {depth} m");
        return Err(FieldError::new(field, format!("up to {highest} m"), &rule, "check the unit"));
    }
    let near = height.iter().filter(|height| **height < NEAR_BED * depth).count();
    if near < 2 {
        let defect = format!("{near} of 2 points needed below {} m, a fifth of the depth", NEAR_BED * depth);
        return Err(FieldError::finding(field, defect, "give points nearer to the bed"));
    }
    Ok(())
}

/// Profile of a layer as far as it was given.
pub(crate) fn profile(given: &ExternalData) -> DepthProfile {
    let height = given.profile("height").to_vec();
    DepthProfile {
        velocity: given.full_profile("velocity"),
        pressure: given.full_profile("pressure"),
        normal_stress: given.full_profile("normal_stress"),
        shear_stress: vec![f64::NAN; height.len()],
        samples: vec![1.0; height.len()],
        height,
    }
}

/// History of a layer as far as it was given.
pub(crate) fn series(given: &ExternalData) -> TimeSeries {
    let time = given.series("time").to_vec();
    TimeSeries {
        mean_velocity: given.full_series("mean_velocity"),
        rms_speed: given.full_series("rms_speed"),
        relative_height: vec![f64::NAN; time.len()],
        pressure_noise: Vec::new(),
        time,
    }
}

/// No measurement: two times without a value, so that a history exists.
pub(crate) fn unmeasured() -> LayerObservation {
    let nothing = || vec![f64::NAN; 2];
    LayerObservation {
        series: TimeSeries {
            time: vec![0.0, 1.0],
            mean_velocity: nothing(),
            rms_speed: nothing(),
            relative_height: nothing(),
            pressure_noise: Vec::new(),
        },
        ..LayerObservation::default()
    }
}

fn snapshot(picture: &ParticleFrame) -> Result<Snapshot<2>, FieldError> {
    let remedy = "give x, y, vx and vy of a layer's particles";
    let [x, y, vx, vy] = ["x", "y", "vx", "vy"].map(|name| picture.needed(name, remedy));
    let (x, y, vx, vy) = (x?, y?, vx?, vy?);
    let or = |name: &str, value: f64| {
        let column = picture.column(name);
        if column.is_empty() { vec![value; x.len()] } else { column.to_vec() }
    };
    Ok(Snapshot {
        time: picture.time,
        // the points of a mesh lie on the bed, not below it
        position: x
            .iter()
            .zip(y)
            .map(|(x, y)| Vector::<2>::new(*x, if *y == 0.0 { f64::MIN_POSITIVE } else { *y }))
            .collect(),
        velocity: vx.iter().zip(vy).map(|(vx, vy)| Vector::<2>::new(*vx, *vy)).collect(),
        stress: vec![Tensor::<2>::from_element(f64::NAN); x.len()],
        pressure: or("pressure", f64::NAN),
        mass: or("mass", 1.0),
        ..Snapshot::default()
    })
}
