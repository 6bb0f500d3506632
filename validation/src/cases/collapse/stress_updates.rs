//! Return mapping and regularised viscosity side by side.

use super::Record;
use super::column::{ColumnRun, Purpose};
use super::deposit::Collapse;
use crate::case::Run;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Kind, Metric, Variant};

/// The regularised runs.
fn regularised(records: &[Record]) -> impl Iterator<Item = &Record> {
    records.iter().filter(|(run, _)| run.purpose == Purpose::Regularised)
}

/// The run by return mapping that a regularised run is compared with, if it was asked for.
fn partner<'a>(records: &'a [Record], run: &ColumnRun) -> Option<&'a Record> {
    records.iter().find(|(other, _)| {
        other.purpose == Purpose::Law
            && (&other.material, other.aspect_ratio, other.resolution)
                == (&run.material, run.aspect_ratio, run.resolution)
    })
}

/// Pairs of a regularised run and its partner.
fn pairs(records: &[Record]) -> Vec<(&Record, &Record)> {
    regularised(records).filter_map(|record| Some((record, partner(records, &record.0)?))).collect()
}

pub(super) fn metrics(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in regularised(records) {
        let variant = run.variant();
        // what (29) would ask for with the viscosity of (35) at rest under the whole column
        metrics.push(
            Metric::observed("explicit_steps", &variant, run.explicit_viscous_steps(record.simulated_time), "-")
                .against(
                    Some(record.steps as f64),
                    "the steps that the implicit run took; an explicit one was not made",
                    Confidence::Exact,
                )
                .with_snapshot_tolerance(0.02, 1.0),
        );
        metrics.push(
            Metric::observed("run_out", &variant, record.data.run_out(), "-")
                .of_kind(Kind::Validation)
                .with_snapshot_tolerance(1e-3, 1e-3),
        );
        let Some((_, mapped)) = partner(records, run) else { continue };
        let difference = |of: fn(&Collapse) -> f64| 100.0 * (of(&record.data) / of(&mapped.data) - 1.0);
        for (quantity, value) in [
            ("run_out", difference(Collapse::run_out)),
            ("centroid", difference(|collapse| collapse.centroid)),
            ("final_height", difference(Collapse::final_height)),
        ] {
            let variant = Variant::of("quantity", quantity).followed_by(&variant);
            metrics.push(
                Metric::observed("regularised_difference", &variant, value, "%")
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Parameters, Tier};
    use crate::cases::column_planar::ColumnPlanarParameters;
    use crate::observation::{Outcome, Recorded};

    /// The metrics' names of columns of sand with these aspect ratios and of regularised ones with a = 1.
    fn names(sand: &[f64]) -> Vec<String> {
        let mut parameters = ColumnPlanarParameters::of_tier(Tier::Quick);
        parameters.sand.aspect_ratios = sand.to_vec();
        parameters.regularised.aspect_ratios = vec![1.0];
        let record = Recorded {
            outcome: Outcome::Finished,
            state_hash: String::new(),
            particles: 1,
            steps: 1,
            simulated_time: 1.0,
            wall_seconds: 1.0,
            threads: 1,
            frames: Vec::new(),
            data: Collapse { deposit: vec![(0.05, 0.5), (2.95, 0.03), (3.05, 0.01)], ..Collapse::default() },
        };
        let records: Vec<Record> = parameters.runs().into_iter().map(|run| (run, record.clone())).collect();
        let metrics = metrics(&records);
        assert!(metrics.iter().all(|metric| metric.name != "run_out" || (metric.value - 2.0).abs() < 1e-12));
        metrics.into_iter().map(|metric| metric.name).collect()
    }

    #[test]
    fn a_regularised_column_without_a_partner_has_its_own_run_out() {
        assert_eq!(names(&[0.9]), ["explicit_steps", "run_out"]);
        let difference = "regularised_difference";
        assert_eq!(names(&[0.9, 1.0]), ["explicit_steps", "run_out", difference, difference, difference]);
    }
}
