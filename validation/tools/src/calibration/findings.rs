//! Open questions of a calibration, in sentences: of the search, of the fit, of the intervals.

use super::law;
use super::plan::{CalibratedParameter, CalibrationPlan};
use super::result::DatumComparison;
use crate::inference::diagnosis::{outliers, widest_step};
use crate::inference::search::Evaluated;
use crate::inference::{Answer, Explored, ParameterLabel, Region, SerialCorrelation, Termination, UNLIKELY, assess};
use crate::number::{four_digits, short_digits};

/// Factor of wider intervals that is told `[-]`.
const WIDER: f64 = 1.05;
/// Distance from a bound, as a share of the range, that is none.
const AT_BOUND: f64 = 1e-6;

/// Everything that a search and its region leave open, the gravest first.
pub(super) fn of(plan: &CalibrationPlan, answer: &Answer, fit: &[DatumComparison]) -> Vec<String> {
    let mut findings = of_search(plan, answer);
    match &answer.explored {
        None => {
            findings.push("too few evaluations succeeded to estimate the uncertainty of the parameters".to_owned());
        }
        Some(explored) => {
            findings.extend(of_fit(plan.parameters.len(), explored.region.p_value, fit));
            findings.extend(answer.correlation.filter(|own| own.factor > WIDER).map(correlated));
            findings.extend(stepped(plan, answer, explored, fit));
            findings.extend(rough(plan, answer, &explored.region));
            findings.extend(of_region(plan, explored));
            findings.extend(law::beyond(plan, &plan.values(&answer.search.best), fit));
        }
    }
    findings
}

fn of_search(plan: &CalibrationPlan, answer: &Answer) -> Vec<String> {
    let search = &answer.search;
    let mut findings = Vec::new();
    if matches!(search.stopped, Termination::BudgetSpent | Termination::Stalled | Termination::Plateau) {
        findings.push(format!("the search did not converge: {}", search.stopped));
    }
    if !search.every_start {
        findings.push(format!(
            "not all {} other starts were followed, so there may be a lower minimum; allow more `evaluations`",
            plan.budget.starts
        ));
    }
    let rival = answer.explored.as_ref().map_or(0.0, |explored| explored.region.threshold);
    for minimum in search.minima.iter().filter(|minimum| minimum.chi_squared - search.chi_squared <= rival).skip(1) {
        let names = plan.parameters.iter().zip(plan.values(&minimum.point));
        let place: Vec<String> =
            names.map(|(parameter, value)| format!("`{}` = {}", parameter.name, short_digits(value, 3))).collect();
        let why = if plan.repeats.count > 1 { " (that of the smooth fit through all runs)" } else { "" };
        findings.push(format!(
            "a second minimum also agrees with the data at 95 %: {} with χ² {}, the best{why} has {}",
            place.join(", "),
            short_digits(minimum.chi_squared, 3),
            short_digits(search.chi_squared, 3)
        ));
    }
    findings
}

/// Findings from the residuals at the best point.
fn of_fit(parameters: usize, p_value: Option<f64>, fit: &[DatumComparison]) -> Vec<String> {
    let mut findings = Vec::new();
    match p_value {
        Some(p) if p < UNLIKELY => findings.push(format!(
            "the model does not explain the data within their uncertainties (p = {}): the model or a datum is wrong, or the \
             uncertainties are too small",
            short_digits(p, 2)
        )),
        Some(p) if p > 1.0 - UNLIKELY => findings.push(format!(
            "the data agree with the model better than their uncertainties allow (1 − p = {}): the uncertainties are too \
             large, or the errors are correlated",
            short_digits(1.0 - p, 2)
        )),
        _ => {}
    }
    let residuals: Vec<f64> = fit.iter().map(|datum| datum.residual).collect();
    for (place, distance) in outliers(&residuals, parameters) {
        let datum = &fit[place];
        findings.push(format!(
            "the datum `{}` = {} {} of `{}` is an outlier, {} robust standard deviations from the others; check it, or use \
             loss = \"huber\"",
            datum.label,
            short_digits(datum.datum, 4),
            datum.unit,
            datum.block,
            short_digits(distance, 2)
        ));
    }
    findings
}

