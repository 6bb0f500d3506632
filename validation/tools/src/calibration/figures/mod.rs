//! Figures of a calibration, from its outcome alone.

mod corner;
mod pairs;

use super::result::{CalibrationResult, DatumComparison, ParameterEstimate};
use crate::figure::{Axis, Figure, Panel};
use crate::inference::chi_squared_quantile;
use crate::statistics::grouped;

/// All figures that the outcome has the numbers for.
pub(super) fn all(outcome: &CalibrationResult) -> Vec<Figure> {
    let mut figures = Vec::new();
    figures.extend(history(outcome));
    figures.extend(profiles(outcome));
    figures.extend(pairs::figure(outcome));
    figures.extend(corner::figure(outcome));
    if outcome.trials.is_empty() {
        figures.extend(agreement("fit", "Data that were fitted, and the model.", &outcome.fit));
        let caption = "Data that were held out, and the model's prediction.";
        figures.extend(agreement("hold-out", caption, &outcome.hold_out));
    } else {
        figures.extend(trials(outcome));
    }
    figures.extend(sensitivity(outcome));
    figures
}

pub(super) fn axis(parameter: &ParameterEstimate) -> Axis {
    let label = format!("{} [{}]", parameter.name, parameter.unit);
    if parameter.logarithmic { Axis::logarithmic(&label) } else { Axis::linear(&label) }
}

fn history(outcome: &CalibrationResult) -> Option<Figure> {
    let points: Vec<(f64, f64)> = outcome
        .evaluations
        .iter()
        .enumerate()
        .filter_map(|(k, evaluation)| evaluation.chi_squared.map(|chi| ((k + 1) as f64, chi)))
        .collect();
    if points.len() < 2 {
        return None;
    }
    let mut least = f64::INFINITY;
    let best = points.iter().map(|&(k, chi)| {
        least = least.min(chi);
        (k, least)
    });
    let best: Vec<(f64, f64)> = best.collect();
    let mut first = Panel::new("", Axis::linear("evaluation [-]"), Axis::logarithmic("χ² [-]"));
    first.points("evaluation", 0, points);
    first.line("best so far", 1, best);
    let mut panels = vec![first];
    for (k, parameter) in outcome.parameters.iter().enumerate() {
        let mut panel = Panel::new("", Axis::linear("evaluation [-]"), axis(parameter));
        let values = outcome.evaluations.iter().enumerate().map(|(n, e)| ((n + 1) as f64, e.values[k]));
        panel.points("", 0, values);
        if let Some(truth) = parameter.truth {
            let last = outcome.evaluations.len() as f64;
            panel.reference("truth", [(1.0, truth), (last, truth)]);
        }
        panels.push(panel);
    }
    let caption = "All evaluations of the search, followed by those at the ends of the intervals.";
    Some(Figure::new("history", caption, panels))
}

fn profiles(outcome: &CalibrationResult) -> Option<Figure> {
    let threshold = outcome.inflation * outcome.inflation * chi_squared_quantile(0.95, 1);
    let mut panels = Vec::new();
    for parameter in outcome.parameters.iter().filter(|parameter| parameter.profile.len() > 1) {
        let mut panel = Panel::new("", axis(parameter), Axis::linear("χ² above its minimum [-]"));
        let highest = 3.0 * threshold;
        let points: Vec<(f64, f64)> = parameter.profile.iter().copied().filter(|point| point.1 <= highest).collect();
        let ends = points.first().zip(points.last()).map(|(first, last)| (first.0, last.0)).unwrap_or_default();
        panel.line("profile", 0, points);
        panel.reference("95 %", [(ends.0, threshold), (ends.1, threshold)]);
        panel.points("best", 1, [(parameter.best, 0.0)]);
        let (rise, open, are_runs) = (parameter.rise, parameter.open, outcome.has_runs_at_ends());
        let emulated = |is_open: bool| (!are_runs && !is_open).then_some(threshold);
        let interval = parameter.interval.map(|(low, high)| {
            [(low, rise.0.or_else(|| emulated(open.0))), (high, rise.1.or_else(|| emulated(open.1)))]
        });
        let points = interval.into_iter().flatten().filter_map(|(value, rise)| Some((value, rise?)));
        panel.points(&format!("ends: {}", outcome.ends_in_words()), 3, points.filter(|point| point.1 <= highest));
        if let Some(truth) = parameter.truth.filter(|truth| *truth >= ends.0 && *truth <= ends.1) {
            panel.points("truth", 2, [(truth, 0.0)]);
        }
        panels.push(panel);
    }
    let columns = panels.len().min(3);
    let caption = "Profile likelihood: χ² with all other parameters at their best, on an emulator of the \
                   evaluations. Values below the dashed line agree with the data at 95 %.";
    (columns > 0).then(|| Figure::new("profiles", caption, panels).in_columns(columns))
}

/// One panel a group of data: profiles over their abscissa, single numbers model over datum.
fn agreement(name: &str, caption: &str, data: &[DatumComparison]) -> Option<Figure> {
    let title = |datum: &DatumComparison| match &datum.at {
        Some(place) => place.table.clone(),
        None => datum.label.split(' ').next().unwrap_or_default().to_owned(),
    };
    let groups = grouped(data.iter().map(|datum| (title(datum), datum)));
    let tables: Vec<&str> =
        groups.iter().filter(|(_, members)| members[0].at.is_some()).map(|(title, _)| title.as_str()).collect();
    let (head, tail) = common_ends(&tables);
    let titled = |(title, members): &(String, Vec<&DatumComparison>)| match members[0].at {
        Some(_) if tables.len() > 1 => panel(&title[head..title.len() - tail], members),
        Some(_) => panel("", members),
        None => panel(title, members),
    };
    let panels: Vec<Panel> = groups.iter().map(titled).collect();
    let mut caption = format!(
        "{caption} Error bars of data: one standard uncertainty. Bands and bars of the model: 95 % interval of the posterior prediction."
    );
    if let Some(first) = tables.first() {
        let middle = if tables.len() > 1 { "…" } else { &first[head..first.len() - tail] };
        caption += &format!(" Profiles of {}{middle}{}.", &first[..head], &first[first.len() - tail..]);
    }
    let columns = panels.len().min(3);
    (columns > 0).then(|| Figure::new(name, &caption, panels).in_columns(columns))
}

