//! A bake-off: every choice of a setting is tried, and ranked by how well it explains the same data.

use super::assembly::compared;
use super::objective::{Objective, Question};
use super::plan::{CalibrationPlan, Choice};
use super::result::{CalibrationResult, ChoiceResult, DatumComparison, weighted_error};
use super::target::Target;
use crate::ToolError;
use crate::inference::scores;

/// Resamplings of the data for the ranks.
const REPEATS: usize = 2000;

/// Weight above which a choice is not refuted.
const RIVAL: f64 = 0.05;

/// Data below which resampling them says little about ranks.
const FEW_DATA: usize = 10;

/// Evaluates and ranks all choices. One that fails stays in the table with its reason.
pub(super) fn try_all(objective: &Objective<'_>) -> Result<CalibrationResult, ToolError> {
    let plan = objective.plan;
    let blocks = plan.blocks.len();
    let setting = |choice: &Choice, block: usize| choice.in_case(&plan.blocks[block].request.case);
    let questions: Vec<Question> = plan
        .choices
        .iter()
        .flat_map(|choice| (0..blocks).map(move |block| Question { block, settings: setting(choice, block) }))
        .collect();
    let answers = objective.ask(&questions)?;
    let mut trials: Vec<ChoiceResult> = Vec::new();
    let mut first_error = None;
    for (choice, answers) in plan.choices.iter().zip(answers.chunks(blocks)) {
        let named = |target: &Target| target.with_variant(|variant| variant.replace("{choice}", &choice.name));
        let both = |held_out: bool| compared(objective, held_out, |block| answers.get(block), named);
        match both(false) {
            // what is held out must not decide who is ranked
            Ok(fit) => trials.push(match both(true) {
                Ok(hold_out) => ChoiceResult::of(choice.name.clone(), fit, hold_out),
                Err(error) => ChoiceResult {
                    hold_out_failure: Some(error.to_string()),
                    ..ChoiceResult::of(choice.name.clone(), fit, Vec::new())
                },
            }),
            Err(error) => {
                let (name, failure) = (choice.name.clone(), Some(error.to_string()));
                trials.push(ChoiceResult { name, failure, ..ChoiceResult::default() });
                first_error.get_or_insert(error);
            }
        }
    }
    let worked: Vec<&ChoiceResult> = trials.iter().filter(|trial| trial.failure.is_none()).collect();
    let residuals = |data: &[DatumComparison]| data.iter().map(|datum| datum.residual).collect::<Vec<f64>>();
    let choices: Vec<(String, Vec<f64>)> =
        worked.iter().map(|trial| (trial.name.clone(), residuals(&trial.fit))).collect();
    let Some(ranked) = scores::rank(&choices, REPEATS, plan.budget.seed) else {
        let nothing = || ToolError::at(&plan.file, "no choice gave numbers".to_owned());
        return Err(first_error.unwrap_or_else(nothing));
    };
    for trial in &mut trials {
        let score = ranked.iter().find(|score| score.name == trial.name);
        trial.weight = score.map(|score| score.weight);
        trial.first = score.map(|score| score.first);
        trial.ranks = score.map(|score| (score.ranks[0], score.ranks[1]));
    }
    let weight = |trial: &ChoiceResult| trial.chi_squared.unwrap_or(f64::INFINITY);
    trials.sort_by(|a, b| weight(a).total_cmp(&weight(b)));
    Ok(CalibrationResult::of_trials(plan, trials))
}

impl CalibrationResult {
    pub(super) fn of_trials(plan: &CalibrationPlan, trials: Vec<ChoiceResult>) -> Self {
        Self {
            title: plan.title.clone(),
            note: plan.note.clone(),
            method: "all choices".to_owned(),
            stopped: "done: every choice was tried".to_owned(),
            searched: trials.len(),
            inflation: 1.0,
            findings: undecided(&trials),
            trials,
            ..Self::default()
        }
    }
}

/// Open questions of a bake-off, in sentences; the best choice comes first.
fn undecided(trials: &[ChoiceResult]) -> Vec<String> {
    let is_rival = |trial: &&ChoiceResult| {
        trial.weight.is_some_and(|weight| weight >= RIVAL) || trial.ranks.is_some_and(|(best, _)| best == 1)
    };
    let rivals: Vec<&str> = trials.iter().filter(is_rival).map(|trial| trial.name.as_str()).collect();
    let mut findings = Vec::new();
    if rivals.len() > 1 {
        findings.push(format!(
            "the data do not discriminate between {}: each has a weight of 5 % or more, or ranks first in 2.5 % of resampled data",
            rivals.join(", ")
        ));
    }
    let failed: Vec<&str> =
        trials.iter().filter(|trial| trial.failure.is_some()).map(|trial| trial.name.as_str()).collect();
    if !failed.is_empty() {
        findings.push(format!("{} failed and could not be ranked; the table gives the reasons", failed.join(", ")));
    }
    let data = trials.iter().map(|trial| trial.fit.len()).max().unwrap_or(0);
    if data < FEW_DATA {
        findings.push(format!("{data} data are too few to rank choices by resampling; use the weights"));
    }
    let best = trials.iter().find(|trial| trial.failure.is_none());
    if let Some(error) = best.and_then(|trial| weighted_error(&trial.fit)).filter(|error| *error > 2.0) {
        findings.push(format!(
            "even the best choice differs from the data by {error:.1} standard uncertainties, so the weights have little \
             meaning"
        ));
    }
    findings
}

impl ChoiceResult {
    pub(super) fn of(name: String, fit: Vec<DatumComparison>, hold_out: Vec<DatumComparison>) -> Self {
        let sum = |data: &[DatumComparison]| data.iter().map(|datum| datum.residual * datum.residual).sum();
        Self {
            name,
            chi_squared: Some(sum(&fit)),
            hold_out_chi_squared: (!hold_out.is_empty()).then(|| sum(&hold_out)),
            fit,
            hold_out,
            ..Self::default()
        }
    }
}
