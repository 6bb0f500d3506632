//! A bake-off: every choice of a setting is tried, and ranked by how well it explains the same data.

use super::objective::{Objective, Question};
use super::plan::Choice;
use super::result::{Compared, Outcome, Trial, compared};
use super::target::Target;
use crate::error::InputError;
use crate::inference::scores;

/// Resamplings of the data for the ranks.
const REPEATS: usize = 2000;

/// Evaluates and ranks all choices. One that fails stays in the table with its reason.
pub(super) fn try_all(objective: &Objective<'_>) -> Result<Outcome, InputError> {
    let plan = objective.plan;
    let blocks = plan.blocks.len();
    let setting = |choice: &Choice, block: usize| choice.in_case(&plan.blocks[block].request.case);
    let questions: Vec<Question> = plan
        .choices
        .iter()
        .flat_map(|choice| (0..blocks).map(move |block| Question { block, settings: setting(choice, block) }))
        .collect();
    let records = objective.ask(&questions)?;
    let mut trials: Vec<Trial> = Vec::new();
    let mut first_error = None;
    for (choice, records) in plan.choices.iter().zip(records.chunks(blocks)) {
        let named = |target: &Target| target.with_variant(|variant| variant.replace("{choice}", &choice.name));
        let both = |held_out: bool| compared(objective, held_out, |block| records.get(block), named);
        match both(false) {
            // what is held out must not decide who is ranked
            Ok(fit) => trials.push(match both(true) {
                Ok(hold_out) => Trial::of(choice.name.clone(), fit, hold_out),
                Err(error) => Trial {
                    hold_out_failure: Some(error.to_string()),
                    ..Trial::of(choice.name.clone(), fit, Vec::new())
                },
            }),
            Err(error) => {
                trials.push(Trial::failed(choice.name.clone(), error.to_string()));
                first_error.get_or_insert(error);
            }
        }
    }
    let worked: Vec<&Trial> = trials.iter().filter(|trial| trial.failure.is_none()).collect();
    let residuals = |data: &[Compared]| data.iter().map(|datum| datum.residual).collect::<Vec<f64>>();
    let choices: Vec<scores::Choice> = worked
        .iter()
        .map(|trial| scores::Choice { name: trial.name.clone(), residuals: residuals(&trial.fit), parameters: 0 })
        .collect();
    let Some(ranked) = scores::rank(&choices, REPEATS, plan.budget.seed) else {
        let nothing = InputError::Search { file: plan.file.clone(), reason: "no choice gave numbers".to_owned() };
        return Err(first_error.unwrap_or(nothing));
    };
    for trial in &mut trials {
        trial.score(ranked.iter().find(|score| score.name == trial.name));
    }
    let weight = |trial: &Trial| trial.chi_squared.unwrap_or(f64::INFINITY);
    trials.sort_by(|a, b| weight(a).total_cmp(&weight(b)));
    Ok(Outcome::of_trials(plan, trials))
}
