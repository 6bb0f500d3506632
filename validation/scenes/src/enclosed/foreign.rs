//! A scene as another code, or a paper about one, gives it: the front over time, along the line of the scene's gauge.

use super::flow::Dimension;
use super::metrics::{FRONT, GAUGE_ERROR};
use super::setting::SceneGauge;
use super::{Measurand, SceneFlow, SceneObservation, series};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::input::FieldError;
use crate::statistics::{Extrapolation, interpolated};

/// Columns that an external code may give for a run.
pub(crate) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[],
    series: &[
        ExternalColumn::new("time", "s", "time since the start of the scene"),
        ExternalColumn::new("front", "m", "distance of the front from the start of the gauge's line, along it"),
    ],
    profile: &[],
    description: "The front is that of the scene's gauge of kind \"front\": the first place behind the start of its line where less than \
        its thickness stands across it; another definition moves it by about that much. A table [[measured]] for this gauge in the \
        scene's file has what gauge_error compares with, and its limit; both codes are held against it alike. Without one nothing is \
        judged: the front at the scene's end stands beside that of Bagnold's run, and both series are drawn.",
};

/// The observation from what another code gives; none where it gives no front.
///
/// # Errors
/// A scene without a gauge for it, or with several; a time or a front that is missing beside the other; a series that lasts
/// neither as long as what was measured nor, where nothing was, as the scene.
pub(crate) fn observe<S: Dimension<D>, const D: usize>(
    run: &SceneFlow<S, D>,
    given: &ExternalData,
) -> Result<Option<ExternalObservation<SceneObservation<D>>>, FieldError> {
    let (time, front) = (given.series("time"), given.series("front"));
    if time.is_empty() {
        return Ok(None);
    }
    if front.is_empty() {
        let remedy = "name the column of the file that holds it";
        return Err(FieldError::finding("series.front", "missing", remedy));
    }
    let gauge = gauge_of(run)?;
    let samples: Vec<(f64, f64)> = time.iter().copied().zip(front.iter().copied()).collect();
    let at = |time: f64| interpolated(&samples, time, (Extrapolation::Nothing, Extrapolation::Nothing));
    let points = || run.measured.iter().filter(|measured| measured.gauge == gauge).flat_map(|one| &one.points);
    let (first, last) = points().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &(t, _)| (a.min(t), b.max(t)));
    // the scene's own series ends with its last row, which is less than an interval before its end
    let last_row = run.duration - run.interval;
    let end = time.last().map_or(last_row, |given| given.clamp(last_row, run.duration));
    let mut measured = Vec::new();
    if points().next().is_some() {
        reaches(&samples, (first, last), "the measurements", "")?;
        measured.push(GAUGE_ERROR.name);
    } else if at(end).is_none() {
        let end = run.duration;
        let ends = samples.last().map_or(end, |last| last.0);
        let shorter = format!(", shorten the scene by with = {{ duration = {ends} }}");
        reaches(&samples, (end, end), "the scene's end, where the front is compared", &shorter)?;
    }
    // the front at the end is that of the scene's end, however long the other code went on
    let at_end = at(end).filter(|_| last <= end);
    let kept: Vec<(f64, f64)> = match at_end {
        Some(front) => {
            measured.push(FRONT.name);
            samples.iter().copied().filter(|(time, _)| *time < end).chain([(end, front)]).collect()
        }
        None => {
            let name = &run.name;
            let why = if last > end { "the measurements last longer" } else { "it ends before" };
            tracing::warn!(
                "scene {name}: the given front is not compared at the scene's end, {} s: {why}",
                run.duration
            );
            samples.clone()
        }
    };
    let mut observation = SceneObservation { time: kept.iter().map(|sample| sample.0).collect(), ..Default::default() };
    let front: Vec<f64> = kept.iter().map(|sample| sample.1).collect();
    observation.gauges = columns(run, gauge, &front);
    Ok(Some(ExternalObservation { observation, measured }))
}

