//! Expected cost of evaluations over the box of a calibration, told before the search and limited in it.

use super::plan::CalibrationPlan;
use crate::case::{Limits, Registry};
use crate::number::four_digits;

/// Most parameters whose corners are all estimated.
const MOST_PARAMETERS: usize = 6;
/// Largest cost of an evaluation over that of the cheapest corner, and the least that is allowed anyway `[h]`: a search makes
/// some hundreds.
const DEAREST: f64 = 100.0;
const ALWAYS_ALLOWED: f64 = 0.5;

/// Nominal cost of an evaluation on one core.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluationCost {
    /// Cost at the start of the search `[h]`.
    pub start: f64,
    /// Cost at the cheapest corner of the box `[h]`.
    pub cheapest: f64,
    /// Cost at the dearest corner of the box that the cases accept `[h]`.
    pub dearest: f64,
    /// Names and values of the parameters there.
    pub at: String,
}

impl EvaluationCost {
    /// Cost at the start and at the dearest corner; none for a plan of choices, and none where the start is refused.
    pub fn of(plan: &CalibrationPlan, registry: Registry) -> Option<Self> {
        let hours = |point: &[f64]| -> Option<f64> {
            let values = plan.values(point);
            let fitted = plan.blocks.iter().filter(|block| !block.held_out && !block.is_law);
            fitted
                .map(|block| {
                    let settings = plan.settings(block, &values);
                    let prepared = block.request.prepare(registry, &plan.file, &settings, Limits::NONE).ok()?;
                    Some(prepared.estimate_of_all().core_seconds / 3600.0 * plan.repeats.count as f64)
                })
                .sum()
        };
        if !plan.choices.is_empty() || plan.parameters.is_empty() || plan.blocks.iter().all(|block| block.is_law) {
            return None;
        }
        let start = hours(&plan.start())?;
        let count = plan.parameters.len().min(MOST_PARAMETERS);
        let corner = |bits: usize| -> Vec<f64> {
            let of = |k: usize, middle: f64| if k < count { ((bits >> k) & 1) as f64 } else { middle };
            plan.start().into_iter().enumerate().map(|(k, middle)| of(k, middle)).collect()
        };
        let corners = (0..1 << count).map(corner);
        let mut costs: Vec<(f64, Vec<f64>)> = corners.filter_map(|point| Some((hours(&point)?, point))).collect();
        costs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let cheapest = costs.first()?.0.min(start);
        let (dearest, point) = costs.pop()?;
        let named = plan.parameters.iter().zip(plan.values(&point));
        let at: Vec<String> =
            named.map(|(parameter, value)| format!("{} = {}", parameter.name, four_digits(value))).collect();
        Some(Self { start, cheapest, dearest, at: at.join(", ") })
    }

    /// Largest cost of a simulation that a search accepts unless the user gives another limit `[h]`.
    pub fn limit(&self) -> f64 {
        (DEAREST * self.cheapest).max(ALWAYS_ALLOWED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_evaluation_may_cost_a_hundred_times_the_cheapest() {
        let of = |cheapest| EvaluationCost { start: 1.0, cheapest, dearest: 0.0, at: String::new() }.limit();
        assert_eq!((of(1e-4), of(0.1)), (0.5, 10.0));
    }
}
