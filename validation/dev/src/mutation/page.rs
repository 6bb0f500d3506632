//! The findings as a table for the terminal and as Markdown.

use super::{Detection, LEAST_CAUGHT, LEAST_GATED, MutationOutcome, shares_caught, tally};
use crate::number::short_digits;
use std::fmt::Write as _;

/// Kind of detection, in a word.
fn word(catch: &Detection) -> &'static str {
    match catch {
        Detection::Gate(_) => "gate",
        Detection::Stop(_) => "stop",
        Detection::Test(_) => "test",
        Detection::Snapshot => "snapshot only",
        Detection::Nothing => "NOTHING",
    }
}

/// Broken gate with its value and limit, or the message of a stopped run.
fn witness(finding: &MutationOutcome) -> String {
    match &finding.catch {
        Detection::Gate(broken) => {
            let digits = |value| short_digits(value, 4);
            let Some(first) = broken.first() else { return String::new() };
            let metric = &first.metric;
            let limit = metric.gate.as_ref().map_or_else(String::new, |gate| gate.limit.in_words(digits));
            let others = if broken.len() > 1 { format!(" and {} more", broken.len() - 1) } else { String::new() };
            let value = digits(metric.value);
            format!(
                "{} {} [{}] = {value} {}, must be {limit}{others}",
                first.case, metric.name, metric.variant, metric.unit
            )
        }
        Detection::Stop(message) | Detection::Test(message) => message.clone(),
        Detection::Snapshot | Detection::Nothing => finding.first_drift.clone(),
    }
}

/// The shares in a sentence each, with what they must be.
fn shares(findings: &[MutationOutcome]) -> String {
    let all = findings.len();
    let tally = tally(findings);
    let [gate, stop, test, snapshot, nothing] = tally;
    if all > 0 && gate + stop + snapshot == 0 {
        return format!("{all} errors: {test} caught by their tests, {nothing} by nothing.\n");
    }
    let (caught, gated) = shares_caught(tally);
    let [caught, least_caught, gated, least_gated] =
        [caught, LEAST_CAUGHT, gated, LEAST_GATED].map(|share| format!("{:.1} %", 100.0 * share));
    format!(
        "{all} errors: {gate} caught by a gate, {stop} by a run that stopped, {snapshot} by the snapshot only, {nothing} by nothing.\n\
         Caught: {caught} (at least {least_caught}). By a gate or a stop: {gated} (at least {least_gated}).\n",
    )
}

/// A line per error, those that no gate noticed last, then the shares.
pub fn table(findings: &[MutationOutcome]) -> String {
    let mut text = String::new();
    let width = findings.iter().map(|finding| finding.error.name.len()).max().unwrap_or(0);
    for finding in findings {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:width$}  {:13}  {}", finding.error.name, word(&finding.catch), witness(finding));
    }
    text + "\n" + &shares(findings)
}

/// A row of a table in Markdown.
fn row(cells: &[&str]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|").replace('\n', " ")).collect();
    format!("| {} |\n", cells.join(" | "))
}

/// The findings as a table in Markdown, with what is wrong, which cases ran, and a last column.
fn rows(findings: &[MutationOutcome], last: (&str, impl Fn(&MutationOutcome) -> String)) -> String {
    let heads = row(&["mutation", "what is wrong", "killed by", "witness", "cases", last.0]) + &row(&["---"; 6]);
    let line = |finding: &MutationOutcome| {
        let MutationOutcome { error, catch, cases, .. } = finding;
        let cells = [word(catch), &witness(finding), &cases.join(", "), &last.1(finding)];
        row(&[&[error.name.as_str(), &error.description], &cells[..]].concat())
    };
    heads + &findings.iter().map(line).collect::<String>()
}

/// A drawn mutation in one line: place, rule, right → wrong, what detected it, seconds.
pub fn drawn_line(finding: &MutationOutcome) -> String {
    let (word, witness) = (word(&finding.catch), witness(finding));
    format!("{}; {word}: {witness} ({:.1} s)", finding.error.description, finding.wall_seconds)
}

/// 95 % interval of Wilson for a share, of `part` among `all` `[-]`.
fn share_interval(part: usize, all: usize) -> (f64, f64) {
    /// Of the normal distribution, for 19 cases of 20.
    const QUANTILE: f64 = 1.959_963_985;
    let (part, all, square) = (part as f64, all as f64, QUANTILE * QUANTILE);
    let centre = (part + square / 2.0) / (all + square);
    let half = QUANTILE * (part * (all - part) / all + square / 4.0).sqrt() / (all + square);
    (centre - half, centre + half)
}

/// The findings of a draw as Markdown: its title and a sentence on how it was drawn, shares with their intervals, a row per mutation.
pub fn drawn_page(sentence: &str, findings: &[MutationOutcome]) -> String {
    let all = findings.len().max(1);
    let [gate, stop, test, snapshot, nothing] = tally(findings);
    let mut text =
        format!("# Drawn mutations\n\n{sentence}\n\n| killed by | mutations | share % | 95 % interval % |\n");
    text += "| --- | --- | --- | --- |\n";
    for (by, part) in [
        ("a gate", gate),
        ("a run that stopped", stop),
        ("a gate or a run that stopped", gate + stop),
        ("a test alone", test),
        ("the snapshot alone", snapshot),
        ("nothing: survived", nothing),
    ] {
        let (lower, upper) = share_interval(part, all);
        let share = part as f64 / all as f64;
        text += &format!("| {by} | {part} | {:.0} | {:.0} … {:.0} |\n", 100.0 * share, 100.0 * lower, 100.0 * upper);
    }
    text + "\n" + &rows(findings, ("s", |finding| format!("{:.1}", finding.wall_seconds)))
}

/// The findings as Markdown, with the shares.
pub fn page(findings: &[MutationOutcome]) -> String {
    let rows = rows(findings, ("values moved", |finding| finding.drifted.to_string()));
    format!("# Mutations\n\n{}\n{rows}", shares(findings))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_wilson() {
        // Brown, Cai and DasGupta (2001), and by hand
        for (part, all, lower, upper) in [(0, 10, 0.0, 0.278), (5, 10, 0.237, 0.763), (10, 10, 0.722, 1.0)] {
            let interval = share_interval(part, all);
            assert!((interval.0 - lower).abs() < 5e-4 && (interval.1 - upper).abs() < 5e-4, "{interval:?}");
        }
    }
}