/// Bytes that all names begin and end with, without splitting a word at a hyphen.
fn common_ends(names: &[&str]) -> (usize, usize) {
    let Some((first, others)) = names.split_first() else { return (0, 0) };
    if others.is_empty() {
        return (0, 0);
    }
    let shared = |same: &dyn Fn(&str) -> usize| others.iter().map(|other| same(other)).min().unwrap_or(0);
    let head = shared(&|other| first.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count());
    let tail = shared(&|other| first.bytes().rev().zip(other.bytes().rev()).take_while(|(a, b)| a == b).count());
    let head = first[..head].rfind('-').map_or(0, |place| place + 1);
    let tail = first[first.len() - tail..].find('-').map_or(0, |place| tail - place);
    let shortest = names.iter().map(|name| name.len()).min().unwrap_or(0);
    if head + tail < shortest { (head, tail) } else { (0, 0) }
}

fn panel(title: &str, members: &[&DatumComparison]) -> Panel {
    let first = members[0];
    let half = |datum: &&DatumComparison| 0.5 * (datum.band.1 - datum.band.0);
    let errors: Vec<f64> = members.iter().map(half).collect();
    if let Some(place) = &first.at {
        let mut panel = Panel::new(title, Axis::linear(&place.x), Axis::linear(&place.y));
        let of = |value: fn(&DatumComparison) -> f64| -> Vec<(f64, f64)> {
            members.iter().filter_map(|datum| Some((datum.at.as_ref()?.at, value(datum)))).collect()
        };
        let band = |datum: &&DatumComparison| {
            datum.predicted.zip(datum.at.as_ref()).map(|((low, high), place)| (place.at, low, high))
        };
        let band: Vec<(f64, f64, f64)> = members.iter().filter_map(band).collect();
        if band.len() > 1 {
            panel.band("model, 95 %", band);
        }
        panel.line("model", 0, of(|datum| datum.model));
        panel.points("data", 1, of(|datum| datum.datum)).error = errors;
        return panel;
    }
    let label = |what: &str| format!("{title}, {what} [{}]", first.unit);
    let mut panel = Panel::new("", Axis::linear(&label("model")), Axis::linear(&label("datum")));
    let values: Vec<f64> = members.iter().flat_map(|datum| [datum.datum, datum.model]).collect();
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
    panel.reference("equal", [(low, low), (high, high)]);
    for (place, datum) in members.iter().enumerate() {
        if let Some((low, high)) = datum.predicted {
            let label = if place == 0 { "model, 95 %" } else { "" };
            panel.line(label, 0, [(low, datum.datum), (high, datum.datum)]);
        }
    }
    panel.points("data", 1, members.iter().map(|datum| (datum.model, datum.datum))).error = errors;
    panel
}

fn trials(outcome: &CalibrationResult) -> Option<Figure> {
    let worked: Vec<_> = outcome.trials.iter().filter(|trial| trial.failure.is_none()).collect();
    let data = worked.first()?.fit.len();
    let mut panel = Panel::new("", Axis::linear("datum by number [-]"), Axis::linear("(model − datum)/σ [-]"));
    panel.band("±2 σ", [(0.5, -2.0, 2.0), (data as f64 + 0.5, -2.0, 2.0)]);
    for (slot, trial) in worked.iter().enumerate() {
        let points = trial.fit.iter().enumerate().map(|(k, datum)| ((k + 1) as f64, datum.residual));
        panel.line_points(&trial.name, slot, points);
    }
    Some(Figure::new("choices", "Weighted residuals of every choice, in the order of the table of data.", vec![panel]))
}

fn sensitivity(outcome: &CalibrationResult) -> Option<Figure> {
    if outcome.sensitivity.is_empty() {
        return None;
    }
    let (mean, scatter) = ("mean effect μ* [σ per range]", "scatter σ of the effects [σ per range]");
    let mut panel = Panel::new("", Axis::linear(mean), Axis::linear(scatter));
    for (slot, effect) in outcome.sensitivity.iter().enumerate() {
        if effect.effect.is_finite() && effect.spread.is_finite() {
            panel.points(&effect.name, slot, [(effect.effect, effect.spread)]);
        }
    }
    let caption = "Morris screening over the whole ranges: the data are sensitive to parameters on the right; those at \
                   the top act nonlinearly or interact with others.";
    Some(Figure::new("sensitivity", caption, vec![panel]))
}

#[cfg(test)]
mod tests {
    use super::common_ends;

    #[test]
    fn names_are_told_apart_by_their_middle() {
        let names = ["profile-angle-22-start-rest", "profile-angle-23.5-start-rest"];
        let (head, tail) = common_ends(&names);
        assert_eq!(names.map(|name| &name[head..name.len() - tail]), ["22", "23.5"]);
        assert_eq!(common_ends(&["a-b"]), (0, 0));
        assert_eq!(common_ends(&[]), (0, 0));
    }
}