/// The name of the scene's only gauge of a front.
fn gauge_of<S: Dimension<D>, const D: usize>(run: &SceneFlow<S, D>) -> Result<&str, FieldError> {
    let gauges = run.gauges.iter().zip(run.measures());
    let fronts: Vec<&str> =
        gauges.filter(|(_, measure)| matches!(measure, Measurand::Front(_))).map(|(gauge, _)| gauge.name()).collect();
    let refused = |defect: String, remedy: &str| Err(FieldError::finding("series.front", defect, remedy));
    match fronts[..] {
        [only] => Ok(only),
        [] => refused(
            format!("scene `{}` has no gauge of kind \"front\"", run.name),
            "add one under [[gauges]] with name, from, to and thickness; for a gate, also [[measured]] with gauge, source, points \
             and limit",
        ),
        _ => refused(
            format!("scene `{}` has several gauges of kind \"front\": {}", run.name, fronts.join(", ")),
            "keep only the gauge that this front belongs to, or give numbers",
        ),
    }
}

/// The values of all gauges, column by column, of which only those of one gauge are known.
fn columns<S: Dimension<D>, const D: usize>(run: &SceneFlow<S, D>, gauge: &str, front: &[f64]) -> Vec<Vec<f64>> {
    let none = SceneObservation::default();
    let of_gauge = |series: series::GaugeSeries<'_, D>| {
        let mut columns = vec![Vec::new(); series.columns.len()];
        if series.gauge == gauge {
            columns[0] = front.to_vec();
        }
        columns
    };
    series::of_run(run, &none).into_iter().flat_map(of_gauge).collect()
}

