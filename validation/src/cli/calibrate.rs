//! `bagnold calibrate`: parameters from data.

use super::arguments::CalibrateArguments;
use super::count::CountBar;
use super::error::ProgramError;
use super::{Exit, Session, folder_of};
use crate::calibration::{
    CalibrationFolder, CalibrationMonitor, CalibrationPlan, CalibrationResult, EvaluationCost, calibrate, write,
};
use crate::number::aligned_digits;
use indicatif::HumanDuration;
use std::time::Duration;

/// Calibrates, writes the page and prints the parameters.
pub(super) fn run(command: &CalibrateArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let mut plan = CalibrationPlan::read(&command.file, session.registry, command.allowance.limits())?;
    let folder = folder_of(command.out.as_ref(), "reports/calibrations", &command.file);
    let kept = CalibrationFolder::begin(&folder, &command.file, session.registry.origin(), command.resume)?;
    if plan.choices.is_empty() {
        // other starts may take as many evaluations again, and a search among runs that scatter goes before with its intervals
        let scatter = usize::from(plan.repeats.count > 1);
        let grid = plan.levels.iter().product();
        let searches = (1 + usize::from(plan.budget.starts > 0)) * (1 + scatter);
        let search = if plan.levels.is_empty() { searches * plan.budget.evaluations } else { grid };
        let search = search + scatter * plan.region_evaluations;
        let each = plan.blocks.iter().filter(|block| !block.held_out && !block.is_law).count() * plan.repeats.count;
        let intervals = plan.region_evaluations + scatter;
        let simulations = if each == 0 { String::new() } else { format!("; simulations per evaluation: {each}") };
        let rest = format!("{intervals} for intervals{simulations}");
        session.note(&format!("planned evaluations: up to {search} for the search, {rest}"));
    }
    if let Some(cost) = EvaluationCost::of(&plan, session.registry) {
        let is_limited = command.allowance.most_hours.is_some() || std::env::var_os("BAGNOLD_MOST_HOURS").is_some();
        if !is_limited {
            plan.limits.core_hours = plan.limits.core_hours.min(cost.limit());
        }
        session.note(&cost_in_words(&cost, plan.limits.core_hours));
    }
    let bar = CountBar::new("simulations", 0, 0, session.quiet);
    bar.plan(plan.usual_evaluations());
    let outcome = calibrate(&plan, &kept, session.registry, &command.work.open_store(), &bar)?;
    drop(bar);
    write(&outcome, &plan, &folder, command.figures.format())?;
    session.say(&text(&outcome));
    let beyond = outcome.evaluations.len().saturating_sub(outcome.searched);
    let (searched, simulations) = (outcome.searched, outcome.simulations);
    session
        .say(&format!("evaluations: {searched} for the search, {beyond} for intervals; simulations: {simulations}\n"));
    let open = outcome.findings.len();
    let found = outcome.parameters.iter().map(|found| format!("{} = {}", found.name, aligned_digits(found.best)));
    let found: Vec<String> =
        found.chain(outcome.trials.first().map(|best| format!("best of the choices: {}", best.name))).collect();
    session.say(&format!("{}; findings: {open}. Report: {}\n", found.join(", "), folder.join("index.html").display()));
    Ok(Exit::Held)
}

/// Cost of an evaluation at the start and at the dearest corner of the box.
fn cost_in_words(cost: &EvaluationCost, limit: f64) -> String {
    let time = |hours: f64| HumanDuration(Duration::from_secs_f64((3600.0 * hours).clamp(1.0, 1e12)));
    let (start, dearest) = (time(cost.start), time(cost.dearest));
    let mut text = format!("core time of an evaluation: about {start} at the start, {dearest} at {}", cost.at);
    if cost.dearest > limit {
        text += &format!("; simulations above {} count as failed (--most-hours)", time(limit));
    }
    text
}

/// The parameters or choices, a line each, and what the data leave open.
fn text(outcome: &CalibrationResult) -> String {
    let mut text = String::new();
    for found in &outcome.parameters {
        let words = || format!("  95 %: {}", found.intervals_in_words(aligned_digits));
        let interval = found.interval.map_or_else(String::new, |_| words());
        let unit = if found.unit == "-" { "" } else { &found.unit };
        text += &format!("{} = {} {unit}{interval}\n", found.name, aligned_digits(found.best));
    }
    for trial in &outcome.trials {
        let optional = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), aligned_digits);
        text += &format!(
            "{}: χ² {}, held-out χ² {}, weight {}{}\n",
            trial.name,
            optional(trial.chi_squared),
            optional(trial.hold_out_chi_squared),
            optional(trial.weight),
            trial.failure.as_ref().map_or_else(String::new, |reason| format!("; failed: {reason}"))
        );
    }
    let error = |what: &str, data: &[crate::calibration::DatumComparison]| {
        crate::calibration::weighted_error(data)
            .map_or_else(String::new, |error| format!("{what}: {} σ over {} data\n", aligned_digits(error), data.len()))
    };
    text += &error("fit error", &outcome.fit);
    text += &error("held-out error", &outcome.hold_out);
    for finding in &outcome.findings {
        text += &format!("finding: {finding}\n");
    }
    text
}

impl CalibrationMonitor for CountBar {
    fn expected(&self, evaluations: usize) {
        self.expect(evaluations);
    }

    fn evaluated(&self, case: &str, failure: Option<&str>) {
        if let Some(reason) = failure {
            tracing::warn!("{case}: {reason}");
        }
        self.say(case);
        self.step();
    }
}
