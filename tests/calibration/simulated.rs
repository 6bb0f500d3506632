//! The simulator itself in the place of a formula: μ_s from the run-out of columns, the fluid's viscosity from velocities at
//! which suspensions sink, to which it comes through the drag.

use super::coverage::{Problem, Tally, normal, usual};
use bagnold_harness::case::{Limits, Silent};
use bagnold_harness::evaluation::{CaseRequest, EvaluationRecord, evaluate};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_inference::inference::{Budget, SolvePlan};
use bagnold_validation::REGISTRY;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;

/// A case with one parameter, and the data that are taken from it.
struct Simulated {
    case: &'static str,
    /// Changes to the quick tier.
    with: &'static str,
    /// The parameter's path and its value at a point.
    setting: fn(f64) -> String,
    /// The data of a record.
    predict: fn(&EvaluationRecord) -> Vec<f64>,
    /// Number of data.
    data: usize,
    /// Their relative standard uncertainty.
    noise: f64,
    /// Parameter behind the data, in the unit cube.
    truth: f64,
    /// Step of differences in the unit cube, above the scatter of runs.
    difference: f64,
    /// Results already simulated, by the bits of the coordinate: many seeds ask for the same points.
    known: RefCell<BTreeMap<u64, Option<Vec<f64>>>>,
}

impl Simulated {
    /// The data at a point; none where a run fails.
    fn values(&self, u: f64) -> Option<Vec<f64>> {
        let known = self.known.borrow().get(&u.to_bits()).cloned();
        known.unwrap_or_else(|| {
            let values = self.simulated(u);
            self.known.borrow_mut().insert(u.to_bits(), values.clone());
            values
        })
    }

    fn simulated(&self, u: f64) -> Option<Vec<f64>> {
        let with = toml::from_str(self.with).expect("parameters of the case");
        let request = CaseRequest { case: self.case.to_owned(), with, ..CaseRequest::default() };
        let prepared =
            request.prepare(*REGISTRY, Path::new("simulated.rs"), &[(self.setting)(u)], Limits::default()).ok()?;
        let record = evaluate(prepared, &[], &Store::open(StorePolicy::Use), &Silent).expect("threads to run it");
        record.failure.is_none().then(|| (self.predict)(&record)).filter(|values| values.len() == self.data)
    }

    fn problem(&self, seed: u64) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>>> {
        let exact = self.values(self.truth).expect("the truth can be simulated");
        let noise = normal(seed, exact.len());
        let residuals = move |u: &[f64]| {
            let model = self.values(u[0])?;
            Some((0..model.len()).map(|k| (model[k] / exact[k] - 1.0) / self.noise - noise[k]).collect())
        };
        Problem { residuals, truth: vec![self.truth], series: Vec::new() }
    }

    /// Repeats the calibration with many seeds.
    fn study(&self, name: &str, seeds: std::ops::Range<u64>) -> Tally {
        let plan = usual(vec![0.3]);
        let plan = SolvePlan { budget: Budget { difference: self.difference, ..plan.budget }, ..plan };
        let tally = Tally::by(seeds, &plan, |seed| self.problem(seed));
        tally.print(name);
        println!("{} points were simulated in all", self.known.borrow().len());
        tally
    }
}

/// Run-outs of three columns of sand, ten particles over the half width.
fn columns() -> Simulated {
    Simulated {
        case: "column-planar",
        with: "resolution = 10\nvary = [{ path = \"aspect_ratio\", values = [0.9, 1.5, 3.0] }]\n",
        setting: |u| format!("material.static_friction={}", 0.4 + 0.4 * u),
        predict: |record| {
            // the front's; other measures of the run-out say which they are
            let is_front = |variant: &str| !variant.contains("quantity=");
            let run_outs = record
                .metrics
                .iter()
                .filter(|metric| metric.name == "run_out" && is_front(&metric.variant.to_string()));
            run_outs.map(|metric| metric.value).collect()
        },
        data: 3,
        noise: 0.1,
        truth: 0.45,
        difference: 0.05,
        known: RefCell::default(),
    }
}

/// Sinking velocities of three suspensions by Wen and Yu's law, means over the second half of the run.
fn suspensions() -> Simulated {
    Simulated {
        case: "settling",
        with: "vary = [{ path = \"solid_fraction\", values = [0.1, 0.3, 0.5] }]\n",
        setting: |u| format!("kinematic_viscosity={}", 5e-7 * 8.0_f64.powf(u)),
        predict: |record| {
            record
                .tables
                .iter()
                .filter_map(|table| {
                    let column = table.columns.iter().position(|column| column == "sinking velocity [m/s]")?;
                    let half = &table.rows[table.rows.len() / 2..];
                    Some(half.iter().map(|row| row[column]).sum::<f64>() / half.len() as f64)
                })
                .collect()
        },
        data: 3,
        noise: 0.05,
        truth: 1.0 / 3.0,
        difference: 0.02,
        known: RefCell::default(),
    }
}

#[test]
#[ignore = "the full study: columns are simulated for more than half an hour"]
fn regions_of_columns_hold_the_friction() {
    let tally = columns().study("column run-out, μ_s", 100..140);
    assert!(tally.joint >= 34 && tally.single[0] >= 34, "{tally:?}");
}

#[test]
#[ignore = "the full study: suspensions are simulated for some minutes"]
fn regions_of_suspensions_hold_the_viscosity() {
    let tally = suspensions().study("settling, viscosity by the drag", 100..140);
    assert!(tally.joint >= 34 && tally.single[0] >= 34, "{tally:?}");
}
