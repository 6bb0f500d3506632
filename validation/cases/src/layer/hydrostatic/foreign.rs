//! A layer at rest as another code gives it: its profile and its history.

use super::flow::HydrostaticFlow;
use super::metrics::{HEIGHT_DRIFT, NORMAL_STRESS_L2, PRESSURE_L2, RMS_SPEED};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::input::FieldError;
use crate::layer::{LayerObservation, TimeSeries, foreign};

/// Possible data of a run.
pub(super) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[],
    series: &[
        ExternalColumn::new("time", "s", "time since the start"),
        ExternalColumn::new("rms_speed", "m/s", "root mean square of the speed"),
        ExternalColumn::new("mean_height", "m", "mean over the mass of the height above the bed"),
    ],
    profile: &[
        ExternalColumn::new("height", "m", "height above the bed, rising"),
        ExternalColumn::new("pressure", "Pa", "pressure there, a mean over the last half second"),
        ExternalColumn::new("normal_stress", "Pa", "stress across the layer p − s_yy there, compressive positive"),
    ],
    description: "The layer is prepared, or settles, before the start. pressure_l2 is the root of the summed squares of the errors of the \
        pressure over that of the exact hydrostatic one, K (exp(ρ0 g (H − y)/K) − 1), for laws without a yield that carries \
        stress; normal_stress_l2 is the same of p − s_yy for grains, whose pressure at rest is not unique. height_drift is the \
        mean height from 1.8 to 2.2 s over that from 0.8 to 1.2 s, less 1; rms_speed the last of the series.",
};

/// The observation from what another code gives.
///
/// # Errors
/// None yet: columns that are missing make what needs them unmeasured.
pub(super) fn observe(
    run: &HydrostaticFlow,
    given: &ExternalData,
) -> Result<ExternalObservation<LayerObservation>, FieldError> {
    let mut measured = Vec::new();
    let mut observation = foreign::unmeasured();
    if !given.profile("height").is_empty() {
        observation.profile = foreign::profile(given);
        let columns = [(PRESSURE_L2, "pressure"), (NORMAL_STRESS_L2, "normal_stress")];
        measured.extend(
            columns.iter().filter(|(_, column)| !given.profile(column).is_empty()).map(|(quantity, _)| quantity.name),
        );
    }
    if given.series("time").len() > 1 {
        // only ratios of heights are judged
        let relative_height =
            given.full_series("mean_height").iter().map(|height| 2.0 * height / run.height()).collect();
        observation.series = TimeSeries { relative_height, ..foreign::series(given) };
        if !given.series("rms_speed").is_empty() {
            measured.push(RMS_SPEED.name);
        }
        if !given.series("mean_height").is_empty() {
            measured.push(HEIGHT_DRIFT.name);
        }
    }
    Ok(ExternalObservation { observation, measured })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::NamedColumns;

    #[test]
    fn the_exact_pressure_has_no_error_and_what_is_not_given_is_not_measured() {
        let run = HydrostaticFlow::default();
        let height: Vec<f64> = (0..20).map(|k| (f64::from(k) + 0.5) / 20.0 * run.height()).collect();
        let pressure = height.iter().map(|&y| run.pressure(y)).collect();
        let profile: NamedColumns = [("height".to_owned(), height), ("pressure".to_owned(), pressure)].into();
        let seen = observe(&run, &ExternalData { profile, ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, ["pressure_l2"]);
        let wrong = seen.observation.profile.pressure.iter().zip(&seen.observation.profile.height);
        assert!(wrong.into_iter().all(|(pressure, &y)| *pressure == run.pressure(y)));
        assert!(seen.observation.profile.normal_stress.iter().all(|stress| stress.is_nan()));
    }

    #[test]
    fn a_history_of_heights_gives_the_drift() {
        let run = HydrostaticFlow::default();
        let series: NamedColumns = [("time", vec![0.0, 1.0, 2.0]), ("mean_height", vec![0.5, 0.5, 0.5])]
            .map(|(name, values)| (name.to_owned(), values))
            .into();
        let seen = observe(&run, &ExternalData { series, ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, ["height_drift"]);
    }
}
