//! Return mapping and regularised viscosity side by side.

use super::Measure;
use super::quantities::*;
use crate::case::Run;
use crate::collapse::{Collapse, CollapseRecord, ColumnPurpose};
use crate::figure::{Axis, Figure, Mark, Panel};
use crate::metric::{Metric, Variant};

/// The regularised runs.
fn regularised(records: &[CollapseRecord]) -> impl Iterator<Item = &CollapseRecord> {
    records.iter().filter(|(run, _)| run.purpose == ColumnPurpose::Regularised)
}

pub(crate) fn metrics(records: &[CollapseRecord]) -> Vec<Metric> {
    regularised(records).flat_map(|record| of_regularised(record, record.0.partner(records))).collect()
}

fn of_regularised((run, record): &CollapseRecord, partner: Option<&CollapseRecord>) -> Vec<Metric> {
    let variant = run.variant();
    let mut metrics = vec![
        // what (29) would ask for with the viscosity of (35) at rest under the whole column
        EXPLICIT_STEPS
            .of(&variant, run.explicit_viscous_steps(record.simulated_time))
            .exactly(record.steps as f64, "the steps that the implicit run took; an explicit one was not made")
            .with_snapshot_tolerance(0.02, 1.0),
        RUN_OUT.of(&variant, record.data.run_out()).with_snapshot_tolerance(1e-3, 1e-3),
    ];
    if let Some((_, mapped)) = partner {
        let difference = |of: Measure| 100.0 * (of(&record.data) / of(&mapped.data) - 1.0);
        let values = [
            (RUN_OUT.name, difference(Collapse::run_out)),
            ("centroid", difference(|collapse| collapse.centroid)),
            (FINAL_HEIGHT.name, difference(Collapse::final_height)),
        ];
        metrics.extend(values.map(|(quantity, value)| {
            let variant = Variant::of("quantity", quantity).followed_by(&variant);
            let metric = REGULARISED_DIFFERENCE.of(&variant, value);
            metric.exactly(0.0, "the same column by return mapping").with_snapshot_tolerance(0.02, 0.1)
        }));
    }
    metrics
}

pub(crate) fn figure(records: &[CollapseRecord]) -> Option<Figure> {
    let pairs: Vec<(&CollapseRecord, &CollapseRecord)> =
        regularised(records).filter_map(|record| Some((record, record.0.partner(records)?))).collect();
    if pairs.is_empty() {
        return None;
    }
    let [x, thickness] = [("x/r0 [-]", "x"), ("thickness/r0 [-]", "thickness")]
        .map(|(label, name)| Axis::linear(label).over(name, "m", pairs.iter().map(|((run, _), _)| run.half_width)));
    let mut deposit = Panel::new("", x, thickness);
    let mut front = Panel::new("", Axis::linear("t/√(h0/g) [-]"), Axis::linear("(front − r0)/r0 [-]"));
    for (slot, (regularised, mapped)) in pairs.into_iter().enumerate() {
        for ((run, record), kind, mark) in
            [(mapped, "return mapping", Mark::Line), (regularised, "regularised, implicit", Mark::Reference)]
        {
            let label = format!("{}, a = {}: {kind}", run.material, run.aspect_ratio);
            let data = &record.data;
            deposit.draw(&label, mark, slot, data.drawn());
            let way = data.time.iter().zip(&data.front).map(|(t, x)| (t / run.time_scale(), x - 1.0));
            front.draw("", mark, slot, way);
        }
    }
    Some(Figure::new(
        "stress-updates",
        "The two stress updates: return mapping with a true yield, and the paper's regularised viscosity (35) with \
         an implicit step. The regularised deposit creeps for ever, so its front is that of the time at which the \
         run ended.",
        vec![deposit, front],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{ColumnRun, Geometry, Material, Release};
    use crate::observation::{Outcome, Recorded};
    use crate::reference::grains::TABLE_2_SAND;
    use bagnold_solver::material::rheology::Rheology;
    use bagnold_solver::weakly_compressible::numerics::Numerics;

    /// A column of sand.
    fn column(aspect_ratio: f64, regularisation_rate: Option<f64>) -> ColumnRun {
        let grains = TABLE_2_SAND.law;
        ColumnRun {
            purpose: if regularisation_rate.is_some() { ColumnPurpose::Regularised } else { ColumnPurpose::Law },
            geometry: Geometry::Planar,
            material: Material::SAND,
            aspect_ratio,
            resolution: 20,
            half_width: 0.1,
            law: regularisation_rate
                .map_or(Rheology::MuI(grains), |rate| Rheology::RegularisedMuI(grains.regularised(rate))),
            bulk_density: 1500.0,
            regularisation_rate,
            shown_times: Vec::new(),
            release: Release::with(Numerics::default()),
        }
    }

    /// The metrics' names of columns of sand with these aspect ratios and of a regularised one with a = 1.
    fn names(sand: &[f64]) -> Vec<String> {
        let record = Recorded {
            outcome: Outcome::Finished,
            state_hash: String::new(),
            particles: 1,
            steps: 1,
            simulated_time: 1.0,
            wall_seconds: 1.0,
            threads: 1,
            frames: Vec::new(),
            first_bad: None,
            data: Collapse { deposit: vec![(0.05, 0.5), (2.95, 0.03), (3.05, 0.01)], ..Collapse::default() },
        };
        let columns = sand.iter().map(|&ratio| column(ratio, None)).chain([column(1.0, Some(0.01))]);
        let records: Vec<CollapseRecord> = columns.map(|run| (run, record.clone())).collect();
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
