//! Return mapping and regularised viscosity side by side.

use super::Measure;
use super::quantities::*;
use crate::case::Flow;
use crate::collapse::{Collapse, CollapseRecord};
use crate::figure::{Axis, Figure, Mark, Panel};
use crate::metric::{Metric, Variant};

/// The regularised runs.
fn regularised<const D: usize>(records: &[CollapseRecord<D>]) -> impl Iterator<Item = &CollapseRecord<D>> {
    records.iter().filter(|(run, _)| run.is_regularised())
}

pub(crate) fn metrics<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Metric> {
    regularised(records).flat_map(|record| of_regularised(record, record.0.partner(records))).collect()
}

fn of_regularised<const D: usize>(
    (run, record): &CollapseRecord<D>,
    partner: Option<&CollapseRecord<D>>,
) -> Vec<Metric> {
    let variant = run.variant();
    let mut metrics = vec![
        // what (29) would ask for with the viscosity of (35) at rest under the whole column
        EXPLICIT_STEPS
            .of(&variant, run.explicit_viscous_steps(record.simulated_time))
            .exactly(record.steps as f64, "steps of the implicit run; no explicit run was made")
            .with_snapshot_tolerance(0.02, 1.0),
    ];
    // one without a partner is judged by itself
    if let Some((_, mapped)) = partner {
        metrics.push(RUN_OUT.of(&variant, record.data.run_out()).with_snapshot_tolerance(1e-3, 1e-3));
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

pub(crate) fn figure<const D: usize>(records: &[CollapseRecord<D>]) -> Option<Figure> {
    let pairs: Vec<(&CollapseRecord<D>, &CollapseRecord<D>)> =
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
            let label = format!("{}, a = {}: {kind}", run.made_of(), run.aspect_ratio);
            let data = &record.data;
            deposit.draw(&label, mark, slot, data.drawn());
            let way = data.time.iter().zip(&data.front).map(|(t, x)| (t / run.time_scale(), x - 1.0));
            front.draw("", mark, slot, way);
        }
    }
    Some(Figure::new(
        "stress-updates",
        "Stress updates: return mapping with a true yield, and the paper's regularised viscosity (35) with an implicit step, whose \
         front creeps and is that at the end of the run.",
        vec![deposit, front],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::ColumnFlow;
    use crate::collapse::metrics::all;
    use crate::observation::{Outcome, Recorded};
    use crate::reference::grains::TABLE_2_SAND;
    use bagnold_solver::material::rheology::Rheology;

    /// The metrics' names of columns of sand with these aspect ratios and of a regularised one with a = 1: those of the latter by itself, and
    /// how many differences it has.
    fn names(sand: &[f64]) -> (Vec<String>, usize) {
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
        let column = |aspect_ratio: f64| ColumnFlow::<2> { aspect_ratio, ..ColumnFlow::default() };
        let material = Rheology::RegularisedMuI(TABLE_2_SAND.law.regularised(0.01));
        let regularised = ColumnFlow { material, ..column(1.0) };
        let columns = sand.iter().map(|&ratio| column(ratio)).chain([regularised.clone()]);
        let records: Vec<CollapseRecord<2>> = columns.map(|run| (run, record.clone())).collect();
        let metrics = all(&records);
        let own = metrics.iter().filter(|metric| metric.variant == regularised.variant());
        let own = own.filter(|metric| [EXPLICIT_STEPS.name, RUN_OUT.name].contains(&metric.name.as_str()));
        let differences = metrics.iter().filter(|metric| metric.name == REGULARISED_DIFFERENCE.name).count();
        let own: Vec<&Metric> = own.collect();
        assert!(own.iter().all(|metric| metric.name != RUN_OUT.name || (metric.value - 2.0).abs() < 1e-12));
        (own.iter().map(|metric| metric.name.clone()).collect(), differences)
    }

    #[test]
    fn a_regularised_column_has_its_own_run_out_once_and_differences_beside_a_partner() {
        let (mut alone, differences) = names(&[0.9]);
        alone.sort();
        assert_eq!((alone, differences), (vec!["explicit_steps".to_owned(), "run_out".to_owned()], 0));
        assert_eq!(names(&[0.9, 1.0]), (vec!["explicit_steps".to_owned(), "run_out".to_owned()], 3));
    }
}
