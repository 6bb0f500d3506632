//! A case at both ends of the ranges of its inputs, one at a time: what `validation/harness/sensitivities` is made of.

use crate::case::{AnyCase, CaseResult, Changes, Limits, ParameterError, PreparedCase, Tier, only};
use crate::evidence::{RangeEnd, SensitivityRow, StatedUncertainty};
use crate::metric::{Metric, MetricKind, Variant};
use std::collections::BTreeMap;

/// A case with an input at an end of its range.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Step {
    input: String,
    end: RangeEnd,
    repeat: usize,
    settings: Vec<String>,
    /// Keys of the runs that the input concerns; all runs where there are none.
    only: &'static [Variant],
}

/// Runs of a case that propagate its input uncertainty.
#[derive(Debug)]
pub struct SensitivityPlan {
    steps: Vec<Step>,
}

impl SensitivityPlan {
    /// Plan that propagates the stated ranges of a case; empty if none are stated.
    pub fn of(case: &str) -> Self {
        let stated = StatedUncertainty::of(case);
        let stated = stated.filter(|stated| !stated.ranges.is_empty() || !stated.spacings.is_empty());
        let Some(stated) = stated else { return Self { steps: Vec::new() } };
        let all = &stated.runs.only[..];
        let mut ends: Vec<(&str, RangeEnd, &[String], &[Variant])> = vec![("", RangeEnd::Own, &[], all)];
        for range in &stated.ranges {
            let only = if range.only_for.is_empty() { all } else { &range.only_for };
            ends.push((&range.name, RangeEnd::Low, &range.low, only));
            ends.push((&range.name, RangeEnd::High, &range.high, only));
        }
        ends.extend(stated.spacings.iter().map(|own| (own.name.as_str(), RangeEnd::Refined, &own.refined[..], all)));
        let mut seeds: Vec<Vec<String>> = stated.runs.seeds.iter().map(|seed| vec![format!("seed={seed}")]).collect();
        if seeds.is_empty() {
            seeds.push(Vec::new());
        }
        let of_end = |(input, end, changes, only): &(&str, RangeEnd, &[String], &'static [Variant])| {
            let of_seed = |(repeat, seed): (usize, &Vec<String>)| Step {
                input: (*input).to_owned(),
                end: *end,
                repeat,
                settings: [&stated.runs.settings[..], seed, changes].concat(),
                only,
            };
            seeds.iter().enumerate().map(of_seed).collect::<Vec<Step>>()
        };
        Self { steps: ends.iter().flat_map(of_end).collect() }
    }

    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The runs, in the plan's order.
    ///
    /// # Errors
    /// A setting of the ranges that the case refuses.
    pub fn prepare(
        &self,
        case: &'static dyn AnyCase,
        limits: Limits,
    ) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
        let prepare = |step: &Step| {
            let changes = Changes { file: None, settings: &step.settings, limits, only: step.only };
            only(case.prepare(Tier::Quick, &changes)?, step.only, "only")
        };
        self.steps.iter().map(prepare).collect()
    }

    /// The table of the results. A changed input may change the name of a run and take its reference away, so that the validations
    /// of one name are matched by their order.
    pub fn rows(&self, results: &[CaseResult]) -> Vec<SensitivityRow> {
        let mut own = results.first().map(validations).unwrap_or_default();
        own.retain(|_, metrics| metrics.iter().any(|metric| metric.compared_with().is_some()));
        let mut rows = Vec::new();
        for (step, result) in self.steps.iter().zip(results) {
            let here = validations(result);
            for (name, named) in &own {
                let is_of = |metric: &&&Metric| {
                    step.only.is_empty() || step.only.iter().any(|keys| metric.variant.includes(keys))
                };
                let named: Vec<&&Metric> = named.iter().filter(is_of).collect();
                let found = here.get(name).map_or(&[][..], Vec::as_slice);
                if named.is_empty() {
                    continue;
                }
                if found.len() != named.len() {
                    tracing::warn!(
                        "{} {:?}: {} of {} values of {name}",
                        step.input,
                        step.end,
                        found.len(),
                        named.len()
                    );
                    continue;
                }
                for (metric, named) in found.iter().zip(named).filter(|(metric, _)| metric.value.is_finite()) {
                    let Some(reference) = named.compared_with() else { continue };
                    rows.push(SensitivityRow {
                        input: step.input.clone(),
                        end: step.end,
                        repeat: step.repeat,
                        quantity: named.name.clone(),
                        variant: named.variant.clone(),
                        value: metric.value,
                        reference: metric.compared_with().unwrap_or(reference),
                    });
                }
            }
        }
        rows
    }
}

/// Comparisons of a case with external data, with or without a number, by name, in the case's order.
fn validations(result: &CaseResult) -> BTreeMap<&str, Vec<&Metric>> {
    let mut named: BTreeMap<&str, Vec<&Metric>> = BTreeMap::new();
    for metric in result.metrics.iter().filter(|metric| metric.kind == MetricKind::Validation) {
        named.entry(&metric.name).or_default().push(metric);
    }
    named
}