/// Finding of correlated residuals, whose intervals are widened already.
fn correlated(SerialCorrelation { coefficient, factor }: SerialCorrelation) -> String {
    format!(
        "neighbouring residuals are correlated (coefficient {}): errors depend on each other, or model and data differ in shape; \
         the intervals are therefore {} times as wide as for independent errors",
        short_digits(coefficient, 2),
        short_digits(factor, 2)
    )
}

/// Finding of a model that gives the same at parameters between which it should change, as fronts of whole rows of particles do.
fn stepped(plan: &CalibrationPlan, answer: &Answer, explored: &Explored, fit: &[DatumComparison]) -> Option<String> {
    let worst = answer.search.chi_squared + 2.0 * explored.region.limit;
    let step = widest_step(&explored.region.jacobian(), &answer.search.history, worst)?;
    let ends = step.points.map(|point| plan.values(point));
    let name =
        |k: usize| format!("`{}` {} and {}", plan.parameters[k].name, four_digits(ends[0][k]), four_digits(ends[1][k]));
    let places: Vec<String> = (0..ends[0].len()).filter(|&k| ends[0][k] != ends[1][k]).map(name).collect();
    Some(format!(
        "χ² has steps, which more evaluations do not settle: `{}` is the same at {}, where it should differ by {} σ; refine \
         `spacing`, raise the `thickness` of front gauges (in the measurements too){}{}",
        fit[step.datum].label,
        places.join(", "),
        short_digits(step.promised, 2),
        if fit[step.datum].at.is_none() { ", fit a series" } else { "" },
        if plan.repeats.count == 1 { ", or set `repeats`" } else { ", or give more `repeats`" }
    ))
}

/// Finding of runs whose χ² lies farther from its smooth fit than what bounds the intervals.
fn rough(plan: &CalibrationPlan, answer: &Answer, region: &Region) -> Option<String> {
    let of_run = |run: &Evaluated| Some((run.point.clone(), run.chi_squared?));
    let near: Vec<(Vec<f64>, f64)> = answer.search.history.iter().filter_map(of_run).collect();
    let near: Vec<(Vec<f64>, f64)> = near.into_iter().filter(|(point, _)| region.rise(point) <= region.limit).collect();
    let off = |(point, own): &(Vec<f64>, f64)| (own - region.emulator.chi_squared(point)).powi(2);
    let scatter = (near.iter().map(off).sum::<f64>() / near.len() as f64).sqrt();
    let least = near.iter().map(|run| run.1).reduce(f64::min)?;
    let alike = || near.iter().filter(|run| run.1 <= least + region.limit).map(|run| plan.values(&run.0));
    let span = |(k, parameter): (usize, &CalibratedParameter)| {
        let ends = [f64::min, f64::max].map(|end| alike().map(|values| values[k]).reduce(end));
        let [from, to] = ends.map(|end| four_digits(end.unwrap_or(f64::NAN)));
        (from != to).then(|| format!("`{}` {from} … {to}", parameter.name))
    };
    let spans: Vec<String> = plan.parameters.iter().enumerate().filter_map(span).collect();
    let alike = match &spans[..] {
        [] => "its least value is that of a single run, and the intervals given are not to be quoted".to_owned(),
        spans => format!("the runs at {} agree alike, so take no narrower interval", spans.join(", ")),
    };
    let [scattered, bound] = [(scatter, 2), (region.limit, 3)].map(|(value, digits)| short_digits(value, digits));
    let lower = near.iter().filter(|run| run.1 < region.minimum.chi_squared).count();
    // repeats scatter, and their smooth fit is what counts
    (scatter > region.limit).then(|| match plan.repeats.count {
        1 => format!(
            "χ² of single runs scatters by {scattered} about its smooth fit, more than the {bound} that bound the intervals: \
             {alike}; refine `spacing`, or set `repeats`"
        ),
        _ => format!(
            "χ² of single runs scatters by {scattered} between `repeats`: the best point is that of its smooth fit through all \
             runs, of which {lower} have a lower χ² by chance"
        ),
    })
}

