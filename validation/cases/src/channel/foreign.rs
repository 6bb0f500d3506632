//! A channel as another code gives it: its profile and its history.

use super::{ChannelObservation, ChannelSeries, MomentumBalance};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::input::FieldError;
use crate::statistics::{BlockProfile, ProfilePoint};

/// Possible data of a run of water over a fixed bed.
pub(crate) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[],
    series: &[
        ExternalColumn::new("time", "s", "time since the start"),
        ExternalColumn::new("mean_velocity", "m/s", "mean over the depth of the velocity along the floor"),
        ExternalColumn::new("bed_shear", "Pa", "friction of the bed per area"),
    ],
    profile: &[
        ExternalColumn::new("height", "m", "height above the bed, rising"),
        ExternalColumn::new(
            "velocity",
            "m/s",
            "velocity along the bed there, a mean over a time in which the flow is stationary",
        ),
        ExternalColumn::new("pressure", "Pa", "pressure there"),
    ],
    description: "The profile is compared at the heights at which it is given, between a tenth and nine tenths of the depth: \
        velocity_rms is the root mean square of the velocity less the logarithmic law (of a laminar film: velocity_l2 against its \
        exact profile), over the friction velocity; semi_log_slope that of a line through the velocity over the logarithm of the \
        height. mean_velocity and bed_shear are means over the last quarter of the series, with the standard error of the mean \
        from its blocks.",
};

/// Metrics that a profile suffices for.
const OF_PROFILE: [&str; 5] = ["velocity_rms", "semi_log_slope", "velocity_l2", "observed_order", "flux_error"];
/// Share of the series at the end that is averaged.
const LAST: f64 = 0.25;

pub(crate) fn observe(given: &ExternalData) -> Result<ExternalObservation<ChannelObservation>, FieldError> {
    let mut measured = Vec::new();
    let time = given.series("time").to_vec();
    measured.extend(["mean_velocity", "bed_shear"].iter().filter(|name| !given.series(name).is_empty()));
    let (height, velocity) = (given.profile("height"), given.profile("velocity"));
    let pressure = given.profile("pressure");
    let point = |row: usize| ProfilePoint {
        height: height[row],
        velocity: velocity[row],
        pressure: pressure.get(row).copied().unwrap_or(f64::NAN),
        samples: 1.0,
    };
    if !height.is_empty() && !velocity.is_empty() {
        measured.extend(OF_PROFILE);
    }
    let (first, last) = (time.first().copied().unwrap_or(f64::NAN), time.last().copied().unwrap_or(f64::NAN));
    let unknown = vec![f64::NAN; time.len()];
    let observation = ChannelObservation {
        series: ChannelSeries {
            mean_velocity: given.full_series("mean_velocity"),
            bed_shear: given.full_series("bed_shear"),
            relative_height: unknown.clone(),
            highest: unknown.clone(),
            rms_vertical_velocity: unknown.clone(),
            pressure_error: unknown,
            time,
        },
        window: (last - LAST * (last - first), last),
        profile: BlockProfile::known((0..height.len().min(velocity.len())).map(point)),
        momentum: MomentumBalance { before: f64::NAN, after: f64::NAN, driven: f64::NAN, held: f64::NAN },
        ..ChannelObservation::default()
    };
    Ok(ExternalObservation { observation, measured })
}