/// Refuses a series that does not reach over all times at which it is compared.
fn reaches(samples: &[(f64, f64)], (from, to): (f64, f64), what: &str, shorter: &str) -> Result<(), FieldError> {
    let ends = samples.first().zip(samples.last()).map(|(first, last)| (first.0, last.0));
    match ends {
        Some((first, last)) if first > from || last < to => {
            let needed = if from < to { format!("from {from} to {to} s") } else { format!("to {to} s") };
            // without what rounding leaves of times in other units
            let [first, last] = [first, last].map(|time| (time * 1e9).round() / 1e9);
            let defect = format!("{first} to {last} s does not cover {what}: {needed}");
            let remedy =
                format!("give the front over that time{shorter}, or leave the series out and give [run.numbers]");
            Err(FieldError::finding("series.time", defect, &remedy))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::NamedColumns;
    use crate::enclosed::{MeasuredSeries, metrics, quick};
    use crate::metric::{Metric, Verdict};
    use crate::scene::PlaneFlow;

    /// The tier's scene, with a front that was measured to run 1 m/s until 0.2 s.
    fn scene(limit: f64) -> PlaneFlow {
        let points = vec![(0.1, 0.1), (0.2, 0.2)];
        let source = "own flume".to_owned();
        PlaneFlow {
            measured: vec![MeasuredSeries { gauge: "front".to_owned(), source, points, limit, file: String::new() }],
            ..quick()
        }
    }

    fn given(time: &[f64], speed: f64) -> ExternalData {
        let front = time.iter().map(|time| speed * time).collect();
        let series: NamedColumns = [("time".to_owned(), time.to_vec()), ("front".to_owned(), front)].into();
        ExternalData { series, ..ExternalData::default() }
    }

    fn judged(scene: &PlaneFlow, given: &ExternalData) -> Result<Vec<Metric>, String> {
        let seen = observe(scene, given).map_err(|error| error.to_string())?.expect("a front");
        let record = given.record(seen.observation);
        let all = metrics::all(&[(scene.clone(), record)]);
        Ok(all.into_iter().filter(|metric| seen.measured.contains(&metric.name.as_str())).collect())
    }

    #[test]
    fn a_front_is_held_against_what_was_measured_by_the_scenes_own_limit() {
        // 5 % ahead everywhere, also beyond the end of the scene
        let given = given(&[0.0, 0.05, 0.3, 1.0], 1.05);
        for (limit, verdict) in [(6.0, Verdict::Pass), (4.0, Verdict::Fail), (0.0, Verdict::Observed)] {
            let metrics = judged(&scene(limit), &given).expect("long enough");
            let of = |name: &str| {
                metrics.iter().find(|metric| metric.name == name && metric.value.is_finite()).expect("given")
            };
            assert!((of("gauge_error").value - 5.0).abs() < 1e-9, "{}", of("gauge_error").value);
            assert_eq!(of("gauge_error").verdict(), verdict);
            // at the scene's end, 0.6 s, not at that of the series
            assert!((of("front").value - 0.63).abs() < 1e-12, "{}", of("front").value);
            assert!(metrics.iter().all(|metric| metric.name != "energy_residual"));
        }
    }

    #[test]
    fn a_series_that_ends_too_early_is_refused_with_the_time_that_is_needed() {
        let short = judged(&scene(6.0), &given(&[0.0, 0.15], 1.0)).expect_err("too short");
        assert_eq!(
            short,
            "`series.time`: 0 to 0.15 s does not cover the measurements: from 0.1 to 0.2 s; give the front over \
             that time, or leave the series out and give [run.numbers]"
        );
        let nearly = judged(&scene(6.0), &given(&[0.0, 0.199_97], 1.0)).expect_err("a little too short");
        assert!(nearly.contains("0 to 0.19997 s does not cover the measurements: from 0.1 to 0.2 s"), "{nearly}");
        let rounded = judged(&scene(6.0), &given(&[0.0, 0.15 + f64::EPSILON], 1.0)).expect_err("too short");
        assert!(rounded.contains("0 to 0.15 s does not"), "{rounded}");
        let late = judged(&scene(6.0), &given(&[0.15, 1.0], 1.0)).expect_err("begins too late");
        assert!(late.contains("0.15 to 1 s does not cover the measurements"), "{late}");
        // less than an interval of 5 ms before the end counts as the end, as in the scene's own series
        let metrics = judged(&scene(6.0), &given(&[0.0, 0.597], 1.0)).expect("as long as the scene");
        assert!(metrics.iter().any(|metric| metric.name == "front" && (metric.value - 0.597).abs() < 1e-12));
        // as long as the measurement, but not as the scene: judged by it, and not compared at the end
        let metrics = judged(&scene(6.0), &given(&[0.0, 0.25], 1.0)).expect("as long as the measurement");
        assert!(!metrics.is_empty() && metrics.iter().all(|metric| metric.name == "gauge_error"), "{metrics:?}");
        let tier = quick();
        let nothing = judged(&tier, &given(&[0.0, 0.25], 1.0)).expect_err("nothing to compare with");
        assert!(nothing.contains("does not cover the scene's end, where the front is compared: to 0.6 s"), "{nothing}");
    }

    #[test]
    fn a_scene_that_measures_no_front_or_several_says_what_to_change() {
        let own = scene(6.0);
        let none = PlaneFlow { gauges: own.gauges[1..].to_vec(), measured: Vec::new(), ..own.clone() };
        let message = judged(&none, &given(&[0.0, 1.0], 1.0)).expect_err("no gauge");
        assert!(
            message.starts_with("`series.front`: scene `step` has no gauge of kind \"front\"; add one"),
            "{message}"
        );
        assert!(message.contains("under [[gauges]] with name, from, to and thickness"), "{message}");
        let mut twice = own.clone();
        twice.gauges.push(own.gauges[0].clone());
        let message = judged(&twice, &given(&[0.0, 1.0], 1.0)).expect_err("two gauges");
        assert!(message.contains("has several gauges of kind \"front\": "), "{message}");
        assert!(observe(&own, &ExternalData::default()).expect("nothing").is_none());
        let no_front = ExternalData { series: [("time".to_owned(), vec![0.0])].into(), ..ExternalData::default() };
        assert!(observe(&own, &no_front).expect_err("no front").to_string().contains("`series.front`: missing"));
    }
}