fn of_region(plan: &CalibrationPlan, explored: &Explored) -> Vec<String> {
    let region = &explored.region;
    let physical = |k: usize, u: f64| plan.parameters[k].bounds.value(u);
    let names: Vec<ParameterLabel> =
        plan.parameters.iter().map(|p| ParameterLabel { name: p.name.clone(), unit: p.unit.clone() }).collect();
    let mut findings: Vec<String> =
        assess(&region.jacobian(), region, &names, &physical).iter().map(ToString::to_string).collect();
    for (k, (parameter, ends)) in names.iter().zip(&explored.ends).enumerate() {
        for (end, word) in ends.iter().zip(["lower", "upper"]) {
            let at_bound = |other: &usize| *other != k && !(AT_BOUND..=1.0 - AT_BOUND).contains(&end.point[*other]);
            if let Some(other) = (0..names.len()).find(at_bound).filter(|_| !end.open) {
                findings.push(format!(
                    "the {word} end of `{}` is where `{}` meets its bound: wider bounds would move it",
                    parameter.name, names[other].name
                ));
            }
            if !end.settled {
                let (open, given, or) = match plan.repeats.count {
                    1 => {
                        ("the model has not confirmed", ", and the wider of what it and its emulator say is given", "")
                    }
                    _ => {
                        ("too few runs lie about, or they lie above their smooth fit at,", "", ", or narrow the bounds")
                    }
                };
                findings.push(format!(
                    "interval not settled: {open} the {word} end of `{}`{given}; allow more `region_evaluations`{or}",
                    parameter.name
                ));
            } else if end.fails {
                findings.push(format!("the model fails beyond the {word} end of `{}`", parameter.name));
            }
        }
    }
    if !explored.joint_settled && explored.ends.iter().flatten().all(|end| end.settled) {
        let open = "the model and its emulator disagree at the edge; allow more `region_evaluations`";
        findings.push(format!("joint region not settled: {open}"));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::super::target::ProfileLocation;
    use super::*;
    use crate::inference::chi_squared_tail;
    use crate::sampling::Random;

    /// A profile of fitted data with these residuals.
    fn fit(residuals: &[f64]) -> Vec<DatumComparison> {
        let datum = |(k, residual): (usize, &f64)| DatumComparison {
            block: "fit[0]".to_owned(),
            label: format!("u at {k}"),
            at: Some(ProfileLocation {
                table: "profile".to_owned(),
                x: "y [m]".to_owned(),
                y: "u [m/s]".to_owned(),
                at: k as f64,
            }),
            datum: 1.0,
            band: (0.9, 1.1),
            model: 1.0 + 0.1 * residual,
            unit: "m/s".to_owned(),
            residual: *residual,
            scatter: 0.0,
            predicted: None,
            spread: 0.0,
            source: "a test".to_owned(),
        };
        residuals.iter().enumerate().map(datum).collect()
    }

    fn findings(residuals: &[f64]) -> Vec<String> {
        let chi_squared = residuals.iter().map(|residual| residual * residual).sum();
        of_fit(2, Some(chi_squared_tail(chi_squared, residuals.len() - 2)), &fit(residuals))
    }

    fn normal(seed: u64, scale: f64) -> Vec<f64> {
        let mut random = Random::new(seed);
        (0..15).map(|_| scale * random.normal()).collect()
    }

    #[test]
    fn correct_data_raise_nothing_in_nine_of_ten_experiments() {
        let raised = (0..200).filter(|seed| !findings(&normal(*seed, (13.0_f64 / 15.0).sqrt())).is_empty()).count();
        assert!(raised <= 20, "{raised} of 200");
    }

    #[test]
    fn uncertainties_three_times_too_large_or_small_are_told() {
        for seed in 0..10 {
            assert!(findings(&normal(seed, 0.3))[0].contains("better than their uncertainties allow"));
            assert!(findings(&normal(seed, 3.0))[0].contains("does not explain the data"));
        }
    }

    #[test]
    fn outliers_are_named() {
        let mut residuals = normal(3, 1.0);
        residuals[4] = 12.0;
        residuals[12] = -12.0;
        let found = findings(&residuals);
        assert!(found.iter().any(|text| text.contains("`u at 4` = 1 m/s of `fit[0]`")), "{found:?}");
        assert!(found.iter().any(|text| text.contains("`u at 12`")), "{found:?}");
    }
}
