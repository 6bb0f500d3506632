//! The case's figures.

use super::ClearWaterRecord;
use crate::figure::{Axis, Figure, Panel};
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
        "Left: velocity in units of u_* with the logarithmic law; z′ is the height above the law's origin, z₀ the \
         roughness length. Right: difference, with the rms limit from 0.1 to 0.9 h. Error bars: statistical errors.",
        vec![profile, residual],
    )
}
