//! Return mapping and regularised viscosity side by side.

use super::Record;
use super::column::Purpose;
use crate::case::Run;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Metric};

/// Pairs of a regularised run and the run by return mapping that it is compared with.
fn pairs(records: &[Record]) -> Vec<(&Record, &Record)> {
    let regularised = records.iter().filter(|(run, _)| run.purpose == Purpose::Regularised);
    let partner = |record: &&Record| {
        let run = &record.0;
        records.iter().find(|(other, _)| {
            other.purpose == Purpose::Law
                && (&other.material, other.aspect_ratio, other.resolution)
                    == (&run.material, run.aspect_ratio, run.resolution)
        })
    };
    regularised.filter_map(|record| Some((record, partner(&record)?))).collect()
}

pub(super) fn metrics(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (regularised, mapped) in pairs(records) {
        let variant = regularised.0.variant();
        let (other, own) = (&regularised.1.data, &mapped.1.data);
        // what (29) would ask for with the viscosity of (35) at rest under the whole column
        metrics.push(
            Metric::observed(
                "explicit_steps",
                &variant,
                regularised.0.explicit_viscous_steps(regularised.1.simulated_time),
                "-",
            )
            .against(
                Some(regularised.1.steps as f64),
                "the steps that the implicit run took; an explicit one was not made",
                Confidence::Exact,
            )
            .with_snapshot_tolerance(0.02, 1.0),
        );
        let difference = |of: fn(&super::Collapse) -> f64| 100.0 * (of(other) / of(own) - 1.0);
        for (quantity, value) in [
            ("run_out", difference(super::Collapse::run_out)),
            ("centroid", difference(|collapse| collapse.centroid)),
            ("final_height", difference(super::Collapse::final_height)),
        ] {
            metrics.push(
                Metric::observed("regularised_difference", &format!("quantity={quantity},{variant}"), value, "%")
                    .against(Some(0.0), "the same column by return mapping", Confidence::Exact)
                    .with_snapshot_tolerance(0.02, 0.1),
            );
        }
    }
    metrics
}

pub(super) fn figure(records: &[Record]) -> Option<Figure> {
    let pairs = pairs(records);
    if pairs.is_empty() {
        return None;
    }
    let mut deposit = Panel::new("", Axis::linear("x/r0 [-]"), Axis::linear("thickness/r0 [-]"));
    let mut front = Panel::new("", Axis::linear("t/√(h0/g) [-]"), Axis::linear("(front − r0)/r0 [-]"));
    for (slot, (regularised, mapped)) in pairs.into_iter().enumerate() {
        for ((run, record), kind, mark) in
            [(mapped, "return mapping", Mark::Line), (regularised, "regularised, implicit", Mark::Reference)]
        {
            let label = format!("{}, a = {}: {kind}", run.material, run.aspect_ratio);
            let data = &record.data;
            let end = data.deposit.iter().rposition(|bin| bin.1 > 0.0).map_or(0, |last| last + 1);
            deposit.series.push(Series::new(&label, mark, slot, data.deposit[..end].to_vec()));
            let way = data.time.iter().zip(&data.front).map(|(t, x)| (t / run.time_scale(), x - 1.0)).collect();
            front.series.push(Series::new("", mark, slot, way));
        }
    }
    Some(Figure {
        name: "stress-updates".to_owned(),
        caption: "The two stress updates: return mapping with a true yield, and the paper's regularised viscosity (35) with \
                  an implicit step. The regularised deposit creeps for ever, so its front is that of the time at which the \
                  run ended."
            .to_owned(),
        panels: vec![deposit, front],
        columns: 2,
    })
}
