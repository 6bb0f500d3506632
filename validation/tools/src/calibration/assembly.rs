//! From the answer of a search to a result in physical units, with the data beside the model.

use super::findings;
use super::objective::Objective;
use super::plan::{CalibratedParameter, CalibrationPlan};
use super::repeated::Repeated;
use super::result::{CalibrationResult, DatumComparison, ElementaryEffect, Evaluation, ParameterEstimate};
use super::target::{Datum, Target};
use crate::ToolError;
use crate::inference::Answer;
use crate::inference::posterior::Posterior;
use crate::measured::{Measurements, read_overlay, with_overlay};
use crate::sampling::Spacing;

/// Samples of the posterior that are kept.
const MOST_SAMPLES: usize = 1000;

/// The data of one kind beside the answers of their blocks.
pub(super) fn compared<'r>(
    objective: &Objective<'_>,
    held_out: bool,
    answer: impl Fn(usize) -> Option<&'r Repeated>,
    named: impl Fn(&Target) -> Target,
) -> Result<Vec<DatumComparison>, ToolError> {
    let one = |(place, datum): (usize, &Datum)| {
        let target = named(&datum.target);
        let model = objective.predict(datum, &target, answer(datum.block))?;
        Ok(DatumComparison {
            block: objective.plan.blocks[datum.block].field.clone(),
            label: target.label(),
            at: target.place(),
            datum: datum.value,
            band: datum.band(),
            model,
            unit: datum.unit.clone(),
            residual: datum.residual(model) * if held_out { 1.0 } else { objective.weight(place) },
            scatter: if held_out { 0.0 } else { objective.scatter(place) },
            predicted: None,
            spread: 0.0,
            source: datum.source.clone(),
        })
    };
    objective.data_of(held_out).enumerate().map(one).collect()
}

/// The fitted cases as complete files, each once, with the measurements that they name; where evaluations are repeated, with
/// the first seed.
pub(super) fn calibrated(
    objective: &Objective<'_>,
    values: &[f64],
) -> Result<(Vec<String>, Vec<Measurements>), ToolError> {
    let plan = objective.plan;
    let (mut texts, mut kept) = (Vec::new(), Vec::<Measurements>::new());
    for place in (0..plan.blocks.len()).filter(|&k| !plan.blocks[k].held_out && !plan.blocks[k].is_law) {
        let request = &plan.blocks[place].request;
        let first = &objective.with_seeds(&objective.question(place, values))[0];
        let prepared = request.prepare(objective.registry, &plan.file, &first.settings, plan.limits)?;
        let mut overlay = read_overlay(prepared.as_ref(), &request.overlay, &[])?;
        for own in &mut overlay {
            // files of one name that two cases have in different folders
            if kept.iter().any(|other| other.kept() == own.kept() && other.text != own.text) {
                own.path.set_file_name(format!("{}-{}.csv", own.name(), place + 1));
            }
        }
        texts.push(with_overlay(prepared.parameters_toml(), &overlay));
        kept.extend(overlay);
    }
    Ok((texts, kept))
}

/// Everything about a search, in physical units; with samples of the posterior if they were asked for.
pub(super) fn assemble(
    plan: &CalibrationPlan,
    answer: &Answer,
    sensitivity: Vec<ElementaryEffect>,
    (fit, hold_out): (Vec<DatumComparison>, Result<Vec<DatumComparison>, String>),
    (calibrated, measured): (Vec<String>, Vec<Measurements>),
    truth_inside: Option<bool>,
    posterior: Option<&Posterior>,
) -> CalibrationResult {
    let search = &answer.search;
    let count = plan.repeats.count;
    let seeds = if count > 1 { format!(", every evaluation the mean of {count} seeds,") } else { String::new() };
    let region = answer.explored.as_ref().map(|explored| &explored.region);
    let mut findings = findings::of(plan, answer, &fit);
    let hold_out = hold_out.unwrap_or_else(|reason| {
        findings.push(format!("the held-out runs failed at the best parameters: {reason}"));
        Vec::new()
    });
    let correlation = region.map_or_else(Vec::new, |region| {
        region.correlation.row_iter().map(|row| row.iter().copied().collect()).collect()
    });
    let evaluation = |point: &[f64], chi_squared: Option<f64>| Evaluation { values: plan.values(point), chi_squared };
    CalibrationResult {
        title: plan.title.clone(),
        note: plan.note.clone(),
        method: plan.method.name().to_owned() + &seeds,
        stopped: search.stopped.to_string(),
        searched: answer.searched,
        evaluations: search.history.iter().map(|own| evaluation(&own.point, own.chi_squared)).collect(),
        parameters: found(plan, answer, posterior),
        samples: posterior.map_or_else(Vec::new, |posterior| {
            let every = (posterior.samples.len() / MOST_SAMPLES).max(1);
            posterior.samples.iter().step_by(every).map(|sample| plan.values(sample)).collect()
        }),
        minima: search.minima.iter().map(|own| evaluation(&own.point, Some(own.chi_squared))).collect(),
        chi_squared: Some(search.chi_squared),
        reduced_chi_squared: region.and_then(|region| region.reduced_chi_squared),
        p_value: region.and_then(|region| region.p_value),
        inflation: region.map_or(1.0, |region| region.inflation),
        correlation,
        region: region.map_or_else(Vec::new, |region| {
            let curves = region.profiles.iter().flat_map(|profile| &profile.curve);
            curves.filter(|point| point.rise <= region.limit).map(|point| plan.values(&point.point)).collect()
        }),
        covered: Some(search.covered()),
        truth_inside,
        findings,
        sensitivity,
        fit,
        hold_out,
        calibrated,
        measured,
        ..CalibrationResult::default()
    }
}

/// Estimates of all parameters.
fn found(plan: &CalibrationPlan, answer: &Answer, posterior: Option<&Posterior>) -> Vec<ParameterEstimate> {
    let best = plan.values(&answer.search.best);
    let found = |(k, parameter): (usize, &CalibratedParameter)| {
        let physical = |u: f64| parameter.bounds.value(u);
        let profile = answer.explored.as_ref().map(|explored| &explored.region.profiles[k]);
        let ends = answer.explored.as_ref().map(|explored| &explored.ends[k]);
        ParameterEstimate {
            name: parameter.name.clone(),
            unit: parameter.unit.clone(),
            bounds: (parameter.bounds.lower, parameter.bounds.upper),
            logarithmic: parameter.bounds.spacing == Spacing::Log,
            start: parameter.start,
            best: best[k],
            interval: profile.map(|profile| (physical(profile.interval[0]), physical(profile.interval[1]))),
            gaps: profile.map_or_else(Vec::new, |profile| {
                profile.gaps.iter().map(|[lower, upper]| (physical(lower[k]), physical(upper[k]))).collect()
            }),
            open: ends.map_or((false, false), |[below, above]| (below.open, above.open)),
            settled: ends.map_or((false, false), |[below, above]| (below.settled, above.settled)),
            rise: ends.map_or((None, None), |[below, above]| (below.rise, above.rise)),
            credible: posterior.map(|posterior| posterior.intervals[k].map(physical).into()),
            profile: profile.map_or_else(Vec::new, |profile| {
                profile.curve.iter().map(|point| (physical(point.point[k]), point.rise)).collect()
            }),
            truth: parameter.truth,
        }
    };
    plan.parameters.iter().enumerate().map(found).collect()
}
