//! Morris screening with the model itself: which parameters the data feel at all, over the whole ranges.

use super::objective::Objective;
use super::result::ElementaryEffect;
use crate::ToolError;
use crate::inference::sensitivity;

/// Effects of every parameter; empty without trajectories.
pub(super) fn screen(objective: &mut Objective<'_>, trajectories: usize) -> Result<Vec<ElementaryEffect>, ToolError> {
    if trajectories == 0 {
        return Ok(Vec::new());
    }
    let parameters = objective.plan.parameters.len();
    let seed = objective.plan.budget.seed;
    let effects = sensitivity::screen(objective, parameters, trajectories, seed)?;
    let plan = objective.plan;
    Ok(plan
        .parameters
        .iter()
        .zip(&effects)
        .map(|(parameter, effect)| ElementaryEffect {
            name: parameter.name.clone(),
            effect: effect.mean_size,
            spread: effect.deviation,
        })
        .collect())
}
