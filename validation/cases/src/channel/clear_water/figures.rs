//! The case's figures.

use super::ClearWaterRecord;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::shared::percent;

pub(super) fn profiles(records: &[ClearWaterRecord]) -> Figure {
    let mut profile = Panel::new("", Axis::logarithmic("z′/z₀ [-]"), Axis::linear("u/u_* [-]"));
    let mut residual = Panel::new("", Axis::linear("z/h [-]"), Axis::linear("(u − u_log)/u_* [-]"));
    residual.band("limit of the rms", [(0.1, -0.25, 0.25), (0.9, -0.25, 0.25)]);
    residual.reference("", [(0.0, 0.0), (1.0, 0.0)]);
    for (slot, (run, record)) in records.iter().enumerate() {
        let law = run.reference();
        let scale = law.friction_velocity();
        let distance = |z: f64| libm::exp(law.logarithm(z));
        if slot == 0 {
            // one line for all slopes
            let curve = (0..=60).map(|k| law.depth * f64::from(k) / 60.0);
            let exact = curve.map(|z| (distance(z), law.velocity(z) / scale));
            profile.reference("logarithmic law", exact);
        }
        let (points, velocities) = (record.data.profile.points(), record.data.profile.velocities());
        let error: Vec<f64> = velocities.iter().map(|velocity| velocity.standard_error / scale).collect();
        let values = points.iter().map(|point| (distance(point.height), point.velocity / scale));
        profile.points(&percent(run.slope), slot, values).error.clone_from(&error);
        let deviation = |z: f64, velocity: f64| (z / law.depth, (velocity - law.velocity(z)) / scale);
        let deviations = points.iter().map(|point| deviation(point.height, point.velocity));
        residual.line_points("", slot, deviations).error = error;
    }
    Figure::new(
        "velocity-profile",
        "Left: mean velocity u over the friction velocity u_*, against the logarithmic law; z′ is the distance from the origin of the wall \
         law and z₀ the roughness length. Right: the difference from the law over the height above the bed, with the limit of its rms from \
         0.1 to 0.9 h. Bars are the statistical errors from blocks of time, where they are wider than the marks. Bins are one spacing high.",
        vec![profile, residual],
    )
}

pub(super) fn over_time(records: &[ClearWaterRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("t [s]"), Axis::linear("U/U_log [-]"));
    let mut shear = Panel::new("", Axis::linear("t [s]"), Axis::linear("bed shear/(ρ g h i) [-]"));
    let mut longest: f64 = 0.0;
    let mut intervals = Vec::new();
    for (slot, (run, record)) in records.iter().enumerate() {
        let law = run.reference();
        let data = &record.data;
        let series = &data.series;
        longest = longest.max(record.simulated_time);
        let mean = law.mean_velocity();
        velocity.line(&percent(run.slope), slot, series.curve(&series.mean_velocity, mean));
        shear.line("", slot, series.curve(&series.bed_shear, law.bed_shear_stress()));
        let marks = data.marks.iter().map(|mark| (mark.time, mark.mean_velocity / mean)).collect();
        intervals.push(Series::new("", Mark::Points, slot, marks));
    }
    intervals.retain(|series| !series.points.is_empty());
    let criterion = if intervals.is_empty() {
        let course = |(run, record): &ClearWaterRecord| {
            let values = &record.data.series.mean_velocity;
            let share = |value: Option<&f64>| value.map_or(f64::NAN, |value| value / run.reference().mean_velocity());
            let (first, last) = (share(values.first()), share(values.last()));
            format!(" At {} U/U_log is {first:.3} at first and {last:.3} in the end.", percent(run.slope))
        };
        format!(
            "The run has a fixed end and no criterion of stationarity.{}",
            records.iter().map(course).collect::<String>()
        )
    } else {
        "Points are the ends of the intervals U/(2 g i) of the criterion; the last of them is where the flow counts as stationary and the \
         averaging window begins."
            .to_owned()
    };
    velocity.series.extend(intervals);
    for panel in [&mut velocity, &mut shear] {
        panel.reference("", [(0.0, 1.0), (longest, 1.0)]);
    }
    let caption = format!(
        "Depth mean U of the velocity over that of the logarithmic law, U_log, and the friction of the bed over ρ g h i. {criterion}"
    );
    Figure::new("stationarity", &caption, vec![velocity, shear])
}
