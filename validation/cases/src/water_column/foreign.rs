//! A collapse of water as another code, or a paper about one, gives it: the front over time.

use super::flow::{ColumnObservation, WaterColumnFlow};
use super::metrics::{DELAYED_FRONT_ERROR, DELAYED_HEIGHT_ERROR, FRONT_DELAY, FRONT_ERROR, HEIGHT_ERROR};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::input::FieldError;

/// Possible data of a run.
pub(super) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[],
    series: &[
        ExternalColumn::new("time", "s", "time since the column was released"),
        ExternalColumn::new("front", "m", "distance of the front from the symmetry plane or the back wall"),
        ExternalColumn::new("relative_time", "-", "the same time, t √(2g/a), as figures of the experiment have it"),
        ExternalColumn::new("relative_front", "-", "the same distance over the width, x/a"),
        ExternalColumn::new("height", "m", "thickness at the symmetry plane or the back wall"),
    ],
    profile: &[],
    description: "a is the column's width. Of time and of front one column each is enough. Where particles are at hand, the front \
        is the first place from the symmetry plane outwards where less than a fiftieth of the width stands on the bed; another \
        definition moves it by that much. The front must reach as far in time as the measurement, t √(2g/a) = 2.51; front_error \
        takes the times as they are, delayed_front_error less the delay that fits best, for a gate that takes its time.",
};

/// The observation from what another code gives; none where it gives no front.
///
/// # Errors
/// A time or a front that is missing beside the other, or a front that ends before the measurement.
pub(super) fn observe(
    run: &WaterColumnFlow,
    given: &ExternalData,
) -> Result<Option<ExternalObservation<ColumnObservation>>, FieldError> {
    let either = |absolute: &str, relative: &str, scale: f64| -> Vec<f64> {
        let absolute = given.series(absolute);
        if absolute.is_empty() {
            given.series(relative).to_vec()
        } else {
            absolute.iter().map(|value| value / scale).collect()
        }
    };
    let time = either("time", "relative_time", run.time_scale());
    let front = either("front", "relative_front", run.width);
    match (time.is_empty(), front.is_empty()) {
        (true, true) => Ok(None),
        (false, false) => {
            as_long_as_measured(run, &time)?;
            let start = run.width * run.aspect_ratio;
            let height: Vec<f64> = given.series("height").iter().map(|height| height / start).collect();
            let mut measured = vec![FRONT_ERROR.name, FRONT_DELAY.name, DELAYED_FRONT_ERROR.name];
            if !height.is_empty() {
                measured.extend([HEIGHT_ERROR.name, DELAYED_HEIGHT_ERROR.name]);
            }
            let observation = ColumnObservation { time, front, height, ..ColumnObservation::default() };
            Ok(Some(ExternalObservation { observation, measured }))
        }
        (no_time, _) => {
            let (field, rule) = if no_time {
                ("series.time", "given, or `relative_time`, together with a front")
            } else {
                ("series.front", "given, or `relative_front`, together with a time")
            };
            Err(FieldError::new(field, "missing", rule, "name the column of the file that contains it"))
        }
    }
}

/// Refuses a front that ends before the last measured place: no error over all places follows from it, and with a delay only
/// one over some.
fn as_long_as_measured(run: &WaterColumnFlow, time: &[f64]) -> Result<(), FieldError> {
    let needed = run.measured().points.iter().fold(0.0, |last: f64, (time, _)| last.max(*time));
    match time.last() {
        Some(last) if *last < needed => {
            let in_seconds = |time: f64| time * run.time_scale();
            let value = format!("up to t √(2g/a) = {last} ({:.4} s)", in_seconds(*last));
            let rule = format!(
                "up to at least the last measurement, t √(2g/a) = {needed} ({:.4} s for this width)",
                in_seconds(needed)
            );
            let remedy = "give a longer series, or leave it out and give single numbers under [run.numbers]";
            Err(FieldError::new("series.time", value, &rule, remedy))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::NamedColumns;
    use crate::reference::water::WATER_FRONT;

    fn seen(columns: &[(&str, Vec<f64>)]) -> Result<Option<ExternalObservation<ColumnObservation>>, FieldError> {
        let series: NamedColumns = columns.iter().map(|(name, values)| ((*name).to_owned(), values.clone())).collect();
        observe(&WaterColumnFlow::default(), &ExternalData { series, ..ExternalData::default() })
    }

    #[test]
    fn a_front_in_metres_and_seconds_is_the_one_over_width_and_time_scale() {
        let (time, front): (Vec<f64>, Vec<f64>) = WATER_FRONT.points.iter().copied().unzip();
        let flat = seen(&[
            ("relative_time", time.clone()),
            ("relative_front", front.clone()),
            ("height", vec![0.1; time.len()]),
        ]);
        let flat = flat.expect("complete").expect("a front");
        assert!(flat.measured.contains(&"height_error") && flat.observation.height.len() == time.len());
        let plain = seen(&[("relative_time", time.clone()), ("relative_front", front.clone())]).expect("complete");
        let plain = plain.expect("a front").observation;
        assert_eq!((&plain.time, &plain.front), (&time, &front));
        // a = 57.15 mm: √(a/2g) = 53.97 ms
        let scaled = |values: &[f64], scale: f64| values.iter().map(|value| value * scale).collect::<Vec<f64>>();
        let scale = (0.05715_f64 / 19.62).sqrt();
        let columns = [("time", scaled(&time, scale)), ("front", scaled(&front, 0.05715))];
        let metric = seen(&columns).expect("complete").expect("a front").observation;
        let same = |one: &[f64], other: &[f64]| one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(same(&metric.time, &time) && same(&metric.front, &front));
    }

    #[test]
    fn a_front_without_its_times_is_refused_and_nothing_is_nothing() {
        assert!(seen(&[]).expect("nothing").is_none());
        let error = seen(&[("front", vec![0.1])]).expect_err("no times").to_string();
        assert!(error.contains("`series.time` is missing"), "{error}");
    }

    #[test]
    fn a_front_that_ends_before_the_measurement_is_refused_with_the_time_that_is_needed() {
        let short = |last: f64| vec![("relative_time", vec![0.0, last]), ("relative_front", vec![1.0, 4.0])];
        let needed = WATER_FRONT.points.last().expect("a table").0;
        assert!(
            EXTERNAL_SCHEMA.description.contains(&format!("t √(2g/a) = {needed};")),
            "the template names the same time"
        );
        assert!(seen(&short(needed)).expect("long enough").is_some());
        assert_eq!(
            seen(&short(2.4)).expect_err("too short").to_string(),
            "`series.time` is up to t √(2g/a) = 2.4 (0.1295 s), but must be up to at least the last measurement, \
             t √(2g/a) = 2.51 (0.1355 s for this width); give a longer series, or leave it out and give single numbers under \
             [run.numbers]"
        );
    }
}
